"""Jigsaw puzzles, and what holds them together."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from . import _native
from .errors import OptionError, ReadError, WriteError
from .files import write_whole

__all__ = ["Puzzle", "puzzle"]


@dataclass(frozen=True, eq=False, repr=False)
class Puzzle:
    """A jigsaw puzzle.

    Attributes
    ----------
    outlines : list of numpy.ndarray of float, shape (n, 2)
        The corners of each piece. What two pieces share is the same bits in both.
    report : dict
        What ``pompeiu puzzle --json`` says of it.
    """

    outlines: List[np.ndarray]
    report: Dict[str, Any]
    _drawings: Tuple[bytes, ...] = field(default=())

    @property
    def is_locked(self) -> bool:
        """Whether no piece can move against another one, over all motions of all pieces at once."""
        return len(self.report["clusters"]) == 1

    @property
    def clusters(self) -> List[List[int]]:
        """Pieces that cannot move against each other."""
        return self.report["clusters"]

    @property
    def holds(self) -> Optional[bool]:
        """Whether no two pieces can part with the gap of the cut between them; none without a cut."""
        return self.report["kerf"]["holds"] if "kerf" in self.report else None

    def write(self, path: Union[str, "os.PathLike[str]"], *, cuts: bool = False, motion: bool = False) -> None:
        """Writes a drawing, a picture or a page.

        Parameters
        ----------
        path : str or path
            ``.svg`` or ``.dxf``: a drawing; ``.png``: the pieces as a picture; ``.html``: a page on which pieces can be dragged.
        cuts : bool
            Each border once, in the order to cut them, instead of one closed path for each piece.
        motion : bool
            The motion that takes a puzzle apart which is not locked, as an SVG that plays it, instead of the pieces.

        Raises
        ------
        WriteError
            If the file cannot be written, its suffix is another one, or there is no motion.
        """
        suffix = Path(path).suffix.lower()
        place = {".svg": 6 if motion else int(cuts), ".dxf": 2 + cuts, ".html": 4, ".png": 5}.get(suffix)
        if place is None:
            raise WriteError(f"{path}: puzzles are written as .svg, .dxf, .png or .html")
        if not self._drawings[place]:
            raise WriteError(f"{path}: no motion takes the puzzle apart")
        try:
            write_whole(path, self._drawings[place])
        except OSError as error:
            raise WriteError(f"{path}: {error.strerror}") from error

    def __repr__(self) -> str:
        return f"Puzzle({len(self.outlines)} pieces, {'locked' if self.is_locked else 'not locked'})"


def puzzle(
    pieces: int = 24,
    *,
    outline: Optional[Any] = None,
    size: Sequence[float] = (300.0, 200.0),
    layout: str = "grid",
    tab: str = "knob",
    seed: int = 0,
    piece: Optional[Any] = None,
    method: str = "descent",
    metric: str = "distance",
    corners: bool = False,
    feedback: bool = True,
    mirrors: bool = True,
    free_outline: bool = False,
    whimsies: Sequence[Any] = (),
    kerf: float = 0.0,
    image: Optional[Union[str, "os.PathLike[str]"]] = None,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    memory_limit: Optional[int] = None,
    progress: Optional[Callable[[float], Optional[bool]]] = None,
) -> Puzzle:
    """Makes a jigsaw puzzle on a rectangle or within an outline, and tests whether it holds together.

    Parameters
    ----------
    pieces : int
        Number of pieces; hexagons, and pieces within an outline, come near to it.
    outline : array of shape (n, 2), optional
        What is around the puzzle; a rectangle by default. See :func:`read_outlines` for those in files.
    size : pair of float
        Width and height; an outline is scaled to fit into that.
    layout : str
        ``"grid"``, ``"hexagons"`` or ``"voronoi"``.
    tab : str
        ``"none"``, ``"knob"`` or ``"dovetail"``.
    seed : int
        The same seed gives the same puzzle on every machine.
    piece : str or array of shape (n, 2), optional
        Make pieces as like this shape as they can be, with as few tabs as hold the puzzle together: ``"square"``, ``"hexagon"``,
        ``"classic"``, ``"corner"``, ``"fish"``, ``"bird"``, ``"star"``, or the corners of an outline. The layout is not used then.
    method : str
        How copies of the shape are placed: ``"descent"`` from lattices, or ``"lloyd"``.
    metric, corners, feedback
        For Lloyd's method: what counts where a ray meets the shape several times (``"distance"``, ``"least"``, ``"greatest"``); whether
        to measure by corners instead of sides; whether copies turn as the registration on their regions says.
    mirrors : bool
        Whether copies may be mirrored.
    free_outline : bool
        Let the outline be what whole copies of the shape leave, so that it cuts no piece.
    whimsies : sequence of arrays of shape (n, 2)
        Outlines that become pieces of their own, each twice as large as the others; not with ``piece``.
    kerf : float
        Width of the cut. Paths are moved by half of it, and :attr:`Puzzle.holds` says whether the puzzle holds with the gap.
    image : path, optional
        A picture to lie on the pieces: PNG, JPEG, GIF or BMP.
    threads, time_limit, memory_limit : optional
        Limits on the placing of copies; the best pieces found by then are made. With fewer bytes, borders are drawn coarser.
    progress : callable, optional
        Called with the share of the placing that is done; ``False`` ends it.

    Raises
    ------
    OptionError
        If options make no sense.
    ReadError
        If the picture cannot be read.

    Examples
    --------
    >>> import pompeiu
    >>> pompeiu.puzzle(12)
    Puzzle(12 pieces, locked)
    >>> pompeiu.puzzle(12, tab="none").is_locked
    False
    """
    sides = tuple(float(side) for side in size)
    if len(sides) != 2:
        raise OptionError(f"size has {len(sides)} numbers; a width and a height are needed")
    if pieces < 0:
        raise OptionError(f"{pieces} pieces are asked for; there must be at least 2")
    like = None
    if piece is not None:
        like = {
            "name": piece if isinstance(piece, str) else "",
            "points": None if isinstance(piece, str) else piece,
            "method": method,
            "metric": metric,
            "corners": bool(corners),
            "feedback": bool(feedback),
            "mirrors": bool(mirrors),
            "free_outline": bool(free_outline),
            "threads": threads,
            "time_limit": time_limit,
            "memory_limit": memory_limit,
        }
    if piece is not None and len(whimsies) > 0:
        raise OptionError("whimsies are for pieces without a shape; leave out piece or whimsies")
    if not (kerf >= 0 and kerf < float("inf")):
        raise OptionError(f"kerf is {kerf}; it must be a width, or 0")
    picture = None
    if image is not None:
        try:
            picture = Path(image).read_bytes()
        except OSError as error:
            raise ReadError(f"{os.fspath(image)}: {error.strerror}") from error
    outlines, report, drawings = _native.puzzle(
        outline, pieces, sides, layout, tab, seed, like, list(whimsies), float(kerf), picture, progress
    )
    return Puzzle(outlines, json.loads(report), tuple(drawings))
