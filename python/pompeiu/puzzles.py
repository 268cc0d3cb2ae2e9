"""Jigsaw puzzles, and what holds them together."""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable, Dict, List, Literal, Optional, Sequence, Union

import numpy as np

from . import _native
from ._asking import ask
from .errors import OptionError, ReadError, WriteError

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
    _drawings: Any = field(default=None)
    _stop: str = "tolerance"

    def __getstate__(self) -> Dict[str, Any]:
        # What drawings need does not travel.
        return {name: value for name, value in self.__dict__.items() if name != "_drawings"}

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

    @property
    def stop(self) -> str:
        """Why the computation ended: ``"tolerance"`` if it reached what was asked, else the limit that ended it."""
        return self._stop

    def write(
        self,
        path: Union[str, "os.PathLike[str]"],
        *,
        cuts: bool = False,
        motion: bool = False,
        pull: float = 0.0,
        image: Optional[Union[str, "os.PathLike[str]"]] = None,
    ) -> None:
        """Writes a drawing, a picture or a page.

        Parameters
        ----------
        path : str or path
            ``.svg`` or ``.dxf``: a drawing; ``.png``: a picture; ``.html``: a page on which pieces can be dragged.
        cuts : bool
            Each border once, in the order to cut them, instead of one closed path for each piece.
        motion : bool
            The motion that takes a puzzle apart which is not locked, as an SVG that plays it or a PNG of its end, instead of the
            pieces.
        pull : float
            Pull the pieces apart, by this factor of their distance from the middle.
        image : path, optional
            A picture to lie on the pieces: PNG, JPEG, GIF or BMP.

        Raises
        ------
        WriteError
            If the file cannot be written, its suffix is another one, or there is no motion.
        ReadError
            If the picture cannot be read.
        ValueError
            If this puzzle was pickled.
        """
        suffix = Path(path).suffix.lower()
        what = "page" if suffix == ".html" else "motion" if motion else "cuts" if cuts else "pieces"
        known = {"page": (".html",), "motion": (".svg", ".png"), "cuts": (".svg", ".dxf"), "pieces": (".svg", ".dxf", ".png")}[what]
        if suffix not in known:
            names = f"{', '.join(known[:-1])} or {known[-1]}" if len(known) > 1 else known[0]
            raise WriteError(f"{path}: {what} of puzzles are written as {names}")
        picture = None
        if image is not None:
            try:
                picture = Path(image).read_bytes()
            except OSError as error:
                raise ReadError(f"{os.fspath(image)}: {error.strerror}") from error
        if self._drawings is None:
            raise ValueError("this puzzle was pickled: what its drawings need does not travel with it")
        drawn = self._drawings.draw(what, suffix[1:], float(pull), picture)
        if drawn is None:
            raise WriteError(f"{path}: no motion takes the puzzle apart")
        _native.write_whole(path, drawn)

    def __repr__(self) -> str:
        return f"Puzzle({len(self.outlines)} pieces, {'locked' if self.is_locked else 'not locked'})"


def puzzle(
    pieces: int = 24,
    *,
    outline: Optional[Union[str, Sequence[Sequence[float]]]] = None,
    size: Sequence[float] = (300.0, 200.0,),
    layout: Literal["grid", "hexagons", "voronoi"] = "grid",
    tab: Literal["none", "knob", "dovetail"] = "knob",
    neck: Optional[Union[float, str]] = None,
    seed: int = 0,
    piece: Optional[Union[str, Sequence[Sequence[float]]]] = None,
    method: Literal["descent", "lloyd"] = "descent",
    metric: Literal["least", "greatest", "distance"] = "distance",
    corners: bool = False,
    feedback: bool = True,
    mirrors: bool = True,
    free_outline: bool = False,
    whimsy: Sequence[Union[str, Sequence[Sequence[float]]]] = (),
    kerf: Optional[Union[float, str]] = None,
    layout_on: Optional[Sequence[float]] = None,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    progress: Optional[Callable[[float], Optional[bool]]] = None,
) -> Puzzle:
    """Makes a jigsaw puzzle on a rectangle or within an outline, and tests whether it holds together.

    Parameters
    ----------
    pieces : int
        Number of pieces; hexagons, and pieces within an outline, come near to it.
    outline : Union[str, Sequence[Sequence[float]]], optional
        The outline of the puzzle: a picture (its largest part), a drawing, a list of points, or in Python corners; a
        rectangle by default.
    size : Sequence[float]
        Width and height, in millimetres for drawings; an outline is scaled to fit into that.
    layout : str
        The pieces before they get tabs. ``"grid"``: rows of rectangles; ``"hexagons"``: rows of hexagons;
        ``"voronoi"``: voronoi cells of random sites, made regular by Lloyd's method.
    tab : str
        The shape of tabs on borders between pieces. ``"none"``: straight borders; ``"knob"``: a round head on a
        narrower neck; ``"dovetail"``: a trapezium that is wider at its head.
    neck : Union[float, str], optional
        The least width of necks that tabs leave, in millimetres or with another unit; by default 15 % of the mean side
        of a piece, and 3 mm where these are at most a fifth of it.
    seed : int
        Seed of places and sides.
    piece : Union[str, Sequence[Sequence[float]]], optional
        Make pieces as similar to a shape as possible, with as few tabs as hold the puzzle together: square, hexagon,
        classic, corner, fish, bird, star, a file, or in Python corners; the layout is not used then.
    method : str
        The arrangement of copies of the shape of pieces. ``"descent"``: from lattices, by a descent whose energy never
        increases, and hops; ``"lloyd"``: lloyd's method with the shape-matching metric.
    metric : str
        Lloyd's method: what counts where a ray from the site meets the shape several times. ``"least"``: the least
        factor, of the outermost intersection: the metric of the star hull; ``"greatest"``: the greatest factor, of the
        innermost intersection: the metric of the part of the shape visible from the site; ``"distance"``: the signed
        distance to the shape instead of a factor, negative inside. It is continuous everywhere.
    corners : bool
        Lloyd's method: measure by the shape's corners instead of its sides.
    feedback : bool
        Lloyd's method: turn copies as the registration of the shape on their regions says.
    mirrors : bool
        Mirror copies of the shape where they fit better.
    free_outline : bool
        Let the outline be what whole copies of the shape leave, so that it cuts no piece; it comes near to the one
        asked for.
    whimsy : Sequence[Union[str, Sequence[Sequence[float]]]]
        Make a piece of an outline, twice as large as the others: a picture (its largest part), a drawing or a list of
        points; may be repeated.
    kerf : Union[float, str], optional
        Width of the cut, such as 0.2 for millimetres, 0.2mm or 8mil: paths are moved by half of it, and whether the
        puzzle holds with the gap is tested.
    layout_on : Sequence[float], optional
        Lay the pieces out on a sheet of this width and height, with the width of the cut between their paths.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
    progress : callable, optional
        Called with the share of the placing that is done; ``False`` ends it.

    Raises
    ------
    OptionError
        If options make no sense.
    ReadError
        If a file cannot be read.

    Examples
    --------
    >>> import pompeiu
    >>> pompeiu.puzzle(12)
    Puzzle(12 pieces, locked)
    >>> pompeiu.puzzle(12, tab="none").is_locked
    False
    """
    if pieces < 0:
        raise OptionError(f"the number of pieces is {pieces}; it must be at least 2")
    answer, beside = ask("puzzle", locals(), meshes=())
    for left_out in answer["report"].get("left_out", []):
        warnings.warn(left_out, stacklevel=2)
    return Puzzle(beside["outlines"], answer["report"], beside["drawings"], answer["stop"])
