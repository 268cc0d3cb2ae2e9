"""Cutting surfaces open and laying them flat, one-to-one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Dict, Literal, Optional, Sequence, Tuple, Union

import numpy as np

from . import _native
from ._asking import ask
from .errors import OptionError
from .results import _read_only
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
    mesh : Mesh or None
        With ``straighten``, the mesh into which the cut was inserted; where edges were divided for a boundary with straight sides, the
        mesh with the new vertices. The other numbers are those of its vertices and faces.
    """

    coordinates: np.ndarray
    corners: np.ndarray
    vertex_map: np.ndarray
    edges: np.ndarray
    face_distortion: np.ndarray
    report: Dict[str, Any]
    mesh: Optional[Mesh] = None

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


def cut(
    mesh: MeshLike,
    *,
    strategy: Literal["auto", "genus", "euclidean", "geodesic", "tips", "medial", "medial-tree", "bones"] = "auto",
    cuts: Optional[int] = None,
    spread: Optional[float] = None,
    balls: int = 30,
    sections: bool = False,
    through: Sequence[int] = (),
    along: Sequence[Sequence[int]] = (),
    forbid: Sequence[int] = (),
    forbid_edges: Sequence[Sequence[int]] = (),
    forbid_faces: Sequence[int] = (),
    forbid_box: Optional[Sequence[float]] = None,
    avoid_curvature: float = 0.0,
    symmetry: Optional[Union[str, Sequence[float]]] = None,
    straighten: bool = False,
) -> Cut:
    """Opens a surface along edges, so that each of its parts becomes a disk.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold.
    strategy : str
        The method that chooses the edges to cut. ``"auto"``: what leaves a disk of each part; the tips of a sphere
        joined; ``"genus"``: the least that makes a disk of what is neither a disk nor a sphere; ``"euclidean"``: the
        farthest pair of vertices in space joined, then the vertex farthest from the cut; ``"geodesic"``: the same with
        distances along the surface; ``"tips"``: what leaves a disk, and all tips; ``"medial"``: the touched vertices
        farthest apart of the balls at the ends of the longest path between balls; ``"medial-tree"``: what leaves a
        disk, and the vertices nearest to the centres of balls; ``"bones"``: a path along each edge of the shortest tree
        between balls.
    cuts : int, optional
        Number of cuts of the strategies euclidean and geodesic; with spread the most, 1 and 100 unless given.
    spread : float, optional
        With the strategies euclidean and geodesic, go on until the standard deviation of the distance from the cut is
        at most S √area.
    balls : int
        Number of balls of the strategies medial, medial-tree and bones.
    sections : bool
        With the strategy bones, cut along an arc around the surface where each bone begins, too.
    through : Sequence[int]
        Join these vertices, counted from 0, by shortest paths, instead of a strategy.
    along : Sequence[Sequence[int]]
        Cut along this path of vertices joined by edges, and along nothing else; may be repeated.
    forbid : Sequence[int]
        Let no cut touch these vertices.
    forbid_edges : Sequence[Sequence[int]]
        Let no cut take this edge, given by its ends; may be repeated.
    forbid_faces : Sequence[int]
        Let no cut enter these faces; it may run along their border.
    forbid_box : Sequence[float], optional
        Let no cut touch the vertices in this box, given by its least and its greatest coordinates.
    avoid_curvature : float
        Let paths keep away from curvature: an edge costs its length times 1 + W |κ| √area.
    symmetry : Union[str, Sequence[float]], optional
        Keep a plane in which the surface is its own mirror image: x, y or z for the plane across that axis through the
        origin, x=C through C, or NX,NY,NZ,D for all points p with N · p = D; with the strategies auto, genus and tips,
        and with through.
    straighten : bool
        Straighten the cut across faces, and insert it into the mesh.

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
    answer, beside = ask("cut", locals())
    vertex_map = _read_only(np.asarray(answer["report"]["vertex_map"], dtype=np.uint32))
    return Cut(beside["mesh"], vertex_map, beside["edges"])


def flatten(
    mesh: MeshLike,
    *,
    strategy: Literal["auto", "genus", "euclidean", "geodesic", "tips", "medial", "medial-tree", "bones"] = "auto",
    cuts: Optional[int] = None,
    spread: Optional[float] = None,
    balls: int = 30,
    sections: bool = False,
    through: Sequence[int] = (),
    along: Sequence[Sequence[int]] = (),
    forbid: Sequence[int] = (),
    forbid_edges: Sequence[Sequence[int]] = (),
    forbid_faces: Sequence[int] = (),
    forbid_box: Optional[Sequence[float]] = None,
    avoid_curvature: float = 0.0,
    symmetry: Optional[Union[str, Sequence[float]]] = None,
    straighten: bool = False,
    boundary: Union[str, Sequence[Sequence[float]]] = "free",
    weights: Literal["uniform", "cotangent", "mean-value"] = "mean-value",
    energy: Literal["symmetric-dirichlet", "lscm", "spectral", "arap"] = "symmetric-dirichlet",
    virtual_layers: int = 0,
    virtual_scale: float = 1.2,
    virtual_kind: Literal["intrinsic", "extrinsic"] = "intrinsic",
    target: float = 4.25,
    most_cuts: Optional[int] = None,
    charts: Union[int, str] = "components",
    max_distortion: Optional[float] = None,
    pack: bool = True,
    precision: Literal["double", "single"] = "double",
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    progress: Optional[Callable[[float], Optional[bool]]] = None,
) -> Flattening:
    """Cuts a surface open and lays it flat: no face flipped, no two faces on each other.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold.
    strategy : str
        The method that chooses the edges to cut. ``"auto"``: what leaves a disk of each part; the tips of a sphere
        joined; ``"genus"``: the least that makes a disk of what is neither a disk nor a sphere; ``"euclidean"``: the
        farthest pair of vertices in space joined, then the vertex farthest from the cut; ``"geodesic"``: the same with
        distances along the surface; ``"tips"``: what leaves a disk, and all tips; ``"medial"``: the touched vertices
        farthest apart of the balls at the ends of the longest path between balls; ``"medial-tree"``: what leaves a
        disk, and the vertices nearest to the centres of balls; ``"bones"``: a path along each edge of the shortest tree
        between balls.
    cuts : int, optional
        Number of cuts of the strategies euclidean and geodesic; with spread the most, 1 and 100 unless given.
    spread : float, optional
        With the strategies euclidean and geodesic, go on until the standard deviation of the distance from the cut is
        at most S √area.
    balls : int
        Number of balls of the strategies medial, medial-tree and bones.
    sections : bool
        With the strategy bones, cut along an arc around the surface where each bone begins, too.
    through : Sequence[int]
        Join these vertices, counted from 0, by shortest paths, instead of a strategy.
    along : Sequence[Sequence[int]]
        Cut along this path of vertices joined by edges, and along nothing else; may be repeated.
    forbid : Sequence[int]
        Let no cut touch these vertices.
    forbid_edges : Sequence[Sequence[int]]
        Let no cut take this edge, given by its ends; may be repeated.
    forbid_faces : Sequence[int]
        Let no cut enter these faces; it may run along their border.
    forbid_box : Sequence[float], optional
        Let no cut touch the vertices in this box, given by its least and its greatest coordinates.
    avoid_curvature : float
        Let paths keep away from curvature: an edge costs its length times 1 + W |κ| √area.
    symmetry : Union[str, Sequence[float]], optional
        Keep a plane in which the surface is its own mirror image: x, y or z for the plane across that axis through the
        origin, x=C through C, or NX,NY,NZ,D for all points p with N · p = D; with the strategies auto, genus and tips,
        and with through.
    straighten : bool
        Straighten the cut across faces, and insert it into the mesh.
    boundary : Union[str, Sequence[Sequence[float]]]
        The shape of the boundary in the plane: free, circle, square, own or polygon:X,Y;… with the corners of a convex
        polygon, counter-clockwise.
    weights : str
        Weights of edges where the boundary goes to a convex curve. ``"uniform"``: equal weights: Tutte's embedding.
        Ignores the shapes of faces; ``"cotangent"``: half the sum of the opposite cotangents, on the intrinsic Delaunay
        triangulation: the discrete harmonic map. Faces of the original surface may flip; mean value weights are then
        used instead; ``"mean-value"``: floater's mean value weights, which are always positive.
    energy : str
        The distortion that is minimised where the boundary is free. ``"symmetric-dirichlet"``: lengths, without flips
        and overlaps; ``"lscm"``: angles, two vertices held; faces may flip; ``"spectral"``: angles, by an eigenvector;
        faces may flip; ``"arap"``: lengths, as rigid as possible; faces may flip.
    virtual_layers : int
        Layers of faces that are mapped around a convex boundary's disk and then dropped, so that its own boundary is
        freer.
    virtual_scale : float
        The ratio of the widths of two successive layers.
    virtual_kind : str
        The source of the lengths of their edges. ``"intrinsic"``: from circles: layer k lies on the circle of radius r
        aᵏ, where 2 π r is the length of the boundary, at angles proportional to the lengths of its edges. Edges of the
        boundary keep their lengths; ``"extrinsic"``: from positions in space: layer k is the boundary scaled about its
        centroid by aᵏ.
    target : float
        Add cuts until the mean symmetric Dirichlet energy is at most this (isometry: 4).
    most_cuts : int, optional
        Most cuts that are added to a chart; where nothing is said 6 to 32, the more the fewer faces there are, or 12
        where charts are divided.
    charts : Union[int, str]
        How many charts: components for one of each connected part, a number, or auto for as many as the distortion
        needs.
    max_distortion : float, optional
        Divide charts until the mean symmetric Dirichlet energy of the whole map is at most this (isometry: 4); 4.1
        where nothing is said and the number of charts is auto.
    pack : bool
        Pack all charts into the unit square; otherwise a single chart stays as large as the surface, where the method
        puts it.
    precision : str
        Numbers in which the coordinates of the map are kept; single where the file that is written holds no others, as
        GLB does. ``"double"``: 53 bits: every mesh in memory; ``"single"``: 24 bits: files such as STL and GLB.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
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
    answer, beside = ask("flatten", locals())
    return Flattening(report=answer["report"], **beside)


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
    tolerance: float = 0.001,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
) -> Medial:
    """Fills a closed surface with few balls, and bounds how far they are from it.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold without boundary.
    balls : int
        Number of balls; fewer are left if so many cannot be told apart.
    samples : int
        Points of the surface from which balls are shrunk.
    tolerance : float
        Width of the interval of the distance from the surface to the balls, over the diagonal of the box around the
        surface.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.

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
    answer, beside = ask("medial", locals())
    report = answer["report"]
    lower, upper = report["deviation"]["surface_to_balls"]
    return Medial(
        surface_to_balls=(lower, upper),
        balls_to_surface=report["deviation"]["balls_to_surface"],
        stop=answer["stop"],
        **beside,
    )
