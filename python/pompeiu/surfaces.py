"""Surfaces on their way: flow to least area, remeshing, simplification within a proven distance, self-intersections."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, List, Literal, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._asking import ask, split
from .certificates import _Within
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
        The surface it ended in; with ``center`` without the shift that ``report["rounding"]`` has.
    report : dict
        What ``pompeiu flow --json`` says of it: volume, pressure, stability, discs, cone, neck, history.
    """

    mesh: Mesh
    report: Dict[str, Any]

    @property
    def stop(self) -> str:
        """``"stationary"``, ``"time"``, ``"steps"``, ``"pinched"``, ``"stalled"``, ``"degenerate"``, ``"limit"`` or ``"cancelled"``."""
        return self.report["stop"]

    @property
    def steps(self) -> int:
        """Number of steps."""
        return self.report["steps"]

    @property
    def area(self) -> Tuple[float, float]:
        """Area at first and at the end."""
        return self.report["area"]["initial"], self.report["area"]["final"]

    @property
    def gradient(self) -> Tuple[float, float]:
        """Greatest gradient of the area at a vertex, along its normal and across it: lengths."""
        return self.report["gradient"]["normal"], self.report["gradient"]["tangential"]

    @property
    def least_eigenvalue(self) -> Optional[float]:
        """Of a stationary surface: above zero for a local minimum of the area, below for a saddle."""
        stability = self.report["stability"]
        return None if stability is None else stability["least_eigenvalue"]

    @property
    def history(self) -> List[Dict[str, Any]]:
        """Every step, the surface given first: time, area, gradient, scheme, reason."""
        return self.report["history"]

    def __repr__(self) -> str:
        return f"Flow({self.stop!r} after {self.steps} steps, area {self.area[1]:.9g}, was {self.area[0]:.9g})"


def flow(
    mesh: MeshLike,
    *,
    scheme: Optional[Literal["explicit", "fixed-laplacian", "implicit", "conformalized", "normal-newton", "newton", "newton-or-gradient"]] = None,
    until: str = "stationary",
    time_step: Optional[float] = None,
    planes: Optional[Sequence[float]] = None,
    volume: Literal["free", "keep"] = "free",
    remesh: Optional[Union[float, str]] = None,
    unit: str = "",
    remesh_every: int = 5,
    keep_angles: bool = True,
    intersections: Literal["ignore", "report", "refuse", "refuse-new"] = "report",
    precision: Literal["double", "single"] = "double",
    center: bool = False,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    progress: StepLike = None,
) -> Flow:
    """Lets a surface flow to less area: to a minimal surface, in time, or to a bubble.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold whose faces have an area.
    scheme : str, optional
        The scheme that moves the surface; normal-newton to a stationary surface, implicit otherwise. ``"explicit"``:
        gradient descent X − δ M⁻¹ g, with a line search (Armijo); ``"fixed-laplacian"``: (M₀ + δ L₀) X' = M₀ X with
        both matrices of the first step. It minimises the Dirichlet energy in the metric of the first surface, not the
        area, and its limit is no minimal surface; ``"implicit"``: (M + δ L) X' = M X with both matrices rebuilt at each
        step: backward Euler; ``"conformalized"``: (M + δ L₀) X' = M X: conformalized mean curvature flow. It does not
        pinch, and is no gradient flow of the area; ``"normal-newton"``: newton's method for motions along vertex
        normals; where the Hessian is not positive definite, blended with L; ``"newton"``: newton's method for all
        coordinates; the negative in-plane part of the Hessian of each face is left out; ``"newton-or-gradient"``:
        newton's method with the whole Hessian while the area falls, gradient descent where it would not.
    until : str
        When to end: stationary, stationary:TOL, time:T or steps:N.
    time_step : float, optional
        Length of a step in time, in squared lengths; by default each is chosen.
    planes : Sequence[float], optional
        Let the boundary slide in planes with this normal, three numbers (on the command line also x, y or z); otherwise
        it stays.
    volume : str
        The treatment of the enclosed volume. ``"free"``: it changes; ``"keep"``: it stays: a soap bubble.
    remesh : Union[float, str], optional
        Remesh on the way to edges of this length, such as 2, 2mm with the unit given, or 1% of the diagonal.
    unit : str
        The unit of the coordinates, such as mm; files have none.
    remesh_every : int
        Steps between two remeshings to that length.
    keep_angles : bool
        Where angles decay, remesh to the mean length of edges; not by schemes that keep the metric of the first
        surface.
    intersections : str
        The treatment of faces of the result that intersect. ``"ignore"``: they are not looked for; ``"report"``: they
        are counted; ``"refuse"``: there is no result; ``"refuse-new"``: there is no result where the input has none
        that intersect; otherwise those of both are counted.
    precision : str
        Numbers in which the coordinates of the result are kept; single where the file that is written holds no others,
        as STL and GLB do. ``"double"``: 53 bits: every mesh in memory; ``"single"``: 24 bits: files such as STL and
        GLB.
    center : bool
        Count the coordinates of the result from a point near the centre of the mesh, which is reported: far from zero
        this keeps digits for which single precision has no room.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
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
    answer, beside = ask("flow", locals())
    return Flow(beside["mesh"], answer["report"])


@dataclass(frozen=True, eq=False, repr=False)
class Simplified(_Within):
    """A mesh with fewer faces, and how far it is proven to be from the input.

    Attributes
    ----------
    mesh : Mesh
        The result; with ``center`` without the shift that ``report["rounding"]`` has.
    report : dict
        What ``pompeiu simplify --json`` says of the result.
    texture : tuple of ndarray or None
        Texture coordinates, shape (k, 2), and which of them each corner of each face has, shape (m, 3); ``None`` unless given.
    colors : ndarray of uint8 or None
        Colours of the vertices, shape (n, 3); ``None`` unless given.
    finer : tuple of Simplified
        Other levels of detail, each finer than the one before; empty unless asked for.
    """

    mesh: Mesh
    report: Dict[str, Any]
    texture: Optional[Tuple[NDArray[np.float64], NDArray[np.uint32]]] = None
    colors: Optional[NDArray[np.uint8]] = None
    finer: Tuple["Simplified", ...] = ()
    _proven: "Tuple[Optional[Mesh], Optional[float]]" = field(default=(None, None), repr=False)

    @property
    def distance(self) -> SymmetricReport:
        """Both directed distances, enclosed: A is the input, B the result."""
        return SymmetricReport._of(self.report["distance"])

    @property
    def collapses(self) -> int:
        """Number of edges collapsed."""
        return self.report["collapses"]

    @property
    def stop(self) -> str:
        """Why it ended."""
        return self.report["stop"]

    def __repr__(self) -> str:
        return f"Simplified({self.mesh.n_faces} faces, at most {self.distance.upper:.6g} from the input)"

    @classmethod
    def _of(
        cls,
        report: Dict[str, Any],
        beside: Dict[str, Any],
        source: Optional[Mesh],
        finer: Tuple["Simplified", ...] = (),
    ) -> "Simplified":
        texture = (beside["texture"], beside["corners"]) if "texture" in beside else None
        return cls(beside["mesh"], report, texture, beside.get("colors"), finer, (source, report["within"]))


def simplify(
    mesh: MeshLike,
    texture: Optional[Tuple[ArrayLike, ArrayLike]] = None,
    colors: Optional[ArrayLike] = None,
    *,
    within: Optional[Union[float, str]] = None,
    unit: str = "",
    relative: Optional[float] = None,
    faces: Optional[Union[int, str]] = None,
    effort: Literal["fast", "best"] = "best",
    features: Optional[float] = None,
    repair: bool = False,
    intersections: Literal["ignore", "report", "refuse", "refuse-new"] = "refuse-new",
    levels: int = 1,
    precision: Literal["double", "single"] = "double",
    center: bool = False,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    progress: Optional[Callable[[float], Optional[bool]]] = None,
) -> Simplified:
    """Reduces the number of faces, and proves how far the result is from the input.

    One of ``within``, ``relative`` and ``faces`` is given.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold.
    texture : tuple of array_like, optional
        Texture coordinates, shape (k, 2), and which of them each corner of each face has, shape (m, 3). Edges with other coordinates on both
        sides stay curves, and the result has coordinates of its own.
    colors : array_like of uint8, optional
        Colours of the vertices, shape (n, 3), carried over to the result.
    within : Union[float, str], optional
        Largest distance from the input, such as 0.1, 0.1mm with the unit given, or 0.5% of the diagonal.
    unit : str
        The unit of the coordinates, such as mm; files have none.
    relative : float, optional
        Largest distance as a fraction of the diagonal of the bounding box.
    faces : Union[int, str], optional
        Number of faces to reach, such as 1000, or 10% of those of the input; the distance follows.
    effort : str
        The effort to make the distance small at a given number of faces. ``"fast"``: quadric errors alone decide;
        ``"best"``: every collapse is tested, as for a distance: some ten to twenty times the time of fast, mostly a
        third to a half of its distance.
    features : float, optional
        Keep edges whose faces meet at more than this angle between their normals, in degrees, and boundaries: as curves
        with the same corners.
    repair : bool
        Repair the mesh first; the distance is measured from the mesh as it was.
    intersections : str
        The treatment of faces of the result that intersect; where they are refused, no more pairs intersect than in the
        input. ``"ignore"``: they are not looked for; ``"report"``: they are counted; ``"refuse"``: there is no result;
        ``"refuse-new"``: there is no result where the input has none that intersect; otherwise those of both are
        counted.
    levels : int
        Number of levels of detail: each further one has half the distance, or twice the number of faces, of the one
        before.
    precision : str
        Numbers in which the coordinates of the result are kept; single where the file that is written holds no others,
        as STL and GLB do. ``"double"``: 53 bits: every mesh in memory; ``"single"``: 24 bits: files such as STL and
        GLB.
    center : bool
        Count the coordinates of the result from a point near the centre of the mesh, which is reported: far from zero
        this keeps digits for which single precision has no room.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
    progress : callable, optional
        Called with the share that is done; ``False`` ends it.

    Raises
    ------
    SurfaceError
        If the mesh is no oriented manifold.
    OptionError
        If not exactly one of ``within``, ``relative`` and ``faces`` is given, or an option makes no sense; if a mesh with texture or colours
        is to be repaired.

    Examples
    --------
    >>> import pompeiu
    >>> few = pompeiu.simplify(pompeiu.shapes.icosphere(1.0, 3), within=0.05)
    >>> few.mesh.n_faces < 300 and few.distance.upper <= 0.05
    True
    """
    given = dict(locals())
    texture, colors = given.pop("texture"), given.pop("colors")
    if repair and not (texture is None and colors is None):
        raise OptionError("texture and colours cannot be carried over from a mesh that is repaired first; repair it before")
    mesh = as_mesh(given.pop("mesh"))
    options, limits, progress = split(given)
    answer, beside = _native.simplify(mesh, options, limits, texture, colors, progress)
    report = json.loads(answer)["report"]
    source = None if center else mesh
    finer = tuple(
        Simplified._of({**report, **level, "finer": []}, arrays, source) for level, arrays in zip(report["finer"], beside["finer"])
    )
    return Simplified._of(report, beside, source, finer)


@dataclass(frozen=True, eq=False, repr=False)
class Remeshed(_Within):
    """A mesh with new triangles.

    Attributes
    ----------
    mesh : Mesh
        The result; with ``center`` without the shift that ``report["rounding"]`` has.
    report : dict
        What ``pompeiu remesh --json`` says of the result.
    """

    mesh: Mesh
    report: Dict[str, Any]
    _proven: "Tuple[Optional[Mesh], Optional[float]]" = field(default=(None, None), repr=False)

    @property
    def before(self) -> Dict[str, Any]:
        """The triangles of the input: ``faces``, ``edge_length``, ``least_angle`` (degrees; each with ``least``, ``mean``, ``greatest``),
        ``regular`` and so on."""
        return self.report["before"]

    @property
    def after(self) -> Dict[str, Any]:
        """The triangles of the result."""
        return self.report["after"]

    @property
    def distance(self) -> SymmetricReport:
        """Both directed distances, enclosed: A is the input, B the result."""
        return SymmetricReport._of(self.report["distance"])

    @property
    def iterations(self) -> int:
        """Number of rounds done."""
        return self.report["iterations"]

    @property
    def stop(self) -> str:
        """Why it ended."""
        return self.report["stop"]

    def __repr__(self) -> str:
        least = self.after["least_angle"]["least"]
        return f"Remeshed({self.mesh.n_faces} faces, least angle {least:.1f} degrees)"


def remesh(
    mesh: MeshLike,
    *,
    edge_length: Optional[Union[float, str]] = None,
    relative: Optional[float] = None,
    adaptive: Optional[Union[float, str]] = None,
    within: Optional[Union[float, str]] = None,
    unit: str = "",
    features: Optional[float] = None,
    iterations: int = 10,
    most_faces: int = 20000000,
    intersections: Literal["ignore", "report", "refuse", "refuse-new"] = "refuse-new",
    precision: Literal["double", "single"] = "double",
    center: bool = False,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    progress: Optional[Callable[[float], Optional[bool]]] = None,
) -> Remeshed:
    """Gives a surface nearly equilateral faces of a wanted size.

    Of ``edge_length``, ``relative`` and ``adaptive`` at most one is given; without any, edges are as long as those of the mesh in the
    mean.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold.
    edge_length : Union[float, str], optional
        Length of edges, such as 2, 2mm with the unit given, or 1% of the diagonal; by default the mean of those of the
        mesh, at most 4/3 of those of as many equilateral faces with its area.
    relative : float, optional
        Length of edges as a fraction of the diagonal of the bounding box.
    adaptive : Union[float, str], optional
        Height of chords: edges are as long as the curvature allows.
    within : Union[float, str], optional
        Largest distance from the input, to be proven, such as 0.1, 0.1mm with the unit given, or 0.5% of the diagonal.
    unit : str
        The unit of the coordinates, such as mm; files have none.
    features : float, optional
        Keep edges whose faces meet at more than this angle between their normals, in degrees; boundaries are always
        kept.
    iterations : int
        Rounds of splits, collapses, flips and moves.
    most_faces : int
        Most faces that the result may have.
    intersections : str
        The treatment of faces of the result that intersect. ``"ignore"``: they are not looked for; ``"report"``: they
        are counted; ``"refuse"``: there is no result; ``"refuse-new"``: there is no result where the input has none
        that intersect; otherwise those of both are counted.
    precision : str
        Numbers in which the coordinates of the result are kept; single where the file that is written holds no others,
        as STL and GLB do. ``"double"``: 53 bits: every mesh in memory; ``"single"``: 24 bits: files such as STL and
        GLB.
    center : bool
        Count the coordinates of the result from a point near the centre of the mesh, which is reported: far from zero
        this keeps digits for which single precision has no room.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
    progress : callable, optional
        Called with the share that is done; ``False`` ends it.

    Raises
    ------
    SurfaceError
        If the mesh is no oriented manifold.
    OptionError
        If more than one of ``edge_length``, ``relative`` and ``adaptive`` is given, or an option makes no sense.

    Examples
    --------
    >>> import pompeiu
    >>> even = pompeiu.remesh(pompeiu.shapes.icosphere(1.0, 3), edge_length=0.15)
    >>> even.after["least_angle"]["least"] > 35 and even.distance.upper < 0.02
    True
    """
    source = as_mesh(mesh)
    given = {**locals(), "mesh": source}
    del given["source"]
    answer, beside = ask("remesh", given)
    report = answer["report"]
    return Remeshed(beside["mesh"], report, (None if center else source, report["within"]))


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
