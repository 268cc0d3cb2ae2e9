"""Writing meshes and other files, and saying what meshes are."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from typing import Any, Dict, Mapping, Optional

from . import _native
from ._asking import ask
from .results import MeshSummary
from .sources import MeshLike, as_mesh

__all__ = ["Info", "info", "mesh_summary", "read_options", "write_mesh"]


def read_options(path: "str | os.PathLike[str]") -> Dict[str, Any]:
    """The options in a TOML file, as ``--config`` and scenes have them: ``pompeiu.medial(mesh, **pompeiu.read_options("medial.toml"))``.

    Raises
    ------
    ReadError, OptionError
        If the file cannot be read, or is no TOML.
    """
    return json.loads(_native.read_options(path))


def write_mesh(
    path: "str | os.PathLike[str]",
    mesh: MeshLike,
    *,
    vertex_scalars: Optional[Mapping[str, Any]] = None,
    face_scalars: Optional[Mapping[str, Any]] = None,
    face_vectors: Optional[Mapping[str, Any]] = None,
    vertex_colors: Optional[Any] = None,
    face_colors: Optional[Any] = None,
) -> None:
    """Writes a mesh in the format that the suffix names: OBJ, PLY, STL, OFF, VTP, VTU, 3MF or GLB; ``.gz`` after it compresses.

    Every bit of every coordinate is kept, except in STL and GLB, which hold single precision. The file appears whole or not
    at all.

    Parameters
    ----------
    path : str or path-like
        The file.
    mesh : MeshLike
        See :func:`pompeiu.as_mesh`.
    vertex_scalars, face_scalars : mapping of str to array_like of float, shape (n,) or (m,), optional
        Numbers by name; PLY, VTP and VTU hold them.
    face_vectors : mapping of str to array_like of float, shape (m, 3), optional
        Vectors by name; PLY, VTP and VTU hold them.
    vertex_colors, face_colors : array of uint8, shape (n, 3) or (m, 3), optional
        Red, green and blue.

    Raises
    ------
    WriteError
        If the file cannot be written, the suffix names no format, or the format has no place for an attribute.
    MeshError
        If an array has the wrong shape.
    """
    _native.write_mesh(
        os.fspath(path),
        as_mesh(mesh),
        list((vertex_scalars or {}).items()),
        list((face_scalars or {}).items()),
        list((face_vectors or {}).items()),
        vertex_colors,
        face_colors,
    )


@dataclass(frozen=True, repr=False)
class Info:
    """What is said of a mesh.

    Attributes
    ----------
    summary : MeshSummary
        Counts, measures and connectivity.
    self_intersections : dict or None
        ``count``, ``touching``, ``complete`` and the ``first`` thousand pairs of faces that intersect; ``None`` unless asked for.
    """

    summary: MeshSummary
    self_intersections: Optional[Dict[str, Any]]

    def __repr__(self) -> str:
        return f"Info({self.summary!r})"


def info(
    mesh: MeshLike,
    *,
    intersections: bool = False,
) -> Info:
    """Describes a mesh: counts, size, area, volume, topology, oddities.

    Parameters
    ----------
    mesh : MeshLike
        Any mesh.
    intersections : bool
        Find pairs of faces that intersect, decided exactly.

    Examples
    --------
    >>> import pompeiu
    >>> ball = pompeiu.info(pompeiu.shapes.icosphere(1.0, 2), intersections=True)
    >>> ball.summary.genus, ball.self_intersections["count"]
    (0, 0)
    """
    report = ask("info", locals())[0]["report"]
    intersections = report.pop("self_intersections")
    del report["file"]
    return Info(MeshSummary._of(report), intersections)


def mesh_summary(mesh: MeshLike) -> MeshSummary:
    """Counts, area, volume, boundaries, components, genus and oddities of a mesh.

    Parameters
    ----------
    mesh : MeshLike
        See :func:`pompeiu.as_mesh`.
    """
    return MeshSummary._of(json.loads(as_mesh(mesh)._summary()))
