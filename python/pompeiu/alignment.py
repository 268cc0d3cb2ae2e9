"""Moving one mesh onto another, from any start, also where only parts match."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Optional

import numpy as np

from . import _native
from .sources import Mesh, MeshLike, as_mesh

__all__ = ["Registration", "align"]


@dataclass(frozen=True, eq=False, repr=False)
class Registration:
    """Where a mesh belongs on another. Nothing of it is proven; the distance of ``mesh`` can be.

    Attributes
    ----------
    mesh : Mesh
        The moved mesh.
    matrix : numpy.ndarray
        The map, of shape (4, 4): it acts on columns ``(x, y, z, 1)``.
    scale : float
        The factor by which it scales; 1 unless a scale was asked for.
    scale_deviation : float, optional
        One standard deviation of that factor, if it was asked for, as if the distances of the samples were independent errors.
    turn_degrees : float
        The angle of its rotation.
    matched : float
        The share of the area of the moved mesh that lies within ``reach`` of the fixed one.
    reach : float
        That length.
    rms : float
        Root mean square distance of what the fit rests on: the overlap asked for, or what is within four standard deviations.
    spread : float
        Root mean square distance of what is matched, as a share of ``reach``: 0.3 at most but for noise, 0.45 where surfaces merely cross.
    fits : bool
        Whether the surfaces lie on each other where they are matched, over a fifth of the area at least. If not, the shapes seem to be
        different ones.
    is_unique : bool
        Whether it fits, no other place that was tried fits nearly as well, and no motion is free.
    alternatives : list of dict
        Other places that fit nearly as well, with ``matrix``, ``matched`` and ``rms``, and the turn that leads to them from the best:
        ``apart_degrees`` about ``axis`` through ``point``, with a ``slide`` along it.
    free_motions : list of dict
        Motions that leave the fit as it is, with ``point``, ``turn`` and ``shift``.
    stop : str
        Why it ended.
    """

    mesh: Mesh
    matrix: np.ndarray
    scale: float
    scale_deviation: Optional[float]
    turn_degrees: float
    matched: float
    reach: float
    spread: float
    fits: bool
    rms: float
    is_unique: bool
    alternatives: List[Dict[str, Any]]
    free_motions: List[Dict[str, Any]]
    stop: str

    def __repr__(self) -> str:
        unique = "" if self.is_unique else ", not unique" if self.fits else ", does not fit"
        return f"Registration({100 * self.matched:.1f} % matched{unique}, turned by {self.turn_degrees:.4g} degrees)"


def align(
    moving: MeshLike,
    fixed: MeshLike,
    *,
    scale: bool = False,
    overlap: Optional[float] = None,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    progress: Optional[Callable[[float], Optional[bool]]] = None,
) -> Registration:
    """Moves a mesh onto another by a rotation and a translation, from any start, also where only parts match.

    Parameters
    ----------
    moving : MeshLike
        The mesh to move.
    fixed : MeshLike
        The mesh that stays.
    scale : bool
        Finds a factor of scale, too; the meshes must overlap nearly whole.
    overlap : float, optional
        The share of the area of ``moving`` that has a counterpart; by default the spread of the distances tells.
    threads, time_limit : optional
        Limits; the best place so far is returned when the time is over.
    progress : callable, optional
        Called with the share that is done; ``False`` ends it.

    Raises
    ------
    OptionError
        If a mesh has no area, the sizes are too far apart, or the overlap is not a share.

    Examples
    --------
    >>> import numpy as np, pompeiu
    >>> box = pompeiu.shapes.cube(1.0, 4)
    >>> part = pompeiu.Mesh(box.vertices * [3.0, 2.0, 1.0], box.faces)
    >>> turn = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    >>> found = pompeiu.align(pompeiu.Mesh(part.vertices @ turn.T + 5.0, part.faces), part)
    >>> pompeiu.hausdorff(found.mesh, part).upper < 1e-9
    True
    """
    made, text, is_unique = _native.register(
        as_mesh(moving),
        as_mesh(fixed),
        scale,
        None if overlap is None else float(overlap),
        (threads, time_limit, None),
        progress,
    )
    report = json.loads(text)
    report["matrix"] = np.array(report["matrix"])
    return Registration(mesh=made, is_unique=is_unique, **report)
