"""Distances between two meshes."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass, field
from typing import Any, Literal, Optional, Tuple, Union

from numpy.typing import NDArray

from . import _native
from ._asking import ask
from .certificates import Certificate, Ends, _write
from .errors import OptionError
from .progress import ProgressLike, watching
from .results import DirectedReport, SymmetricReport, _Interval
from .sources import Mesh, MeshLike, as_mesh, points_or_mesh

__all__ = ["DEFAULT_TOLERANCE", "Distance", "Target", "directed_hausdorff", "distance", "hausdorff"]

#: The default width of an enclosure, as a fraction of the diagonal of the joint bounding box.
DEFAULT_TOLERANCE = 1e-12

ToleranceKind = Literal["diagonal", "relative", "absolute"]
Method = Literal["fast", "classic"]

_LIMITS = ("threads", "time_limit", "memory_limit")


class Target:
    """A mesh with its tree built: measure many meshes against it.

    Parameters
    ----------
    mesh : MeshLike
        See :func:`pompeiu.as_mesh`.

    Notes
    -----
    Building takes O(m log m) time. A target holds about 107 bytes per face, can be used by many
    threads at once, and cannot be pickled: send the mesh and build again.
    """

    __slots__ = ("_native",)

    def __init__(self, mesh: MeshLike) -> None:
        self._native = _native.Target(as_mesh(mesh))

    @property
    def n_faces(self) -> int:
        """Number of faces."""
        return self._native.n_faces

    @property
    def nbytes(self) -> int:
        """Bytes of memory held."""
        return self._native.nbytes

    @property
    def bounds(self) -> "tuple[Tuple[float, float, float], Tuple[float, float, float]]":
        """Least and greatest corner of the bounding box of the faces."""
        lower, upper = self._native.bounds
        return lower, upper

    def __repr__(self) -> str:
        return f"Target({self.n_faces} faces, {self.nbytes} bytes)"


@dataclass(frozen=True)
class Distance(_Interval):
    """The distance of two meshes, in one direction or both.

    Attributes
    ----------
    lower, upper : float
        The enclosure of what was asked for: of the Pompeiu–Hausdorff distance, or of one direction.
    distance : SymmetricReport or DirectedReport
        The same, with what proves it.
    a_to_b, b_to_a : DirectedReport or None
        How far A is from B, and B from A; ``None`` where only the other direction was asked for.
    hausdorff : SymmetricReport or None
        The Pompeiu–Hausdorff distance, where both directions were asked for.
    answer : str or None
        Whether the distance is at most ``assert_below``: ``"below"``, ``"above"`` or ``"undecided"``.
    stop : str
        Why the search ended; the intervals hold in every case.
    report : dict
        What ``pompeiu distance --json`` says in ``report``: with ``trace``, how the interval narrowed; with ``align``, how B was moved.
    """

    a_to_b: Optional[DirectedReport]
    b_to_a: Optional[DirectedReport]
    hausdorff: Optional[SymmetricReport]
    answer: Optional[str]
    stop: str
    report: "dict[str, Any]" = field(repr=False)
    _meshes: "Tuple[Mesh, Mesh]" = field(repr=False, compare=False)
    _slack: float = field(repr=False, compare=False)

    @property
    def distance(self) -> "Union[SymmetricReport, DirectedReport]":
        """The Pompeiu–Hausdorff distance, or the one direction that was asked for."""
        found = self.hausdorff or self.a_to_b or self.b_to_a
        assert found is not None
        return found

    @property
    def lower(self) -> float:  # type: ignore[override]
        """Lower bound on the distance."""
        return self.distance.lower

    @property
    def upper(self) -> float:  # type: ignore[override]
        """Upper bound on the distance."""
        return self.distance.upper

    def certificate(
        self,
        path: "str | os.PathLike[str]",
        *,
        threads: Optional[int] = None,
        time_limit: Optional[float] = None,
        memory_limit: Optional[int] = None,
    ) -> Certificate:
        """Writes a file from which anybody can prove the distance anew; see :func:`pompeiu.verify`.

        The upper ends are raised by ``certificate_slack`` of the question, a fraction of the joint diagonal. Where the distance is
        proven to be at most ``assert_below``, that length is the upper end.

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
            If B was moved by ``align``: a certificate is about the triangles that were handed in.
        WriteError
            If the file cannot be written, a limit was reached, or rounding hides that the interval holds; a little more slack
            decides that.
        """
        if self.report.get("alignment") is not None:
            raise OptionError("a certificate is about the triangles that were handed in, but align moved B; move it first")
        threshold = self.report["threshold"]["value"] if self.answer == "below" else None

        def ends(one: "Optional[DirectedReport]") -> "Optional[Ends]":
            if one is None:
                return None
            start = one.witness.from_
            return one.upper if threshold is None else threshold, start.face, start.barycentric, one.lower

        slack = self._slack if threshold is None else 0.0
        limits = (threads, time_limit, memory_limit)
        return _write(path, self._meshes, (ends(self.a_to_b), ends(self.b_to_a)), slack, limits)


def distance(
    a: "MeshLike | NDArray[Any]",
    b: "MeshLike | NDArray[Any]",
    *,
    align: Optional[Literal["rigid"]] = None,
    tolerance: float = 1e-12,
    tolerance_kind: Literal["diagonal", "relative", "absolute"] = "diagonal",
    direction: Literal["both", "a-to-b", "b-to-a"] = "both",
    assert_below: Optional[Union[float, str]] = None,
    unit: str = "",
    method: Literal["fast", "classic"] = "fast",
    trace: bool = False,
    certificate_slack: float = 1e-12,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[int] = None,
    progress: ProgressLike = None,
) -> Distance:
    """Encloses the distance of two meshes, of all points of all faces: the question of ``pompeiu distance``.

    Parameters
    ----------
    a, b : MeshLike, or ndarray of shape (n, 3)
        Two meshes in one unit of length, see :func:`pompeiu.as_mesh`, or a mesh and a cloud of points: an array, or a file without faces. How far the
        points are from the mesh is then measured, and not the way back, because between its points a cloud says nothing of the surface.
    align : str, optional
        Move B onto A first, from any start; parts of either may have no counterpart. ``"rigid"``: rotate and translate.
    tolerance : float
        Largest width of the proven intervals.
    tolerance_kind : str
        The unit of the tolerance. ``"diagonal"``: the diagonal of the box around both meshes; ``"relative"``: the
        distance itself; ``"absolute"``: the unit of the files.
    direction : str
        The directed distances to compute. ``"both"``: from A to B and from B to A: the symmetric distance;
        ``"a-to-b"``: from A to B: how far points of A are from B; ``"b-to-a"``: from B to A: how far points of B are
        from A.
    assert_below : Union[float, str], optional
        Ask only whether the distance is at most this length, such as 0.1, 0.1mm with the unit given, or 0.5% of the
        diagonal of both meshes, and stop at the first proof.
    unit : str
        The unit of the coordinates, such as mm; files have none.
    method : str
        The search method. ``"fast"``: cover, generate and cut; ``"classic"``: the textbook branch and bound: a
        baseline, slow at small tolerances.
    trace : bool
        Show how the interval narrows: a row per tolerance 1e-1, 1e-2, ... of the diagonal.
    certificate_slack : float
        Raise the upper ends that a certificate states by this fraction of the diagonal: the more, the shorter it is.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
    memory_limit : int, optional
        Stop before memory exceeds so many bytes, with the answer found by then.
    progress : bool or callable, optional
        ``True`` for a bar if tqdm is there, or a function that is called with a :class:`pompeiu.Progress`; if it returns
        ``False`` the search ends with what is proven.

    Raises
    ------
    MeshError, ReadError
        If an argument is no mesh.
    OptionError
        If an option means nothing.
    KeyboardInterrupt
        On Ctrl-C, within a fraction of a second.

    Examples
    --------
    >>> import pompeiu
    >>> ball, cube = pompeiu.shapes.icosphere(1.0, 2), pompeiu.shapes.cube(2.0, 1)
    >>> pompeiu.distance(ball, cube, assert_below=0.5).answer
    'above'
    """
    return _asked(locals())


def _asked(given: "dict[str, Any]") -> Distance:
    (a, a_is_cloud), (b, b_is_cloud) = points_or_mesh(given["a"]), points_or_mesh(given["b"])
    meshes = a, b
    if a_is_cloud != b_is_cloud:
        given["direction"] = _from_points("a-to-b" if a_is_cloud else "b-to-a", given)
    with watching(given.pop("progress")) as watch:
        answer, _ = ask("distance", {**given, "a": meshes[0], "b": meshes[1], "progress": watch}, ("a", "b"))
    report = answer["report"]
    a_to_b, b_to_a = (_directed(report.get(way), ends) for way, ends in (("a_to_b", "ab"), ("b_to_a", "ba")))
    both: Optional[SymmetricReport] = None
    if a_to_b is not None and b_to_a is not None:
        both = SymmetricReport(report["hausdorff"]["lower"], report["hausdorff"]["upper"], a_to_b, b_to_a)
    threshold = report.get("threshold")
    slack = answer["request"]["certificate_slack"]
    return Distance(a_to_b, b_to_a, both, threshold and threshold["answer"], answer["stop"], report, meshes, slack)


def _from_points(direction: str, given: "dict[str, Any]") -> str:
    """The direction from a cloud of points to a mesh, which is the only one that can be measured."""
    asked, cloud = given["direction"], direction[0]
    if asked not in ("both", direction):
        raise OptionError(
            f"direction is {asked!r}, but {cloud} is a cloud of points, which says nothing of the surface between them; direction can be {direction!r}"
        )
    if given.get("align") is not None:
        raise OptionError(f"align needs two surfaces, but {cloud} is a cloud of points; align the cloud where it was measured")
    return direction


def _directed(report: "Optional[dict[str, Any]]", ends: str) -> Optional[DirectedReport]:
    if report is None:
        return None
    witness = {name: report["witness"][mesh] for name, mesh in zip(("from", "to"), ends)}
    return DirectedReport._of({**report, "witness": witness})


def hausdorff(
    a: MeshLike,
    b: MeshLike,
    *,
    tolerance: float = DEFAULT_TOLERANCE,
    tolerance_kind: ToleranceKind = "diagonal",
    threshold: Optional[float] = None,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[int] = None,
    method: Method = "fast",
    progress: ProgressLike = None,
) -> SymmetricReport:
    """Encloses the Pompeiu–Hausdorff distance ``H(A, B) = max(h(A, B), h(B, A))``, of all points of all faces.

    The enclosure is proven for the meshes as stored, rounding included, and the same bits for any number of threads.

    Parameters
    ----------
    a, b : MeshLike
        Two meshes in one unit of length; see :func:`pompeiu.as_mesh`.
    tolerance : float
        How narrow the enclosure should be.
    tolerance_kind : {"diagonal", "relative", "absolute"}
        What the tolerance is measured in: the diagonal of the joint bounding box, the distance itself, or the unit of the
        meshes.
    threshold : float, optional
        Ask only whether the distance is at most this length: the search ends with the first proof of either answer. See
        :meth:`SymmetricReport.is_below`.
    threads : int, optional
        Number of threads; all processors if not given.
    time_limit : float, optional
        Seconds; when they are over the search ends with a wider enclosure.
    memory_limit : int, optional
        Bytes, meshes and trees included; before taking more the search ends with a wider enclosure.
    method : {"fast", "classic"}
        ``"classic"`` is the textbook branch and bound, for comparison on small meshes.
    progress : bool or callable, optional
        ``True`` for a bar if tqdm is there, or a function that is called with a :class:`pompeiu.Progress`; if it returns
        ``False`` the search ends with what is proven.

    Returns
    -------
    SymmetricReport
        ``lower``, ``upper``, ``witness`` and both directions.

    Raises
    ------
    MeshError, ReadError
        If an argument is no mesh.
    OptionError
        If an option means nothing.
    KeyboardInterrupt
        On Ctrl-C, within a fraction of a second.

    Examples
    --------
    >>> import numpy as np, pompeiu
    >>> faces = [[0, 1, 2]]
    >>> low = np.array([[0, 0, 0], [2, 0, 0], [1, 1, 0]], float)
    >>> report = pompeiu.hausdorff((low, faces), (low + [0, 0, 0.25], faces))
    >>> 0.25 in report
    True
    """
    for one in (a, b):
        if isinstance(one, Target):
            raise TypeError("a Target answers for one direction; use directed_hausdorff, or hand in the mesh")
    found = _asked({**_given(locals(), "both"), "a": as_mesh(a), "b": as_mesh(b)}).hausdorff
    assert found is not None
    return found


def _given(given: "dict[str, Any]", direction: str) -> "dict[str, Any]":
    """The arguments of a question about a distance."""
    names = ("a", "b", "tolerance", "tolerance_kind", *_LIMITS, "method", "progress")
    threshold = given["threshold"]
    if threshold is not None and not math.isfinite(threshold):
        raise OptionError(f"threshold is {threshold}; it must be a finite number")
    return {**{name: given[name] for name in names}, "assert_below": given["threshold"], "direction": direction}


def directed_hausdorff(
    a: MeshLike,
    b: Union[MeshLike, Target],
    *,
    tolerance: float = DEFAULT_TOLERANCE,
    tolerance_kind: ToleranceKind = "diagonal",
    threshold: Optional[float] = None,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[int] = None,
    method: Method = "fast",
    progress: ProgressLike = None,
) -> DirectedReport:
    """Encloses how far the points of A are from B, ``h(A, B) = max over a in A of min over b in B of |a - b|``.

    Parameters
    ----------
    a : MeshLike
        The mesh that is measured from.
    b : MeshLike or Target
        The mesh that is measured to; a :class:`Target` if many meshes are measured to it (``method`` is then ``"fast"``).
    tolerance, tolerance_kind, threshold, threads, time_limit, memory_limit, method, progress
        As for :func:`hausdorff`.

    Returns
    -------
    DirectedReport
        ``lower``, ``upper`` and ``witness``.

    Raises
    ------
    MeshError, ReadError, OptionError, KeyboardInterrupt
        As for :func:`hausdorff`.
    """
    given = locals()
    if not isinstance(b, Target):
        found = _asked({**_given(given, "a-to-b"), "a": as_mesh(a), "b": as_mesh(b)}).a_to_b
        assert found is not None
        return found
    options = {name: given[name] for name in ("tolerance", "tolerance_kind", "threshold", *_LIMITS, "method")}
    with watching(progress) as watch:
        return DirectedReport._of(json.loads(b._native.directed_from(as_mesh(a), options, watch)))
