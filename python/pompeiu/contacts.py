"""Elastic solids, cloth and shells in contact that never intersect."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Literal, Mapping, Optional, Sequence, Union

import numpy as np

from . import _native
from ._asking import ask, split
from .neurons import _content
from .sources import as_mesh

__all__ = ["Contact", "contact"]


@dataclass(frozen=True, eq=False, repr=False)
class Contact:
    """Bodies at the end of a run.

    Attributes
    ----------
    positions : numpy.ndarray of float, shape (n, 3)
        Positions of all vertices, body after body.
    velocities : numpy.ndarray of float, shape (n, 3)
        Their velocities.
    faces : numpy.ndarray of int, shape (m, 3)
        The faces of all surfaces.
    checkpoint : bytes
        The state after the last step, from which ``resume`` goes on to the same bits: JSON as of ``pompeiu contact --checkpoint``.
    report : dict
        What ``pompeiu contact --json`` says of the run.
    stop : str
        Why it ended: ``"steps"`` if all steps were computed, ``"stalled"`` if one could not be, else the limit.
    """

    positions: np.ndarray
    velocities: np.ndarray
    faces: np.ndarray
    checkpoint: bytes
    report: Dict[str, Any]
    stop: str
    _page: Optional["_native.RunPage"] = None

    def __getstate__(self) -> Dict[str, Any]:
        # What the page needs does not travel.
        return {name: value for name, value in self.__dict__.items() if name != "_page"}

    @property
    def steps(self) -> List[Dict[str, Any]]:
        """What was measured after each step."""
        return self.report["steps"]

    @property
    def intersections(self) -> Optional[int]:
        """Pairs of faces that the exact test found intersecting; none if it did not run after a step."""
        certificate = self.report["certificate"]
        return certificate["intersecting"] if certificate["tested"] else None

    @property
    def failure(self) -> Optional[str]:
        """Why a step could not be computed; none if all could."""
        return self.report["failure"]

    def save_checkpoint(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the state after the last step to a file: ``resume`` of the same call goes on from it, and so does
        ``pompeiu contact --resume`` with the same scene and meshes."""
        with open(path, "wb") as file:
            file.write(self.checkpoint)

    def save_html(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes a page that plays the run, as ``pompeiu contact --report`` does. It appears whole or not at all.

        Parameters
        ----------
        path : str or path-like
            The file.

        Raises
        ------
        ValueError
            If this answer was pickled: the frames do not travel with it.
        OSError
            If the file cannot be written.
        """
        if self._page is None:
            raise ValueError("this answer was pickled: the frames of the run do not travel with it")
        _native.write_whole(path, self._page.html().encode())

    def __repr__(self) -> str:
        certificate = self.report["certificate"]
        return (
            f"Contact({self.report['scene']}, {len(self.steps)} of {self.report['asked']} steps, {certificate['intersecting']} "
            f"intersecting pairs in {certificate['tested']} tested)"
        )


def contact(
    scene: Union[str, "os.PathLike[str]", Mapping[str, Any]],
    meshes: Sequence[Any] = (),
    on_step: Optional[Callable[[Dict[str, Any], np.ndarray, np.ndarray], Optional[bool]]] = None,
    resume: Optional[Union[bytes, str, "os.PathLike[str]"]] = None,
    *,
    steps: Optional[int] = None,
    dt: Optional[float] = None,
    distance: Optional[float] = None,
    friction: Optional[float] = None,
    gravity: Optional[Sequence[float]] = None,
    pairs: Optional[Literal["exclusive", "plain"]] = None,
    projection: Optional[Literal["normal", "exact"]] = None,
    integrator: Optional[Literal["euler", "bdf2"]] = None,
    check: Optional[Literal["every", "last", "never"]] = None,
    tolerance: Optional[float] = None,
    stiffness: Optional[float] = None,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    progress: Optional[Callable[[float], Optional[bool]]] = None,
) -> Contact:
    """Lets elastic solids, cloth and shells move and touch without ever intersecting.

    Parameters
    ----------
    scene : path, str or mapping
        The file of a scene that ``pompeiu contact`` takes; the name of an example: ``"incline"``, ``"stack"``, ``"drape"``,
        ``"cloth-twist"``, ``"rod-twist"``, ``"collision"``; or a mapping with the keys of such a file.
    meshes : sequence
        Meshes of bodies that name none in the scene: paths, pairs of arrays, or other meshes (see :func:`as_mesh`) for cloth and
        shells. A path may be of tetrahedra (VTK, VTU), and so may a pair of vertices (n, 3) and cells (k, 4).
    on_step : callable, optional
        Called after each step with what was measured, positions and velocities; ``False`` ends the run.
    resume : bytes or path, optional
        The checkpoint of a run of the same scene, meshes and options to go on from, or its file (:meth:`Contact.save_checkpoint`).
    steps : int, optional
        Number of steps, from the beginning also where a state is resumed.
    dt : float, optional
        Length of a step in time.
    distance : float, optional
        The distance below which surfaces push each other.
    friction : float, optional
        Coefficient of friction.
    gravity : Sequence[float], optional
        The acceleration of gravity.
    pairs : str, optional
        The sum of barriers for a contact: exclusive pushes a point once however a flat surface is divided, plain adds
        all pairs. ``"exclusive"``: inclusion and exclusion for points: faces less inner edges plus inner vertices, so
        that a flat surface pushes a point once, however it is divided. Pairs of edges count as much as their faces are
        bent at them when a step begins; ``"plain"``: all pairs of points with triangles and of edges with edges. Inner
        edges of a flat surface push sideways.
    projection : str, optional
        The projection of second derivatives of barriers to positive semi-definite matrices. ``"normal"``: only the part
        along the normal, of rank one; ``"exact"``: the nearest positive semi-definite matrix, from an eigenproblem of
        size five.
    integrator : str, optional
        The time integrator: implicit Euler damps, bdf2 is of second order. ``"euler"``: implicit Euler: first order,
        damps oscillations; ``"bdf2"``: the backward differentiation formula of second order.
    check : str, optional
        When the exact test looks for intersections. ``"every"``: after each step; ``"last"``: when asked for:
        [`Simulation::certify`](crate::Simulation::certify); ``"never"``: not at all, but for the start.
    tolerance : float, optional
        The speed of the fastest vertex of a Newton step below which a step in time is done.
    stiffness : float, optional
        The stiffness of barriers, kept fixed; by default it is chosen from the weight and raised where surfaces come
        too close.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.

    Raises
    ------
    OptionError
        If options make no sense, or bodies intersect at the start.
    ReadError
        If the scene or a mesh cannot be read.

    Examples
    --------
    >>> import pompeiu
    >>> found = pompeiu.contact("collision", steps=3)
    >>> found.intersections, found.positions.shape
    (0, (128, 3))
    """
    given = dict(locals())
    for name in ("scene", "meshes", "on_step", "resume"):
        del given[name]
    first = ((json.dumps(dict(scene), default=_plain),),) if isinstance(scene, Mapping) else (os.fspath(scene),)
    sources = [first] + [_source(mesh) for mesh in meshes]
    if resume is not None:
        sources.append(((resume if isinstance(resume, bytes) else _content(resume),),))
    if on_step is None:
        answer, beside = ask("contact", given, meshes=(), others=sources)
    else:
        told = lambda step, positions, velocities: on_step(json.loads(step), positions, velocities)  # noqa: E731
        text, beside = _native.contact(sources, *split(given), told)
        answer = json.loads(text)
    arrays = (beside["positions"], beside["velocities"], beside["faces"])
    return Contact(*arrays, beside["checkpoint"], answer["report"], answer["stop"], beside["page"])


def _source(mesh: Any) -> Any:
    """The mesh of a body as the library takes it."""
    if isinstance(mesh, (str, os.PathLike)):
        return (os.fspath(mesh), os.fspath(mesh))
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2 and np.ndim(mesh[1]) == 2 and np.shape(mesh[1])[1] == 4:
        return ("tetrahedra", np.asarray(mesh[0], dtype=float), np.asarray(mesh[1]).tolist())
    return as_mesh(mesh)


def _plain(value: Any) -> Any:
    """Arrays, numbers of NumPy and paths for JSON."""
    return value.tolist() if hasattr(value, "tolist") else os.fspath(value)
