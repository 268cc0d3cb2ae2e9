"""Two solvers made to agree at the interface between them."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from typing import Any, Callable, Dict, Literal, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._asking import ask, split
from .errors import OptionError

__all__ = ["Coupled", "couple"]


@dataclass(frozen=True, eq=False, repr=False)
class Coupled:
    """Interface data that two solvers agree on.

    Attributes
    ----------
    x : numpy.ndarray of float, shape (w, n)
        The data that the first solver takes and the second one gives, for each window that was solved.
    y : numpy.ndarray of float, shape (w, m)
        What the first solver gives for it.
    report : dict
        What ``pompeiu couple --json`` says of the run, or of each run where schemes were compared.
    stop : str
        Why it ended: ``"tolerance"`` if all windows were solved, ``"stalled"`` if one could not be, else the limit.
    """

    x: np.ndarray
    y: np.ndarray
    report: Dict[str, Any]
    stop: str
    _page: Optional["_native.RunPage"] = None

    def __getstate__(self) -> Dict[str, Any]:
        # What the page needs does not travel.
        return {name: value for name, value in self.__dict__.items() if name != "_page"}

    @property
    def runs(self) -> list[Dict[str, Any]]:
        """The run, or one for each scheme."""
        return self.report["runs"]

    @property
    def failure(self) -> Optional[str]:
        """Why the run ended early, with what is known of the solvers; none if it did not."""
        return self.runs[0]["failure"]

    def save_html(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes a page that plays the run of a scene, as ``pompeiu couple --report`` does. It appears whole or not at all.

        Parameters
        ----------
        path : str or path-like
            The file.

        Raises
        ------
        OptionError
            If the solvers are not those of a scene, so that nothing is known of their interface; if schemes were compared; or if this
            answer was pickled.
        OSError
            If the file cannot be written.
        """
        if self._page is None:
            raise OptionError("a page is of one run of a scene, before it is pickled: give the file of a scene, without compare")
        _native.write_whole(path, self._page.html().encode())

    def __repr__(self) -> str:
        run = self.runs[0]
        return f"Coupled({len(run['windows'])} of {self.report['windows']} windows, {run['solves']} solves, {run['scheme']})"


def couple(
    fluid: Union[str, "os.PathLike[str]", Callable[[np.ndarray], ArrayLike], Any],
    solid: Optional[Any] = None,
    x0: Optional[ArrayLike] = None,
    *,
    scheme: Optional[str] = None,
    windows: Optional[int] = None,
    tolerance: Optional[float] = None,
    most_solves: Optional[int] = None,
    reuse: Optional[int] = None,
    filter: Optional[float] = None,
    extrapolate: Optional[int] = None,
    closed: Optional[Literal["project", "refuse"]] = None,
    compare: bool = False,
    threads: Optional[int] = None,
    time_limit: Optional[float] = None,
    progress: Optional[Callable[[float], Optional[bool]]] = None,
) -> Coupled:
    """Makes two solvers agree at the interface between them, window by window in time.

    The first solver gives y for x, the second one x for y: pressures for displacements, and displacements for pressures, for instance. A
    solver is a function of an array, or an object with a method ``solve(array)``. An object with a state also has ``accept()``, which makes the
    last solution the state from which the next window starts, and ``reject()``; every solve starts from the last accepted state. One that
    finds no solution for an input raises an ``ArithmeticError``: then a smaller change is tried. Other exceptions end the run.

    Parameters
    ----------
    fluid : callable, object, or path
        The first solver; or the file of a scene that ``pompeiu couple`` takes, instead of solvers.
    solid : callable or object
        The second solver.
    x0 : array of shape (n,)
        What the first solver starts from. One window is solved unless ``windows`` says more.
    scheme : str, optional
        The coupling scheme: fixed, constant:W, aitken, aitken:W, iqn-ils, iqn-imvj, two-models.
    windows : int, optional
        Number of windows in time.
    tolerance : float, optional
        The relative change of both data below which a window is done.
    most_solves : int, optional
        Largest number of solves of an attempt at a window.
    reuse : int, optional
        Number of earlier windows whose solves are used again.
    filter : float, optional
        Leave columns out whose new part is shorter than this part of them.
    extrapolate : int, optional
        Order of the extrapolation of first guesses: 0, 1, 2.
    closed : str, optional
        The treatment of an enclosed fluid. ``"project"``: the pressure constant is chosen so that the displacement of
        the solid equals the inflow; ``"refuse"``: the run ends with an error that states the imbalance.
    compare : bool
        Run the scene with all schemes, for a table.
    threads : int, optional
        Threads to use; all processors by default. The answer does not depend on it.
    time_limit : float, optional
        Stop after so many seconds with the answer found by then.
    progress : callable, optional
        Called with the share of windows that are done; ``False`` ends it.

    Raises
    ------
    OptionError
        If options make no sense, or solvers give arrays of other lengths.
    ReadError
        If the scene cannot be read.

    Examples
    --------
    >>> import numpy as np
    >>> import pompeiu
    >>> pressure = lambda x: -8.0 * (x - 1.0)
    >>> found = pompeiu.couple(pressure, lambda y: 0.5 * y, np.zeros(1))
    >>> round(float(found.x[0, 0]), 6)
    0.8
    """
    given = dict(locals())
    for name in ("fluid", "solid", "x0"):
        del given[name]
    if isinstance(fluid, (str, os.PathLike)):
        if solid is not None or x0 is not None:
            raise OptionError("a scene has its own solvers; leave out solid and x0")
        answer, beside = ask("couple", given, meshes=(), others=[(os.fspath(fluid),)])
        x, y, page = beside["x"], beside["y"], beside.get("page")
    elif solid is None or x0 is None:
        raise OptionError("a second solver and first data are needed: couple(fluid, solid, x0)")
    else:
        options, limits, progress = split(given)
        text, x, y = _native.couple(fluid, solid, x0, options, limits, progress)
        page = None
        answer = json.loads(text)
    report = answer["report"]
    rows = sum(len(run["windows"]) for run in report["runs"])
    shaped = lambda values: values.reshape(rows, -1 if rows else 0)  # noqa: E731
    return Coupled(shaped(x), shaped(y), report, answer["stop"], page)
