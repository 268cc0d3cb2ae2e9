"""Cutting surfaces open and laying them flat, one-to-one."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Callable, Dict, Optional, Sequence, Tuple, Union

import numpy as np

from . import _native
from .errors import OptionError
from .sources import Mesh, MeshLike, as_mesh

__all__ = ["Cut", "Flattening", "Medial", "Straightened", "cut", "flatten", "medial", "straighten"]


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

    @property
    def parts(self) -> list[Dict[str, Any]]:
        """What is said of each chart: its faces, its cut and its distortion."""
        return self.report["parts"]

    def __repr__(self) -> str:
        verdict = "one-to-one" if self.is_one_to_one else "not one-to-one"
        return f"Flattening({verdict}, {self.charts} charts, {len(self.edges)} edges cut)"


def _cutting(
    strategy: str,
    cuts: Optional[int],
    through: Optional[Sequence[int]],
    along: Optional[Sequence[Sequence[int]]],
    balls: int,
    sections: bool,
    forbidden: Sequence[int],
    forbidden_edges: Sequence[Sequence[int]],
    forbidden_faces: Sequence[int],
    curvature: float,
    spread: Optional[float],
    symmetry: Optional[Sequence[float]],
) -> Dict[str, Any]:
    if through is not None and along is not None:
        raise OptionError("through and along are both given; choose one")
    if cuts is None:
        cuts = 1 if spread is None else 100
    if cuts < 1:
        raise OptionError(f"the number of cuts is {cuts}; at least 1 is needed")
    if balls < 1:
        raise OptionError(f"the number of balls is {balls}; at least 1 is needed")

    plane = None if symmetry is None else [float(x) for x in symmetry]
    if plane is not None and len(plane) != 4:
        raise OptionError(f"symmetry has {len(plane)} numbers; a plane is given by 4, its normal and its offset")

    def indices(list_: Sequence[int], of: str = "vertex") -> list[int]:
        found = [int(i) for i in list_]
        for i in found:
            if not 0 <= i < 2**32:
                raise OptionError(f"there is no {of} {i}")
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
        "through": indices([] if through is None else through),
        "along": [indices(path) for path in ([] if along is None else along)],
        "balls": int(balls),
        "sections": bool(sections),
        "forbidden": indices(forbidden),
        "forbidden_edges": [indices(ends) for ends in forbidden_edges],
        "forbidden_faces": indices(forbidden_faces, "face"),
        "curvature": float(curvature),
        "spread": None if spread is None else float(spread),
        "symmetry": None if plane is None else (plane[:3], plane[3]),
    }


def cut(
    mesh: MeshLike,
    *,
    strategy: str = "auto",
    cuts: Optional[int] = None,
    through: Optional[Sequence[int]] = None,
    along: Optional[Sequence[Sequence[int]]] = None,
    balls: int = 30,
    sections: bool = False,
    forbidden: Sequence[int] = (),
    forbidden_edges: Sequence[Sequence[int]] = (),
    forbidden_faces: Sequence[int] = (),
    curvature: float = 0.0,
    spread: Optional[float] = None,
    symmetry: Optional[Sequence[float]] = None,
) -> Cut:
    """Opens a surface along edges, so that each of its parts becomes a disk.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold.
    strategy : str
        ``"auto"``: what leaves disks; ``"genus"``: the least that makes disks of what are neither disks nor spheres;
        ``"euclidean"``: the farthest pair of vertices joined, then the vertex farthest from the cut, both in space; ``"geodesic"``: the
        same along the surface; ``"tips"``: what leaves disks, joined with the tips; ``"medial"``, ``"medial-tree"`` and ``"bones"`` follow the balls that :func:`medial` finds: from end to
        end of the longest path between them, through the vertices nearest to their centres, along the edges of their shortest tree.
    cuts : int, optional
        Number of cuts of ``"euclidean"`` and ``"geodesic"``: 1 unless given; with ``spread`` the most, 100.
    through : sequence of int, optional
        Join these vertices by shortest paths instead.
    along : sequence of sequences of int, optional
        Cut along these paths of vertices instead, and along nothing else.
    balls : int
        Number of balls of ``"medial"``, ``"medial-tree"`` and ``"bones"``.
    sections : bool
        With ``"bones"``, an arc around the surface where each bone begins.
    forbidden : sequence of int
        Vertices that no cut may touch.
    forbidden_edges : sequence of pairs of int
        Edges that no cut may take, by their ends.
    forbidden_faces : sequence of int
        Faces that no cut may enter; it may run along their border.
    curvature : float
        Paths keep away from curvature: an edge costs its length times 1 + this |κ| √area.
    spread : float, optional
        Go on with the cuts of ``"euclidean"`` and ``"geodesic"`` until the standard deviation of the distance from the cut is at most
        this times √area.
    symmetry : sequence of 4 floats, optional
        A plane (nx, ny, nz, d) of all points p with n · p = d in which the surface is its own mirror image: the cut will be, too, and so
        will the map. Edges must run along the plane. With ``"auto"``, ``"genus"``, ``"tips"`` and ``through``.

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
    cutting = _cutting(
        strategy,
        cuts,
        through,
        along,
        balls,
        sections,
        forbidden,
        forbidden_edges,
        forbidden_faces,
        curvature,
        spread,
        symmetry,
    )
    opened, seams = _native.cut(as_mesh(mesh), cutting)
    return Cut(opened, *seams)


def flatten(
    mesh: MeshLike,
    *,
    boundary: Union[str, Sequence[Sequence[float]]] = "free",
    weights: str = "mean-value",
    energy: str = "symmetric-dirichlet",
    virtual_layers: int = 0,
    virtual_scale: float = 1.2,
    virtual_kind: str = "intrinsic",
    strategy: str = "auto",
    cuts: Optional[int] = None,
    through: Optional[Sequence[int]] = None,
    along: Optional[Sequence[Sequence[int]]] = None,
    balls: int = 30,
    sections: bool = False,
    forbidden: Sequence[int] = (),
    forbidden_edges: Sequence[Sequence[int]] = (),
    forbidden_faces: Sequence[int] = (),
    curvature: float = 0.0,
    spread: Optional[float] = None,
    symmetry: Optional[Sequence[float]] = None,
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
    energy : str
        What is least where the boundary is free: ``"symmetric-dirichlet"``, without flips and overlaps; ``"lscm"`` or
        ``"spectral"``, which keep angles, and ``"arap"``, which may flip faces.
    virtual_layers : int
        Layers of faces that are mapped around the disk of a convex boundary and then dropped.
    virtual_scale : float
        How much wider each of these layers is than the one before.
    virtual_kind : str
        Where the lengths of their edges come from: ``"intrinsic"`` from circles, ``"extrinsic"`` from places in space.
    strategy, cuts, through, along, balls, sections, forbidden, forbidden_edges, forbidden_faces, curvature, spread, symmetry
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
    if virtual_layers < 0:
        raise OptionError(f"the number of virtual layers is {virtual_layers}; it must not be negative")
    polygon = [] if isinstance(boundary, str) else [[float(x) for x in corner] for corner in boundary]
    if isinstance(boundary, str) and boundary == "polygon":
        raise OptionError("boundary is 'polygon'; give its corners")
    mapping = {
        "boundary": boundary if isinstance(boundary, str) else "polygon",
        "polygon": polygon,
        "weights": weights,
        "energy": energy,
        "virtual_layers": int(virtual_layers),
        "virtual_scale": float(virtual_scale),
        "virtual_kind": virtual_kind,
        "target": float(target),
        "most_cuts": int(most_cuts),
        "pack": bool(pack),
        "threads": threads,
        "time_limit": time_limit,
    }
    cutting = _cutting(
        strategy,
        cuts,
        through,
        along,
        balls,
        sections,
        forbidden,
        forbidden_edges,
        forbidden_faces,
        curvature,
        spread,
        symmetry,
    )
    *arrays, report = _native.flatten(as_mesh(mesh), cutting, mapping, progress)
    return Flattening(*arrays, json.loads(report))


@dataclass(frozen=True, eq=False, repr=False)
class Straightened:
    """A surface into which a straightened cut was inserted.

    Attributes
    ----------
    mesh : Mesh
        The vertices of the input, those where the cut crosses its edges, and the parts of its faces.
    edges : numpy.ndarray of int, shape (e, 2)
        The edges of the cut, which :func:`flatten` and :func:`cut` take as ``along``.
    faces : numpy.ndarray of int, shape (m,)
        For each face the face of the input that it is a part of.
    """

    mesh: Mesh
    edges: np.ndarray
    faces: np.ndarray

    def __repr__(self) -> str:
        return f"Straightened({len(self.edges)} edges)"


def straighten(mesh: MeshLike, edges: Sequence[Sequence[int]]) -> Straightened:
    """Straightens the paths of a cut across faces by edge flips, and inserts them into the mesh.

    Ends, branches and the surface stay as they are, and so do the pieces that the cut leaves. Where paths would touch each other or the
    boundary, they are left as they are.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold.
    edges : sequence of pairs of int
        The edges of the cut, by their ends: ``edges`` of :func:`cut` or :func:`flatten`.

    Raises
    ------
    SurfaceError
        If the mesh is no oriented manifold, or an edge does not exist.

    Examples
    --------
    >>> import pompeiu
    >>> torus = pompeiu.shapes.torus(2.0, 0.7, 24, 16)
    >>> straight = pompeiu.straighten(torus, pompeiu.cut(torus).edges)
    >>> pompeiu.flatten(straight.mesh, along=straight.edges).is_one_to_one
    True
    """
    pairs = [[int(v) for v in pair] for pair in edges]
    for pair in pairs:
        if len(pair) != 2 or not all(0 <= v < 2**32 for v in pair):
            raise OptionError(f"{pair} is no edge; give the numbers of its two ends")
    return Straightened(*_native.straighten(as_mesh(mesh), pairs))


@dataclass(frozen=True, eq=False, repr=False)
class Medial:
    """Balls that fill a closed surface.

    Attributes
    ----------
    centres : numpy.ndarray of float, shape (n, 3)
        Their centres.
    radii : numpy.ndarray of float, shape (n,)
        Their radii.
    edges : numpy.ndarray of int, shape (e, 2)
        Pairs of balls that lie beside each other along the medial axis.
    overlaps : numpy.ndarray of int, shape (o, 2)
        Pairs of balls that overlap.
    surface_to_balls : pair of floats
        Bounds of the greatest distance of a point of the surface from the union of the balls.
    balls_to_surface : float
        The balls reach out of the surface by this at most.
    stop : str
        Why it stopped.
    """

    centres: np.ndarray
    radii: np.ndarray
    edges: np.ndarray
    overlaps: np.ndarray
    surface_to_balls: Tuple[float, float]
    balls_to_surface: float
    stop: str

    def __repr__(self) -> str:
        return f"Medial({len(self.radii)} balls)"


def medial(
    mesh: MeshLike,
    *,
    balls: int = 30,
    samples: int = 2000,
    tolerance: float = 1e-3,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
) -> Medial:
    """Fills a closed surface with few balls, and bounds how far they are from it.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold without boundary.
    balls : int
        Number of balls in the end.
    samples : int
        Points of the surface from which balls are shrunk.
    tolerance : float
        Width of the interval ``surface_to_balls``, over the diagonal of the box around the surface.
    threads, time_limit : optional
        Limits; more balls are returned when the time is over.

    Raises
    ------
    SurfaceError
        If the mesh is no oriented manifold, or has a boundary.
    OptionError
        If options make no sense.

    Examples
    --------
    >>> import pompeiu
    >>> ball = pompeiu.medial(pompeiu.shapes.icosphere(1.0, 3), balls=1)
    >>> round(float(ball.radii[0]), 1)
    1.0
    """
    if balls < 1 or samples < 1:
        raise OptionError(f"balls is {balls} and samples is {samples}; at least 1 of each is needed")
    filling = {
        "balls": int(balls),
        "samples": int(samples),
        "tolerance": float(tolerance),
        "threads": threads,
        "time_limit": time_limit,
    }
    centres, radii, edges, overlaps, (bounds, out), stop = _native.medial(as_mesh(mesh), filling)
    return Medial(centres, radii, edges, overlaps, (bounds[0], bounds[1]), out, json.loads(stop))
