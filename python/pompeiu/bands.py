"""Signed tolerance bands: how much of both surfaces lies in which."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Mapping, Optional, Tuple

from .results import Stop

if TYPE_CHECKING:
    from .deviations import Enclosure

__all__ = ["BandReport", "DirectedBands"]


@dataclass(frozen=True)
class DirectedBands:
    """How much of one surface lies in which tolerance band.

    Attributes
    ----------
    lowest, highest : Enclosure
        The least and the greatest signed deviation.
    shares : tuple of Enclosure, optional
        For each class the share of the area: too low, each class between two edges, too high. None for a surface without area.
    closed : bool
        Whether the other surface is closed. Beside the boundary of an open one, which side is inside is a choice.
    stop : str
        Why cutting ended; shares hold in every case.
    """

    lowest: Enclosure
    highest: Enclosure
    shares: Optional[Tuple[Enclosure, ...]]
    closed: bool
    stop: Stop

    @classmethod
    def _of(cls, data: Mapping[str, Any]) -> "DirectedBands":
        from .deviations import Enclosure

        shares = data["shares"]
        return cls(
            lowest=Enclosure(**data["lowest"]),
            highest=Enclosure(**data["highest"]),
            shares=None if shares is None else tuple(Enclosure(**share) for share in shares),
            closed=data["closed"],
            stop=data["stop"],
        )


@dataclass(frozen=True)
class BandReport:
    """How much of both surfaces lies in which tolerance band.

    Attributes
    ----------
    edges : tuple of float
        Ends of the classes between the first, which is too low, and the last, which is too high; ascending.
    a_to_b : DirectedBands
        Of the points of A: what is missing in B is negative, where B has more is positive.
    b_to_a : DirectedBands
        Of the points of B: outside of A is positive, inside of it negative.
    """

    edges: Tuple[float, ...]
    a_to_b: DirectedBands
    b_to_a: DirectedBands

    @classmethod
    def _of(cls, data: Mapping[str, Any]) -> "BandReport":
        return cls(tuple(data["edges"]), DirectedBands._of(data["a_to_b"]), DirectedBands._of(data["b_to_a"]))
