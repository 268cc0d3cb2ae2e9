"""Distances between two meshes."""

from __future__ import annotations

import json
from typing import Any, Literal, Optional, Tuple, Union

from . import _native
from .progress import ProgressLike, watching
from .results import DirectedReport, SymmetricReport
from .sources import MeshLike, as_mesh

__all__ = ["DEFAULT_TOLERANCE", "Target", "directed_hausdorff", "hausdorff"]

#: The default width of an enclosure, as a fraction of the diagonal of the joint bounding box.
DEFAULT_TOLERANCE = 1e-12

ToleranceKind = Literal["diagonal", "relative", "absolute"]
Method = Literal["fast", "classic"]


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


def _options(
    tolerance: float,
    tolerance_kind: str,
    threshold: Optional[float],
    threads: Optional[int],
    time_limit: Optional[float],
    memory_limit: Optional[int],
    method: str,
) -> "dict[str, Any]":
    return {
        "tolerance": tolerance,
        "tolerance_kind": tolerance_kind,
        "threshold": threshold,
        "threads": threads,
        "time_limit": time_limit,
        "memory_limit": memory_limit,
        "method": method,
    }


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
    options = _options(tolerance, tolerance_kind, threshold, threads, time_limit, memory_limit, method)
    for one in (a, b):
        if isinstance(one, Target):
            raise TypeError("a Target answers for one direction; use directed_hausdorff, or hand in the mesh")
    a, b = as_mesh(a), as_mesh(b)
    with watching(progress) as watch:
        return SymmetricReport._of(json.loads(_native.hausdorff(a, b, options, watch)))


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
    options = _options(tolerance, tolerance_kind, threshold, threads, time_limit, memory_limit, method)
    a = as_mesh(a)
    if not isinstance(b, Target):
        b = as_mesh(b)
    with watching(progress) as watch:
        if isinstance(b, Target):
            return DirectedReport._of(json.loads(b._native.directed_from(a, options, watch)))
        return DirectedReport._of(json.loads(_native.directed_hausdorff(a, b, options, watch)))
