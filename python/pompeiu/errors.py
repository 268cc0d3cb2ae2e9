"""What can go wrong. Each message is one sentence that says what was found, what was expected, and where."""

from __future__ import annotations

__all__ = [
    "FieldError",
    "MeshError",
    "MeshWarning",
    "MissingFileError",
    "OptionError",
    "OutlineError",
    "PompeiuError",
    "ReadError",
    "SurfaceError",
    "UndecidedError",
    "WriteError",
]


class PompeiuError(Exception):
    """Any error of this package."""


class MeshError(PompeiuError, ValueError):
    """The arrays are no mesh: their shape, a coordinate that is not finite, an index out of range, no faces."""


class SurfaceError(PompeiuError, ValueError):
    """The mesh is no oriented manifold, or a face is degenerate, where a surface is needed."""


class FieldError(PompeiuError, ValueError):
    """A field does not fit its surface, or a linear system could not be solved."""


class OptionError(PompeiuError, ValueError):
    """An option has a value that means nothing."""


class UndecidedError(PompeiuError, ArithmeticError):
    """The bounds of a value do not decide a comparison."""


class OutlineError(PompeiuError, ValueError):
    """Points make no closed polygon: fewer than three, no area, a coordinate that is not finite."""


class ReadError(PompeiuError, OSError):
    """A file could not be read, or does not hold a mesh; the message begins with its name."""


class MissingFileError(ReadError, FileNotFoundError):
    """There is no such file."""


class WriteError(PompeiuError, OSError):
    """A file could not be written, or its format cannot hold what it is given."""


class MeshWarning(UserWarning):
    """A file or object holds more than the mesh that was made of it."""
