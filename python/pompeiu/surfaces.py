"""Surfaces on their way: flow to least area, remeshing, simplification within a proven distance, self-intersections."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from .errors import OptionError
from .results import SymmetricReport
from .sources import Mesh, MeshLike, as_mesh

__all__ = ["Flow", "Intersections", "Remeshed", "Simplified", "flow", "intersections", "remesh", "simplify"]

#: Called with the number of the step, the area, and the greatest gradient along a normal; ``False`` ends the flow.
StepLike = Optional[Callable[[int, float, float], Optional[bool]]]


@dataclass(frozen=True, eq=False, repr=False)
class Flow:
    """Where a flow ended, and how it came there.

    Attributes
    ----------
    mesh : Mesh
        The surface it ended in.
    stop : str
        ``"stationary"``, ``"time"``, ``"steps"``, ``"pinched"``, ``"stalled"``, ``"degenerate"``, ``"limit"`` or ``"cancelled"``.
    steps : int
        Number of steps.
    area : tuple of float
        Area at first and at the end.
    gradient : tuple of float
        Greatest gradient of the area at a vertex, along its normal and across it: lengths.
    least_eigenvalue : float or None
        Of a stationary surface: above zero for a local minimum of the area, below for a saddle.
    report : dict
        All of it, as ``pompeiu flow --json`` has it: volume, pressure, stability, discs, cone, neck, history.
    """

    mesh: Mesh
    stop: str
    steps: int
    area: Tuple[float, float]
    gradient: Tuple[float, float]
    least_eigenvalue: Optional[float]
    report: Dict[str, Any]

    @property
    def history(self) -> List[Dict[str, Any]]:
        """Every step, the surface given first: time, area, gradient, scheme, reason."""
        return self.report["history"]

    def __repr__(self) -> str:
        return f"Flow({self.stop!r} after {self.steps} steps, area {self.area[1]:.9g}, was {self.area[0]:.9g})"


def flow(
    mesh: MeshLike,
    *,
    stationary: float = 1e-11,
    time: Optional[float] = None,
    steps: Optional[int] = None,
    scheme: Optional[str] = None,
    time_step: Optional[float] = None,
    planes: Optional[Sequence[float]] = None,
    keep_volume: bool = False,
    remesh: Union[float, None] = None,
    remesh_every: int = 5,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    progress: StepLike = None,
) -> Flow:
    """Lets a surface flow to less area: to a minimal surface, in time, or to a bubble.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold whose faces have an area.
    stationary : float
        Ends once the gradient along vertex normals is at most this part of the square root of the area; the default end.
    time : float, optional
        Ends at this time instead, in squared lengths.
    steps : int, optional
        Ends after so many steps instead.
    scheme : str, optional
        ``"normal-newton"``, ``"implicit"``, ``"conformalized"``, ``"fixed-laplacian"``, ``"explicit"``, ``"newton"`` or
        ``"newton-or-gradient"``.
    time_step : float, optional
        Length of a step in time; by default chosen step by step.
    planes : sequence of three floats, optional
        Lets each vertex of the boundary slide in the plane through it with this normal; by default the boundary stays.
    keep_volume : bool
        Keeps the enclosed volume.
    remesh : float, optional
        Remeshes to edges of this length every ``remesh_every`` steps.
    threads, time_limit : optional
        Limits; the surface reached is returned when the time is over.
    progress : callable, optional
        Called with the number of the step, the area and the gradient, at most twenty times a second; ``False`` ends the flow.

    Raises
    ------
    SurfaceError
        If the mesh is no oriented manifold, or a face has no area.
    OptionError
        If options do not belong together.

    Examples
    --------
    >>> import pompeiu
    >>> tube = pompeiu.shapes.schwarz_lantern(1.0, 1.0, 48, 12)
    >>> film = pompeiu.flow(tube)
    >>> film.stop, film.least_eigenvalue > 0
    ('stationary', True)
    >>> abs(film.area[1] / 5.991796975802282 - 1) < 5e-4
    True
    """
    if time is not None and steps is not None:
        raise OptionError("time and steps are both given; a flow has one end")
    until = ("time", float(time)) if time is not None else ("steps", float(steps)) if steps is not None else ("stationary", float(stationary))
    if until[1] < 0 or until[1] != until[1]:
        raise OptionError(f"{until[0]} is {until[1]}; it must not be negative")
    options = {
        "scheme": scheme,
        "until": until,
        "time_step": time_step,
        "planes": None if planes is None else list(planes),
        "keep_volume": keep_volume,
        "remesh": None if remesh is None else (remesh, remesh_every),
        "threads": threads,
        "time_limit": time_limit,
    }
    made, text = _native.mean_curvature_flow(as_mesh(mesh), options, progress)
    report = json.loads(text)
    stability = report["stability"]
    return Flow(
        mesh=made,
        stop=report["stop"],
        steps=report["steps"],
        area=(report["area"]["initial"], report["area"]["final"]),
        gradient=(report["gradient"]["normal"], report["gradient"]["tangential"]),
        least_eigenvalue=None if stability is None else stability["least_eigenvalue"],
        report=report,
    )


@dataclass(frozen=True, eq=False, repr=False)
class Simplified:
    """A mesh with fewer faces, and how far it is proven to be from the input.

    Attributes
    ----------
    mesh : Mesh
        The result.
    distance : SymmetricReport
        Both directed distances, enclosed: A is the input, B the result.
    collapses : int
        Number of edges collapsed.
    stop : str
        Why it ended.
    texture : tuple of ndarray or None
        Texture coordinates, shape (k, 2), and which of them each corner of each face has, shape (m, 3); ``None`` unless given.
    colors : ndarray of uint8 or None
        Colours of the vertices, shape (n, 3); ``None`` unless given.
    """

    mesh: Mesh
    distance: SymmetricReport
    collapses: int
    stop: str
    texture: Optional[Tuple[NDArray[np.float64], NDArray[np.uint32]]] = None
    colors: Optional[NDArray[np.uint8]] = None

    def __repr__(self) -> str:
        return f"Simplified({self.mesh.n_faces} faces, at most {self.distance.upper:.6g} from the input)"


def simplify(
    mesh: MeshLike,
    *,
    within: Optional[float] = None,
    faces: Optional[int] = None,
    effort: str = "best",
    features: Optional[float] = None,
    repair: bool = False,
    texture: Optional[Tuple[ArrayLike, ArrayLike]] = None,
    colors: Optional[ArrayLike] = None,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    progress: Optional[Callable[[float], Optional[bool]]] = None,
) -> Simplified:
    """Reduces the number of faces, and proves how far the result is from the input.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold.
    within : float, optional
        Largest Pompeiu–Hausdorff distance from the input. Either this or ``faces`` is given.
    faces : int, optional
        Number of faces to reach; the distance follows.
    effort : str
        ``"best"`` makes that distance small, ``"fast"`` goes by quadric errors alone.
    features : float, optional
        Keeps boundaries, and edges whose faces meet at more than this angle between their normals, in degrees.
    repair : bool
        Repairs the mesh first; the distance is measured from the mesh as it was.
    texture : tuple of array_like, optional
        Texture coordinates, shape (k, 2), and which of them each corner of each face has, shape (m, 3). Edges with other coordinates on both
        sides stay curves, and the result has coordinates of its own.
    colors : array_like of uint8, optional
        Colours of the vertices, shape (n, 3), carried over to the result.
    threads, time_limit : optional
        Limits; the mesh reached is returned when the time is over.
    progress : callable, optional
        Called with the share that is done; ``False`` ends it.

    Raises
    ------
    SurfaceError
        If the mesh is no oriented manifold.
    OptionError
        If not exactly one of ``within`` and ``faces`` is given, or it makes no sense; if a mesh with texture or colours is to be repaired.

    Examples
    --------
    >>> import pompeiu
    >>> few = pompeiu.simplify(pompeiu.shapes.icosphere(1.0, 3), within=0.05)
    >>> few.mesh.n_faces < 300 and few.distance.upper <= 0.05
    True
    """
    if (within is None) == (faces is None):
        raise OptionError("give either within, a length, or faces, a number")
    if faces is not None and faces < 0:
        raise OptionError(f"the number of faces is {faces}; at least 1 is needed")
    if effort not in ("best", "fast"):
        raise OptionError(f'effort is {effort!r}; it must be "best" or "fast"')
    if repair and not (texture is None and colors is None):
        raise OptionError("texture and colours cannot be carried over from a mesh that is repaired first; repair it before")
    options = {
        "within": None if within is None else float(within),
        "faces": faces or 0,
        "features": features,
        "repair": repair,
        "fast": effort == "fast",
        "threads": threads,
        "time_limit": time_limit,
    }
    made, text, *rest = _native.simplify(as_mesh(mesh), options, texture, colors, progress)
    return Simplified(made, SymmetricReport._of(json.loads(text)), *rest)


@dataclass(frozen=True, eq=False, repr=False)
class Remeshed:
    """A mesh with new triangles.

    Attributes
    ----------
    mesh : Mesh
        The result.
    before, after : dict
        The triangles of the input and of the result, as ``pompeiu remesh --json`` has them: ``faces``, ``edge_length``,
        ``least_angle`` (degrees; each with ``least``, ``mean``, ``greatest``), ``regular`` and so on.
    distance : SymmetricReport
        Both directed distances, enclosed: A is the input, B the result.
    iterations : int
        Number of rounds done.
    stop : str
        Why it ended.
    """

    mesh: Mesh
    before: Dict[str, Any]
    after: Dict[str, Any]
    distance: SymmetricReport
    iterations: int
    stop: str

    def __repr__(self) -> str:
        least = self.after["least_angle"]["least"]
        return f"Remeshed({self.mesh.n_faces} faces, least angle {least:.1f} degrees)"


def remesh(
    mesh: MeshLike,
    edge_length: Optional[float] = None,
    *,
    chord_height: Optional[float] = None,
    within: Optional[float] = None,
    features: Optional[float] = None,
    iterations: int = 10,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    progress: Optional[Callable[[float], Optional[bool]]] = None,
) -> Remeshed:
    """Gives a surface nearly equilateral faces of a wanted size.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold.
    edge_length : float, optional
        Length of edges. Either this or ``chord_height`` is given.
    chord_height : float, optional
        Height of chords: edges are as long as the curvature allows.
    within : float, optional
        Largest Pompeiu–Hausdorff distance from the input, to be proven.
    features : float, optional
        Keeps edges whose faces meet at more than this angle between their normals, in degrees. Boundaries are always kept.
    iterations : int
        Rounds of splits, collapses, flips and moves.
    threads, time_limit : optional
        Limits; the mesh reached is returned when the time is over.
    progress : callable, optional
        Called with the share that is done; ``False`` ends it.

    Raises
    ------
    SurfaceError
        If the mesh is no oriented manifold.
    OptionError
        If not exactly one of ``edge_length`` and ``chord_height`` is given, or an option makes no sense.

    Examples
    --------
    >>> import pompeiu
    >>> even = pompeiu.remesh(pompeiu.shapes.icosphere(1.0, 3), 0.15)
    >>> even.after["least_angle"]["least"] > 35 and even.distance.upper < 0.02
    True
    """
    if (edge_length is None) == (chord_height is None):
        raise OptionError("give either edge_length or chord_height, both are lengths")
    if iterations < 0:
        raise OptionError(f"the number of iterations is {iterations}; it must not be negative")
    options = {
        "edge_length": edge_length,
        "chord_height": chord_height,
        "within": within,
        "features": features,
        "iterations": iterations,
        "threads": threads,
        "time_limit": time_limit,
    }
    made, reports, done, stop = _native.remesh(as_mesh(mesh), options, progress)
    before, after, distance = (json.loads(text) for text in reports)
    return Remeshed(made, before, after, SymmetricReport._of(distance), done, stop)


@dataclass(frozen=True, eq=False, repr=False)
class Intersections:
    """Pairs of faces that intersect.

    Attributes
    ----------
    faces : ndarray of uint32, shape (n, 2)
        Each pair once, the lesser index first.
    places : ndarray of float64, shape (n, 3)
        A point near both faces of each pair.
    touching : int
        Number of further pairs that only touch, where different vertices are at one position.
    complete : bool
        Whether these are all; otherwise there were more than asked for.
    """

    faces: NDArray[np.uint32]
    places: NDArray[np.float64]
    touching: int
    complete: bool

    def __len__(self) -> int:
        return len(self.faces)

    def __repr__(self) -> str:
        return f"Intersections({'' if self.complete else 'more than '}{len(self)} pairs)"


def intersections(mesh: MeshLike, *, most: int = 1_000_000) -> Intersections:
    """Finds the pairs of faces of a mesh that intersect, decided exactly.

    Faces that share a corner or an edge intersect if they meet elsewhere, too.

    Parameters
    ----------
    mesh : MeshLike
        Any mesh.
    most : int
        Pairs to return at most.

    Examples
    --------
    >>> import numpy as np
    >>> import pompeiu
    >>> ball = pompeiu.shapes.icosphere(1.0, 2)
    >>> len(pompeiu.intersections(ball))
    0
    >>> both = np.concatenate([ball.vertices, ball.vertices + 0.5])
    >>> len(pompeiu.intersections((both, np.concatenate([ball.faces, ball.faces + ball.n_vertices])))) > 10
    True
    """
    if most < 0:
        raise OptionError(f"the number of pairs is {most}; it must not be negative")
    return Intersections(*_native.intersections(as_mesh(mesh), most))
