"""Showing how far a search has come."""

from __future__ import annotations

from typing import Any, Callable, ContextManager, Optional, Union
from contextlib import contextmanager

from .results import Progress

__all__ = ["ProgressLike"]

#: ``True`` for a bar (with tqdm, if it is there), or a function that is called with a :class:`pompeiu.Progress` some twenty
#: times a second; if it returns ``False``, the search ends with what is proven.
ProgressLike = Union[bool, Callable[[Progress], Optional[bool]], None]

_NAMES = {"a_to_b": "A to B", "b_to_a": "B to A"}


def _called(callback: Callable[[Progress], Optional[bool]]) -> Callable[..., Optional[bool]]:
    return lambda *told: callback(Progress(*told))


@contextmanager
def watching(progress: ProgressLike) -> "ContextManager[Callable[..., Optional[bool]] | None]":
    """The function to hand to a search, and closing the bar after it."""
    if progress is None or progress is False:
        yield None
    elif progress is not True:
        yield _called(progress)
    else:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            yield None
            return
        with tqdm(unit="pieces", leave=False) as bar:

            def show(told: Progress) -> None:
                bar.total = told.examined + told.left
                bar.n = told.examined
                bar.set_description(f"{_NAMES[told.direction]}: {told.lower:.6g} to {told.upper:.6g}", refresh=False)
                bar.refresh()

            yield _called(show)
