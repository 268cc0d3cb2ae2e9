"""Many meshes: which are nearest to a template, and how far all are from each other."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Any, Literal, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._asking import ask
from .errors import OptionError, ReadError
from .progress import StepsLike, watching_steps
from .results import Stop, _Arrays, _table
from .sources import Mesh, MeshLike, as_mesh

__all__ = ["DistanceMatrix", "RankReport", "RankWork", "Standing", "matrix", "rank"]

#: Meshes by place, or by name, or all files of a folder.
Targets = Union[Sequence[MeshLike], Mapping[str, MeshLike], str, "os.PathLike[str]"]


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
    def _of(cls, data: Mapping[str, Any]) -> "Standing":
        both = lambda *names: None if data[names[0]] is None else tuple(data[name] for name in names)  # noqa: E731
        return cls(
            target=data["target"],
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
    def _of(cls, data: Mapping[str, Any]) -> "RankReport":
        work = {**data["work"], "searches": tuple(map(tuple, data["work"]["searches"]))}
        return cls(tuple(map(Standing._of, data["targets"])), RankWork(**work), data["stop"])


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
    directed : bool
        Whether ``lower`` and ``upper`` are those of the directed distances.
    names : tuple of str
        The names of the meshes: those of a mapping, the paths of files, or their places.
    failed : dict
        Which of them cannot be used, and why.
    """

    directed_lower: NDArray[np.float64]
    directed_upper: NDArray[np.float64]
    distances: int
    stop: Stop = "tolerance"
    open: Tuple[Tuple[int, int], ...] = ()
    directed: bool = False
    names: Tuple[str, ...] = ()
    failed: "dict[str, str]" = field(default_factory=dict)

    @property
    def lower(self) -> NDArray[np.float64]:
        """Lower bounds on the distances that were asked for, by default the symmetric ones: shape (k, k)."""
        return self.directed_lower if self.directed else np.maximum(self.directed_lower, self.directed_lower.T)

    @property
    def upper(self) -> NDArray[np.float64]:
        """Upper bounds on them: shape (k, k)."""
        return self.directed_upper if self.directed else np.maximum(self.directed_upper, self.directed_upper.T)

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of lists, ready for ``json.dumps``."""
        return {
            "directed_lower": self.directed_lower.tolist(),
            "directed_upper": self.directed_upper.tolist(),
            "distances": self.distances,
            "stop": self.stop,
            "open": [list(pair) for pair in self.open],
            "names": list(self.names),
            "failed": dict(self.failed),
        }

    @classmethod
    def _of(
        cls, report: Mapping[str, Any], ends: "tuple[NDArray[np.float64], NDArray[np.float64]]", directed: bool, found: "Usable"
    ) -> "DistanceMatrix":
        """Of the meshes that can be used; rows and columns of the others are NaN."""
        places, count = found.places, len(found.names)

        def whole(end: NDArray[np.float64]) -> NDArray[np.float64]:
            entries = np.full((count, count), np.nan)
            entries[np.ix_(places, places)] = end.reshape(len(places), len(places))
            entries.flags.writeable = False
            return entries

        lower, upper = map(whole, ends)
        pairs = tuple((places[pair["from"]], places[pair["to"]]) for pair in report["open"])
        return cls(lower, upper, report["distances"], report["stop"], pairs, directed, found.names, found.failed)

    def __len__(self) -> int:
        return len(self.directed_lower)


def named(targets: Targets) -> "list[tuple[str, MeshLike]]":
    """Names and meshes: what a mapping calls them, paths for files, else their places. Folders are the files in them with the suffix of a mesh."""
    if isinstance(targets, Mapping):
        return [(str(name), source) for name, source in targets.items()]
    if isinstance(targets, (str, os.PathLike)):
        targets = [targets]
    sources: "list[MeshLike]" = []
    for source in targets:
        sources.extend(_in_folder(source) if isinstance(source, (str, os.PathLike)) and os.path.isdir(source) else [source])
    digits = len(str(len(sources)))
    shown = lambda i, s: os.fspath(s) if isinstance(s, (str, os.PathLike)) else f"{i:0{digits}}"  # noqa: E731
    return [(shown(i, source), source) for i, source in enumerate(sources)]


@dataclass(frozen=True)
class Usable:
    """The meshes of a matrix that can be used: their places among all names; why the others cannot be."""

    names: Tuple[str, ...]
    places: "list[int]"
    meshes: "list[Mesh]"
    failed: "dict[str, str]"


def usable(meshes: Targets) -> Usable:
    """Reads all meshes; files that cannot be read have failed, unless all have."""
    sources = named(meshes)
    found = Usable(tuple(name for name, _ in sources), [], [], {})
    for place, (name, source) in enumerate(sources):
        try:
            found.meshes.append(as_mesh(source))
            found.places.append(place)
        except ReadError as error:
            found.failed[name] = str(error)
    if found.failed and not found.meshes:
        raise ReadError(f"none of the {len(sources)} meshes can be used; the first: {next(iter(found.failed.values()))}")
    return found


def _in_folder(folder: "str | os.PathLike[str]") -> "list[str]":
    paths = (os.path.join(os.fspath(folder), name) for name in sorted(os.listdir(folder)))
    found = [path for path in paths if _native.is_mesh_file(path) and os.path.isfile(path)]
    if not found:
        raise OptionError(f"{os.fspath(folder)} holds no file with the suffix of a mesh")
    return found


def rank(
    template: MeshLike,
    targets: Targets,
    *,
    top: int = 10,
    all: bool = False,
    direction: Literal["both", "from-template", "to-template"] = "both",
    align: Literal["none", "centroid", "scale", "rigid"] = "none",
    tolerance: float = 1e-12,
    tolerance_kind: Literal["diagonal", "relative", "absolute"] = "diagonal",
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[int] = None,
    progress: StepsLike = None,
) -> RankReport:
    """Ranks targets by their Pompeiu–Hausdorff distance from a template, computing only as much as the ranking needs.

    Ranks follow from proven enclosures alone; where these overlap at the finest tolerance the rank stays a range. The same
    bits come out for any number of threads, and on a cluster: see :mod:`pompeiu.ray`.

    Parameters
    ----------
    template : MeshLike
        The mesh to compare with.
    targets : sequence of MeshLike, mapping from names, or a folder
        The meshes to rank; of folders, all files with the suffix of a mesh. Files are read when they are needed and forgotten again; one that cannot be
        read has failed. Targets have the names of a mapping, the paths of files, or their places; names break ties.
    top : int
        The number of the best to find; those that tie with the last are reported, too.
    all : bool
        Measure every target in full.
    direction : str
        The distance to rank by. ``"both"``: the symmetric distance, the larger of the two directed ones;
        ``"from-template"``: the distance of the template from the target: finds shapes of which the template is a part;
        ``"to-template"``: the distance of the target from the template: finds parts of the template.
    align : str
        The alignment of targets with the template before the distance; distances are then those of the targets as
        moved. ``"none"``: coordinates stay; ``"centroid"``: a translation that makes the area centroids coincide;
        ``"scale"``: that translation, and a scaling about the centroid that makes the root-mean-square distances from
        it equal; ``"rigid"``: a rotation and a translation, found by iterated closest points from several starts: a
        local optimum.
    tolerance : float
        Largest width of the proven intervals.
    tolerance_kind : str
        The unit of the tolerance. ``"diagonal"``: the diagonal of the box around both meshes; ``"relative"``: the
        distance itself; ``"absolute"``: the unit of the files.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
    memory_limit : int, optional
        Stop before memory exceeds so many bytes, with the answer found by then.
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
        If the template, or a target that is no file, is no mesh, or if no target can be used.
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
    given = dict(locals())
    meshes = [
        (name, source if isinstance(source, (str, os.PathLike)) else as_mesh(source))
        for name, source in named(given.pop("targets"))
    ]
    with watching_steps(progress, "targets settled") as watch:
        answer, _ = ask("rank", {**given, "progress": watch}, meshes=("template",), others=meshes)
    return RankReport._of(answer["report"])


def matrix(
    meshes: Targets,
    *,
    directed: bool = False,
    tolerance: float = 1e-12,
    tolerance_kind: Literal["diagonal", "relative", "absolute"] = "diagonal",
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[int] = None,
    progress: StepsLike = None,
) -> DistanceMatrix:
    """Encloses the distances of all pairs of some meshes, both directions.

    Parameters
    ----------
    meshes : sequence of MeshLike, mapping from names, or a folder
        What :func:`rank` takes as targets. All of them are held in memory; a file that cannot be read has failed, and its row and column are NaN.
    directed : bool
        Give both directed distances of each pair instead of the greater one.
    tolerance : float
        Largest width of the proven intervals.
    tolerance_kind : str
        The unit of the tolerance. ``"diagonal"``: the diagonal of the box around both meshes; ``"relative"``: the
        distance itself; ``"absolute"``: the unit of the files.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
    memory_limit : int, optional
        Stop before memory exceeds so many bytes, with the answer found by then.
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
    given = dict(locals())
    found = usable(given.pop("meshes"))
    checked = [(found.names[place], mesh) for place, mesh in zip(found.places, found.meshes)]
    with watching_steps(progress, "meshes") as watch:
        answer, beside = ask("matrix", {**given, "progress": watch}, meshes=(), others=checked)
    return DistanceMatrix._of(answer["report"], (beside["directed_lower"], beside["directed_upper"]), directed, found)
