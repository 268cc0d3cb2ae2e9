"""Meshes from whatever holds one: a path, arrays, or an object of another library.

Objects are recognised by their attributes, so none of the libraries need be there. Arrays are handed on as they are, without
a copy in Python.
"""

from __future__ import annotations

import os
import warnings
from typing import Any, Protocol, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._native import Mesh
from .errors import MeshError, MeshWarning

__all__ = ["MeshLike", "as_mesh", "read_mesh"]

class _WithFaces(Protocol):
    """A mesh of trimesh."""

    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class _WithTriangles(Protocol):
    """A mesh of Open3D."""

    @property
    def vertices(self) -> Any: ...
    @property
    def triangles(self) -> Any: ...


class _WithTensors(Protocol):
    """A mesh of tensors of Open3D."""

    @property
    def vertex(self) -> Any: ...
    @property
    def triangle(self) -> Any: ...


class _WithCells(Protocol):
    """A mesh of meshio."""

    @property
    def points(self) -> Any: ...
    @property
    def cells(self) -> Any: ...


class _WithPoints(Protocol):
    """A surface of PyVista."""

    @property
    def points(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class _WithSurface(Protocol):
    """A grid of PyVista."""

    @property
    def points(self) -> Any: ...
    def extract_surface(self) -> Any: ...


class _Scene(Protocol):
    """A scene of trimesh."""

    @property
    def geometry(self) -> Any: ...
    @property
    def graph(self) -> Any: ...


#: A path, a pair of arrays, a :class:`pompeiu.Mesh`, or an object of trimesh, meshio, Open3D or PyVista.
MeshLike = Union[
    str,
    "os.PathLike[str]",
    Mesh,
    Tuple[ArrayLike, ArrayLike],
    _WithFaces,
    _WithTriangles,
    _WithTensors,
    _WithCells,
    _WithPoints,
    _WithSurface,
    _Scene,
]

#: Cells of meshio without area, which are no part of a surface.
_THIN_CELLS = ("vertex", "line")


def as_mesh(source: MeshLike) -> Mesh:
    """A mesh of whatever holds one.

    Parameters
    ----------
    source : path, (vertices, faces), Mesh, or an object of another library
        A path is read, see :func:`read_mesh`. A pair is ``vertices`` of shape (n, 3) and ``faces`` of shape (m, 3). Of
        other libraries' objects these are taken: ``vertices`` and ``faces`` (trimesh), ``points`` and ``cells``
        (meshio), ``vertices`` and ``triangles`` or ``vertex.positions`` and ``triangle.indices`` (Open3D), ``points``
        and ``faces`` with counts (PyVista). A scene of trimesh is taken with all its meshes where they are placed; of a grid of
        PyVista its surface; faces of PyVista with more than three corners are cut by its own ``triangulate``.

    Returns
    -------
    Mesh
        ``source`` itself if it is a :class:`Mesh`.

    Raises
    ------
    MeshError
        If the arrays are no mesh, or hold faces that are no triangles.
    ReadError
        If the file cannot be read.
    TypeError
        If the object is of no kind known.
    """
    if isinstance(source, Mesh):
        return source
    if isinstance(source, (str, os.PathLike)):
        return read_mesh(source)
    if isinstance(source, (tuple, list)) and len(source) == 2:
        return Mesh(source[0], source[1])
    for recognise in (_trimesh_scene, _trimesh, _open3d, _open3d_tensor, _pyvista, _meshio):
        mesh = recognise(source)
        if mesh is not None:
            return mesh
    if isinstance(source, np.ndarray):
        raise TypeError(
            f"found an array of shape {source.shape}, expected a mesh; a cloud of points has no area: pompeiu.distance measures how far its points "
            "are from a mesh"
        )
    raise TypeError(
        f"found an object of type {type(source).__name__}, expected a path, a pair (vertices, faces), a pompeiu.Mesh, "
        "or a mesh of trimesh, meshio, Open3D or PyVista"
    )


def points_or_mesh(source: "MeshLike | NDArray[Any]") -> "tuple[Mesh, bool]":
    """A mesh, or a cloud of points of shape (n, 3) or from a file without faces, each point as a face without extent; and whether these are points."""
    if isinstance(source, (str, os.PathLike)):
        mesh, is_cloud = _native.read_mesh_or_points(os.fspath(source))
        return (mesh, True) if is_cloud else (as_mesh(source), False)
    if isinstance(source, np.ndarray):
        return Mesh(source, np.repeat(np.arange(len(source))[:, np.newaxis], 3, axis=1)), True
    return as_mesh(source), False


def read_mesh(path: "str | os.PathLike[str]") -> Mesh:
    """Reads a triangle mesh from a file: OBJ, PLY, STL, OFF, glTF, GLB, VTK, VTP, VTU or 3MF, each also with ``.gz``.

    The format is the one that the content shows. Faces with more than three corners are cut into triangles.

    Parameters
    ----------
    path : str or path-like
        The file.

    Returns
    -------
    Mesh
        Coordinates in double precision or in text arrive as the nearest doubles.

    Raises
    ------
    ReadError
        If the file cannot be opened or holds no mesh; the message names the file and the line, byte, face or vertex.
        :class:`MissingFileError`, which is a ``FileNotFoundError`` too, if there is none.

    Warns
    -----
    MeshWarning
        If faces with fewer than three corners were left out.
    """
    mesh, _format, _triangulated, dropped = _native.read_mesh(os.fspath(path))
    if dropped:
        warnings.warn(
            f"{os.fspath(path)}: {dropped} faces with fewer than three corners were left out", MeshWarning, stacklevel=2
        )
    return mesh


def _triangles(faces: Any, what: str) -> np.ndarray:
    faces = np.asarray(faces)
    if faces.ndim == 2 and faces.shape[1] == 3:
        return faces
    raise MeshError(f"{what} have shape {faces.shape}, expected triangles, (m, 3); triangulate the mesh first")


def _trimesh_scene(source: Any) -> "Mesh | None":
    if not isinstance(getattr(source, "geometry", None), dict) or not hasattr(source, "graph"):
        return None
    if not any(hasattr(one, "faces") for one in source.geometry.values()):
        raise MeshError("the scene has no mesh")
    # Newer releases have a method for it.
    merged = source.to_mesh() if hasattr(source, "to_mesh") else source.dump(concatenate=True)
    return _trimesh(merged)


def _trimesh(source: Any) -> "Mesh | None":
    vertices, faces = getattr(source, "vertices", None), getattr(source, "faces", None)
    if vertices is None or faces is None:
        return None
    return Mesh(vertices, _triangles(faces, "faces"))


def _open3d(source: Any) -> "Mesh | None":
    vertices, triangles = getattr(source, "vertices", None), getattr(source, "triangles", None)
    if vertices is None or triangles is None:
        return None
    return Mesh(np.asarray(vertices), _triangles(triangles, "triangles"))


def _open3d_tensor(source: Any) -> "Mesh | None":
    positions = getattr(getattr(source, "vertex", None), "positions", None)
    indices = getattr(getattr(source, "triangle", None), "indices", None)
    if positions is None or indices is None:
        return None
    # Tensors may lie on another device, and say so only when asked.
    arrays = [t.cpu().numpy() if hasattr(t, "cpu") else t.numpy() for t in (positions, indices)]
    return Mesh(arrays[0], _triangles(arrays[1], "indices of triangles"))


def _pyvista(source: Any, triangulated: bool = False) -> "Mesh | None":
    points, faces = getattr(source, "points", None), getattr(source, "faces", None)
    if points is not None and faces is None and hasattr(source, "extract_surface"):
        return _pyvista(source.extract_surface())
    if points is None or faces is None:
        return None
    strips = getattr(source, "strips", None)
    if strips is not None and len(strips):
        if triangulated or not hasattr(source, "triangulate"):
            raise MeshError("the mesh has strips of triangles; call its triangulate() first")
        return _pyvista(source.triangulate(), triangulated=True)
    faces = np.asarray(faces)
    if faces.ndim == 2:
        return Mesh(points, _triangles(faces, "faces"))
    # Each face is its number of corners, then their indices.
    if faces.size % 4 or (counts := faces.reshape(-1, 4)[:, 0]).size and np.any(counts != 3):
        if not triangulated and hasattr(source, "triangulate"):
            return _pyvista(source.triangulate(), triangulated=True)
        raise MeshError("the mesh has faces that are no triangles; call its triangulate() first")
    return Mesh(points, faces.reshape(-1, 4)[:, 1:])


def _meshio(source: Any) -> "Mesh | None":
    points, cells = getattr(source, "points", None), getattr(source, "cells", None)
    if points is None or not isinstance(cells, (list, tuple)):
        return None
    triangles, other = [], set()
    for block in cells:
        kind = str(block.type)
        if kind == "triangle":
            triangles.append(np.asarray(block.data))
        elif kind.rstrip("0123456789") not in _THIN_CELLS:
            other.add(kind)
    if other:
        kinds = ", ".join(sorted(other))
        raise MeshError(f"the mesh has cells of type {kinds}, expected triangles; extract and triangulate its surface first")
    if not triangles:
        raise MeshError(f"the mesh has no triangles ({len(points)} vertices)")
    return Mesh(points, triangles[0] if len(triangles) == 1 else np.concatenate(triangles))
