"""Neurons: skeletons read in all dialects of SWC, what is wrong with them, hexahedral meshes, flow and transport through them."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, Callable, Dict, List, Literal, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _native
from ._asking import ask
from .errors import MissingFileError, OptionError, ReadError, WriteError
from .results import _read_only

__all__ = [
    "Neuron",
    "NeuronFlow",
    "NeuronMesh",
    "NeuronSplines",
    "NeuronTransport",
    "Skeleton",
    "SkeletonCheck",
    "neuron",
    "read_neuron_mesh",
    "read_skeleton",
    "sweep_neurons",
]


@dataclass(frozen=True, eq=False, repr=False)
class _Origin:
    """A file, and what was done to it: what a checkpoint belongs to."""

    content: bytes
    repair: bool = False
    smooth: int = 0
    spacing: Optional[float] = None
    layer: float = 2.0
    stage: str = "transport"

    def run(self, parts: int, resume: Optional[Union[str, "os.PathLike[str]"]], other: str = "") -> Tuple[Any, ...]:
        """What ``pompeiu neuron`` has in a checkpoint for the same file and options, and the checkpoint to go on from."""
        options = (self.stage, parts, self.layer, self.repair, self.smooth, self.spacing)
        state = None if resume is None else (os.fspath(resume), _content(resume))
        return self.content, _native.neuron_options(*options) + other, state


@dataclass(frozen=True, eq=False, repr=False)
class NeuronTransport:
    """What became of material in a neuron. Times are in seconds; the last axis of concentrations is free material, material on
    motors away from the inlet, and material on motors towards it.

    Attributes
    ----------
    times : numpy.ndarray of float, shape (s + 1,)
        The times of the beginning and of all steps.
    ends : numpy.ndarray of float, shape (s + 1, c, 3)
        Mean concentrations at each flat end at these times.
    frame_times : numpy.ndarray of float, shape (f,)
        The times of frames.
    frames : numpy.ndarray of float, shape (f, m, 3)
        Concentrations of each cell at these times.
    report : dict
        What ``pompeiu neuron transport --json`` says of it under ``transport``.
    """

    times: np.ndarray
    ends: np.ndarray
    frame_times: np.ndarray
    frames: np.ndarray
    report: Dict[str, Any]
    _run: Optional[_native.NeuronRun] = None

    def __getstate__(self) -> Dict[str, Any]:
        # What pages and checkpoints need does not travel.
        return {name: value for name, value in self.__dict__.items() if name != "_run"}

    def _here(self) -> _native.NeuronRun:
        if self._run is None:
            raise ValueError("this answer was pickled: the state of the run does not travel with it")
        return self._run

    def save_html(self, path: Union[str, "os.PathLike[str]"], *, name: str = "neuron") -> None:
        """Writes a page that plays the transport in 3-D, with concentrations at the ends over time: one file that needs no network.

        Parameters
        ----------
        path : str or path-like
            The file.
        name : str
            What the neuron is called.

        Raises
        ------
        ValueError
            If this answer was pickled: the state of the run does not travel with it.
        WriteError
            If the file cannot be written.
        """
        _write(path, self._here().html(name).encode())

    def save_checkpoint(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the state after the last step: ``resume`` of the same call goes on from it to the same bits, and so does
        ``pompeiu neuron --resume`` with the same file and options.

        Raises
        ------
        ValueError, WriteError
            As for :meth:`save_html`.
        """
        _write(path, self._here().checkpoint())

    def __repr__(self) -> str:
        steps, balance = self.report["steps"], self.report["mass_balance"]
        return f"NeuronTransport({steps} steps, mass kept to {balance:.1e})"


def _write(path: Union[str, "os.PathLike[str]"], content: bytes) -> None:
    name = os.fspath(path)
    try:
        _native.write_whole(name, content)
    except OSError as error:
        raise WriteError(f"{name}: {error.strerror}") from error


def _content(path: Union[str, "os.PathLike[str]"]) -> bytes:
    """The bytes of a file."""
    name = os.fspath(path)
    try:
        with open(name, "rb") as file:
            return file.read()
    except FileNotFoundError as error:
        raise MissingFileError(f"{name}: there is no such file; check the name and the folder") from error
    except OSError as error:
        raise ReadError(f"{name}: {error.strerror}") from error


def _check_frames(frames: int) -> None:
    if frames < 2:
        raise OptionError(f"the number of frames is {frames}; at least 2 are needed")


def _config(config: Union[str, "os.PathLike[str]"]) -> str:
    """The text of a configuration, or of the file of one."""
    if isinstance(config, str):
        return config
    name = os.fspath(config)
    try:
        with open(name, encoding="utf-8") as file:
            return file.read()
    except FileNotFoundError as error:
        raise MissingFileError(f"{name}: there is no such file; check the name and the folder") from error
    except (OSError, UnicodeDecodeError) as error:
        raise ReadError(f"{name}: {error}") from error


def _transport(found: Any, ends: int) -> NeuronTransport:
    run, rows, steps, values, step, report = found
    count = len(rows) // ends
    return NeuronTransport(
        _read_only(step * np.arange(count)),
        rows.reshape(count, ends, 3),
        _read_only(step * np.array(steps)),
        values.reshape(len(steps), -1, 3),
        json.loads(report),
        run,
    )


def _write_vtu(path: Union[str, "os.PathLike[str]"], content: bytes, what: str) -> None:
    name = os.fspath(path)
    if not name.lower().endswith(".vtu"):
        raise WriteError(f"{name}: {what} is written as .vtu")
    _write(name, content)


@dataclass(frozen=True, eq=False, repr=False)
class NeuronSplines:
    """A mesh of a neuron of tricubic cells, patches of cubic splines. Lengths are in micrometres.

    Attributes
    ----------
    control_points : numpy.ndarray of float, shape (n, 3)
        Places.
    cells : numpy.ndarray of int, shape (m, 64)
        The control points of each cell, the first axis fastest.
    branches : numpy.ndarray of int, shape (m,)
        The branch of each cell; -1, -2, … at nodes.
    elements : numpy.ndarray of int, shape (e, 5)
        The elements of the splines: how often each was halved, its cell, and its place there along the three axes, among the elements of
        its size.
    vtu : bytes
        The cells, or the elements where they were refined, as a VTK unstructured grid of trilinear cells, 27 for each.
    report : dict
        What ``pompeiu neuron spline --json`` says of it under ``mesh`` and ``spline``.
    """

    control_points: np.ndarray
    cells: np.ndarray
    branches: np.ndarray
    elements: np.ndarray
    vtu: bytes
    report: Dict[str, Any]
    _space: _native.NeuronSplineSpace

    @property
    def certified(self) -> bool:
        """Whether the Jacobian determinant is proven positive over every cell."""
        return self.report["mesh"]["certified"]

    def extraction(self) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Which functions each element has, and their Bézier coefficients there: what a solver needs of the splines.

        Returns
        -------
        starts : numpy.ndarray of int, shape (e + 1,)
            The functions of element ``k`` are ``functions[starts[k] : starts[k + 1]]``.
        functions : numpy.ndarray of int, shape (f,)
            Numbers of functions.
        coefficients : numpy.ndarray of float, shape (f, 64)
            Bézier coefficients of these functions over the element, the first axis fastest.
        """
        return self._space.extraction()

    def positions(self) -> np.ndarray:
        """The coefficients of the positions, one row for each function: the geometry in terms of the splines, but for rounding."""
        return self._space.positions()

    def write(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the mesh as a ``.vtu`` file."""
        _write_vtu(path, self.vtu, "a mesh of a neuron")

    def __repr__(self) -> str:
        verdict = "certified" if self.certified else "not certified"
        return f"NeuronSplines({len(self.cells)} cells, {self.report['spline']['functions']} functions, {verdict})"


@dataclass(frozen=True, eq=False, repr=False)
class NeuronFlow:
    """The steady viscous flow through a neuron. Lengths are in micrometres, times in seconds, pressures in pascals.

    Attributes
    ----------
    control_points : numpy.ndarray of float, shape (n, 3)
        Places.
    cells : numpy.ndarray of int, shape (m, 64)
        The control points of each cell, the first axis fastest.
    branches : numpy.ndarray of int, shape (m,)
        The branch of each cell; -1, -2, … at nodes.
    velocity : numpy.ndarray of float, shape (n, 3)
        Bézier coefficients of the velocity.
    pressure : numpy.ndarray of float, shape (m,)
        In the middle of each cell.
    end_samples : numpy.ndarray of int, shape (c,)
        For each flat end the number of its sample.
    end_fluxes : numpy.ndarray of float, shape (c,)
        What flows out there.
    end_pressures : numpy.ndarray of float, shape (c,)
        The mean pressure there.
    vtu : bytes
        The flow as a VTK unstructured grid of trilinear cells, 27 for each.
    report : dict
        What ``pompeiu neuron flow --json`` says of it under ``mesh`` and ``flow``.
    """

    control_points: np.ndarray
    cells: np.ndarray
    branches: np.ndarray
    velocity: np.ndarray
    pressure: np.ndarray
    end_samples: np.ndarray
    end_fluxes: np.ndarray
    end_pressures: np.ndarray
    vtu: bytes
    report: Dict[str, Any]
    _flow: _native.NeuronFlow
    _origin: _Origin

    def write(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the flow as a ``.vtu`` file."""
        _write_vtu(path, self.vtu, "a flow")

    def transport(
        self,
        config: Union[str, "os.PathLike[str]"] = "",
        *,
        parts: int = 2,
        frames: int = 20,
        resume: Optional[Union[str, "os.PathLike[str]"]] = None,
        time_limit: Optional[float] = None,
        memory_limit: Optional[int] = None,
        progress: Optional[Callable[[float], Optional[bool]]] = None,
    ) -> NeuronTransport:
        """Lets material diffuse and be carried along the flow: conservative, and without negative concentrations.

        Parameters
        ----------
        config : str or path
            Parameters as text (TOML with units, or pairs of names and values), or the path of a file of them. The flow stays as it is.
        parts : int
            Parts of each cell of the flow along each edge, 1 to 8.
        frames : int
            Fields that are kept, the first and the last among them.
        resume : path, optional
            A checkpoint to go on from (:meth:`NeuronTransport.save_checkpoint`); steps count from the beginning.
        time_limit, memory_limit : optional
            Limits; with the first, the steps that are done are returned.
        progress : callable, optional
            Called with the share of steps that are done; ``False`` ends it.

        Raises
        ------
        OptionError
            As for :meth:`NeuronMesh.transport`.
        """
        _check_frames(frames)
        if parts < 1:
            raise OptionError(f"the number of parts of a cell is {parts}; expected 1 to 8")
        text = _config(config)
        run = self._origin.run(int(parts), resume, self._flow.other_than(text))
        found = self._flow.transport(int(parts), text, int(frames), run, time_limit, memory_limit, progress)
        return _transport(found, len(self.end_samples))

    def __repr__(self) -> str:
        reynolds, drift = self.report["flow"]["reynolds"], self.report["flow"]["section_flux_drift"]
        return f"NeuronFlow({len(self.cells)} cells, Reynolds number {reynolds:.3g}, fluxes kept to {drift:.1e})"


@dataclass(frozen=True, eq=False, repr=False)
class NeuronMesh:
    """A hexahedral mesh of a neuron. Lengths are in micrometres.

    Attributes
    ----------
    vertices : numpy.ndarray of float, shape (n, 3)
        Places.
    cells : numpy.ndarray of int, shape (m, 8)
        The vertices of each cell, in the order of VTK.
    branches : numpy.ndarray of int, shape (m,)
        The branch of each cell; -1, -2, … at nodes.
    boundary : numpy.ndarray of int, shape (b, 4)
        The faces of the boundary, counter-clockwise seen from outside.
    caps : numpy.ndarray of int, shape (b,)
        For each of these faces the flat end that it lies on, -1 on the wall.
    cap_samples : numpy.ndarray of int, shape (c,)
        For each flat end the number of its sample.
    vtu : bytes
        The mesh as a VTK unstructured grid.
    report : dict
        What ``pompeiu neuron mesh --json`` says of it under ``mesh``.
    """

    vertices: np.ndarray
    cells: np.ndarray
    branches: np.ndarray
    boundary: np.ndarray
    caps: np.ndarray
    cap_samples: np.ndarray
    vtu: bytes
    report: Dict[str, Any]
    _mesh: _native.NeuronHexahedra
    _origin: _Origin
    _parts: int = 2

    @property
    def certified(self) -> bool:
        """Whether the Jacobian determinant is proven positive over every cell."""
        return self.report["certified"]

    @property
    def within(self) -> Optional[bool]:
        """Whether the wall is proven to be within the tolerated distance of the cones of the skeleton, both ways, or farther away.

        ``None`` where neither is proven, and for a mesh that was not made from a skeleton.
        """
        return self._mesh.is_within()

    def write(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the mesh as a ``.vtu`` file."""
        _write_vtu(path, self.vtu, "a mesh of a neuron")

    def transport(
        self,
        config: Union[str, "os.PathLike[str]"] = "",
        *,
        frames: int = 20,
        resume: Optional[Union[str, "os.PathLike[str]"]] = None,
        time_limit: Optional[float] = None,
        memory_limit: Optional[int] = None,
        progress: Optional[Callable[[float], Optional[bool]]] = None,
    ) -> NeuronTransport:
        """Lets material diffuse and be carried through the mesh: conservative, and without negative concentrations.

        Parameters
        ----------
        config : str or path
            Parameters as text (TOML with units, or pairs of names and values), or the path of a file of them.
        frames : int
            Fields that are kept, the first and the last among them.
        resume : path, optional
            A checkpoint to go on from (:meth:`NeuronTransport.save_checkpoint`); steps count from the beginning.
        time_limit, memory_limit : optional
            Limits; with the first, the steps that are done are returned.
        progress : callable, optional
            Called with the share of steps that are done; ``False`` ends it.

        Raises
        ------
        OptionError
            If a key is unknown, a unit is wrong, or there is no inlet: the message says where, and what was expected.

        Examples
        --------
        >>> import pompeiu
        >>> mesh = pompeiu.read_skeleton(b"1 2 0 0 0 1 -1\\n2 2 8 0 0 1 1\\n").mesh(parts=1)
        >>> mesh.transport("[transport]\\nsteps = 5").ends.shape
        (6, 2, 3)
        """
        _check_frames(frames)
        text = _config(config)
        run = self._origin.run(self._parts, resume)
        found = self._mesh.transport(text, int(frames), run, time_limit, memory_limit, progress)
        return _transport(found, len(self.cap_samples))

    def splines(
        self,
        *,
        elements: int = 1,
        refine: Sequence[str] = (),
        levels: int = 1,
        threads: Optional[int] = None,
        time_limit: Optional[float] = None,
        memory_limit: Optional[int] = None,
        progress: Optional[Callable[[float], Optional[bool]]] = None,
    ) -> NeuronSplines:
        """Makes each cell a patch of cubic splines: for meshes that were made elsewhere. See :meth:`Skeleton.splines`; places to refine
        are ``"ends"``, ``"wall"`` and ``"ball=x,y,z,r"``.
        """
        meshing = _meshing(elements, 2.0, threads, time_limit, memory_limit)
        return _splines(self._mesh, meshing, refine, levels, progress)

    def flow(
        self,
        config: Union[str, "os.PathLike[str]"] = "",
        *,
        elements: int = 1,
        threads: Optional[int] = None,
        time_limit: Optional[float] = None,
        memory_limit: Optional[int] = None,
        progress: Optional[Callable[[float], Optional[bool]]] = None,
    ) -> NeuronFlow:
        """Makes each cell a patch, and solves for the steady viscous flow through them: for meshes that were made elsewhere, between their
        ends. See :meth:`Skeleton.flow`.
        """
        meshing = _meshing(elements, 2.0, threads, time_limit, memory_limit)
        return _flow(self._mesh, meshing, config, progress, replace(self._origin, stage=f"all {elements}"))

    def __repr__(self) -> str:
        verdict = "certified" if self.certified else "not certified"
        return f"NeuronMesh({len(self.vertices)} vertices, {len(self.cells)} hexahedra, {verdict})"


def _meshing(
    elements: int,
    layer: float,
    threads: Optional[int],
    time_limit: Optional[float],
    memory_limit: Optional[int],
) -> Dict[str, Any]:
    if not 1 <= elements <= 4:
        raise OptionError(f"the number of elements of a patch is {elements}; expected 1 to 4")
    return _of_blocks(elements, layer, None, (threads, time_limit, memory_limit))


def _trilinear(
    parts: int,
    layer: float,
    within: float,
    threads: Optional[int],
    time_limit: Optional[float],
    memory_limit: Optional[int],
) -> Dict[str, Any]:
    if parts < 1:
        raise OptionError(f"the number of parts of a block is {parts}; expected 1 to 8")
    return _of_blocks(parts, layer, float(within), (threads, time_limit, memory_limit))


def _of_blocks(
    parts: int, layer: float, within: Optional[float], limits: Tuple[Optional[int], Optional[float], Optional[int]]
) -> Dict[str, Any]:
    asked = {"parts": int(parts), "layer": float(layer), "within": within}
    return {**asked, **dict(zip(("threads", "time_limit", "memory_limit"), limits))}


def _splines(
    source: Any,
    meshing: Dict[str, Any],
    refine: Sequence[str],
    levels: int,
    progress: Optional[Callable[[float], Optional[bool]]],
) -> NeuronSplines:
    if not 1 <= levels <= 5:
        raise OptionError(f"the number of levels of refinement is {levels}; expected 1 to 5")
    return _splines_of(source.splines(meshing, list(refine), int(levels), progress))


def _splines_of(parts: Any) -> NeuronSplines:
    space, *found, mesh, spline = parts
    return NeuronSplines(*found, {"mesh": json.loads(mesh), "spline": json.loads(spline)}, space)


def _flow(
    source: Any,
    meshing: Dict[str, Any],
    config: Union[str, "os.PathLike[str]"],
    progress: Optional[Callable[[float], Optional[bool]]],
    origin: _Origin,
) -> NeuronFlow:
    return _flow_of(source.flow(meshing, _config(config), progress), origin)


def _flow_of(parts: Any, origin: _Origin) -> NeuronFlow:
    native, *found, samples, ends, vtu, mesh, flow = parts
    report = {"mesh": json.loads(mesh), "flow": json.loads(flow)}
    return NeuronFlow(*found, samples, ends[:, 0], ends[:, 1], vtu, report, native, origin)


@dataclass(frozen=True)
class SkeletonCheck:
    """Whether a neuron can be meshed.

    Attributes
    ----------
    meshable : bool, optional
        Whether every cell of a mesh is proven valid and its wall proven to be within the tolerated distance of the cones; ``None`` if
        that is not decided.
    problems : list of dict
        What the mesh cannot do, each with its ``kind``, ``sample``, ``line`` and ``message``; empty unless ``meshable`` is ``False``.
    """

    meshable: Optional[bool]
    problems: List[Dict[str, Any]]


@dataclass(frozen=True, eq=False, repr=False)
class Skeleton:
    """The skeleton of a neuron: balls, each with its parent before it. Lengths are in micrometres.

    Attributes
    ----------
    ids : numpy.ndarray of int, shape (n,)
        The numbers of the samples in the file.
    kinds : numpy.ndarray of int, shape (n,)
        Structures: 1 soma, 2 axon, 3 and 4 dendrites.
    positions : numpy.ndarray of float, shape (n, 3)
        Centres.
    radii : numpy.ndarray of float, shape (n,)
        Radii.
    parents : numpy.ndarray of int, shape (n,)
        For each sample the index of the one that it continues, -1 for a root.
    swc : str
        The skeleton as an SWC file.
    report : dict
        What ``pompeiu neuron mesh --json`` says of it under ``skeleton``.
    """

    ids: np.ndarray
    kinds: np.ndarray
    positions: np.ndarray
    radii: np.ndarray
    parents: np.ndarray
    swc: str
    report: Dict[str, Any]
    _skeleton: _native.NeuronSkeleton
    _origin: _Origin

    @property
    def problems(self) -> List[Dict[str, Any]]:
        """Defects of the file and of its shape, each with its ``kind``, ``branch``, ``sample``, ``line`` and ``message``."""
        return self.report["problems"]

    def check(
        self,
        *,
        parts: int = 2,
        layer: float = 2.0,
        within: float = 0.2,
        threads: Optional[int] = None,
        time_limit: Optional[float] = None,
        memory_limit: Optional[int] = None,
        progress: Optional[Callable[[float], Optional[bool]]] = None,
    ) -> "SkeletonCheck":
        """Finds out whether :meth:`mesh` can mesh the neuron with the same options, and where and why it cannot. It takes as long.

        Parameters
        ----------
        parts, layer, within, threads, time_limit, memory_limit, progress
            As for :meth:`mesh`.

        Raises
        ------
        OptionError
            If an option makes no sense, or a limit ends it.

        Examples
        --------
        >>> import pompeiu
        >>> pompeiu.read_skeleton(b"1 2 0 0 0 1 -1\\n2 2 8 0 0 1 1\\n").check().meshable
        True
        """
        meshing = _trilinear(parts, layer, within, threads, time_limit, memory_limit)
        meshable, problems = self._skeleton.check(meshing, progress)
        return SkeletonCheck(meshable, json.loads(problems))

    def mesh(
        self,
        *,
        parts: int = 2,
        layer: float = 2.0,
        within: float = 0.2,
        threads: Optional[int] = None,
        time_limit: Optional[float] = None,
        memory_limit: Optional[int] = None,
        progress: Optional[Callable[[float], Optional[bool]]] = None,
    ) -> NeuronMesh:
        """Fills the neuron with hexahedra, every cell proven valid.

        Parameters
        ----------
        parts : int
            Parts of each block along each edge: 1, 2 and 3 give 5, 20 and 45 cells to a section.
        layer : float
            Length of a block along a branch, in radii.
        within : float
            Tolerated distance of the wall from the cones of the skeleton, both ways, in radii: see :attr:`NeuronMesh.within`.
        threads, time_limit, memory_limit : optional
            Limits; there is no mesh when one is reached.
        progress : callable, optional
            Called with the share of nodes that are done; ``False`` ends it.

        Raises
        ------
        OptionError
            If an option makes no sense, or the neuron cannot be meshed: the message says where, and why.

        Examples
        --------
        >>> import pompeiu
        >>> pompeiu.read_skeleton(b"1 2 0 0 0 1 -1\\n2 2 8 0 0 1 1\\n").mesh(parts=1)
        NeuronMesh(40 vertices, 20 hexahedra, certified)
        """
        meshing = _trilinear(parts, layer, within, threads, time_limit, memory_limit)
        native, *found, report = self._skeleton.mesh(meshing, progress)
        return NeuronMesh(*found, json.loads(report), native, replace(self._origin, layer=float(layer)), int(parts))

    def splines(
        self,
        *,
        elements: int = 1,
        layer: float = 2.0,
        refine: Sequence[str] = (),
        levels: int = 1,
        threads: Optional[int] = None,
        time_limit: Optional[float] = None,
        memory_limit: Optional[int] = None,
        progress: Optional[Callable[[float], Optional[bool]]] = None,
    ) -> NeuronSplines:
        """Fills the neuron with tricubic cells, patches of cubic splines, every cell proven valid.

        Refined splines are truncated hierarchical ones: not negative, with the sum one, linearly independent. They contain those without
        refinement, and all splines of the smaller elements where these were asked for.

        Parameters
        ----------
        elements : int
            Elements of splines of each patch along each edge, 1 to 4.
        layer : float
            Length of a patch along a branch, in radii.
        refine : sequence of str
            Places where elements are halved: ``"nodes"``, ``"ends"``, ``"wall"``, ``"branch=3"``, ``"sample=57"`` (within the ball of
            that sample) or ``"ball=x,y,z,r"``.
        levels : int
            How often, 1 to 5.
        threads, time_limit, memory_limit, progress : optional
            As for :meth:`mesh`.

        Raises
        ------
        OptionError
            As for :meth:`mesh`, and where there is no element in a place.

        Examples
        --------
        >>> import pompeiu
        >>> pompeiu.read_skeleton(b"1 2 0 0 0 1 -1\\n2 2 8 0 0 1 1\\n").splines()
        NeuronSplines(25 cells, 832 functions, certified)
        """
        meshing = _meshing(elements, layer, threads, time_limit, memory_limit)
        return _splines(self._skeleton, meshing, refine, levels, progress)

    def flow(
        self,
        config: Union[str, "os.PathLike[str]"] = "",
        *,
        elements: int = 1,
        layer: float = 2.0,
        threads: Optional[int] = None,
        time_limit: Optional[float] = None,
        memory_limit: Optional[int] = None,
        progress: Optional[Callable[[float], Optional[bool]]] = None,
    ) -> NeuronFlow:
        """Fills the neuron with tricubic cells and solves for the steady viscous flow through them.

        Parameters
        ----------
        config : str or path
            Parameters as text in TOML with units, or the path of a file of them: the tables ``[flow]`` and ``[inlet]``.
        elements, layer, threads, time_limit, memory_limit, progress
            As for :meth:`splines`; the flow has the elements as cells.

        Raises
        ------
        OptionError
            As for :meth:`mesh`, and where nothing can flow.
        """
        meshing = _meshing(elements, layer, threads, time_limit, memory_limit)
        origin = replace(self._origin, layer=float(layer), stage=f"all {elements}")
        return _flow(self._skeleton, meshing, config, progress, origin)

    def __repr__(self) -> str:
        branches, tips = self.report["branches"], self.report["tips"]
        return f"Skeleton({len(self.ids)} samples, {branches} branches, {tips} tips, {len(self.problems)} problems)"


def read_skeleton(
    source: Union[str, "os.PathLike[str]", bytes],
    *,
    repair: bool = False,
    smooth: int = 0,
    spacing: Optional[float] = None,
) -> Skeleton:
    """Reads the skeleton of a neuron.

    Parameters
    ----------
    source : path or bytes
        An SWC file, or what is in one.
    repair : bool
        Repair missing parents, cycles, missing radii, coincident samples and branches within the ball of their node. What was
        done is in ``report["repairs"]``.
    smooth : int
        Steps of smoothing along branches, radius included.
    spacing : float, optional
        Distance of new samples along smooth branches, in micrometres. How far both move the samples is in
        ``report["deviation"]``.

    Raises
    ------
    ReadError
        If the file holds no tree: the message says in which line, and why.
    OptionError
        If options make no sense.

    Examples
    --------
    >>> import pompeiu
    >>> pompeiu.read_skeleton(b"1 1 0 0 0 3 -1\\n2 3 9 0 0 1 1\\n3 3 0 9 0 1 1\\n")
    Skeleton(3 samples, 2 branches, 2 tips, 0 problems)
    """
    if smooth < 0:
        raise OptionError(f"the number of steps of smoothing is {smooth}; it must not be negative")
    if spacing is not None and not (math.isfinite(spacing) and spacing > 0):
        raise OptionError(f"the spacing is {spacing}; it must be a finite length above 0")
    if isinstance(source, bytes):
        content, name = source, None
    else:
        content, name = _content(source), os.fspath(source)
    try:
        native, *parts, report = _native.read_skeleton(content, bool(repair), int(smooth), spacing)
    except ReadError as error:
        if name is None:
            raise
        raise ReadError(f"{name}: {error}") from None
    return Skeleton(*parts, json.loads(report), native, _Origin(content, bool(repair), int(smooth), spacing))


def read_neuron_mesh(source: Union[str, "os.PathLike[str]"], *, sides: Sequence[str] = ()) -> NeuronMesh:
    """Reads a hexahedral mesh from a ``.vtk`` or ``.vtu`` file, for transport through it: heat in a block, for instance.

    Parameters
    ----------
    source : path
        An unstructured grid of hexahedra.
    sides : sequence of str
        Sides of the box around the mesh that are its ends, such as ``["-x", "+x"]``: the inlet first. Without them, the ends are where
        the file's point data ``label`` says so: 1 at the inlet, 2 and more at other ends.

    Raises
    ------
    ReadError
        If the file holds no hexahedra.
    OptionError
        If a cell is folded, cells do not meet face to face, or a side is no end.
    """
    name = os.fspath(source)
    if not os.path.exists(name):
        raise MissingFileError(f"{name}: there is no such file; check the name and the folder")
    native, *found, report = _native.read_neuron_mesh(name, list(sides))
    with open(name, "rb") as file:
        return NeuronMesh(*found, json.loads(report), native, _Origin(file.read()))


@dataclass(frozen=True, eq=False, repr=False)
class Neuron:
    """What the stages of :func:`neuron` left; what was not computed is none.

    Attributes
    ----------
    report : dict
        What ``pompeiu neuron --json`` says of each stage.
    stop : str
        Why the computation ended: ``"tolerance"`` if all stages are done, else the limit that ended it.
    skeleton : Skeleton
        The skeleton, unless a mesh was given.
    mesh : NeuronMesh
        Trilinear cells of the stage mesh.
    splines : NeuronSplines
        Tricubic cells and splines of the stage spline.
    flow : NeuronFlow
        The flow of the stage flow.
    transport : NeuronTransport
        What became of material.
    """

    report: Dict[str, Any]
    stop: str
    skeleton: Optional[Skeleton] = None
    mesh: Optional[NeuronMesh] = None
    splines: Optional[NeuronSplines] = None
    flow: Optional[NeuronFlow] = None
    transport: Optional[NeuronTransport] = None

    def __repr__(self) -> str:
        done = [name for name in ("skeleton", "mesh", "spline", "flow", "transport") if name in self.report]
        return f"Neuron({', '.join(done)})" if self.stop == "tolerance" else f"Neuron({', '.join(done)}, stopped by {self.stop})"


def neuron(
    source: Union[str, "os.PathLike[str]", bytes],
    *,
    stage: Literal["check", "mesh", "spline", "flow", "transport", "all"] = "all",
    repair: bool = False,
    smooth: int = 0,
    spacing: Optional[float] = None,
    parts: int = 2,
    layer: float = 2.0,
    within: float = 0.2,
    elements: int = 1,
    refine: Sequence[str] = (),
    levels: int = 1,
    frames: int = 20,
    resume: Optional[str] = None,
    parameters: Optional[str] = None,
    transport: Optional[Mapping[str, Any]] = None,
    flow: Optional[Mapping[str, Any]] = None,
    inlet: Optional[Mapping[str, Any]] = None,
    tips: Optional[Mapping[str, Any]] = None,
    initial: Optional[Mapping[str, Any]] = None,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[int] = None,
    progress: Optional[Callable[[float], Optional[bool]]] = None,
) -> Neuron:
    """Computes what travels through a neuron, from its skeleton on: what ``pompeiu neuron`` does.

    To work with what a stage left, or to repeat one of them, use :func:`read_skeleton` and the methods of its result.

    Parameters
    ----------
    source : path or bytes
        A skeleton (SWC) or what is in one, or a hexahedral mesh (``.vtk``, ``.vtu``).
    stage : str
        The last stage; the command also takes its name before the file. ``"check"``: the skeleton is read, and what is
        wrong with it and what the stage mesh cannot do is reported; it takes as long as that; ``"mesh"``: the neuron is
        filled with trilinear cells; ``"spline"``: the neuron is filled with tricubic cells, and the splines over them
        are counted; ``"flow"``: tricubic cells, and the steady viscous flow through them; ``"transport"``: trilinear
        cells, and transport through them along the potential flow; ``"all"``: tricubic cells, the viscous flow, and
        transport along it.
    repair : bool
        Repair what can be repaired: missing parents, cycles, missing radii, coincident samples, branches within the
        ball of their node; each repair is reported.
    smooth : int
        Steps of smoothing along branches, radius included.
    spacing : float, optional
        Distance of new samples along smooth branches, in micrometres.
    parts : int
        Parts of each block along each edge, 1 to 8: for trilinear cells 1, 2 and 3 give 5, 20 and 45 to a section;
        cells of a flow are cut into so many for transport.
    layer : float
        Length of a block or a patch along a branch, in radii.
    within : float
        Tolerated distance of the wall from the cones of the file, both ways, in radii; the exit code is 1 if it is
        greater, and no stage follows the mesh.
    elements : int
        Elements of each patch along each edge, 1 to 4, for splines and flow.
    refine : Sequence[str]
        Stage spline: halve elements here: nodes, ends, wall, branch=N, sample=ID or ball=X,Y,Z,R; may be given more
        than once.
    levels : int
        Stage spline: how often elements are halved there, 1 to 5.
    frames : int
        Frames of transport that are kept, the first and the last among them.
    resume : str, optional
        Go on from a state that was written as a checkpoint, with the same options; steps count from the beginning.
    parameters : str, optional
        A file of parameters, in the place of the tables below: TOML with units, or pairs of names and values of other
        programs.
    transport : Mapping[str, Any], optional
        Diffusion, speeds, rates and time steps of transport; in files the table called transport.
    flow : Mapping[str, Any], optional
        The fluid and what drives it; in files the table called flow.
    inlet : Mapping[str, Any], optional
        The inlet and what enters there; in files the table called inlet.
    tips : Mapping[str, Any], optional
        The conditions at the other flat ends; in files the table called tips.
    initial : Mapping[str, Any], optional
        Concentrations in the beginning; in files the table called initial.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
    memory_limit : int, optional
        Stop before memory exceeds so many bytes, with the answer found by then.
    progress : callable, optional
        Called with the share of a stage that is done; ``False`` ends it.

    Raises
    ------
    ReadError
        If the file cannot be used: the message says in which line, and why.
    OptionError
        If options make no sense, the neuron cannot be meshed, or nothing can flow.

    Examples
    --------
    >>> import pompeiu
    >>> rod = b"1 2 0 0 0 1 -1\\n2 2 8 0 0 1 1\\n"
    >>> pompeiu.neuron(rod, stage="transport", parts=1, within=0.3, transport={"steps": 5})
    Neuron(skeleton, mesh, transport)
    """
    given = dict(locals())
    del given["source"]
    answer, beside = ask("neuron", given, meshes=(), others=[source if isinstance(source, bytes) else os.fspath(source)])
    made = beside["parts"]
    content = source if isinstance(source, bytes) else _content(source)
    origin = _Origin(content, bool(repair), int(smooth), spacing, float(layer))
    found: Dict[str, Any] = {}
    if "skeleton" in made:
        native, *rows, report = made["skeleton"]
        found["skeleton"] = Skeleton(*rows, json.loads(report), native, origin)
    if "mesh" in made:
        native, *rows, report = made["mesh"]
        found["mesh"] = NeuronMesh(*rows, json.loads(report), native, origin, int(parts))
    if "splines" in made:
        found["splines"] = _splines_of(made["splines"])
    if "flow" in made:
        found["flow"] = _flow_of(made["flow"], replace(origin, stage=f"all {elements}"))
    if "transport" in made:
        found["transport"] = _transport(made["transport"], len(made["transport"][1]) // (answer["report"]["transport"]["steps"] + 1))
    return Neuron(answer["report"], answer["stop"], **found)


@lru_cache(maxsize=2)
def _sweep_mesh(content: bytes, options: Tuple[bool, int, float, int]) -> NeuronMesh:
    """The mesh of a skeleton, made once for each process that works on a sweep."""
    repair, parts, layer, threads = options
    return read_skeleton(content, repair=repair).mesh(parts=parts, layer=layer, threads=threads)


@lru_cache(maxsize=2)
def _sweep_flow(content: bytes, config: str, options: Tuple[bool, int, float, int]) -> NeuronFlow:
    repair, _, layer, threads = options
    return read_skeleton(content, repair=repair).flow(config, layer=layer, threads=threads)


def _sweep_task(
    content: bytes, config: str, viscous: bool, frames: int, options: Tuple[bool, int, float, int]
) -> NeuronTransport:
    """Transport through one neuron with one configuration: a pure function of its arguments."""
    if viscous:
        return _sweep_flow(content, config, options).transport(config, parts=options[1], frames=frames)
    return _sweep_mesh(content, options).transport(config, frames=frames)


def _sweep_inputs(
    skeletons: Sequence[Union[str, "os.PathLike[str]", bytes]],
    configs: Sequence[Union[str, "os.PathLike[str]"]],
    frames: int,
) -> Tuple[List[bytes], List[str]]:
    """The contents of files; what is wrong with one is an error before anything is computed."""
    _check_frames(frames)
    contents = []
    for skeleton in skeletons:
        if not isinstance(skeleton, bytes):
            name = os.fspath(skeleton)
            read_skeleton(name, repair=True)
            with open(name, "rb") as file:
                skeleton = file.read()
        contents.append(skeleton)
    return contents, [_config(config) for config in configs]


def sweep_neurons(
    skeletons: Sequence[Union[str, "os.PathLike[str]", bytes]],
    configs: Sequence[Union[str, "os.PathLike[str]"]],
    *,
    viscous: bool = False,
    repair: bool = False,
    parts: int = 2,
    layer: float = 2.0,
    frames: int = 2,
    threads: int = 1,
) -> List[List[NeuronTransport]]:
    """Transport through several neurons with several configurations; :func:`pompeiu.ray.sweep_neurons` does it on many machines.

    Parameters
    ----------
    skeletons : sequence of path or bytes
        SWC files, or what is in them.
    configs : sequence of str or path
        Configurations as text, or paths of files of them: velocities, rates, ends.
    viscous : bool
        Solve for the viscous flow of each neuron and configuration, and move along it, as ``pompeiu neuron`` does; without it motors
        follow the potential flow, as with ``pompeiu neuron transport``.
    repair, parts, layer, frames
        As for :func:`read_skeleton`, :meth:`Skeleton.mesh` and :meth:`NeuronMesh.transport`.
    threads : int
        Processors for meshing and for the flow. Results are the same for any number.

    Returns
    -------
    list of list of NeuronTransport
        For each skeleton, one for each configuration.

    Raises
    ------
    ReadError, OptionError
        For the first skeleton or configuration that makes no sense.
    """
    contents, texts = _sweep_inputs(skeletons, configs, frames)
    options = (bool(repair), int(parts), float(layer), int(threads))
    return [[_sweep_task(content, text, viscous, frames, options) for text in texts] for content in contents]
