"""Moving one mesh onto another, from any start, also where only parts match."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, Callable, Dict, List, Optional

import numpy as np

from ._asking import ask
from .results import DirectedReport, _read_only
from .sources import Mesh, MeshLike

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
    moved_to_fixed, fixed_to_moved : DirectedReport, optional
        How far the moved mesh is from the fixed one, and the other way round, proven; ``None`` without ``measure``.
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
    moved_to_fixed: Optional[DirectedReport]
    fixed_to_moved: Optional[DirectedReport]

    def __repr__(self) -> str:
        unique = "" if self.is_unique else ", not unique" if self.fits else ", does not fit"
        return f"Registration({100 * self.matched:.1f} % matched{unique}, turned by {self.turn_degrees:.4g} degrees)"


def align(
    moving: MeshLike,
    fixed: MeshLike,
    *,
    scale: bool = False,
    overlap: Optional[float] = None,
    measure: bool = True,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[int] = None,
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
        Find a factor of scale, too; the meshes must overlap nearly whole.
    overlap : float, optional
        The share of the moving surface's area that has a counterpart, such as 0.5; without it the spread of the
        distances tells.
    measure : bool
        Prove how far the moved mesh is from the fixed one, and the other way round.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
    memory_limit : int, optional
        Stop before memory exceeds so many bytes, with the answer found by then.
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
    answer, beside = ask("align", locals(), ("moving", "fixed"))
    report = answer["report"]
    given = ("matrix", "moved_to_fixed", "fixed_to_moved")
    names = [one.name for one in fields(Registration) if one.name in report and one.name not in given]
    return Registration(
        **{name: report[name] for name in names},
        matrix=_read_only(np.array(report["matrix"])),
        mesh=beside["mesh"],
        is_unique=report["unique"],
        moved_to_fixed=_proven(report["moved_to_fixed"]),
        fixed_to_moved=_proven(report["fixed_to_moved"]),
    )


def _proven(report: Optional[Dict[str, Any]]) -> Optional[DirectedReport]:
    return None if report is None else DirectedReport._of(report)
