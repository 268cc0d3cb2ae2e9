"""Outlines in the plane, and how complex they are."""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Literal, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._asking import ask
from .errors import OptionError

__all__ = ["Complexity", "complexity", "k_medoids", "noisy_circle", "polyline", "read_outlines"]

ShapeLike = Union[str, "os.PathLike[str]", ArrayLike]


@dataclass(frozen=True, repr=False)
class Complexity:
    """Measures of shapes, their ranking and their clusters.

    Attributes
    ----------
    report : dict
        What ``pompeiu complexity --json`` says of the shapes.
    """

    report: Dict[str, Any]

    @property
    def shapes(self) -> List[Dict[str, Any]]:
        """The shapes with their measures, by family."""
        return self.report["shapes"]

    @property
    def ranking(self) -> List[str]:
        """The names of the shapes, from the simplest to the most complex."""
        return [ranked["file"] for ranked in self.report["ranking"]]

    @property
    def agreement(self) -> Optional[Dict[str, Any]]:
        """How far the ranking agrees with the one it was compared with."""
        return self.report["agreement"]

    @property
    def clusters(self) -> Optional[Dict[str, Any]]:
        """The clusters, if they were asked for."""
        return self.report["clusters"]

    @property
    def failed(self) -> List[Dict[str, str]]:
        """The files that cannot be used: the path and the message of each."""
        return self.report["failed"]

    def table(self) -> Dict[str, List[Any]]:
        """A column for each measure, as ``pandas.DataFrame`` takes them; histograms are left out.

        Examples
        --------
        >>> import pompeiu
        >>> pompeiu.complexity({"square": [(0, 0), (1, 0), (1, 1), (0, 1)]}).table()["convexity"]
        [1.0]
        """
        place = {ranked["file"]: ranked["rank"] for ranked in self.report["ranking"]}
        columns: Dict[str, List[Any]] = {"file": [shape["file"] for shape in self.shapes]}
        columns["rank"] = [place[file] for file in columns["file"]]
        for family, measures in self.shapes[0].items():
            if not isinstance(measures, dict):
                if family != "file":
                    columns[family] = [shape[family] for shape in self.shapes]
                continue
            for name, value in measures.items():
                if not isinstance(value, list):
                    key = f"boundary_{name}" if family == "boundary" else name
                    key = key if key not in columns else f"{family}_{name}"
                    columns[key] = [shape[family][name] for shape in self.shapes]
        if self.clusters is not None:
            columns["cluster"] = list(self.clusters["labels"])
            columns["silhouette"] = list(self.clusters["silhouettes"])
        return columns

    def __repr__(self) -> str:
        return f"Complexity({len(self.shapes)} shapes, by {self.report['ranked_by']})"


def read_outlines(
    path: Union[str, "os.PathLike[str]"],
    *,
    level: Optional[float] = None,
    foreground: str = "auto",
    staircase: bool = False,
) -> List[np.ndarray]:
    """The closed outlines in a file.

    Parameters
    ----------
    path : str or path
        A picture (PNG, JPEG, GIF, BMP), a drawing (SVG, DXF), or a list of points (TXT, CSV).
    level : float, optional
        The level between shape and background of a picture, from 0 (black) to 1 (white); Otsu's by default.
    foreground : str
        Which part of a picture is the shape: ``"auto"`` (what most of the border is not), ``"dark"`` or ``"light"``.
    staircase : bool
        Whether outlines follow the sides of pixels instead of the smoothest curve within half a pixel of them.

    Returns
    -------
    list of numpy.ndarray of float, shape (n, 2)
        Counter-clockwise corners of each. Of a picture the largest part that stands out, and then its holes; y goes down.

    Raises
    ------
    ReadError
        If the file cannot be read, or holds no closed outline.

    Warns
    -----
    UserWarning
        For each ``<use>`` of an SVG drawing that refers to what is not in it, and draws nothing.
    """
    return _native.read_outlines(os.fspath(path), level, foreground, bool(staircase))


def _area(points: np.ndarray) -> float:
    x, y = (points - points[0]).T
    return 0.5 * abs(float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))))


def complexity(
    shapes: Union[str, "os.PathLike[str]", Mapping[str, ShapeLike], Sequence[ShapeLike]],
    *,
    rank_by: str = "total-curvature",
    against: Optional[Union[str, Mapping[str, float]]] = None,
    clusters: Optional[int] = None,
    features: Sequence[str] = ("log:spread", "convexity", "hull", "circle", "rectangle", "skeleton-variation", "boundary-8", "log:t18",),
    smoothing: float = 0.004,
    level: Optional[float] = None,
    foreground: Literal["auto", "dark", "light"] = "auto",
    staircase: bool = False,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    progress: Optional[Callable[[float], Optional[bool]]] = None,
) -> Complexity:
    """Measures how complex shapes are, ranks and clusters them.

    Parameters
    ----------
    shapes : path, mapping or sequence
        A folder of shapes, or outlines as arrays of shape (n, 2), files (see :func:`read_outlines`) and folders; with names, or
        without. Files that cannot be used are in :attr:`Complexity.failed`, with a warning, and the others are measured. Of a picture
        the largest part is; a warning tells of others.
    rank_by : str
        The measure that ranks the shapes.
    against : Union[str, Mapping[str, float]], optional
        Compare with another ranking: a file with lines name,place, 1 for the simplest shape; in Python also the place
        of each name.
    clusters : int, optional
        Divide the shapes into so many clusters around shapes of their own.
    features : Sequence[str]
        The features that clusters are made by: measures, or log:MEASURE for ln(1 + value).
    smoothing : float
        Standard deviation of the Gaussian that smooths outlines for curvature, as a share of their length.
    level : float, optional
        The level between shape and background of a picture, from 0 (black) to 1 (white); Otsu's by default.
    foreground : str
        The part of a picture that is the shape. ``"auto"``: the part that differs from most pixels of the border;
        ``"dark"``: the part darker than the level; ``"light"``: the part lighter than the level.
    staircase : bool
        Follow the sides of pixels instead of the smoothest curve within half a pixel of them.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
    progress : callable, optional
        Called with the share that is done; ``False`` ends it.

    Raises
    ------
    OutlineError
        If points make no closed polygon.
    ReadError
        If none of the files can be read, or the ranking cannot.
    OptionError
        If options make no sense.

    Examples
    --------
    >>> import pompeiu
    >>> shapes = {str(n): pompeiu.polyline(n, seed=1) for n in (5, 25)}
    >>> pompeiu.complexity(shapes).ranking
    ['5', '25']
    """
    given = dict(locals())
    del given["shapes"]
    if clusters is not None and clusters < 1:
        raise OptionError(f"{clusters} clusters are asked for; at least 1 is needed")
    answer, _ = ask("complexity", given, meshes=(), others=_named(shapes))
    for failed in answer["report"]["failed"]:
        warnings.warn(f"{failed['path']}: {failed['message']}", stacklevel=2)
    for left_out in answer["report"]["left_out"]:
        warnings.warn(left_out, stacklevel=2)
    return Complexity(answer["report"])


def _named(shapes: Any) -> List[Tuple[str, Any]]:
    """Names with paths or arrays."""
    is_path = lambda shape: isinstance(shape, (str, os.PathLike))  # noqa: E731
    if is_path(shapes):
        shapes = [shapes]
    if not isinstance(shapes, Mapping):
        shapes = {os.fspath(shape) if is_path(shape) else str(i): shape for i, shape in enumerate(shapes)}
    return [(str(name), os.fspath(shape) if is_path(shape) else shape) for name, shape in shapes.items()]


def k_medoids(distances: Any, start: Sequence[int]) -> Tuple[float, List[int]]:
    """Swaps medoids with other points while that makes the sum of distances to the nearest medoid less.

    Parameters
    ----------
    distances : array of shape (n, n)
        Distances of points, not negative.
    start : sequence of int
        Different points to start from, one for each cluster.

    Returns
    -------
    loss : float
        The sum of distances to the nearest medoid. No swap of one medoid makes it less.
    medoids : list of int

    Raises
    ------
    OptionError
        If distances are no square array of finite numbers that are not negative, or the start is not one of different points.

    Examples
    --------
    >>> import numpy as np
    >>> import pompeiu
    >>> at = np.array([0.0, 1.0, 2.0, 10.0, 11.0])
    >>> loss, medoids = pompeiu.k_medoids(abs(at[:, None] - at), [0, 1])
    >>> loss
    3.0
    """
    table = np.asarray(distances, dtype=float)
    if table.ndim != 2 or table.shape[0] != table.shape[1] or not (np.isfinite(table).all() and (table >= 0).all()):
        raise OptionError("distances must be a square array of finite numbers that are not negative")
    first = [int(index) for index in start]
    if not first or len(set(first)) < len(first) or not all(0 <= index < len(table) for index in first):
        raise OptionError(f"start must have different points below {len(table)}, at least one")
    loss, medoids = _native.k_medoids(table.tolist(), first)
    return loss, list(medoids)


def polyline(points: int, *, seed: int = 0, order: str = "random") -> np.ndarray:
    """The closed Catmull–Rom curve through points drawn uniformly from the unit square.

    Parameters
    ----------
    points : int
        Number of points, from 3 to 1000.
    seed : int
        The same seed gives the same curve on every machine.
    order : str
        ``"random"``: the curve may cross itself; ``"angle"``: by direction from the mean.

    Returns
    -------
    numpy.ndarray of float, shape (n, 2)
    """
    return _native.polyline(points, seed, order)


def noisy_circle(radius: int = 20, level: int = 1, *, steps: int = 6, seed: int = 0) -> np.ndarray:
    """The outline of a circle of pixels to which random walks have added pixels, ``level`` times over.

    Parameters
    ----------
    radius : int
        In pixels, from 2 to 2000.
    level : int
        How often every pixel of the border takes a walk.
    steps : int
        The longest walk.
    seed : int
        The same seed gives the same outline on every machine.

    Returns
    -------
    numpy.ndarray of float, shape (n, 2)
    """
    return _native.noisy_circle(radius, level, steps, seed)
