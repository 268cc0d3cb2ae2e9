"""Types of the native half; `Mesh` and the shapes are public, the rest is wrapped."""

import os
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

_Vec3 = tuple[float, float, float]
_Watch = Optional[Callable[[str, float, float, int, int], Optional[bool]]]
_Steps = Optional[Callable[[int, int, int, int], Optional[bool]]]
_Matrix = tuple[NDArray[np.float64], NDArray[np.float64], int, str, list[tuple[int, int]]]
_Limits = tuple[Optional[int], Optional[float], Optional[int]]
_Options = dict[str, Any]

def ask(
    name: str,
    given: Sequence[Mesh | tuple[str, Any] | str | bytes],
    options: str,
    limits: _Limits,
    progress: Optional[Callable[..., Optional[bool]]],
) -> tuple[str, dict[str, Any]]: ...

_Ends = tuple[float, int, tuple[float, float, float], float]

def write_certificate(
    path: str | os.PathLike[str],
    a: Mesh,
    b: Mesh,
    ends: tuple[Optional[_Ends], Optional[_Ends]],
    slack: float,
    given: _Limits,
) -> str: ...
def verify_certificate(path: str | os.PathLike[str], a: Mesh, b: Mesh, threads: Optional[int]) -> str: ...

def couple(
    fluid: Any,
    solid: Any,
    x0: ArrayLike,
    options: str,
    limits: _Limits,
    progress: Optional[Callable[[float], Optional[bool]]],
) -> tuple[str, NDArray[np.float64], NDArray[np.float64]]: ...

class PuzzleDrawings:
    def draw(self, what: str, suffix: str, pull: float, image: Optional[bytes]) -> Optional[bytes]: ...

class Mesh:
    def __new__(cls, vertices: ArrayLike, faces: ArrayLike) -> Mesh: ...
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    @property
    def faces(self) -> NDArray[np.uint32]: ...
    @property
    def n_vertices(self) -> int: ...
    @property
    def n_faces(self) -> int: ...
    def without_unreferenced(self) -> Mesh: ...
    def _summary(self) -> str: ...
    def __eq__(self, other: object) -> bool: ...
    def __reduce__(self) -> tuple[type[Mesh], tuple[NDArray[np.float64], NDArray[np.uint32]]]: ...

class Target:
    def __new__(cls, mesh: Mesh) -> Target: ...
    @property
    def n_faces(self) -> int: ...
    @property
    def nbytes(self) -> int: ...
    @property
    def bounds(self) -> list[_Vec3]: ...
    def directed_from(self, a: Mesh, options: _Options, progress: _Watch) -> str: ...

class NeuronFlow:
    def transport(
        self,
        parts: int,
        config: str,
        frames: int,
        origin: tuple[bytes, str, Optional[tuple[str, bytes]]],
        time_limit: Optional[float],
        memory_limit: Optional[int],
        progress: Optional[Callable[[float], Optional[bool]]],
    ) -> tuple[NeuronRun, NDArray[np.float64], list[int], NDArray[np.float64], float, str]: ...
    def other_than(self, config: str) -> str: ...

class NeuronRun:
    def checkpoint(self) -> bytes: ...
    def html(self, name: str) -> str: ...

class NeuronHexahedra:
    def transport(
        self,
        config: str,
        frames: int,
        origin: tuple[bytes, str, Optional[tuple[str, bytes]]],
        time_limit: Optional[float],
        memory_limit: Optional[int],
        progress: Optional[Callable[[float], Optional[bool]]],
    ) -> tuple[NeuronRun, NDArray[np.float64], list[int], NDArray[np.float64], float, str]: ...
    def splines(
        self,
        meshing: _Options,
        refine: list[str],
        levels: int,
        progress: Optional[Callable[[float], Optional[bool]]],
    ) -> tuple[
        NeuronSplineSpace,
        NDArray[np.float64],
        NDArray[np.uint32],
        NDArray[np.int32],
        NDArray[np.uint32],
        bytes,
        str,
        str,
    ]: ...
    def flow(
        self, meshing: _Options, config: str, progress: Optional[Callable[[float], Optional[bool]]]
    ) -> tuple[
        NeuronFlow,
        NDArray[np.float64],
        NDArray[np.uint32],
        NDArray[np.int32],
        NDArray[np.float64],
        NDArray[np.float64],
        NDArray[np.int64],
        NDArray[np.float64],
        bytes,
        str,
        str,
    ]: ...

class NeuronSkeleton:
    def mesh(
        self, meshing: _Options, progress: Optional[Callable[[float], Optional[bool]]]
    ) -> tuple[
        NeuronHexahedra,
        NDArray[np.float64],
        NDArray[np.uint32],
        NDArray[np.int32],
        NDArray[np.uint32],
        NDArray[np.int32],
        NDArray[np.int64],
        bytes,
        str,
    ]: ...
    def splines(
        self,
        meshing: _Options,
        refine: list[str],
        levels: int,
        progress: Optional[Callable[[float], Optional[bool]]],
    ) -> tuple[
        NeuronSplineSpace,
        NDArray[np.float64],
        NDArray[np.uint32],
        NDArray[np.int32],
        NDArray[np.uint32],
        bytes,
        str,
        str,
    ]: ...
    def flow(
        self, meshing: _Options, config: str, progress: Optional[Callable[[float], Optional[bool]]]
    ) -> tuple[
        NeuronFlow,
        NDArray[np.float64],
        NDArray[np.uint32],
        NDArray[np.int32],
        NDArray[np.float64],
        NDArray[np.float64],
        NDArray[np.int64],
        NDArray[np.float64],
        bytes,
        str,
        str,
    ]: ...

class NeuronSplineSpace:
    def extraction(self) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]: ...
    def positions(self) -> NDArray[np.float64]: ...

class HodgeDecomposition:
    def __new__(cls, mesh: Mesh, splitting: str, boundary: str) -> HodgeDecomposition: ...
    def decompose(self, field: ArrayLike) -> dict[str, Any]: ...
    def decompose_many(self, fields: Iterable[ArrayLike]) -> list[dict[str, Any]]: ...
    def harmonic_fields(self) -> list[NDArray[np.float64]]: ...
    def edges(self) -> NDArray[np.uint32]: ...
    def face_areas(self) -> NDArray[np.float64]: ...
    @property
    def harmonic_dimension(self) -> int: ...
    def degrees_of_freedom(self) -> str: ...

class Simulation:
    def __new__(cls, mesh: Mesh, options: _Options) -> Simulation: ...
    def step(self, force: Optional[ArrayLike]) -> str: ...
    def measure(self) -> str: ...
    def scheme(self) -> str: ...
    def set_velocity(self, field: ArrayLike) -> None: ...
    def set_vorticity(self, vorticity: ArrayLike, harmonic: Optional[Sequence[float]]) -> None: ...
    def set_density(self, index: int, density: ArrayLike) -> None: ...
    def restore(
        self,
        at: tuple[int, float],
        vorticity: ArrayLike,
        harmonic: Sequence[float],
        densities: Sequence[ArrayLike],
        edge_velocity: Sequence[Sequence[float]],
        face_densities: Sequence[ArrayLike],
    ) -> None: ...
    def stored(self) -> tuple[NDArray[np.float64], list[NDArray[np.float64]]]: ...
    @property
    def steps(self) -> int: ...
    @property
    def time(self) -> float: ...
    def velocity(self) -> NDArray[np.float64]: ...
    def vorticity(self) -> NDArray[np.float64]: ...
    def stream_function(self) -> NDArray[np.float64]: ...
    def harmonic(self) -> NDArray[np.float64]: ...
    def density(self, index: int) -> Optional[NDArray[np.float64]]: ...
    def harmonic_fields(self) -> list[NDArray[np.float64]]: ...

class SquareSimulation:
    def __new__(cls, options: _Options) -> SquareSimulation: ...
    def step(self, force: Optional[ArrayLike]) -> str: ...
    def measure(self) -> str: ...
    def scheme(self) -> str: ...
    def set_velocity(self, field: ArrayLike) -> None: ...
    def set_density(self, index: int, density: ArrayLike) -> None: ...
    def stored(self) -> list[NDArray[np.float64]]: ...
    def restore(
        self, at: tuple[int, float], velocity: tuple[ArrayLike, ArrayLike], densities: Sequence[ArrayLike]
    ) -> None: ...
    @property
    def steps(self) -> int: ...
    @property
    def time(self) -> float: ...
    def velocity(self) -> NDArray[np.float64]: ...
    def vorticity(self) -> NDArray[np.float64]: ...
    def density(self, index: int) -> Optional[NDArray[np.float64]]: ...

class Ranking:
    def __new__(cls, names: list[str], options: str) -> Ranking: ...
    def round(self) -> list[tuple[int, str]]: ...
    def merge(self, outcomes: list[str]) -> None: ...
    def wants(self, target: int) -> bool: ...
    def settled(self) -> int: ...
    def stop(self) -> None: ...
    def report(self) -> tuple[str, list[int]]: ...

class Template:
    def __new__(cls, mesh: Mesh, options: str) -> Template: ...
    def perform(self, mesh: Mesh, action: str, threads: int) -> str: ...

class Entries:
    def __new__(cls, count: int) -> Entries: ...
    def set(self, to: int, entries: list[tuple[int, str]]) -> None: ...
    def stop(self) -> None: ...
    def arrays(self) -> _Matrix: ...

def rank_meshes(
    template: Mesh,
    sources: Sequence[Mesh | str | os.PathLike[str]],
    names: list[str],
    options: str,
    most: _Limits,
    progress: _Steps,
) -> tuple[str, list[int]]: ...
def distance_matrix(
    meshes: list[Mesh], width: tuple[float, str], most: _Limits, progress: _Steps
) -> _Matrix: ...
def matrix_entries(to: Mesh, from_: list[Mesh], width: tuple[float, str], threads: int) -> list[str]: ...
def straighten(
    mesh: Mesh, edges: list[list[int]]
) -> tuple[Mesh, NDArray[np.uint32], NDArray[np.uint32]]: ...
def read_outlines(
    path: str, level: Optional[float], foreground: str, staircase: bool
) -> list[NDArray[np.float64]]: ...
def k_medoids(distances: Any, start: list[int]) -> tuple[float, list[int]]: ...
def polyline(points: int, seed: int, order: str) -> NDArray[np.float64]: ...
def noisy_circle(radius: int, level: int, steps: int, seed: int) -> NDArray[np.float64]: ...
def neuron_options(
    stage: str, parts: int, layer: float, repair: bool, steps: int, spacing: Optional[float]
) -> str: ...
def read_neuron_mesh(path: str, sides: list[str]) -> tuple[
    NeuronHexahedra,
    NDArray[np.float64],
    NDArray[np.uint32],
    NDArray[np.int32],
    NDArray[np.uint32],
    NDArray[np.int32],
    NDArray[np.int64],
    bytes,
    str,
]: ...
def read_skeleton(
    bytes: bytes, repair: bool, steps: int, spacing: Optional[float]
) -> tuple[
    NeuronSkeleton,
    NDArray[np.int64],
    NDArray[np.int64],
    NDArray[np.float64],
    NDArray[np.float64],
    NDArray[np.int64],
    str,
    str,
]: ...
def simplify(
    mesh: Mesh,
    options: str,
    limits: _Limits,
    texture: Optional[tuple[ArrayLike, ArrayLike]],
    colors: Optional[ArrayLike],
    progress: Optional[Callable[[float], Optional[bool]]],
) -> tuple[str, dict[str, Any]]: ...
def intersections(
    mesh: Mesh, most_pairs: int
) -> tuple[NDArray[np.uint32], NDArray[np.float64], int, bool]: ...
def degrees_of_freedom(mesh: Mesh, boundary: str) -> str: ...
class DeviationPage:
    def html(self, look: _Options) -> str: ...
    def png(
        self,
        look: _Options,
        direction_to_eye: Optional[Sequence[float]],
        size: tuple[int, int],
        theme: str,
    ) -> bytes: ...
    def pdf(
        self,
        look: _Options,
        direction_to_eye: Optional[Sequence[float]],
        verdict: Optional[str],
        paper: str,
    ) -> bytes: ...

def read_mesh(path: str | os.PathLike[str]) -> tuple[Mesh, str, int, int]: ...
def write_mesh(
    path: str | os.PathLike[str],
    mesh: Mesh,
    vertex_scalars: list[tuple[str, ArrayLike]],
    face_scalars: list[tuple[str, ArrayLike]],
    face_vectors: list[tuple[str, ArrayLike]],
    vertex_colors: Optional[ArrayLike],
    face_colors: Optional[ArrayLike],
) -> None: ...
def cube(side: float = 1.0, cells: int = 1) -> Mesh: ...
def cylinder(
    radius: float = 1.0, height: float = 2.0, segments: int = 32, rows: int = 1, capped: bool = False
) -> Mesh: ...
def grid(size: tuple[float, float] = (1.0, 1.0), cells: tuple[int, int] = (1, 1)) -> Mesh: ...
def icosphere(radius: float = 1.0, subdivisions: int = 3) -> Mesh: ...
def schwarz_lantern(radius: float = 1.0, height: float = 2.0, segments: int = 16, bands: int = 16) -> Mesh: ...
def torus(
    major_radius: float = 2.0, minor_radius: float = 0.7, major_segments: int = 48, minor_segments: int = 24
) -> Mesh: ...
