"""Fluids on surfaces, stepped."""

from __future__ import annotations

import json
from os import PathLike
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Union

import numpy as np

from . import _native
from .errors import OptionError
from .files import write_arrays
from .sources import MeshLike, as_mesh

__all__ = ["Simulation", "SquareSimulation"]

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

    def _check_names(self, path: Any, saved: Any) -> None:
        """Refuses a state with other densities."""
        names = [str(name) for name in saved["names"]]
        if names != self._names:
            raise OptionError(f"{path}: has the densities {names}, expected {self._names}")


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
        mesh = as_mesh(mesh)
        self._names = list(densities or {})
        vector = lambda v: None if v is None else [float(x) for x in v]  # noqa: E731
        self._native = _native.Simulation(
            mesh,
            {
                "scheme": scheme,
                "integrator": integrator,
                "correction": correction,
                "diffusion": diffusion,
                "time_step": float(dt),
                "cfl": None if cfl is None else float(cfl),
                "viscosity": float(viscosity),
                "viscosity_model": viscosity_model,
                "wall": wall,
                "transport": transport,
                "gravity": vector(gravity),
                "rotation": vector(rotation),
                "acceleration": vector(acceleration),
                "confinement": float(confinement),
                "inflow": None if inflow is None else [(int(v), int(w), float(s)) for v, w, s in inflow],
                "densities": [_density(name, given) for name, given in (densities or {}).items()],
            },
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

    def save(self, path: Union[str, PathLike]) -> None:
        """Writes the state to a file of NumPy (``.npz``), from which :meth:`load` goes on bit for bit."""
        edges, faces = self._native.stored()
        write_arrays(
            path,
            steps=self.steps,
            time=self.time,
            vorticity=self.vorticity,
            harmonic=self.harmonic,
            names=np.array(self._names, dtype=str),
            densities=np.array(list(self.densities.values())),
            edge_velocity=edges,
            face_densities=np.array(faces),
        )

    def load(self, path: Union[str, PathLike]) -> None:
        """Goes on from a state that :meth:`save` wrote, of the same mesh and options."""
        with np.load(path, allow_pickle=False) as saved:
            self._check_names(path, saved)
            self._native.restore(
                (int(saved["steps"]), float(saved["time"])),
                saved["vorticity"],
                [float(c) for c in saved["harmonic"]],
                list(saved["densities"]),
                [[float(t), float(n)] for t, n in saved["edge_velocity"]],
                list(saved["face_densities"]),
            )

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
        if cells < 2:
            raise OptionError(f"the square has {cells} cells on a side; expected 2 to 4096")
        self._cells = int(cells)
        self._names = list(densities or {})
        solid = None if obstacles is None else np.asarray(obstacles, dtype=bool).ravel().tolist()
        self._native = _native.SquareSimulation(
            {
                "cells": self._cells,
                "grid": grid,
                "edges": edges,
                "time_step": float(dt),
                "viscosity": float(viscosity),
                "wall": wall,
                "lid": float(lid),
                "gravity": [0.0, 0.0] if gravity is None else [float(x) for x in gravity],
                "acceleration": None if acceleration is None else [float(x) for x in acceleration],
                "obstacles": solid,
                "densities": [_density(name, given) for name, given in (densities or {}).items()],
            }
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

    def save(self, path: Union[str, PathLike]) -> None:
        """Writes the state to a file of NumPy (``.npz``), from which :meth:`load` goes on bit for bit."""
        u, v = self._native.stored()
        names = np.array(self._names, dtype=str)
        densities = np.array(list(self.densities.values()))
        write_arrays(path, steps=self.steps, time=self.time, u=u, v=v, names=names, densities=densities)

    def load(self, path: Union[str, PathLike]) -> None:
        """Goes on from a state that :meth:`save` wrote, with the same options."""
        with np.load(path, allow_pickle=False) as saved:
            self._check_names(path, saved)
            densities = [values.ravel() for values in saved["densities"]]
            self._native.restore((int(saved["steps"]), float(saved["time"])), (saved["u"], saved["v"]), densities)

    def __repr__(self) -> str:
        return f"SquareSimulation({self._cells} x {self._cells}, step {self.steps}, time {self.time:g})"


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
