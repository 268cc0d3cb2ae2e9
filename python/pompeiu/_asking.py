"""Asking the library: one call for all functions whose options are those of a request in Rust."""

from __future__ import annotations

import json
import os
import warnings
from typing import Any, Dict, Mapping, Sequence, Tuple

import numpy as np

from . import _native
from .errors import MeshWarning, OptionError
from .sources import Mesh, as_mesh

__all__ = ["ask", "split"]

#: Options of a function that are no part of the request.
_LIMITS = ("threads", "time_limit", "memory_limit")


def ask(
    name: str, given: Dict[str, Any], meshes: Sequence[str] = ("mesh",), others: Sequence[Any] = ()
) -> Tuple[Dict[str, Any], Dict[str, Any]]:
    """The answer to a request, and arrays and meshes beside it.

    ``given`` are the arguments of the function: the meshes of these names, limits, ``progress``, and the options of the request;
    ``others`` are inputs that are no meshes.
    """
    options = dict(given)
    sources = [as_mesh(options.pop(mesh)) for mesh in meshes]
    if len(sources) == 2:
        _warn_of_units(*sources)
    sources += others
    answer, beside = _native.ask(name, sources, *split(options))
    return json.loads(answer), beside


def _warn_of_units(a: Mesh, b: Mesh) -> None:
    found = a._unit_factor(b)
    if found is not None:
        factor, first_is_larger = found
        large, small = ("A", "B") if first_is_larger else ("B", "A")
        warnings.warn(
            f"{large} is about {factor:g} times the size of {small}; are they in the same unit?", MeshWarning, stacklevel=4
        )


def split(given: Dict[str, Any]) -> Tuple[str, Tuple[Any, ...], Any]:
    """The options of a request as JSON, limits, and ``progress``."""
    options = dict(given)
    limits = tuple(options.pop(limit, None) for limit in _LIMITS)
    progress = options.pop("progress", None)
    return _written(options), limits, progress


def _written(options: Dict[str, Any]) -> str:
    for name, value in options.items():
        if isinstance(value, (float, np.floating)) and not np.isfinite(value):
            raise OptionError(f"{name} is {value}; it must be a finite number")
    try:
        return json.dumps({name: _keyed(value) for name, value in options.items()}, default=_plain, allow_nan=False)
    except ValueError:
        raise OptionError("a sequence among the options holds a number that is not finite") from None


def _keyed(value: Any) -> Any:
    """A mapping as a dictionary whose keys are text."""
    return {str(key): item for key, item in value.items()} if isinstance(value, Mapping) else value


def _plain(value: Any) -> Any:
    """What JSON has no word for: numbers and arrays of NumPy, paths, other sequences."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return list(value)
