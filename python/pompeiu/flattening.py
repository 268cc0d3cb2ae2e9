"""Cutting surfaces open and laying them flat, one-to-one."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Callable, Dict, Optional, Sequence, Union

import numpy as np

from . import _native
from .errors import OptionError
from .sources import Mesh, MeshLike, as_mesh

__all__ = ["Cut", "Flattening", "cut", "flatten"]


@dataclass(frozen=True, eq=False, repr=False)
class Cut:
    """A surface opened along edges.

    Attributes
    ----------
    mesh : Mesh
        The opened surface: the same faces, with a copy of a vertex for each part that the cut makes of its faces. The first
        copy keeps the number of the vertex.
    vertex_map : numpy.ndarray of int, shape (n,)
        For each vertex the vertex of the input that it is a copy of.
    edges : numpy.ndarray of int, shape (e, 2)
        The ends of the edges that were cut, in the numbers of the input.
    """

    mesh: Mesh
    vertex_map: np.ndarray
    edges: np.ndarray

    def __repr__(self) -> str:
        return f"Cut({len(self.edges)} edges)"


@dataclass(frozen=True, eq=False, repr=False)
class Flattening:
    """A surface laid flat.

    Attributes
    ----------
    coordinates : numpy.ndarray of float, shape (n, 2)
        Places in the plane, one for each vertex of the opened surface.
    corners : numpy.ndarray of int, shape (m, 3)
        For each corner of each face which of these places it has.
    vertex_map : numpy.ndarray of int, shape (n,)
        For each place the vertex that it belongs to.
    edges : numpy.ndarray of int, shape (e, 2)
        The ends of the edges that were cut.
    face_distortion : numpy.ndarray of float, shape (m,)
        The symmetric Dirichlet energy of each face: 4 where lengths are kept, infinite where it is flipped.
    report : dict
        What ``pompeiu flatten --json`` says of the map.
    """

    coordinates: np.ndarray
    corners: np.ndarray
    vertex_map: np.ndarray
    edges: np.ndarray
    face_distortion: np.ndarray
    report: Dict[str, Any]

    @property
    def uv(self) -> np.ndarray:
        """The place of each corner of each face: shape (m, 3, 2)."""
        return self.coordinates[self.corners]

    @property
    def is_one_to_one(self) -> bool:
        """Whether no face is flipped and none lies on another, decided exactly on the coordinates as they are."""
        return self.report["flipped"] == 0 and self.report["overlapping"] == 0

    @property
    def charts(self) -> int:
        """Number of connected pieces of the map."""
        return self.report["charts"]

    @property
    def distortion(self) -> Dict[str, Any]:
        """How far the map is from keeping angles, areas and lengths."""
        return self.report["distortion"]

    def __repr__(self) -> str:
        verdict = "one-to-one" if self.is_one_to_one else "not one-to-one"
        return f"Flattening({verdict}, {self.charts} charts, {len(self.edges)} edges cut)"


def _cutting(
    strategy: str,
    cuts: int,
    through: Optional[Sequence[int]],
    along: Optional[Sequence[Sequence[int]]],
    forbidden: Sequence[int],
) -> Dict[str, Any]:
    if through is not None and along is not None:
        raise OptionError("through and along are both given; choose one")
    if cuts < 1:
        raise OptionError(f"the number of cuts is {cuts}; at least 1 is needed")

    def indices(list_: Sequence[int]) -> list[int]:
        found = [int(i) for i in list_]
        for i in found:
            if not 0 <= i < 2**32:
                raise OptionError(f"there is no vertex {i}")
        return found

    if through is not None:
        strategy = "through"
    elif along is not None:
        strategy = "along"
    elif strategy in ("through", "along"):
        raise OptionError(f"strategy is {strategy!r}, which is chosen by giving {strategy}")
    return {
        "strategy": strategy,
        "cuts": int(cuts),
        "through": indices(through or []),
        "along": [indices(path) for path in along or []],
        "forbidden": indices(forbidden),
    }


def cut(
    mesh: MeshLike,
    *,
    strategy: str = "auto",
    cuts: int = 1,
    through: Optional[Sequence[int]] = None,
    along: Optional[Sequence[Sequence[int]]] = None,
    forbidden: Sequence[int] = (),
) -> Cut:
    """Opens a surface along edges, so that each of its parts becomes a disk.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold.
    strategy : str
        ``"auto"``: what leaves disks; ``"genus"``: the least that makes disks of what are neither disks nor spheres;
        ``"euclidean"``: the farthest pair of vertices joined, then the vertex farthest from the cut; ``"tips"``: what leaves disks,
        joined with the tips.
    cuts : int
        Number of cuts of ``"euclidean"``.
    through : sequence of int, optional
        Join these vertices by shortest paths instead.
    along : sequence of sequences of int, optional
        Cut along these paths of vertices instead, and along nothing else.
    forbidden : sequence of int
        Vertices that no cut may touch.

    Raises
    ------
    SurfaceError
        If the mesh is no oriented manifold, or the cut does not leave disks.
    OptionError
        If options make no sense.

    Examples
    --------
    >>> import pompeiu
    >>> opened = pompeiu.cut(pompeiu.shapes.torus(2.0, 0.7, 24, 16))
    >>> opened.mesh.n_vertices - 24 * 16 == len(opened.edges) + 1
    True
    """
    opened, seams = _native.cut(as_mesh(mesh), _cutting(strategy, cuts, through, along, forbidden))
    return Cut(opened, *seams)


def flatten(
    mesh: MeshLike,
    *,
    boundary: Union[str, Sequence[Sequence[float]]] = "free",
    weights: str = "mean-value",
    strategy: str = "auto",
    cuts: int = 1,
    through: Optional[Sequence[int]] = None,
    along: Optional[Sequence[Sequence[int]]] = None,
    forbidden: Sequence[int] = (),
    target: float = 4.25,
    most_cuts: int = 6,
    pack: bool = True,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    progress: Optional[Callable[[float], Optional[bool]]] = None,
) -> Flattening:
    """Cuts a surface open and lays it flat: no face flipped, no two faces on each other.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold.
    boundary : str or sequence of pairs of floats
        ``"free"``: the least symmetric Dirichlet energy found; ``"circle"``, ``"square"``, ``"own"`` where it lies in a plane, or
        the corners of a convex polygon, counter-clockwise.
    weights : str
        Where the boundary goes to a convex curve: ``"uniform"``, ``"cotangent"`` or ``"mean-value"``.
    strategy, cuts, through, along, forbidden
        Where to cut: see :func:`cut`.
    target : float
        With a free boundary and the strategy ``"auto"``, cuts are added until the mean symmetric Dirichlet energy is at most this.
    most_cuts : int
        Most cuts that are added to a part.
    pack : bool
        Whether the map fills the unit square; a single part is otherwise as large as the surface.
    threads, time_limit : optional
        Limits; the map reached is returned when the time is over.
    progress : callable, optional
        Called with the share that is done; ``False`` ends it.

    Raises
    ------
    SurfaceError
        If the mesh is no oriented manifold, cannot be cut as asked, or the map is crowded.
    OptionError
        If options make no sense.

    Examples
    --------
    >>> import pompeiu
    >>> flat = pompeiu.flatten(pompeiu.shapes.icosphere(1.0, 3))
    >>> flat.is_one_to_one, flat.uv.shape
    (True, (1280, 3, 2))
    """
    if most_cuts < 0:
        raise OptionError(f"the number of cuts to add is {most_cuts}; it must not be negative")
    polygon = [] if isinstance(boundary, str) else [[float(x) for x in corner] for corner in boundary]
    if isinstance(boundary, str) and boundary == "polygon":
        raise OptionError("boundary is 'polygon'; give its corners")
    mapping = {
        "boundary": boundary if isinstance(boundary, str) else "polygon",
        "polygon": polygon,
        "weights": weights,
        "target": float(target),
        "most_cuts": int(most_cuts),
        "pack": bool(pack),
        "threads": threads,
        "time_limit": time_limit,
    }
    cutting = _cutting(strategy, cuts, through, along, forbidden)
    *arrays, report = _native.flatten(as_mesh(mesh), cutting, mapping, progress)
    return Flattening(*arrays, json.loads(report))
