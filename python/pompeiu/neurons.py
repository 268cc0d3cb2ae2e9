"""Neurons: skeletons read in all dialects of SWC, what is wrong with them, hexahedral meshes, and transport through them."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Optional, Union

import numpy as np

from . import _native
from .errors import MissingFileError, OptionError, ReadError, WriteError

__all__ = ["NeuronMesh", "NeuronTransport", "Skeleton", "read_skeleton"]


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

    def __repr__(self) -> str:
        steps, balance = self.report["steps"], self.report["mass_balance"]
        return f"NeuronTransport({steps} steps, mass kept to {balance:.1e})"


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

    @property
    def certified(self) -> bool:
        """Whether the Jacobian determinant is proven positive over every cell."""
        return self.report["certified"]

    def write(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the mesh as a ``.vtu`` file."""
        name = os.fspath(path)
        if not name.lower().endswith(".vtu"):
            raise WriteError(f"{name}: a mesh of a neuron is written as .vtu")
        try:
            with open(name, "wb") as file:
                file.write(self.vtu)
        except OSError as error:
            raise WriteError(f"{name}: {error.strerror}") from error

    def transport(
        self,
        config: Union[str, "os.PathLike[str]"] = "",
        *,
        frames: int = 20,
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
        if frames < 2:
            raise OptionError(f"the number of frames is {frames}; at least 2 are needed")
        text = config if isinstance(config, str) else ""
        if not isinstance(config, str):
            name = os.fspath(config)
            try:
                with open(name, encoding="utf-8") as file:
                    text = file.read()
            except FileNotFoundError as error:
                raise MissingFileError(f"{name}: there is no such file; check the name and the folder") from error
            except (OSError, UnicodeDecodeError) as error:
                raise ReadError(f"{name}: {error}") from error
        found = self._mesh.transport(text, int(frames), time_limit, memory_limit, progress)
        ends, steps, values, step, report = found
        count = len(ends) // len(self.cap_samples)
        return NeuronTransport(
            step * np.arange(count),
            ends.reshape(count, len(self.cap_samples), 3),
            step * np.array(steps),
            values.reshape(len(steps), len(self.cells), 3),
            json.loads(report),
        )

    def __repr__(self) -> str:
        verdict = "certified" if self.certified else "not certified"
        return f"NeuronMesh({len(self.vertices)} vertices, {len(self.cells)} hexahedra, {verdict})"


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
        What ``pompeiu neuron check --json`` says of it under ``skeleton``.
    """

    ids: np.ndarray
    kinds: np.ndarray
    positions: np.ndarray
    radii: np.ndarray
    parents: np.ndarray
    swc: str
    report: Dict[str, Any]
    _skeleton: _native.NeuronSkeleton

    @property
    def problems(self) -> List[Dict[str, Any]]:
        """What a mesh of it would suffer from, each with its ``kind``, ``branch``, ``sample``, ``line`` and ``message``."""
        return self.report["problems"]

    def mesh(
        self,
        *,
        parts: int = 2,
        layer: float = 2.0,
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
        if parts < 1:
            raise OptionError(f"the number of parts of a block is {parts}; expected 1 to 8")
        meshing = {
            "parts": int(parts),
            "layer": float(layer),
            "threads": threads,
            "time_limit": time_limit,
            "memory_limit": memory_limit,
        }
        native, *found, report = self._skeleton.mesh(meshing, progress)
        return NeuronMesh(*found, json.loads(report), native)

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
        name = os.fspath(source)
        try:
            with open(name, "rb") as file:
                content = file.read()
        except FileNotFoundError as error:
            raise MissingFileError(f"{name}: there is no such file; check the name and the folder") from error
        except OSError as error:
            raise ReadError(f"{name}: {error.strerror}") from error
    try:
        native, *parts, report = _native.read_skeleton(content, bool(repair), int(smooth), spacing)
    except ReadError as error:
        if name is None:
            raise
        raise ReadError(f"{name}: {error}") from None
    return Skeleton(*parts, json.loads(report), native)
