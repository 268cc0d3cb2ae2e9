"""Asking the library: one call for all functions whose options are those of a request in Rust."""

from __future__ import annotations

import json
import os
from typing import Any, Dict, Sequence, Tuple

import numpy as np

from . import _native
from .errors import OptionError
from .sources import as_mesh

__all__ = ["ask"]

#: Options of a function that are no part of the request.
_LIMITS = ("threads", "time_limit", "memory_limit")


def ask(name: str, given: Dict[str, Any], meshes: Sequence[str] = ("mesh",)) -> Tuple[Dict[str, Any], Dict[str, Any]]:
    """The answer to a request, and arrays and meshes beside it.

    ``given`` are the arguments of the function: the meshes of these names, limits, ``progress``, and the options of the request.
    """
    options = dict(given)
    sources = [as_mesh(options.pop(mesh)) for mesh in meshes]
    limits = tuple(options.pop(limit, None) for limit in _LIMITS)
    progress = options.pop("progress", None)
    answer, beside = _native.ask(name, sources, _written(options), limits, progress)
    return json.loads(answer), beside


def _written(options: Dict[str, Any]) -> str:
    for name, value in options.items():
        if isinstance(value, (float, np.floating)) and not np.isfinite(value):
            raise OptionError(f"{name} is {value}; it must be a finite number")
    try:
        return json.dumps(options, default=_plain, allow_nan=False)
    except ValueError:
        raise OptionError("a sequence among the options holds a number that is not finite") from None


def _plain(value: Any) -> Any:
    """What JSON has no word for: numbers and arrays of NumPy, paths, other sequences."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return list(value)
