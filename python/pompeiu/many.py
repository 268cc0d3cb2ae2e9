"""Many meshes: which are nearest to a template, and how far all are from each other."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from typing import Any, Callable, Iterable, List, Literal, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _native
from .distance import DEFAULT_TOLERANCE, ToleranceKind
from .progress import StepsLike, watching_steps
from .results import Stop, _Arrays, _table
from .sources import MeshLike, as_mesh

__all__ = ["DistanceMatrix", "RankReport", "RankWork", "Standing", "distance_matrix", "rank"]

Measure = Literal["symmetric", "template_to_target", "target_to_template"]
Alignment = Literal["none", "centroid", "scale", "rigid"]

#: Meshes by place, or by name.
Targets = Union[Sequence[MeshLike], Mapping[str, MeshLike]]


@dataclass(frozen=True)
class Standing:
    """Where one target stands.

    Attributes
    ----------
    target : int
        Its place among the targets, counted from 0.
    name : str
        Its name.
    status : str
        ``"ranked"``: it is among the best, or ties with the last of them; ``"open"``: the ranking ended before that was
        known; ``"discarded"``: it is proven not to be; ``"failed"``: it cannot be used.
    ranks : tuple of 2 ints, optional
        First and last rank that the enclosures of all targets leave possible, counted from 1; none if it failed.
    lower, upper : float, optional
        Proven bounds on its distance; none if it failed, or was not looked at.
    bound : str, optional
        What proved that a discarded one is farther: ``"supports"``, ``"probes"`` or ``"search"``.
    stop : str, optional
        Why an open one was not settled: ``"time"``, ``"memory"`` or ``"cancelled"``.
    message : str, optional
        Why it failed.
    size : tuple of 2 ints, optional
        Vertices and faces.
    transform : tuple of 4 tuples of 4 floats, optional
        The matrix that brought it onto the template; it acts on columns ``(x, y, z, 1)``.
    """

    target: int
    name: str
    status: Literal["ranked", "open", "discarded", "failed"]
    ranks: Optional[Tuple[int, int]]
    lower: Optional[float]
    upper: Optional[float]
    bound: Optional[str] = None
    message: Optional[str] = None
    size: Optional[Tuple[int, int]] = None
    transform: Optional[Tuple[Tuple[float, ...], ...]] = None
    stop: Optional[Stop] = None

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of plain values."""
        return dict(vars(self))

    @classmethod
    def _of(cls, data: Mapping[str, Any], target: int) -> "Standing":
        both = lambda *names: None if data[names[0]] is None else tuple(data[name] for name in names)  # noqa: E731
        return cls(
            target=target,
            name=data["path"],
            status=data["status"],
            ranks=both("rank_first", "rank_last"),
            lower=data["lower"],
            upper=data["upper"],
            bound=data["discarded_by"],
            stop=data["stop"],
            message=data["message"],
            size=both("vertices", "faces"),
            transform=data["transform"] and tuple(map(tuple, data["transform"])),
        )


@dataclass(frozen=True)
class RankWork:
    """How much was done, in counts that do not depend on the machine or on where tasks ran.

    ``searches`` holds pairs of a tolerance and a number.
    """

    looks: int
    searches: Tuple[Tuple[float, int], ...]
    trees: int
    distances: int
    rounds: int


@dataclass(frozen=True)
class RankReport:
    """Targets in the order of their distance from a template.

    Attributes
    ----------
    standings : tuple of Standing
        The ranked ones, best first; then the open and the discarded ones, by their lower bounds; then those that failed.
    work : RankWork
        What it took.
    stop : str
        Why the ranking ended: ``"tolerance"``, or what left targets open, ``"time"``, ``"memory"`` or ``"cancelled"``.
    """

    standings: Tuple[Standing, ...]
    work: RankWork
    stop: Stop = "tolerance"

    @property
    def finished(self) -> bool:
        """Whether no target is open; else ranks are the ranges known so far."""
        return all(standing.status != "open" for standing in self.standings)

    @property
    def ranked(self) -> "tuple[Standing, ...]":
        """The ranked ones, best first."""
        return tuple(standing for standing in self.standings if standing.status == "ranked")

    def __iter__(self):
        return iter(self.standings)

    def __len__(self) -> int:
        return len(self.standings)

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of plain values, ready for ``json.dumps``."""
        return {
            "standings": [standing.to_dict() for standing in self.standings],
            "work": dict(vars(self.work)),
            "stop": self.stop,
        }

    def __repr__(self) -> str:
        count = {status: sum(s.status == status for s in self.standings) for status in ("ranked", "open", "discarded", "failed")}
        left = f"{count['open']} open, " if count["open"] else ""
        best = f", best {self.standings[0].name!r}" if count["ranked"] else ""
        return f"RankReport({count['ranked']} ranked, {left}{count['discarded']} discarded, {count['failed']} failed{best})"

    def _repr_html_(self) -> str:
        rows = []
        for s in self.standings:
            place = "–".join(str(rank) for rank in dict.fromkeys(s.ranks or ()))
            told = f"{s.lower!r} to {s.upper!r}" if s.message is None else s.message
            rows.append((f"{place} {s.name}".strip(), f"{told} ({s.status})" if s.status in ("open", "discarded") else told))
        return _table("distance from the template", rows)

    @classmethod
    def _of(cls, text: str, places: Iterable[int]) -> "RankReport":
        """From what is serialised, and the place of each target in it."""
        data = json.loads(text)
        work = {**data["work"], "searches": tuple(map(tuple, data["work"]["searches"]))}
        return cls(tuple(map(Standing._of, data["standings"], places)), RankWork(**work), data["stop"])


@dataclass(frozen=True, eq=False, repr=False)
class DistanceMatrix(_Arrays):
    """Distances of all pairs of some meshes, enclosed.

    Attributes
    ----------
    directed_lower, directed_upper : ndarray, float64, shape (k, k)
        Bounds on how far the points of mesh i (row) are from mesh j (column); NaN where a stop left them out.
    distances : int
        Point–triangle distances evaluated.
    stop : str
        Why the computation ended: ``"tolerance"``, or what left pairs open, ``"time"``, ``"memory"`` or ``"cancelled"``.
    open : tuple of pairs of int
        Rows and columns of directed distances that were not measured, or less narrowly than asked.
    """

    directed_lower: NDArray[np.float64]
    directed_upper: NDArray[np.float64]
    distances: int
    stop: Stop = "tolerance"
    open: Tuple[Tuple[int, int], ...] = ()

    @property
    def lower(self) -> NDArray[np.float64]:
        """Lower bounds on the symmetric distances: shape (k, k)."""
        return np.maximum(self.directed_lower, self.directed_lower.T)

    @property
    def upper(self) -> NDArray[np.float64]:
        """Upper bounds on the symmetric distances: shape (k, k)."""
        return np.maximum(self.directed_upper, self.directed_upper.T)

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of lists, ready for ``json.dumps``."""
        return {
            "directed_lower": self.directed_lower.tolist(),
            "directed_upper": self.directed_upper.tolist(),
            "distances": self.distances,
            "stop": self.stop,
            "open": [list(pair) for pair in self.open],
        }

    @classmethod
    def _of(cls, lower: NDArray[np.float64], upper: NDArray[np.float64], distances: int, stop: Stop, open: Iterable[Tuple[int, int]]) -> "DistanceMatrix":
        return cls(lower, upper, distances, stop, tuple(open))

    def __len__(self) -> int:
        return len(self.directed_lower)


def rank_options(top: int, all: bool, measure: str, alignment: str, tolerance: float, tolerance_kind: str = "diagonal") -> str:
    """The options of a ranking, as the native half takes them."""
    from .errors import OptionError

    for name, found, known in (
        ("measure", measure, ("symmetric", "template_to_target", "target_to_template")),
        ("alignment", alignment, ("none", "centroid", "scale", "rigid")),
        ("tolerance_kind", tolerance_kind, ("diagonal", "relative", "absolute")),
    ):
        if found not in known:
            raise OptionError(f"{name} is {found!r}, expected {', '.join(map(repr, known[:-1]))} or {known[-1]!r}")
    if top < 0:
        raise OptionError(f"the number of places asked for is {top}; at least 1 is needed")
    if not (isinstance(tolerance, (int, float)) and 0 <= tolerance < float("inf")):
        raise OptionError(f"the tolerance is {tolerance}; it must be a finite number that is not negative")
    options = {"measure": measure, "alignment": alignment, "top": top, "all": all}
    return json.dumps({**options, "tolerance": float(tolerance), "tolerance_kind": tolerance_kind})


def named(targets: Targets, names: Optional[Sequence[str]]) -> "tuple[list[str], list[MeshLike]]":
    """Names and meshes: what a mapping calls them, paths for files, else their places."""
    if isinstance(targets, Mapping):
        return [str(name) for name in targets], list(targets.values())
    sources = list(targets)
    if names is not None:
        if len(names) != len(sources):
            raise ValueError(f"found {len(names)} names, expected {len(sources)}, one for each target")
        return list(names), sources
    digits = len(str(len(sources)))
    shown = lambda i, s: os.fspath(s) if isinstance(s, (str, os.PathLike)) else f"{i:0{digits}}"  # noqa: E731
    return [shown(i, source) for i, source in enumerate(sources)], sources


def rank(
    template: MeshLike,
    targets: Targets,
    *,
    top: int = 10,
    all: bool = False,
    measure: Measure = "symmetric",
    alignment: Alignment = "none",
    tolerance: float = DEFAULT_TOLERANCE,
    tolerance_kind: ToleranceKind = "diagonal",
    names: Optional[Sequence[str]] = None,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[int] = None,
    progress: StepsLike = None,
) -> RankReport:
    """Ranks targets by their Pompeiu–Hausdorff distance from a template, computing only as much as the ranking needs.

    Ranks follow from proven enclosures alone; where these overlap at the finest tolerance the rank stays a range. The same
    bits come out for any number of threads, and on a cluster: see :mod:`pompeiu.distributed`.

    Parameters
    ----------
    template : MeshLike
        The mesh to compare with.
    targets : sequence of MeshLike, or mapping from names
        The meshes to rank. Files are read when they are needed and forgotten again; one that cannot be read has failed.
    top : int
        How many of the best are wanted; those that tie with the last come too.
    all : bool
        Whether every target gets its full enclosure and rank.
    measure : {"symmetric", "template_to_target", "target_to_template"}
        Which distance: how far the points of the one are from the other, or the greater of both.
    alignment : {"none", "centroid", "scale", "rigid"}
        How targets are moved onto the template first. Distances are then those of the target as moved.
    tolerance : float
        Width of a full enclosure.
    tolerance_kind : {"diagonal", "relative", "absolute"}
        What the tolerance is: a fraction of the diagonal of the joint bounding box, of the distance, or a length.
    names : sequence of str, optional
        One for each target; they break ties. Otherwise paths, or places.
    threads : int, optional
        Number of threads; all processors if not given.
    time_limit, memory_limit : float and int, optional
        Seconds and bytes that the ranking may take. What is proven by then is reported: targets that are not settled are
        open. With a memory limit, targets are searched one after another.
    progress : bool or callable, optional
        ``True`` for a bar if tqdm is there, or a function that is called with tasks done and all tasks of the round, and targets
        settled and all targets; if it returns ``False`` the ranking ends with what is known.

    Returns
    -------
    RankReport
        The standings, best first.

    Raises
    ------
    MeshError, ReadError
        If the template, or a target that is no file, is no mesh.
    OptionError
        If an option means nothing, or there are no targets.
    KeyboardInterrupt
        On Ctrl-C, within a fraction of a second.

    Examples
    --------
    >>> import pompeiu
    >>> spheres = {f"radius {r}": pompeiu.shapes.icosphere(r) for r in (1.5, 1.01, 9.0)}
    >>> report = pompeiu.rank(pompeiu.shapes.icosphere(), spheres, top=1)
    >>> report.ranked[0].name
    'radius 1.01'
    """
    options = rank_options(top, all, measure, alignment, tolerance, tolerance_kind)
    names, sources = named(targets, names)
    meshes = [s if isinstance(s, (str, os.PathLike)) else as_mesh(s) for s in sources]
    with watching_steps(progress, "targets settled") as watch:
        told = _native.rank_meshes(as_mesh(template), meshes, names, options, (threads, time_limit, memory_limit), watch)
    return RankReport._of(*told)


def distance_matrix(
    meshes: Iterable[MeshLike],
    *,
    tolerance: float = DEFAULT_TOLERANCE,
    tolerance_kind: ToleranceKind = "diagonal",
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[int] = None,
    progress: StepsLike = None,
) -> DistanceMatrix:
    """Encloses the distances of all pairs of some meshes, both directions.

    Parameters
    ----------
    meshes : iterable of MeshLike
        All of them are held in memory.
    tolerance : float
        Width of an enclosure.
    tolerance_kind, threads, time_limit, memory_limit
        As for :func:`rank`.
    progress : bool or callable, optional
        As for :func:`rank`: pairs done and all pairs, meshes done and all meshes.

    Returns
    -------
    DistanceMatrix
        ``lower`` and ``upper``, and the directed ones.

    Raises
    ------
    MeshError, ReadError, OptionError, KeyboardInterrupt
        As for :func:`rank`.
    """
    checked = [as_mesh(mesh) for mesh in meshes]
    with watching_steps(progress, "meshes") as watch:
        most = (threads, time_limit, memory_limit)
        return DistanceMatrix._of(*_native.distance_matrix(checked, (tolerance, tolerance_kind), most, watch))
