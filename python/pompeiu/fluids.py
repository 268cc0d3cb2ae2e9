"""Fluids on surfaces, stepped."""

from __future__ import annotations

import json
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Union

import numpy as np

from . import _native
from ._asking import ask, split
from .errors import OptionError
from .sources import MeshLike, as_mesh

__all__ = ["Fluid", "Simulation", "SquareSimulation", "fluid"]

Force = Union[None, np.ndarray, Callable[[Any], np.ndarray]]


class _Stepped:
    """What both simulations have."""

    _native: Any
    _names: List[str]

    def measure(self) -> Dict[str, Any]:
        """What is measured of the flow as it is."""
        return json.loads(self._native.measure())

    @property
    def scheme(self) -> Dict[str, Any]:
        """How the flow is computed."""
        return json.loads(self._native.scheme())

    @property
    def steps(self) -> int:
        """Number of steps so far."""
        return self._native.steps

    @property
    def time(self) -> float:
        """Time so far."""
        return self._native.time

    def _step(self, steps: int, force: Force, shaped: Callable[[Any], Any] = lambda pushed: pushed) -> List[Dict[str, Any]]:
        """Steps, and reads what was measured."""
        if steps < 0:
            raise OptionError(f"the number of steps is {steps}; it must not be negative")
        measured = []
        for _ in range(steps):
            pushed = force(self) if callable(force) else force
            measured.append(json.loads(self._native.step(None if pushed is None else shaped(pushed))))
        return measured

    def _index(self, name: str) -> int:
        """The number of a density."""
        if name not in self._names:
            raise OptionError(f"there is no density {name!r}; there are {self._names}")
        return self._names.index(name)

    def save(self, path: Union[str, PathLike]) -> None:
        """Writes the state to a file, from which :meth:`load` goes on bit for bit: JSON as of ``pompeiu fluid --checkpoint``."""
        _native.write_whole(path, self._native.save())

    def load(self, path: Union[str, PathLike]) -> None:
        """Goes on from a state that :meth:`save` wrote, or ``pompeiu fluid --checkpoint``, of the same mesh and options."""
        self._native.load(Path(path).read_bytes())


class Simulation(_Stepped):
    """An incompressible fluid on a surface, with densities that it carries.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold, with or without boundary, of any genus.
    dt : float
        Length of a step; with ``cfl`` the longest.
    scheme : str
        ``"vorticity"``: conserves energy and enstrophy in space, in substeps; ``"any-step"``: traced back, stable at any step;
        ``"faces"``: velocities on faces, traced back; ``"crouzeix-raviart"``: viscosity on velocities at midpoints of edges.
    integrator : str
        ``"runge-kutta"`` or ``"implicit-midpoint"``, which conserves them in time as well.
    correction : str
        What is done about the blur of what is traced back: ``"mac-cormack"``, ``"bfecc"`` or ``"linear"`` (nothing).
    diffusion : str
        ``"laplacian"``, or ``"edge-length"`` for what is stored on faces, which is no Laplacian and depends on the mesh.
    cfl : float, optional
        Halve the step until no more than this part of what a dual cell holds flows out of it.
    viscosity : float
        Kinematic viscosity.
    viscosity_model : str
        ``"physical"``, ``"bochner"`` or ``"hodge"``.
    wall : str
        ``"no-slip"`` or ``"free-slip"``.
    transport : str
        ``"flux-corrected"``, ``"semi-lagrangian"``, ``"semi-lagrangian-corrected"`` or ``"faces"``.
    gravity, rotation, acceleration : sequence of three floats, optional
        Gravity, felt by densities with a weight; angular velocity of the surface; an acceleration everywhere.
    confinement : float
        Strength of vorticity confinement.
    inflow : sequence of (v, w, speed), optional
        At what speed the fluid flows in through boundary edges between vertices ``v`` and ``w``, below zero where it flows out; as much
        must flow out of each component as into it.
    densities : mapping, optional
        For each name an array of values at vertices, or a mapping with ``initial`` and any of ``diffusivity``, ``weight``, ``source``.

    Raises
    ------
    SurfaceError
        If the mesh is no oriented manifold.
    OptionError, FieldError
        If options make no sense, or arrays do not fit or are not finite.

    Examples
    --------
    >>> import numpy as np, pompeiu
    >>> sphere = pompeiu.shapes.icosphere(1.0, 3)
    >>> fluid = pompeiu.Simulation(sphere, 0.05, densities={"dye": np.exp(-4 * sphere.vertices[:, 0])})
    >>> fluid.set_vorticity(sphere.vertices[:, 2] + sphere.vertices[:, 0] * sphere.vertices[:, 1])
    >>> before = fluid.measure()
    >>> after = fluid.step(5)[-1]
    >>> bool(abs(after["energy"] / before["energy"] - 1) < 1e-6 and abs(after["mass"][0] / before["mass"][0] - 1) < 1e-12)
    True
    """

    def __init__(
        self,
        mesh: MeshLike,
        dt: float,
        *,
        scheme: str = "vorticity",
        integrator: str = "runge-kutta",
        correction: str = "mac-cormack",
        diffusion: str = "laplacian",
        cfl: Optional[float] = None,
        viscosity: float = 0.0,
        viscosity_model: str = "physical",
        wall: str = "no-slip",
        transport: str = "flux-corrected",
        gravity: Optional[Sequence[float]] = None,
        rotation: Optional[Sequence[float]] = None,
        acceleration: Optional[Sequence[float]] = None,
        confinement: float = 0.0,
        inflow: Optional[Sequence[Any]] = None,
        densities: Optional[Mapping[str, Any]] = None,
    ) -> None:
        given = dict(locals())
        for name in ("self", "mesh", "inflow", "densities"):
            del given[name]
        self._names = list(densities or {})
        self._native = _native.Simulation(
            as_mesh(mesh),
            split(given)[0],
            None if inflow is None else [(int(v), int(w), float(s)) for v, w, s in inflow],
            [_density(name, values) for name, values in (densities or {}).items()],
        )

    def step(self, steps: int = 1, *, force: Force = None) -> List[Dict[str, Any]]:
        """Moves on, and says what was measured after each step, as ``pompeiu fluid --json`` does.

        Parameters
        ----------
        steps : int
            How many steps.
        force : array of shape (m, 3), or callable, optional
            An acceleration on faces, or a function that is called with the simulation before each step and returns one.
        """
        return self._step(steps, force)

    @property
    def velocity(self) -> np.ndarray:
        """The velocity on faces: shape (m, 3)."""
        return self._native.velocity()

    @property
    def vorticity(self) -> np.ndarray:
        """The vorticity at vertices."""
        return self._native.vorticity()

    @property
    def stream_function(self) -> np.ndarray:
        """The stream function at vertices."""
        return self._native.stream_function()

    @property
    def harmonic(self) -> np.ndarray:
        """The coefficients of the harmonic fields."""
        return self._native.harmonic()

    @property
    def harmonic_fields(self) -> List[np.ndarray]:
        """The harmonic fields on faces, orthonormal."""
        return self._native.harmonic_fields()

    @property
    def densities(self) -> Dict[str, np.ndarray]:
        """The densities at vertices, by name."""
        return {name: self._native.density(i) for i, name in enumerate(self._names)}

    def set_velocity(self, vectors: Any) -> None:
        """Makes the velocity the one without divergence that is nearest to vectors on faces, shape (m, 3)."""
        self._native.set_velocity(vectors)

    def set_vorticity(self, vorticity: Any, harmonic: Optional[Sequence[float]] = None) -> None:
        """Makes the velocity that of a vorticity at vertices and of coefficients of harmonic fields."""
        self._native.set_vorticity(vorticity, None if harmonic is None else [float(c) for c in harmonic])

    def set_density(self, name: str, values: Any) -> None:
        """Replaces a density."""
        self._native.set_density(self._index(name), values)

    def __repr__(self) -> str:
        return f"Simulation(step {self.steps}, time {self.time:g})"


class SquareSimulation(_Stepped):
    """An incompressible fluid in the unit square of ``cells`` x ``cells`` cells, with densities that it carries.

    Arrays have a row for each row of cells, from below: ``array[j, i]`` is at ``((i + 0.5) / cells, (j + 0.5) / cells)``.

    Parameters
    ----------
    cells : int
        Cells on a side, 2 to 4096.
    dt : float
        Length of a step.
    grid : str
        ``"mac"``: velocities on the sides of cells, free of divergence to rounding; ``"stam"``: both components in cells with a ring
        of ghosts, systems solved directly; ``"stam:SWEEPS"``: by sweeps of Gauss and Seidel, as in Stam's code for games.
    edges : str
        ``"walls"``, ``"periodic"`` or ``"channel:SPEED"``: inflow on the left, outflow on the right.
    viscosity : float
        Kinematic viscosity.
    wall : str
        ``"no-slip"`` or ``"free-slip"``.
    lid : float
        The velocity of the upper wall, to the right.
    gravity : sequence of two floats, optional
        Felt by densities with a weight.
    acceleration : sequence of two floats, optional
        An acceleration everywhere.
    obstacles : array of shape (cells, cells), optional
        Which cells are solid.
    densities : mapping, optional
        As for :class:`Simulation`, with arrays of shape (cells, cells).

    Raises
    ------
    OptionError, FieldError
        If options make no sense, or arrays do not fit or are not finite.

    Examples
    --------
    >>> import pompeiu
    >>> cavity = pompeiu.SquareSimulation(32, 0.05, viscosity=0.01, lid=1.0)
    >>> last = cavity.step(10)[-1]
    >>> last["divergence"] < 1e-12, cavity.velocity.shape
    (True, (32, 32, 2))
    """

    def __init__(
        self,
        cells: int,
        dt: float,
        *,
        grid: str = "mac",
        edges: str = "walls",
        viscosity: float = 0.0,
        wall: str = "no-slip",
        lid: float = 0.0,
        gravity: Optional[Sequence[float]] = None,
        acceleration: Optional[Sequence[float]] = None,
        obstacles: Optional[Any] = None,
        densities: Optional[Mapping[str, Any]] = None,
    ) -> None:
        self._cells = int(cells)
        self._names = list(densities or {})
        solid = None if obstacles is None else np.asarray(obstacles, dtype=bool).ravel().tolist()
        upright = lambda vector: None if vector is None else [*map(float, vector), 0.0]  # noqa: E731
        options = {"square": cells, "dt": dt, "grid": grid, "edges": edges, "viscosity": viscosity, "wall": wall, "lid": lid}
        options.update(gravity=upright(gravity), acceleration=upright(acceleration))
        self._native = _native.SquareSimulation(
            split(options)[0], solid, [_density(name, given) for name, given in (densities or {}).items()]
        )

    def step(self, steps: int = 1, *, force: Force = None) -> List[Dict[str, Any]]:
        """Moves on, and says what was measured after each step, as ``pompeiu fluid --json`` does.

        Parameters
        ----------
        steps : int
            How many steps.
        force : array of shape (cells, cells, 2), or callable, optional
            An acceleration in cells, or a function that is called with the simulation before each step and returns one.
        """
        return self._step(steps, force, lambda pushed: np.asarray(pushed, dtype=float).reshape(-1, 2))

    @property
    def velocity(self) -> np.ndarray:
        """The velocity in cells: shape (cells, cells, 2)."""
        return self._native.velocity().reshape(self._cells, self._cells, 2)

    @property
    def vorticity(self) -> np.ndarray:
        """The vorticity in cells: shape (cells, cells)."""
        return self._native.vorticity().reshape(self._cells, self._cells)

    @property
    def densities(self) -> Dict[str, np.ndarray]:
        """The densities in cells, by name: shape (cells, cells)."""
        square = (self._cells, self._cells)
        return {name: self._native.density(i).reshape(square) for i, name in enumerate(self._names)}

    def set_velocity(self, vectors: Any) -> None:
        """Makes the velocity the one without divergence that is nearest to vectors in cells, shape (cells, cells, 2)."""
        self._native.set_velocity(np.asarray(vectors, dtype=float).reshape(-1, 2))

    def set_density(self, name: str, values: Any) -> None:
        """Replaces a density."""
        self._native.set_density(self._index(name), np.asarray(values, dtype=float).ravel())

    def __repr__(self) -> str:
        return f"SquareSimulation({self._cells} x {self._cells}, step {self.steps}, time {self.time:g})"


@dataclass(frozen=True, eq=False, repr=False)
class Fluid:
    """A flow at its end, and what was measured on the way.

    Attributes
    ----------
    velocity : ndarray
        The velocity on faces, shape (m, 3); in the square in cells, shape (n, n, 2), with a row for each row of cells, from below.
    vorticity : ndarray
        The vorticity at vertices, or in cells.
    densities : dict of ndarray
        The densities by name, at vertices or in cells.
    report : dict
        What ``pompeiu fluid --json`` says of the run: ``steps``, ``scheme``, ``start`` and times.
    stop : str
        Why it ended: ``"steps"``, ``"time"`` or ``"cancelled"``.
    """

    velocity: np.ndarray
    vorticity: np.ndarray
    densities: Dict[str, np.ndarray]
    report: Dict[str, Any]
    stop: str

    @property
    def steps(self) -> List[Dict[str, Any]]:
        """What was measured at first and after each step."""
        return self.report["steps"]

    def __repr__(self) -> str:
        return f"Fluid(time {self.steps[-1]['time']:g} after {len(self.steps) - 1} steps, {self.report['scheme']['name']})"


def fluid(
    mesh: Optional[MeshLike] = None,
    *,
    square: Optional[int] = None,
    grid: str = "mac",
    edges: str = "walls",
    lid: float = 0.0,
    obstacles: Optional[str] = None,
    steps: Optional[int] = None,
    dt: Optional[float] = None,
    cfl: Optional[float] = None,
    scheme: Literal["vorticity", "any-step", "faces", "crouzeix-raviart"] = "vorticity",
    integrator: Literal["runge-kutta", "implicit-midpoint"] = "runge-kutta",
    correction: Literal["linear", "mac-cormack", "bfecc"] = "mac-cormack",
    diffusion: Literal["laplacian", "edge-length"] = "laplacian",
    viscosity: float = 0.0,
    viscosity_model: Literal["hodge", "bochner", "physical"] = "physical",
    wall: Literal["no-slip", "free-slip"] = "no-slip",
    transport: Literal["flux-corrected", "semi-lagrangian", "semi-lagrangian-corrected", "faces"] = "flux-corrected",
    gravity: Optional[Sequence[float]] = None,
    rotation: Optional[Sequence[float]] = None,
    acceleration: Optional[Sequence[float]] = None,
    confinement: float = 0.0,
    velocity: Optional[Union[str, Sequence[Sequence[float]]]] = None,
    vorticity: Optional[str] = None,
    harmonic: Sequence[float] = (),
    density: Sequence[Mapping[str, Any]] = (),
    vortex: Sequence[Mapping[str, Any]] = (),
    force: Sequence[Mapping[str, Any]] = (),
    moving_wall: Sequence[Mapping[str, Any]] = (),
    inflow: Sequence[Mapping[str, Any]] = (),
    outflow: Sequence[Mapping[str, Any]] = (),
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    progress: Optional[Callable[[float], Optional[bool]]] = None,
) -> Fluid:
    """Lets a fluid flow on a surface or in the square, as ``pompeiu fluid`` does.

    :class:`Simulation` and :class:`SquareSimulation` do it step by step, with arrays instead of expressions. A scene is a file of
    options: ``pompeiu.fluid(mesh, **pompeiu.read_options("scene.toml"))``.

    Parameters
    ----------
    mesh : MeshLike, optional
        An oriented manifold, with or without boundary, of any genus; none in the square.
    square : int, optional
        The unit square of N x N cells instead of a mesh.
    grid : str
        The discretisation of the square: mac, stam (solved directly) or stam:SWEEPS of Gauss and Seidel.
    edges : str
        The boundary condition of the square: walls, periodic or channel:SPEED (inflow on the left).
    lid : float
        The velocity of the upper wall of the square, to the right.
    obstacles : str, optional
        A black and white picture of the square; what is dark is an obstacle.
    steps : int, optional
        Number of steps, from the beginning also where a state is resumed.
    dt : float, optional
        Length of a step in time; with cfl the longest.
    cfl : float, optional
        Halve the step until no more than this part of what a dual cell holds flows out of it in a step.
    scheme : str
        The discretisation of the velocity and its advection. ``"vorticity"``: vorticity at vertices and harmonic
        coefficients; Galerkin advection in substeps. Conserves energy, enstrophy and total vorticity in space;
        ``"any-step"``: the same unknowns; semi-Lagrangian advection, stable at any step. Loses energy; ``"faces"``:
        velocities on faces; semi-Lagrangian advection from their centroids with parallel transport, then projection;
        stable at any step. Loses the most energy; ``"crouzeix-raviart"``: velocities at midpoints of edges (Crouzeix
        and Raviart) for viscosity; advection by their vorticity as in [`Scheme::Vorticity`]. Rigid rotations never gain
        energy. Without viscosity it is that scheme.
    integrator : str
        The time integrator of the vorticity. ``"runge-kutta"``: the classical Runge–Kutta method of fourth order;
        ``"implicit-midpoint"``: the implicit midpoint rule, solved to rounding: conserves energy and enstrophy in time
        as well.
    correction : str
        The correction of the numerical diffusion of semi-Lagrangian interpolation. ``"linear"``: not at all: first
        order. [`Scheme::Faces`] then also traces in a straight line, as Stam does; ``"mac-cormack"``: half the error of
        a step forth and back is added at the end (`MacCormack`), limited to the surrounding values; ``"bfecc"``: half
        the error is added at the beginning and advected (back and forth error compensation and correction), limited to
        the surrounding values.
    diffusion : str
        The edge weights by which quantities on faces diffuse; edge-length is no Laplacian and depends on the mesh.
        ``"laplacian"``: those of a Laplacian: velocities diffuse by their stream function and [`ViscosityModel`],
        densities with the length of an edge over the distance of the adjacent centroids; ``"edge-length"``: the length
        of the edge alone. This is not a Laplacian: the effective viscosity depends on the size of the faces and on the
        unit of length, and thin faces diffuse most across their long sides. Provided for comparison.
    viscosity : float
        Kinematic viscosity, squared length per time.
    viscosity_model : str
        The Laplacian of the viscous force. ``"hodge"``: the Hodge Laplacian: harmonic fields do not decay;
        ``"bochner"``: the connection Laplacian: only parallel fields do not decay; ``"physical"``: twice the divergence
        of the rate of strain: rigid motions (Killing fields) do not decay.
    wall : str
        The condition for a viscous flow at the boundary. ``"no-slip"``: no slip: the fluid has the velocity of the
        boundary, which may move tangentially; ``"free-slip"``: the boundary exerts no tangential force.
    transport : str
        The scheme that transports densities. ``"flux-corrected"``: flux-corrected transport between dual cells, of
        second order and limited to the surrounding values: conserves mass, in substeps; ``"semi-lagrangian"``:
        semi-Lagrangian along geodesics, with `any-step` from the points that the vorticity comes from: mass drifts;
        ``"semi-lagrangian-corrected"``: semi-Lagrangian; afterwards the missing mass is distributed where the limits
        allow; ``"faces"``: semi-Lagrangian on faces, from their centroids: mass drifts, and two interpolations per step
        add diffusion.
    gravity : Sequence[float], optional
        Gravity, which acts on densities with a weight.
    rotation : Sequence[float], optional
        Angular velocity of the whole surface: Coriolis force.
    acceleration : Sequence[float], optional
        An acceleration everywhere, along the surface.
    confinement : float
        Strength of vorticity confinement.
    velocity : Union[str, Sequence[Sequence[float]]], optional
        The initial velocity: rotation:AXIS, random:SEED, harmonic:K or a file with a vector for each face; in the
        square two expressions in x and y with a semicolon between them.
    vorticity : str, optional
        The initial vorticity, an expression in x, y and z.
    harmonic : Sequence[float]
        Initial coefficients of the harmonic fields, with a vorticity.
    density : Sequence[Mapping[str, Any]]
        A density: an expression in x, y and z, or name, initial, picture, axis, diffusivity, weight and source.
    vortex : Sequence[Mapping[str, Any]]
        A Gaussian of vorticity: at, radius and circulation.
    force : Sequence[Mapping[str, Any]]
        An acceleration in a ball: at, radius and acceleration.
    moving_wall : Sequence[Mapping[str, Any]]
        Boundary edges in a ball that move along themselves: at, radius and speed.
    inflow : Sequence[Mapping[str, Any]]
        Inflow through boundary edges in a ball: at, radius and speed.
    outflow : Sequence[Mapping[str, Any]]
        Outflow of what flows in, through boundary edges in a ball: at and radius.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
    progress : callable, optional
        Called with the share of steps that are done; ``False`` ends the run with what is done.

    Raises
    ------
    SurfaceError
        If the mesh is no oriented manifold.
    OptionError, FieldError, ReadError
        If options make no sense, or a picture or a file of vectors cannot be read.

    Examples
    --------
    >>> import pompeiu
    >>> cavity = pompeiu.fluid(square=16, lid=1, viscosity=0.01, dt=0.05, steps=4)
    >>> cavity.velocity.shape, cavity.steps[-1]["divergence"] < 1e-12
    ((16, 16, 2), True)
    """
    given = dict(locals())
    meshes = ("mesh",) if mesh is not None else ()
    if mesh is None:
        del given["mesh"]
    answer, beside = ask("fluid", given, meshes=meshes)
    report = answer["report"]
    cells = answer["request"]["square"]
    shaped = lambda array: array if cells is None else array.reshape(cells, cells, *array.shape[1:])  # noqa: E731
    named = zip(report["scheme"]["densities"], beside["densities"])
    densities = {name: shaped(one["values"]) for name, one in named}
    return Fluid(shaped(beside["velocity"]), shaped(beside["vorticity"]), densities, report, answer["stop"])


def _density(name: str, given: Any) -> Dict[str, Any]:
    """A density as the native half takes it."""
    options = dict(given) if isinstance(given, Mapping) else {"initial": given}
    unknown = set(options) - {"initial", "diffusivity", "weight", "source"}
    if unknown or "initial" not in options:
        what = f"unknown {sorted(unknown)[0]!r}" if unknown else "no initial values"
        raise OptionError(f"density {name!r} has {what}; known are initial, diffusivity, weight and source")
    source = options.get("source")
    return {
        "name": name,
        "initial": np.asarray(options["initial"], dtype=float).ravel().tolist(),
        "diffusivity": float(options.get("diffusivity", 0.0)),
        "weight": float(options.get("weight", 0.0)),
        "source": None if source is None else np.asarray(source, dtype=float).ravel().tolist(),
    }
