"""Answers that several modules share: small, immutable, comparable, and able to be pickled.

Times do not count when two answers are compared; everything else does, to the last bit.
"""

from __future__ import annotations

import decimal
import html
import math
import re
from dataclasses import asdict, dataclass, field, fields
from typing import Any, Literal, Mapping, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from .errors import UndecidedError

__all__ = [
    "DirectedReport",
    "MeshSummary",
    "Progress",
    "SurfacePoint",
    "SymmetricReport",
    "Timing",
    "Witness",
    "WorkCount",
]

Vec3 = Tuple[float, float, float]
Direction = Literal["a_to_b", "b_to_a"]
Stop = Literal["tolerance", "threshold", "time", "memory", "pieces", "rounding", "stalled", "cancelled"]


def _table(title: str, rows: "list[tuple[str, str]]") -> str:
    """A small HTML table for notebooks."""
    body = "".join(
        f'<tr><th style="text-align:left">{html.escape(name)}</th>'
        f'<td style="text-align:left">{html.escape(value)}</td></tr>'
        for name, value in rows
    )
    return f"<table><caption>{html.escape(title)}</caption><tbody>{body}</tbody></table>"


#: Digits of bounds that people are shown in tables.
_DIGITS = 6
_DOWN, _UP = (decimal.Context(prec=_DIGITS, rounding=r) for r in (decimal.ROUND_FLOOR, decimal.ROUND_CEILING))


def shown_bounds(lower: float, upper: float) -> str:
    """Both bounds in few digits, rounded outwards: what is shown still holds."""
    ends = (context.create_decimal_from_float(x) for context, x in ((_DOWN, lower), (_UP, upper)))
    return "[{:.6g}, {:.6g}]".format(*ends)


def _read_only(array: NDArray[Any]) -> NDArray[Any]:
    """The same array, of which nobody else knows, made read-only."""
    array.flags.writeable = False
    return array


def _point(position: Vec3) -> str:
    return "({:.6g}, {:.6g}, {:.6g})".format(*position)


def number(value: Optional[float]) -> float:
    """A size, for which JSON has null where it exceeds the range of double precision."""
    return math.inf if value is None else value


#: A format for numbers: what stands before the precision, the precision, and the kind.
_FORMAT = re.compile(r"(?P<head>[^.]*?)(?:\.(?P<precision>\d+))?(?P<kind>[eEfFgG%]?)\Z")
#: Digits that Python takes where a format names none.
_PRECISION = 6


class _Interval:
    """What all answers with a lower and an upper bound can do.

    Comparisons with numbers, and with one another, are ``True`` or ``False`` where both bounds agree, and raise :class:`UndecidedError`
    where they do not. Formats for numbers show the digits in which both bounds agree, and both bounds where there are none.
    """

    lower: float
    upper: float

    @property
    def gap(self) -> float:
        """Width of the enclosure, rounded up."""
        return float(np.nextafter(self.upper - self.lower, np.inf)) if self.upper > self.lower else 0.0

    def __contains__(self, value: float) -> bool:
        return self.lower <= value <= self.upper

    def is_below(self, threshold: float) -> Optional[bool]:
        """Whether the distance is at most ``threshold``: ``True`` or ``False`` if proven, ``None`` if undecided."""
        if self.upper <= threshold:
            return True
        return False if self.lower > threshold else None

    def __lt__(self, other: "Number | _Interval") -> bool:
        ends = _ends(other)
        return NotImplemented if ends is None else self._decided("<", other, self.upper < ends[0], self.lower >= ends[1])

    def __le__(self, other: "Number | _Interval") -> bool:
        ends = _ends(other)
        return NotImplemented if ends is None else self._decided("<=", other, self.upper <= ends[0], self.lower > ends[1])

    def __gt__(self, other: "Number | _Interval") -> bool:
        ends = _ends(other)
        return NotImplemented if ends is None else self._decided(">", other, self.lower > ends[1], self.upper <= ends[0])

    def __ge__(self, other: "Number | _Interval") -> bool:
        ends = _ends(other)
        return NotImplemented if ends is None else self._decided(">=", other, self.lower >= ends[1], self.upper < ends[0])

    def _decided(self, sign: str, other: "Number | _Interval", yes: bool, no: bool) -> bool:
        if yes or no:
            return yes
        mine = f"[{self.lower!r}, {self.upper!r}]"
        theirs = f"[{other.lower!r}, {other.upper!r}]" if isinstance(other, _Interval) else repr(other)
        raise UndecidedError(
            f"whether a value in {mine} is {sign} {theirs} is not decided by these bounds; compare lower or upper, "
            "or ask for a narrower interval"
        )

    def __format__(self, spec: str) -> str:
        if not spec:
            return str(self)
        form = _FORMAT.match(spec)
        if form is None:
            raise ValueError(f"{spec!r} is no format for numbers, such as .3f")
        kind = form["kind"] or "g"
        least = 1 if kind in "gG" else 0
        for precision in range(int(form["precision"] or _PRECISION), least - 1, -1):
            shown = f"{form['head']}.{precision}{kind}"
            lower, upper = format(self.lower, shown), format(self.upper, shown)
            if lower == upper:
                return lower
        return shown_bounds(self.lower, self.upper)


Number = Union[int, float]


def _ends(value: Any) -> "Optional[tuple[float, float]]":
    """The bounds of an interval, or of a number."""
    if isinstance(value, _Interval):
        return value.lower, value.upper
    return (float(value), float(value)) if isinstance(value, (int, float, np.integer, np.floating)) else None


@dataclass(frozen=True)
class SurfacePoint:
    """A point on a face of a mesh.

    Attributes
    ----------
    face : int
        Index of the face.
    barycentric : tuple of 3 floats
        Nonnegative weights of its corners; they add up to 1 but for rounding.
    position : tuple of 3 floats
        The point in space, in the unit of the mesh, rounded.
    """

    face: int
    barycentric: Vec3
    position: Vec3

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of numbers and tuples."""
        return asdict(self)

    @classmethod
    def _of(cls, data: Mapping[str, Any]) -> "SurfacePoint":
        return cls(data["face"], tuple(data["barycentric"]), tuple(data["position"]))


@dataclass(frozen=True)
class Witness:
    """A point that is far from the other mesh, and a point of that mesh nearest to it.

    Attributes
    ----------
    from_ : SurfacePoint
        On the mesh that distances are measured from.
    to : SurfacePoint
        On the mesh that distances are measured to.
    """

    from_: SurfacePoint
    to: SurfacePoint

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary with the keys ``from`` and ``to``."""
        return {"from": self.from_.to_dict(), "to": self.to.to_dict()}

    @classmethod
    def _of(cls, data: Mapping[str, Any]) -> "Witness":
        return cls(SurfacePoint._of(data["from"]), SurfacePoint._of(data["to"]))


@dataclass(frozen=True)
class WorkCount:
    """How much was done, in counts that do not depend on the machine or the number of threads."""

    queries: int
    distances: int
    pieces: int
    games: int
    cuts: int
    depth: int


@dataclass(frozen=True)
class Timing:
    """Wall-clock seconds: building trees, and everything else."""

    build: float
    search: float


@dataclass(frozen=True)
class DirectedReport(_Interval):
    """How far the points of A are from B: ``lower <= h(A, B) <= upper``, proven.

    Attributes
    ----------
    lower, upper : float
        The enclosure, in the unit of the meshes; ``value in report`` asks whether it holds a value.
    witness : Witness
        A point of A at least ``lower`` away from all of B, and a point of B nearest to it.
    stop : str
        Why the search ended: ``"tolerance"``, ``"threshold"``, ``"time"``, ``"memory"``, ``"pieces"``, ``"rounding"`` (the
        tolerance lies below what double precision tells apart) or ``"cancelled"``. The enclosure holds in every case.
    tolerance : float
        The width that was asked for, in the unit of the meshes.
    work : WorkCount
        What it took.
    timing : Timing
        How long it took; does not count in comparisons.
    """

    lower: float
    upper: float
    witness: Witness
    stop: Stop
    tolerance: float
    work: WorkCount = field(repr=False)
    timing: Timing = field(repr=False, compare=False)

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of plain values, ready for ``json.dumps``."""
        return {
            "lower": self.lower,
            "upper": self.upper,
            "stop": self.stop,
            "tolerance": self.tolerance,
            "witness": self.witness.to_dict(),
            "work": asdict(self.work),
            "timing": asdict(self.timing),
        }

    def __repr__(self) -> str:
        return (
            f"DirectedReport({self.lower!r} <= h <= {self.upper!r}, stop={self.stop!r}, "
            f"from face {self.witness.from_.face} to face {self.witness.to.face})"
        )

    def _repr_html_(self) -> str:
        return _table("directed Pompeiu–Hausdorff distance", self._rows())

    def _rows(self) -> "list[tuple[str, str]]":
        return [
            ("lower", repr(self.lower)),
            ("upper", repr(self.upper)),
            ("from", f"face {self.witness.from_.face} at {_point(self.witness.from_.position)}"),
            ("to", f"face {self.witness.to.face} at {_point(self.witness.to.position)}"),
            ("ended by", self.stop),
        ]

    @classmethod
    def _of(cls, data: Mapping[str, Any]) -> "DirectedReport":
        return cls(
            lower=data["lower"],
            upper=data["upper"],
            witness=Witness._of(data["witness"]),
            stop=data["stop"],
            tolerance=data["tolerance"],
            work=WorkCount(**data["work"]),
            timing=Timing(**{part: span / 1000 for part, span in data["timing_ms"].items()}),
        )


@dataclass(frozen=True)
class SymmetricReport(_Interval):
    """The Pompeiu–Hausdorff distance, the greater of both directed ones: ``lower <= H(A, B) <= upper``, proven.

    Attributes
    ----------
    lower, upper : float
        The enclosure, in the unit of the meshes; ``value in report`` asks whether it holds a value.
    a_to_b, b_to_a : DirectedReport
        Both directions; the witness of the second leads from B to A.
    """

    lower: float
    upper: float
    a_to_b: DirectedReport
    b_to_a: DirectedReport

    @property
    def direction(self) -> Direction:
        """The direction with the greater lower bound: the one that proves ``lower``."""
        return "b_to_a" if self.b_to_a.lower > self.a_to_b.lower else "a_to_b"

    @property
    def witness(self) -> Witness:
        """The pair of points that proves ``lower``, from the mesh that :attr:`direction` begins with."""
        return (self.b_to_a if self.direction == "b_to_a" else self.a_to_b).witness

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of plain values, ready for ``json.dumps``."""
        return {
            "lower": self.lower,
            "upper": self.upper,
            "direction": self.direction,
            "a_to_b": self.a_to_b.to_dict(),
            "b_to_a": self.b_to_a.to_dict(),
        }

    def __repr__(self) -> str:
        return (
            f"SymmetricReport({self.lower!r} <= H <= {self.upper!r}, {self.direction}, "
            f"from face {self.witness.from_.face} to face {self.witness.to.face})"
        )

    def _repr_html_(self) -> str:
        rows = [("lower", repr(self.lower)), ("upper", repr(self.upper))]
        for name, report in (("A to B", self.a_to_b), ("B to A", self.b_to_a)):
            rows.extend((f"{name}: {key}", value) for key, value in report._rows())
        return _table("Pompeiu–Hausdorff distance", rows)

    @classmethod
    def _of(cls, data: Mapping[str, Any]) -> "SymmetricReport":
        return cls(
            lower=data["lower"],
            upper=data["upper"],
            a_to_b=DirectedReport._of(data["a_to_b"]),
            b_to_a=DirectedReport._of(data["b_to_a"]),
        )


@dataclass(frozen=True)
class Progress:
    """How far a search has come; the bounds are not yet proven.

    Attributes
    ----------
    direction : str
        ``"a_to_b"`` or ``"b_to_a"``.
    lower, upper : float
        The largest distance met so far, and the largest bound still open.
    examined, left : int
        Faces and pieces looked at, and known to be left; cutting adds to them.
    """

    direction: Direction
    lower: float
    upper: float
    examined: int
    left: int


@dataclass(frozen=True)
class MeshSummary:
    """Counts, measures and connectivity of a mesh.

    ``area`` and ``volume`` are in squared and cubed units of the mesh; ``volume`` is ``None`` unless the faces enclose one,
    ``genus`` unless the mesh is manifold and orientable. The corners are those of the bounding box of the faces.
    """

    vertices: int
    unreferenced_vertices: int
    faces: int
    degenerate_faces: int
    duplicate_faces: int
    lower_corner: Vec3
    upper_corner: Vec3
    area: float
    volume: Optional[float]
    edges: int
    boundary_edges: int
    seam_edges: int
    boundary_loops: int
    non_manifold_edges: int
    non_manifold_vertices: int
    inconsistent_edges: int
    components: int
    euler_characteristic: int
    orientable: bool
    genus: Optional[int]

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of plain values."""
        return asdict(self)

    @classmethod
    def _of(cls, data: Mapping[str, Any]) -> "MeshSummary":
        box = data["bounding_box"]
        others = {name: value for name, value in data.items() if name != "bounding_box"}
        return cls(
            **{**others, "area": number(data["area"])},
            lower_corner=tuple(box["lower"]),
            upper_corner=tuple(box["upper"]),
        )

    def _repr_html_(self) -> str:
        return _table("mesh", [(f.name.replace("_", " "), str(getattr(self, f.name))) for f in fields(self)])


class _Arrays:
    """Comparison, and a short repr, of answers that hold arrays."""

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        for f in fields(self):  # type: ignore[arg-type]
            if not f.compare:
                continue
            mine, theirs = getattr(self, f.name), getattr(other, f.name)
            if isinstance(mine, np.ndarray):
                if not np.array_equal(mine, theirs, equal_nan=mine.dtype.kind == "f"):
                    return False
            elif mine != theirs:
                return False
        return True

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        shown = []
        for f in fields(self):  # type: ignore[arg-type]
            value = getattr(self, f.name)
            shown.append(f"{f.name}=<{value.dtype} {value.shape}>" if isinstance(value, np.ndarray) else f"{f.name}={value!r}")
        return f"{type(self).__name__}({', '.join(shown)})"
