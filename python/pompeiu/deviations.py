"""How far two surfaces deviate from each other, where, and over how much of the area."""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass, field, fields
from typing import Any, Iterable, Literal, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._asking import ask
from .bands import BandReport
from .certificates import Certificate, Ends, _write
from .errors import OptionError
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
    _read_only,
    _table,
    number,
    shown_bounds,
)
from .sources import Mesh, MeshLike, as_mesh

__all__ = [
    "Deviation",
    "DeviationWork",
    "DirectedDeviation",
    "Enclosure",
    "Histogram",
    "Percentile",
    "Region",
    "ShareAbove",
    "SignedStatistics",
    "Statistics",
    "Verdict",
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
        bins, cumulative = (_read_only(row.reshape(-1, 2)) for row in rows)
        return cls(_read_only(np.array(data["edges"], float)), bins, cumulative)


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
    def _of(cls, data: Mapping[str, Any]) -> "Region":
        return cls(
            faces=_read_only(np.array(data["faces"], np.uint32)),
            area=number(data["area"]),
            centre=tuple(data["centre"]),
            lower_corner=tuple(data["lowest"]),
            upper_corner=tuple(data["highest"]),
            peak=Enclosure(**data["peak"]),
            witness=Witness(SurfacePoint._of(data["at"]), SurfacePoint._of(data["nearest"])),
            level=data["level"],
        )


@dataclass(frozen=True)
class SignedStatistics:
    """Statistics of the signed distance over an area: negative inside the other mesh, positive outside. All points count.

    Attributes
    ----------
    mean : Enclosure
        Bounds on the mean.
    standard_deviation : Enclosure
        Bounds on the root of the mean squared distance from the mean.
    lowest, highest : Enclosure
        Bounds on the least and the greatest signed distance: the most inside, and the most outside.
    """

    mean: Enclosure
    standard_deviation: Enclosure
    lowest: Enclosure
    highest: Enclosure

    @classmethod
    def _of(cls, data: Optional[Mapping[str, Any]]) -> "Optional[SignedStatistics]":
        if data is None:
            return None
        return cls(**{f.name: Enclosure(**data[f.name]) for f in fields(cls)})


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
    signed : SignedStatistics, optional
        Of the signed distance over the same area, where sides are known and the other mesh is closed and oriented.
    face_max, face_min, face_mean : ndarray, float64, shape (m, 2)
        For each face lower and upper bound of the distance of its farthest and nearest point, and of the mean over its area.
    vertex_distances : ndarray, float64, shape (n,)
        Distances of the vertices; NaN for those that belong to no face.
    vertex_error : float
        The exact distance of each vertex differs by at most this from the one given.
    signed_vertex_distances : ndarray, float64, shape (n,), optional
        Distances of the vertices, negative inside of the other mesh, if sides are known.
    vertex_winding, face_winding : ndarray, float64, shape (n,) and (m,), optional
        Winding numbers of the other mesh about the vertices and about the centroids of the faces, if sides are known. A
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
    signed: Optional[SignedStatistics]
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
    def _of(
        cls, direction: Direction, data: Mapping[str, Any], beside: Mapping[str, Any], threshold: Optional[float]
    ) -> "DirectedDeviation":
        """From what is serialised, and the arrays beside it."""
        ends = zip(("from", "to"), "ab" if direction == "a_to_b" else "ba")
        witness = {name: data["witness"][mesh] for name, mesh in ends}
        search = data["search"]
        arrays = {name: beside.get(f"{direction}.{name}") for name in _ARRAYS}
        return cls(
            direction=direction,
            distance=DirectedReport._of({**data["distance"], "witness": witness, **search}),
            statistics=Statistics._of(data["statistics"], threshold),
            signed=SignedStatistics._of(data.get("signed")),
            **{**arrays, "vertex_error": float(arrays["vertex_error"][0])},
            regions=tuple(map(Region._of, data["regions"])),
            beyond_threshold=tuple(map(Region._of, data.get("beyond_threshold", ()))),
            stop=data["stop"],
            work=DeviationWork(**data["work"]),
            timing={name.removesuffix("_ms"): 1e-3 * spent for name, spent in data["timing_ms"].items()},
        )


#: Fields of a direction that pass beside the JSON.
_ARRAYS = (
    "face_max",
    "face_min",
    "face_mean",
    "vertex_distances",
    "vertex_error",
    "signed_vertex_distances",
    "vertex_winding",
    "face_winding",
)


@dataclass(frozen=True)
class Verdict:
    """Whether both surfaces are within a tolerance of each other.

    Attributes
    ----------
    answer : str
        ``"within"`` or ``"out"`` if that is proven, else ``"undecided"``.
    allowed : float
        The share of the area of each surface that may be outside.
    sentence : str
        The answer in a sentence, with the tolerance, what is outside of it and the worst place.
    """

    answer: Literal["within", "out", "undecided"]
    allowed: float
    sentence: str

    def __str__(self) -> str:
        return self.sentence


@dataclass(frozen=True, eq=False, repr=False)
class Deviation(_Arrays, _Interval):
    """How far two meshes deviate from each other, both ways.

    With A as it should be and B as it is: what of A is far from B is *missing* on B; what of B is far from A is in *excess*.

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
    verdict : Verdict, optional
        Whether both are within the threshold or the bands, if one of these was given.
    report : dict
        What ``pompeiu deviation --json`` says in ``report``: with parts left out, what that is; with ``align``, how B was moved.
    """

    lower: float
    upper: float
    a_to_b: DirectedDeviation
    b_to_a: DirectedDeviation
    greater_percentiles: Optional[Tuple[Percentile, ...]]
    pooled: Optional[Statistics]
    bands: Optional[BandReport] = None
    verdict: Optional[Verdict] = None
    report: "dict[str, Any]" = field(default_factory=dict, compare=False, repr=False)
    _page: Optional[_native.DeviationPage] = field(default=None, compare=False, repr=False)
    _names: Tuple[str, str] = field(default=("A", "B"), compare=False, repr=False)
    _meshes: "Optional[Tuple[Mesh, Mesh]]" = field(default=None, compare=False, repr=False)

    @property
    def distance(self) -> Enclosure:
        """The Pompeiu–Hausdorff distance, enclosed."""
        return Enclosure(self.lower, self.upper)

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of plain values, ready for ``json.dumps``."""
        return {f.name: _plain(getattr(self, f.name)) for f in fields(self) if not f.name.startswith("_") and f.name != "report"}

    def save_html(
        self,
        path: "str | os.PathLike[str]",
        *,
        names: Optional[Tuple[str, str]] = None,
        unit: Optional[str] = None,
        up: "str | Vec3" = "y",
    ) -> None:
        """Writes a page to explore in a browser: one file that needs no network. It appears whole or not at all.

        Parameters
        ----------
        path : str or path-like
            The file.
        names : tuple of str, optional
            What the two meshes are called; by default their paths, or A and B.
        unit : str, optional
            The unit of length, such as ``"mm"``; by default the one that the analysis was asked with.
        up : {"x", "y", "z"} or three floats
            Which way is up.

        Raises
        ------
        ValueError
            If this answer was pickled: the meshes do not travel with it.
        OSError
            If the file cannot be written.
        """
        _native.write_whole(path, self._shown().html(self._look(names, unit, up)).encode())

    def image(
        self,
        *,
        names: Optional[Tuple[str, str]] = None,
        unit: Optional[str] = None,
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
        unit: Optional[str] = None,
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
            A sentence above all; by default that of :attr:`verdict`.
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
        _native.write_whole(path, self._shown().pdf(look, direction_to_eye, verdict, paper))

    def save_image(self, path: "str | os.PathLike[str]", **options: Any) -> None:
        """Writes :meth:`image`, with its options, to a file, which appears whole or not at all."""
        _native.write_whole(path, self.image(**options))

    def certificate(
        self,
        path: "str | os.PathLike[str]",
        *,
        threads: Optional[int] = None,
        time_limit: Optional[float] = None,
        memory_limit: Optional[int] = None,
    ) -> Certificate:
        """Writes a file from which anybody can prove the largest distances anew; see :func:`pompeiu.verify`.

        The upper ends are raised by 1e-12 of the joint diagonal; where they are at most the threshold, that is the upper end.

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
            If B was moved by ``align``, or parts were left out: a certificate is about all triangles that were handed in.
        WriteError
            If the file cannot be written, or a limit was reached.
        """
        if self._meshes is None:
            raise ValueError("the meshes of this answer are not here: it was pickled; analyse the meshes again")
        if self.report.get("alignment") is not None:
            raise OptionError("a certificate is about the triangles that were handed in, but align moved B; move it first")
        if self.report.get("left_out") is not None:
            raise OptionError("a certificate is about all triangles of both meshes, but some were left out")
        threshold = self.report.get("threshold")
        is_within = threshold is not None and self.upper <= threshold

        def ends(one: DirectedDeviation) -> Ends:
            start = one.witness.from_
            return threshold if is_within else one.upper, start.face, start.barycentric, one.lower

        slack = 0.0 if is_within else 1e-12
        limits = (threads, time_limit, memory_limit)
        return _write(path, self._meshes, (ends(self.a_to_b), ends(self.b_to_a)), slack, limits)

    def _shown(self) -> _native.DeviationPage:
        if self._page is None:
            raise ValueError("the meshes of this answer are not here: it was pickled; analyse the meshes again")
        return self._page

    def _look(self, names: Optional[Tuple[str, str]], unit: Optional[str], up: "str | Vec3") -> "dict[str, Any]":
        return {"names": list(names or self._names), "unit": unit, "up": _axis(up)}

    def __getstate__(self) -> "dict[str, Any]":
        return {**self.__dict__, "_page": None, "_meshes": None}

    def __repr__(self) -> str:
        return f"Deviation(H in {shown_bounds(self.lower, self.upper)}, {self.a_to_b!r}, {self.b_to_a!r})"

    def _repr_html_(self) -> str:
        rows: "list[tuple[str, str]]" = []
        for name, one in (("A to B", self.a_to_b), ("B to A", self.b_to_a)):
            rows.extend((f"{name}: {key}", value) for key, value in one._rows())
        return _table("deviation", rows)

    @classmethod
    def _of(
        cls, data: "dict[str, Any]", beside: Mapping[str, Any], names: Tuple[str, str], meshes: Tuple[Mesh, Mesh]
    ) -> "Deviation":
        greater, bands, verdict = data["greater_percentiles"], data.get("bands"), data.get("verdict")
        threshold = data.get("threshold")
        return cls(
            **data["distance"],
            a_to_b=DirectedDeviation._of("a_to_b", data["a_to_b"], beside, threshold),
            b_to_a=DirectedDeviation._of("b_to_a", data["b_to_a"], beside, threshold),
            greater_percentiles=None if greater is None else _percentiles(greater),
            pooled=Statistics._of(data["pooled"], threshold),
            bands=None if bands is None else BandReport._of(bands),
            verdict=None if verdict is None else Verdict(**verdict),
            report=data,
            _page=beside["page"],
            _names=names,
            _meshes=meshes,
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


def deviation(
    a: MeshLike,
    b: MeshLike,
    *,
    align: Optional[Literal["rigid"]] = None,
    threshold: Optional[Union[float, str]] = None,
    signed: bool = False,
    unsigned: bool = False,
    accuracy: float = 0.01,
    percentiles: Sequence[float] = (50.0, 90.0, 95.0, 99.0,),
    bins: int = 64,
    regions: int = 5,
    most_pieces: Optional[int] = None,
    unit: str = "",
    bands: Sequence[Sequence[Union[float, str]]] = (),
    allow: Optional[float] = None,
    ignore_beyond: Optional[Union[float, str]] = None,
    only_overlap: bool = False,
    box: Optional[Sequence[float]] = None,
    group: Sequence[str] = (),
    ignore_components: Optional[float] = None,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[int] = None,
    progress: ProgressLike = None,
) -> Deviation:
    """Measures how far two surfaces deviate from each other, where, over how much of the area, and whether that is within a tolerance.

    Every statistic is an enclosure of the exact value over all points of all faces, rounding included: what ``pompeiu deviation`` answers.

    Parameters
    ----------
    a, b : MeshLike
        Two meshes in one unit of length, A as it should be and B as it is; see :func:`pompeiu.as_mesh`.
    align : str, optional
        Move B onto A first, from any start; parts of either may have no counterpart. ``"rigid"``: rotate and translate.
    threshold : Union[float, str], optional
        Say whether both are within this length of each other, such as 0.1, 0.1mm with the unit given, or 0.5% of the
        diagonal of both meshes; enclose the share of the area that is farther, and list the regions beyond it.
    signed : bool
        Tell inside from outside whatever the surfaces are, by generalised winding numbers: distances inside the other
        mesh are shown negative. Where both surfaces are closed and oriented, and few of their faces intersect, that is
        the default.
    unsigned : bool
        Do not tell inside from outside unless tolerance bands ask for it.
    accuracy : float
        Largest width of the intervals of mean, root mean square and percentiles, relative to their values; widths below
        1e-9 of the diagonal of both meshes always suffice.
    percentiles : Sequence[float]
        Percentiles to enclose, in percent of the area, such as 50 for the median.
    bins : int
        Bins of the histogram.
    regions : int
        The number of worst regions to list.
    most_pieces : int, optional
        Pieces that the faces of a mesh may be cut into before intervals stay wider than asked; by default 4,000,000, or
        twelve for each face of both meshes if that is more.
    unit : str
        The unit of the coordinates, such as mm; files have none.
    bands : Sequence[Sequence[Union[float, str]]]
        Say whether B deviates from A by no less and no more than this, such as -0.05..0.1: negative where B lacks
        something, positive where it has more; several bands make classes, and what is in none is too low or too high.
    allow : float, optional
        The share of each area that may be farther than the threshold, or outside of all bands, such as 0.01.
    ignore_beyond : Union[float, str], optional
        Leave out what of both is farther than this from the other mesh: what has no counterpart, such as a fixture, or
        what was not scanned; faces that reach farther are cut, and what is kept is proven to be within.
    only_overlap : bool
        Leave out what of both lies beside the other mesh, as of the part of a model that a partial scan does not show:
        the points from which its boundary is no more than a quarter farther away than its surface; faces that reach
        beside are cut.
    box : Sequence[float], optional
        Measure only what lies in this box, given by its least and its greatest coordinates; faces that reach out of it
        are cut.
    group : Sequence[str]
        Measure only faces of this group or object of OBJ, or node of glTF; of several with the option given again; a
        mesh that has no group of any of these names is measured whole.
    ignore_components : float, optional
        Leave out connected parts with less than this share of the area of their mesh, such as 0.001.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
    memory_limit : int, optional
        Stop before memory exceeds so many bytes, with the answer found by then.
    progress : bool or callable, optional
        As for :func:`pompeiu.hausdorff`.

    Returns
    -------
    Deviation
        Both directions, with fields by face and by vertex as arrays, and the verdict on the tolerance.

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
    >>> report = pompeiu.deviation(sheet, lifted, threshold="0.3mm", unit="mm")
    >>> 0.25 in report.a_to_b.statistics.mean
    True
    >>> report.verdict.answer
    'within'
    """
    given = locals()
    names = (_name(a, "A"), _name(b, "B"))
    meshes = (as_mesh(a), as_mesh(b))
    given.update(zip("ab", meshes))
    with watching(given.pop("progress")) as watch:
        answer, beside = ask("deviation", {**given, "progress": watch}, ("a", "b"))
    misplaced = answer["report"].get("misplaced")
    if misplaced is not None:
        warnings.warn(
            f"as it lies, half of B is farther than {misplaced['as_it_lies']:.4g} from A; turned and moved it would be within "
            f"{misplaced['aligned']:.4g}: the poses do not fit, and align=\"rigid\" moves B onto A first",
            stacklevel=2,
        )
    return Deviation._of(answer["report"], beside, names, meshes)


def directed_deviation(
    a: MeshLike,
    b: MeshLike,
    *,
    threshold: Optional[Union[float, str]] = None,
    signed: bool = False,
    unsigned: bool = False,
    accuracy: float = 0.01,
    percentiles: Sequence[float] = (50.0, 90.0, 95.0, 99.0,),
    bins: int = 64,
    regions: int = 5,
    most_pieces: Optional[int] = None,
    unit: str = "",
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[int] = None,
    progress: ProgressLike = None,
) -> DirectedDeviation:
    """Measures how far the points of A are from B: one direction of :func:`deviation`.

    Parameters
    ----------
    a, b : MeshLike
        Two meshes in one unit of length; see :func:`pompeiu.as_mesh`.
    threshold : Union[float, str], optional
        Say whether both are within this length of each other, such as 0.1, 0.1mm with the unit given, or 0.5% of the
        diagonal of both meshes; enclose the share of the area that is farther, and list the regions beyond it.
    signed : bool
        Tell inside from outside whatever the surfaces are, by generalised winding numbers: distances inside the other
        mesh are shown negative. Where both surfaces are closed and oriented, and few of their faces intersect, that is
        the default.
    unsigned : bool
        Do not tell inside from outside unless tolerance bands ask for it.
    accuracy : float
        Largest width of the intervals of mean, root mean square and percentiles, relative to their values; widths below
        1e-9 of the diagonal of both meshes always suffice.
    percentiles : Sequence[float]
        Percentiles to enclose, in percent of the area, such as 50 for the median.
    bins : int
        Bins of the histogram.
    regions : int
        The number of worst regions to list.
    most_pieces : int, optional
        Pieces that the faces of a mesh may be cut into before intervals stay wider than asked; by default 4,000,000, or
        twelve for each face of both meshes if that is more.
    unit : str
        The unit of the coordinates, such as mm; files have none.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
    memory_limit : int, optional
        Stop before memory exceeds so many bytes, with the answer found by then.
    progress : bool or callable, optional
        As for :func:`pompeiu.hausdorff`.

    Returns
    -------
    DirectedDeviation

    Raises
    ------
    MeshError, ReadError, OptionError, KeyboardInterrupt
        As for :func:`deviation`.
    """
    given = dict(locals())
    with watching(given.pop("progress")) as watch:
        answer, beside = ask("directed_deviation", {**given, "progress": watch}, ("a", "b"))
    report = answer["report"]
    return DirectedDeviation._of("a_to_b", report, beside, report["threshold"])
