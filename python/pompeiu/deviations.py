"""How far two surfaces deviate from each other, where, and over how much of the area."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field, fields
from typing import Any, Iterable, Literal, Mapping, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _native
from .bands import BandReport
from .errors import OptionError
from .files import write_whole
from .progress import ProgressLike, watching
from .results import (
    Direction,
    DirectedReport,
    Stop,
    SurfacePoint,
    Vec3,
    Witness,
    _Arrays,
    _Interval,
    _table,
    number,
    shown_bounds,
)
from .sources import MeshLike, as_mesh

__all__ = [
    "Deviation",
    "DeviationWork",
    "DirectedDeviation",
    "Enclosure",
    "Histogram",
    "Percentile",
    "Region",
    "ShareAbove",
    "Statistics",
    "deviation",
    "directed_deviation",
]


@dataclass(frozen=True)
class Enclosure(_Interval):
    """Two bounds that are proven to hold a value between them; ``value in enclosure`` asks whether they hold a given one."""

    lower: float
    upper: float

    def __str__(self) -> str:
        return shown_bounds(self.lower, self.upper)


@dataclass(frozen=True)
class Percentile:
    """The distance that a share of the area, between 0 and 1, does not exceed."""

    share: float
    distance: Enclosure


@dataclass(frozen=True)
class ShareAbove:
    """The share of the area, between 0 and 1, that is farther than a threshold."""

    threshold: float
    share: Enclosure


def _plain(value: Any) -> Any:
    """Lists and dictionaries of numbers."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, tuple):
        return [_plain(one) for one in value]
    if hasattr(value, "to_dict"):
        return value.to_dict()
    if hasattr(value, "__dataclass_fields__"):
        return {f.name: _plain(getattr(value, f.name)) for f in fields(value)}
    return value


@dataclass(frozen=True, eq=False, repr=False)
class Histogram(_Arrays):
    """Shares of an area by distance: bins of one width from zero to about the largest distance.

    Attributes
    ----------
    edges : ndarray, float64, shape (k + 1,)
        Ends of the bins, in the unit of the meshes.
    bins : ndarray, float64, shape (k, 2)
        Lower and upper bound of the share of the area in each bin.
    cumulative : ndarray, float64, shape (k + 1, 2)
        Lower and upper bound of the share of the area up to each end.
    """

    edges: NDArray[np.float64]
    bins: NDArray[np.float64]
    cumulative: NDArray[np.float64]

    @classmethod
    def _of(cls, data: Mapping[str, Any]) -> "Histogram":
        rows = (np.array([(one["lower"], one["upper"]) for one in data[name]], float) for name in ("bins", "cumulative"))
        return cls(np.array(data["edges"], float), *(row.reshape(-1, 2) for row in rows))


@dataclass(frozen=True)
class Statistics:
    """Statistics of the distance over an area: of all its points, not of samples, each enclosed.

    Attributes
    ----------
    area : float
        The area, rounded.
    mean, rms : Enclosure
        Mean distance, and root of the mean squared distance.
    percentiles : tuple of Percentile
        In the order asked for.
    above : ShareAbove, optional
        The share of the area beyond the threshold, if one was given.
    histogram : Histogram
        How much area lies in which range of distances.
    """

    area: float
    mean: Enclosure
    rms: Enclosure
    percentiles: Tuple[Percentile, ...]
    above: Optional[ShareAbove]
    histogram: Histogram = field(repr=False)

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of plain values, ready for ``json.dumps``."""
        return {f.name: _plain(getattr(self, f.name)) for f in fields(self)}

    def _rows(self) -> "list[tuple[str, str]]":
        rows = [("area", f"{self.area:.6g}"), ("mean", str(self.mean)), ("root mean square", str(self.rms))]
        rows += [(f"{100 * p.share:g} % of the area within", str(p.distance)) for p in self.percentiles]
        if self.above is not None:
            rows.append((f"share beyond {self.above.threshold:g}", str(self.above.share)))
        return rows

    def _repr_html_(self) -> str:
        return _table("deviation", self._rows())

    @classmethod
    def _of(cls, data: Optional[Mapping[str, Any]], threshold: Optional[float]) -> "Optional[Statistics]":
        if data is None:
            return None
        share = data.get("share_above_threshold")
        return cls(
            area=number(data["area"]),
            mean=Enclosure(**data["mean"]),
            rms=Enclosure(**data["rms"]),
            percentiles=_percentiles(data["percentiles"]),
            above=None if share is None or threshold is None else ShareAbove(threshold, Enclosure(**share)),
            histogram=Histogram._of(data["histogram"]),
        )


def _percentiles(data: Iterable[Mapping[str, float]]) -> Tuple[Percentile, ...]:
    return tuple(Percentile(one["share"], Enclosure(one["lower"], one["upper"])) for one in data)


@dataclass(frozen=True, eq=False, repr=False)
class Region(_Arrays):
    """A part of a surface that is far from the other one.

    Attributes
    ----------
    faces : ndarray, uint32, shape (k,)
        Its faces, in ascending order.
    area : float
        Their area, rounded.
    centre : tuple of 3 floats
        Mean of its points, by area.
    lower_corner, upper_corner : tuple of 3 floats
        The box around its faces.
    peak : Enclosure
        The greatest distance of its points.
    witness : Witness
        The point with the greatest distance met, and a nearest point of the other mesh.
    level : float
        The distance that its faces reach: half of the peak, or the threshold.
    """

    faces: NDArray[np.uint32]
    area: float
    centre: Vec3
    lower_corner: Vec3
    upper_corner: Vec3
    peak: Enclosure
    witness: Witness
    level: float

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of plain values, ready for ``json.dumps``."""
        return {f.name: _plain(getattr(self, f.name)) for f in fields(self)}

    @classmethod
    def _of(cls, data: Mapping[str, Any], faces: NDArray[np.uint32]) -> "Region":
        return cls(
            faces=faces,
            area=number(data["area"]),
            centre=tuple(data["centre"]),
            lower_corner=tuple(data["lowest"]),
            upper_corner=tuple(data["highest"]),
            peak=Enclosure(**data["peak"]),
            witness=Witness(SurfacePoint._of(data["at"]), SurfacePoint._of(data["nearest"])),
            level=data["level"],
        )


@dataclass(frozen=True)
class DeviationWork:
    """How much was done, in counts that do not depend on the machine or the number of threads."""

    pieces: int
    looks: int
    distances: int
    rounds: int


@dataclass(frozen=True, eq=False, repr=False)
class DirectedDeviation(_Arrays):
    """How far a mesh deviates from another one.

    Attributes
    ----------
    direction : str
        ``"a_to_b"`` or ``"b_to_a"``.
    distance : DirectedReport
        The largest distance of all, and the two points that prove it.
    statistics : Statistics, optional
        Over the area of the mesh; none if it has no area.
    face_max, face_min, face_mean : ndarray, float64, shape (m, 2)
        For each face lower and upper bound of the distance of its farthest and nearest point, and of the mean over its area.
    vertex_distances : ndarray, float64, shape (n,)
        Distances of the vertices; NaN for those that belong to no face.
    vertex_error : float
        The exact distance of each vertex differs by at most this from the one given.
    signed_vertex_distances : ndarray, float64, shape (n,), optional
        Distances of the vertices, negative inside of the other mesh, if ``signed`` was asked for.
    vertex_winding, face_winding : ndarray, float64, shape (n,) and (m,), optional
        Winding numbers of the other mesh about the vertices and about the centroids of the faces, if ``signed`` was asked for. A
        magnitude above one half means inside; about a closed mesh the numbers are whole but for the error of evaluating them.
    regions : tuple of Region
        The worst regions, the worst first.
    beyond_threshold : tuple of Region
        The parts of the surface that are farther than the threshold, the worst first.
    stop : str
        Why the work ended: ``"tolerance"`` where enclosures are as narrow as asked, else why they may be wider. They hold in every case.
    work : DeviationWork
        What it took.
    timing : dict
        Seconds spent on ``build``, ``search`` and ``refine``; they do not count in comparisons.
    """

    direction: Direction
    distance: DirectedReport
    statistics: Optional[Statistics]
    face_max: NDArray[np.float64]
    face_min: NDArray[np.float64]
    face_mean: NDArray[np.float64]
    vertex_distances: NDArray[np.float64]
    vertex_error: float
    signed_vertex_distances: Optional[NDArray[np.float64]]
    vertex_winding: Optional[NDArray[np.float64]]
    face_winding: Optional[NDArray[np.float64]]
    regions: Tuple[Region, ...]
    beyond_threshold: Tuple[Region, ...]
    stop: Stop
    work: DeviationWork
    timing: "dict[str, float]" = field(compare=False)

    @property
    def lower(self) -> float:
        """Lower bound on the largest distance."""
        return self.distance.lower

    @property
    def upper(self) -> float:
        """Upper bound on the largest distance."""
        return self.distance.upper

    @property
    def witness(self) -> Witness:
        """The two points that prove the lower bound on the largest distance."""
        return self.distance.witness

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of plain values, ready for ``json.dumps``."""
        return {f.name: _plain(getattr(self, f.name)) for f in fields(self)}

    def __repr__(self) -> str:
        mean = "" if self.statistics is None else f"mean {self.statistics.mean}, "
        return (
            f"DirectedDeviation({self.direction}, {mean}largest in {shown_bounds(self.lower, self.upper)}, "
            f"{len(self.face_max)} faces, {len(self.regions)} regions)"
        )

    def _rows(self) -> "list[tuple[str, str]]":
        rows: "list[tuple[str, str]]" = [] if self.statistics is None else self.statistics._rows()
        rows.append(("largest", f"[{self.lower!r}, {self.upper!r}]"))
        for place, region in enumerate(self.regions, 1):
            at = "({:.4g}, {:.4g}, {:.4g})".format(*region.witness.from_.position)
            rows.append((f"region {place}", f"{region.peak} at {at}, {len(region.faces)} faces"))
        return rows

    def _repr_html_(self) -> str:
        return _table("deviation", self._rows())

    @classmethod
    def _of(cls, data: Mapping[str, Any], beside: Mapping[str, Any], threshold: Optional[float]) -> "DirectedDeviation":
        """From what is serialised, and the arrays beside it."""
        regions = (
            tuple(map(Region._of, data.get(name, ()), beside[faces]))
            for name, faces in (("regions", "region_faces"), ("beyond_threshold", "beyond_threshold_faces"))
        )
        named = {f.name for f in fields(cls)}
        return cls(
            **{name: value for name, value in beside.items() if name in named and name != "timing"},
            distance=DirectedReport._of(json.loads(beside["largest"])),
            statistics=Statistics._of(data["statistics"], threshold),
            regions=next(regions),
            beyond_threshold=next(regions),
            stop=data["stop"],
            work=DeviationWork(**data["work"]),
            timing=dict(zip(("build", "search", "refine"), beside["timing"])),
        )


@dataclass(frozen=True, eq=False, repr=False)
class Deviation(_Arrays, _Interval):
    """How far two meshes deviate from each other, both ways.

    With A as it should be and B as it is: what of A is far from B is *missing* in B; what of B is far from A is *invented* by it.

    Attributes
    ----------
    lower, upper : float
        The Pompeiu–Hausdorff distance, enclosed.
    a_to_b, b_to_a : DirectedDeviation
        Each way by itself.
    greater_percentiles : tuple of Percentile, optional
        For each share the greater of both directions' percentiles; none if a mesh has no area.
    pooled : Statistics, optional
        Over the areas of both together; none if neither has any.
    bands : BandReport, optional
        How much lies in which tolerance band, if some were given.
    """

    lower: float
    upper: float
    a_to_b: DirectedDeviation
    b_to_a: DirectedDeviation
    greater_percentiles: Optional[Tuple[Percentile, ...]]
    pooled: Optional[Statistics]
    bands: Optional[BandReport] = None
    _page: Optional[_native.DeviationPage] = field(default=None, compare=False, repr=False)
    _names: Tuple[str, str] = field(default=("A", "B"), compare=False, repr=False)

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of plain values, ready for ``json.dumps``."""
        return {f.name: _plain(getattr(self, f.name)) for f in fields(self) if not f.name.startswith("_")}

    def save_html(
        self,
        path: "str | os.PathLike[str]",
        *,
        names: Optional[Tuple[str, str]] = None,
        unit: str = "",
        up: "str | Vec3" = "y",
    ) -> None:
        """Writes a page to explore in a browser: one file that needs no network. It appears whole or not at all.

        Parameters
        ----------
        path : str or path-like
            The file.
        names : tuple of str, optional
            What the two meshes are called; by default their paths, or A and B.
        unit : str
            The unit of length, such as ``"mm"``.
        up : {"x", "y", "z"} or three floats
            Which way is up.

        Raises
        ------
        ValueError
            If this answer was pickled: the meshes do not travel with it.
        OSError
            If the file cannot be written.
        """
        write_whole(path, self._shown().html(self._look(names, unit, up)).encode())

    def image(
        self,
        *,
        names: Optional[Tuple[str, str]] = None,
        unit: str = "",
        up: "str | Vec3" = "y",
        direction_to_eye: Optional[Vec3] = None,
        size: Tuple[int, int] = (1600, 900),
        theme: Literal["light", "dark"] = "light",
    ) -> bytes:
        """A picture of both surfaces, coloured by their distances, as the bytes of a PNG file.

        Parameters
        ----------
        names, unit, up
            As for :meth:`save_html`.
        direction_to_eye : three floats, optional
            From the meshes to the eye.
        size : tuple of int
            Width and height in pixels.
        theme : {"light", "dark"}
            Background.

        Raises
        ------
        OptionError
            If the size or the theme is none.
        ValueError
            If this answer was pickled: the meshes do not travel with it.
        """
        return self._shown().png(self._look(names, unit, up), direction_to_eye, size, theme)

    def save_pdf(
        self,
        path: "str | os.PathLike[str]",
        *,
        names: Optional[Tuple[str, str]] = None,
        unit: str = "",
        up: "str | Vec3" = "y",
        direction_to_eye: Optional[Vec3] = None,
        verdict: Optional[str] = None,
        paper: Literal["a4", "letter"] = "a4",
    ) -> None:
        """Writes a document for printing: the picture, the numbers, the worst places and what was measured. It appears whole or not at all.

        Parameters
        ----------
        path : str or path-like
            The file.
        names, unit, up, direction_to_eye
            As for :meth:`image`.
        verdict : str, optional
            A sentence above all.
        paper : {"a4", "letter"}
            The size of the paper.

        Raises
        ------
        OptionError
            If the paper is none of these.
        ValueError
            If this answer was pickled: the meshes do not travel with it.
        OSError
            If the file cannot be written.
        """
        look = self._look(names, unit, up)
        write_whole(path, self._shown().pdf(look, direction_to_eye, verdict, paper))

    def save_image(self, path: "str | os.PathLike[str]", **options: Any) -> None:
        """Writes :meth:`image`, with its options, to a file, which appears whole or not at all."""
        write_whole(path, self.image(**options))

    def _shown(self) -> _native.DeviationPage:
        if self._page is None:
            raise ValueError("the meshes of this answer are not here: it was pickled; analyse the meshes again")
        return self._page

    def _look(self, names: Optional[Tuple[str, str]], unit: str, up: "str | Vec3") -> "dict[str, Any]":
        return {"names": list(names or self._names), "unit": unit, "up": _axis(up)}

    def __getstate__(self) -> "dict[str, Any]":
        return {**self.__dict__, "_page": None}

    def __repr__(self) -> str:
        return f"Deviation(H in {shown_bounds(self.lower, self.upper)}, {self.a_to_b!r}, {self.b_to_a!r})"

    def _repr_html_(self) -> str:
        rows: "list[tuple[str, str]]" = []
        for name, one in (("A to B", self.a_to_b), ("B to A", self.b_to_a)):
            rows.extend((f"{name}: {key}", value) for key, value in one._rows())
        return _table("deviation", rows)

    @classmethod
    def _of(
        cls,
        data: Mapping[str, Any],
        beside: "tuple[Mapping[str, Any], Mapping[str, Any], _native.DeviationPage, Optional[str]]",
        threshold: Optional[float],
        names: Tuple[str, str],
    ) -> "Deviation":
        there, back, page, bands = beside
        greater = data["greater_percentiles"]
        return cls(
            **data["distance"],
            a_to_b=DirectedDeviation._of(data["a_to_b"], there, threshold),
            b_to_a=DirectedDeviation._of(data["b_to_a"], back, threshold),
            greater_percentiles=None if greater is None else _percentiles(greater),
            pooled=Statistics._of(data["pooled"], threshold),
            bands=None if bands is None else BandReport._of(json.loads(bands)),
            _page=page,
            _names=names,
        )


def _axis(up: "str | Vec3") -> Vec3:
    """The direction that is called so."""
    if isinstance(up, str):
        try:
            return {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}[up]
        except KeyError:
            raise OptionError(f'up is {up!r}, expected "x", "y", "z" or three numbers') from None
    x, y, z = up
    return (float(x), float(y), float(z))


def _name(mesh: Any, otherwise: str) -> str:
    return os.fspath(mesh) if isinstance(mesh, (str, os.PathLike)) else otherwise


#: Width of an enclosure relative to its lower end, by default.
DEFAULT_ACCURACY = 0.01
#: Shares whose percentiles are computed by default.
DEFAULT_PERCENTILES = (0.5, 0.9, 0.95, 0.99)
#: Bins of the histogram, by default.
DEFAULT_BINS = 64
#: Regions listed, by default.
DEFAULT_REGIONS = 5
#: Pieces at most, in each direction, by default.
DEFAULT_PIECES = 4_000_000


def deviation(
    a: MeshLike,
    b: MeshLike,
    *,
    accuracy: float = DEFAULT_ACCURACY,
    threshold: Optional[float] = None,
    percentiles: Sequence[float] = DEFAULT_PERCENTILES,
    bins: int = DEFAULT_BINS,
    regions: int = DEFAULT_REGIONS,
    signed: bool = False,
    bands: Sequence[Tuple[float, float]] = (),
    most_pieces: int = DEFAULT_PIECES,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[int] = None,
    progress: ProgressLike = None,
) -> Deviation:
    """Analyses how far two surfaces deviate from each other, where, and over how much of the area.

    Every statistic is an enclosure of the exact value over all points of all faces, rounding included.

    Parameters
    ----------
    a, b : MeshLike
        Two meshes in one unit of length; see :func:`pompeiu.as_mesh`.
    accuracy : float
        How narrow enclosures should be, relative to their lower ends; of the share beyond the threshold, absolutely.
    threshold : float, optional
        A distance: the share of the area beyond it is enclosed, and the regions beyond it are listed.
    percentiles : sequence of float
        Shares of the area, between 0 and 1.
    bins : int
        Bins of the histogram.
    regions : int
        How many regions are listed, of each kind.
    signed : bool
        Whether to find out on which side of the other mesh vertices and faces lie.
    bands : sequence of pairs of float
        Tolerance bands of the deviation of B from A, negative where B lacks something and positive where it has more: the share of the
        area of each surface in each is enclosed.
    most_pieces : int
        Refining stops at about so many pieces, with wider enclosures.
    threads, time_limit, memory_limit, progress
        As for :func:`pompeiu.hausdorff`.

    Returns
    -------
    Deviation
        Both directions, with fields by face and by vertex as arrays.

    Raises
    ------
    MeshError, ReadError
        If an argument is no mesh.
    OptionError
        If an option means nothing.
    KeyboardInterrupt
        On Ctrl-C.

    Examples
    --------
    >>> import pompeiu
    >>> sheet = pompeiu.shapes.grid((2.0, 2.0))
    >>> lifted = (sheet.vertices + [0, 0, 0.25], sheet.faces)
    >>> report = pompeiu.deviation(sheet, lifted)
    >>> 0.25 in report.a_to_b.statistics.mean
    True
    """
    options = _options(
        accuracy, threshold, percentiles, bins, regions, signed, most_pieces, threads, time_limit, memory_limit
    )
    options["bands"] = [(float(low), float(high)) for low, high in bands]
    names = (_name(a, "A"), _name(b, "B"))
    a, b = as_mesh(a), as_mesh(b)
    with watching(progress) as watch:
        text, *beside = _native.deviation(a, b, options, watch)
    return Deviation._of(json.loads(text), tuple(beside), threshold, names)


def directed_deviation(
    a: MeshLike,
    b: MeshLike,
    *,
    accuracy: float = DEFAULT_ACCURACY,
    threshold: Optional[float] = None,
    percentiles: Sequence[float] = DEFAULT_PERCENTILES,
    bins: int = DEFAULT_BINS,
    regions: int = DEFAULT_REGIONS,
    signed: bool = False,
    most_pieces: int = DEFAULT_PIECES,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[int] = None,
    progress: ProgressLike = None,
) -> DirectedDeviation:
    """Analyses how far the points of A are from B: one direction of :func:`deviation`, with the same parameters.

    Returns
    -------
    DirectedDeviation

    Raises
    ------
    MeshError, ReadError, OptionError, KeyboardInterrupt
        As for :func:`deviation`.
    """
    options = _options(
        accuracy, threshold, percentiles, bins, regions, signed, most_pieces, threads, time_limit, memory_limit
    )
    a, b = as_mesh(a), as_mesh(b)
    with watching(progress) as watch:
        text, beside = _native.directed_deviation(a, b, options, watch)
    return DirectedDeviation._of(json.loads(text), beside, threshold)


def _options(
    accuracy: float,
    threshold: Optional[float],
    percentiles: Sequence[float],
    bins: int,
    regions: int,
    signed: bool,
    most_pieces: int,
    threads: Optional[int],
    time_limit: Optional[float],
    memory_limit: Optional[int],
) -> "dict[str, Any]":
    return {
        "accuracy": accuracy,
        "threshold": threshold,
        "percentiles": list(percentiles),
        "bins": bins,
        "regions": regions,
        "signed": signed,
        "bands": [],
        "most_pieces": most_pieces,
        "threads": threads,
        "time_limit": time_limit,
        "memory_limit": memory_limit,
    }
