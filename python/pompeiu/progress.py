"""Showing how far a search has come."""

from __future__ import annotations

from contextlib import contextmanager
from typing import Any, Callable, Iterator, Optional, Union

from .results import Progress

__all__ = ["ProgressLike", "StepsLike"]

#: ``True`` for a bar (with tqdm, if it is there), or a function that is called with a :class:`pompeiu.Progress` at most twenty
#: times a second; if it returns ``False``, the search ends with what is proven.
ProgressLike = Union[bool, Callable[[Progress], Optional[bool]], None]

#: The same for many tasks: the function is called with tasks done and all tasks, and targets settled and all targets.
StepsLike = Union[bool, Callable[[int, int, int, int], Optional[bool]], None]

_NAMES = {"a_to_b": "A to B", "b_to_a": "B to A"}


@contextmanager
def _bar(unit: str) -> Iterator[Any]:
    """A bar, if tqdm is there."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield None
        return
    with tqdm(unit=unit, leave=False) as bar:
        yield bar


def _shown(bar: Any, done: int, all: int, description: str) -> None:
    bar.total, bar.n = all, done
    bar.set_description(description, refresh=False)
    bar.refresh()


@contextmanager
def watching(progress: ProgressLike) -> "Iterator[Callable[..., Optional[bool]] | None]":
    """The function to hand to a search, and closing the bar after it."""
    if progress is None or progress is False:
        yield None
    elif progress is not True:
        yield lambda *told: progress(Progress(*told))
    else:
        with _bar("pieces") as bar:

            def show(direction: str, lower: float, upper: float, examined: int, left: int) -> None:
                text = f"{_NAMES[direction]}: {lower:.6g} to {upper:.6g}"
                _shown(bar, examined, examined + left, text)

            yield show if bar is not None else None


@contextmanager
def watching_steps(progress: StepsLike, what: str) -> "Iterator[Callable[..., Optional[bool]] | None]":
    """The same for many tasks."""
    if progress is None or progress is False:
        yield None
    elif progress is not True:
        yield progress
    else:
        with _bar("tasks") as bar:

            def show(done: int, all: int, settled: int, of: int) -> None:
                _shown(bar, done, all, f"{settled} of {of} {what}")

            yield show if bar is not None else None
