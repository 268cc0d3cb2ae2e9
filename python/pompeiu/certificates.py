"""Certificates of a distance: files from which anybody can prove the answer anew."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from typing import Any, Literal, Mapping, Optional, Sequence, Tuple

from . import _native
from .errors import OptionError
from .sources import Mesh, MeshLike, as_mesh

__all__ = ["Certificate", "Certified", "UnprovenStatement", "Verified", "verify"]


@dataclass(frozen=True)
class Certified:
    """What a certificate proves of one direction: ``lower <= h <= upper``, in the unit of the meshes.

    Attributes
    ----------
    lower, upper : float
        The ends; the lower one is below that of the report by the rounding of the verifier.
    cells : int
        Convex polygons that the mesh was cut into.
    """

    lower: float
    upper: float
    cells: int

    def __contains__(self, value: float) -> bool:
        return self.lower <= value <= self.upper

    @classmethod
    def _of(cls, data: "Optional[Mapping[str, Any]]") -> "Optional[Certified]":
        return None if data is None else cls(data["lower"], data["upper"], data["cells"])


@dataclass(frozen=True)
class Certificate:
    """A certificate that was written.

    Attributes
    ----------
    a_to_b, b_to_a : Certified or None
        What it proves of h(A, B) and of h(B, A).
    bytes : int
        Its size.
    sha256 : tuple of 2 str
        SHA-256 of the triangles of A and of B, in hexadecimal digits.
    """

    a_to_b: Optional[Certified]
    b_to_a: Optional[Certified]
    bytes: int
    sha256: Tuple[str, str]

    @classmethod
    def _of(cls, data: Mapping[str, Any]) -> "Certificate":
        a_to_b, b_to_a = (Certified._of(data[way]) for way in ("a_to_b", "b_to_a"))
        return cls(a_to_b, b_to_a, data["bytes"], (data["sha256"][0], data["sha256"][1]))


#: What is to be proven of one direction: the upper end, and the face, the weights and the distance of the witness.
Ends = Tuple[float, int, Sequence[float], float]
#: Threads, seconds, bytes.
Limits = Tuple[Optional[int], Optional[float], Optional[int]]


def _write(
    path: "str | os.PathLike[str]",
    meshes: Tuple[Mesh, Mesh],
    ends: "Tuple[Optional[Ends], Optional[Ends]]",
    slack: float,
    limits: Limits,
) -> Certificate:
    return Certificate._of(json.loads(_native.write_certificate(path, *meshes, ends, slack, limits)))


class _Within:
    """A mesh that is proven to be within a distance of the mesh that it was made from."""

    mesh: Mesh
    #: The input, and the distance; the latter ``None`` where none was asked for, both where the result was moved.
    _proven: "Tuple[Optional[Mesh], Optional[float]]"

    def certificate(
        self,
        path: "str | os.PathLike[str]",
        *,
        threads: Optional[int] = None,
        time_limit: Optional[float] = None,
        memory_limit: Optional[int] = None,
    ) -> Certificate:
        """Writes a file from which anybody can prove anew that no point of the input (A) or of :attr:`mesh` (B) is farther from the
        other than the distance that was asked for; see :func:`pompeiu.verify`.

        Parameters
        ----------
        path : str or path-like
            The file; it appears whole or not at all.
        threads : int, optional
            Threads to use; all processors by default. The bytes do not depend on it.
        time_limit : float, optional
            Give up after so many seconds.
        memory_limit : int, optional
            Give up before memory exceeds so many bytes.

        Raises
        ------
        OptionError
            If no distance was asked for, or ``center`` moved the result.
        WriteError
            If the file cannot be written, or a limit was reached.
        """
        source, within = self._proven
        if source is None:
            raise OptionError("a certificate is about the triangles of both meshes, but center moved those of the result")
        if within is None:
            raise OptionError("a certificate proves how far the result is from the input; say with within how far it may be")
        ends = (within, 0, (1.0, 0.0, 0.0), 0.0)
        return _write(path, (source, self.mesh), (ends, ends), 0.0, (threads, time_limit, memory_limit))


@dataclass(frozen=True)
class UnprovenStatement:
    """The first statement of a certificate that is not shown.

    Attributes
    ----------
    statement : str
        What it is about: ``"hash-of-a"`` or ``"hash-of-b"``, another mesh; ``"interval"``, ends that are no lengths; ``"witness"``, a
        point that is not far enough; ``"cell"``, a part of a face that is not near enough.
    direction : str or None
        ``"a_to_b"`` or ``"b_to_a"``; ``None`` of a mesh.
    face, cell, other_face : int or None
        The face that the witness or the cell is on, cells of it before this one, and the face of the other mesh.
    message : str
        The same as a sentence.
    """

    statement: Literal["hash-of-a", "hash-of-b", "interval", "witness", "cell"]
    direction: Optional[Literal["a_to_b", "b_to_a"]]
    face: Optional[int]
    cell: Optional[int]
    other_face: Optional[int]
    message: str


@dataclass(frozen=True)
class Verified:
    """What a certificate proves, or why it is not valid. True in a condition if it is valid.

    Attributes
    ----------
    valid : bool
        Whether everything that it states is shown.
    a_to_b, b_to_a : Certified or None
        What is proven of h(A, B) and of h(B, A); ``None`` where nothing is stated, or if it is not valid.
    failure : UnprovenStatement or None
        The first statement that is not shown.
    """

    valid: bool
    a_to_b: Optional[Certified]
    b_to_a: Optional[Certified]
    failure: Optional[UnprovenStatement]

    def __bool__(self) -> bool:
        return self.valid


def verify(
    certificate: "str | os.PathLike[str]",
    a: MeshLike,
    b: MeshLike,
    *,
    threads: Optional[int] = None,
) -> Verified:
    """Checks a certificate: whether it proves what it states of two meshes. Nothing of the search is used.

    Parameters
    ----------
    certificate : str or path-like
        The file, as the method ``certificate`` of a distance, a deviation, or a mesh that was repaired, simplified or remeshed writes it,
        or ``--certificate`` of the commands.
    a, b : MeshLike
        The meshes; see :func:`pompeiu.as_mesh`. Their triangles count, in their order; vertices that are shared or not do not.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.

    Raises
    ------
    ReadError
        If the file is no certificate, of another version, or cut off.

    Examples
    --------
    >>> import os, pompeiu, tempfile
    >>> ball, cube = pompeiu.shapes.icosphere(1.0, 2), pompeiu.shapes.cube(2.0, 1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = os.path.join(folder, "proof.phc")
    ...     written = pompeiu.distance(ball, cube).certificate(path)
    ...     checked = pompeiu.verify(path, ball, cube)
    >>> bool(checked), checked.a_to_b == written.a_to_b
    (True, True)
    """
    report = json.loads(_native.verify_certificate(certificate, as_mesh(a), as_mesh(b), threads))
    failure = None if report["failure"] is None else UnprovenStatement(**report["failure"])
    a_to_b, b_to_a = (Certified._of(report[way]) for way in ("a_to_b", "b_to_a"))
    return Verified(report["valid"], a_to_b, b_to_a, failure)
