"""Repairing meshes: what algorithms on surfaces stumble over is removed, and told."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Dict, NamedTuple, Optional

import numpy as np
from numpy.typing import NDArray

from . import _native
from .errors import OptionError, SurfaceError
from .results import SymmetricReport
from .sources import Mesh, MeshLike, as_mesh

__all__ = ["Change", "Repaired", "repair"]


class Change(NamedTuple):
    """How often something was done or found, and where at first."""

    #: How often.
    count: int
    #: A point of each of the first ten, in the coordinates of the mesh; shape (k, 3).
    places: NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class Repaired:
    """A repaired mesh, and what was done.

    Attributes
    ----------
    mesh : Mesh
        The result: a manifold with boundary, oriented where that is possible. Faces that were kept keep their order.
    changes : dict of str to Change
        What was done or found at least once, in the order of the operations: ``"unreferenced_vertices"``,
        ``"welded_vertices"``, ``"degenerate_faces"``, ``"duplicate_faces"``, ``"split_edges"``, ``"split_vertices"``,
        ``"turned_faces"``, ``"non_orientable_components"``, ``"filled_holes"``, ``"holes_left"``.
    faces_added : int
        Number of faces that fill holes: the last of the mesh.
    distance : SymmetricReport or None
        Both directed distances, enclosed, where a distance was to be proven: A is the input, B the result.
    """

    mesh: Mesh
    changes: Dict[str, Change]
    faces_added: int
    distance: Optional[SymmetricReport]

    def __repr__(self) -> str:
        done = ", ".join(f"{name} {change.count}" for name, change in self.changes.items())
        return f"Repaired({self.mesh.n_faces} faces; {done or 'nothing to do'})"


def repair(
    mesh: MeshLike,
    *,
    weld: Optional[float] = 0.0,
    fill_holes: int = 0,
    within: Optional[float] = None,
) -> Repaired:
    """Makes a mesh an oriented manifold with boundary, and says what was done.

    In this order: vertices in no face are dropped, vertices at one position become one, faces of area zero and duplicates
    are dropped, each fan of faces around a vertex gets a vertex of its own so that no edge has more than two faces, faces
    are turned to agree, and holes are filled when asked.

    Parameters
    ----------
    mesh : MeshLike
        Any mesh. ``as_mesh`` of what other packages hold welds nothing.
    weld : float or None
        Vertices within this length of each other become one; 0 for equal positions only, ``None`` for no welding.
    fill_holes : int
        Boundary loops with at most so many edges are filled, at most 256.
    within : float, optional
        Largest Pompeiu–Hausdorff distance from the input, to be proven; at least what double precision tells apart, some
        1e-13 of the size of the mesh.

    Raises
    ------
    SurfaceError
        If the result is not proven to be within that distance, or no face is left.
    OptionError
        If an option makes no sense.

    Examples
    --------
    >>> import numpy as np, pompeiu
    >>> sphere = pompeiu.shapes.icosphere(1.0, 1)
    >>> soup = sphere.vertices[sphere.faces].reshape(-1, 3)
    >>> whole = pompeiu.repair((soup, np.arange(240).reshape(80, 3)), within=1e-9)
    >>> whole.mesh.n_vertices, whole.changes["welded_vertices"].count
    (42, 198)
    """
    if fill_holes < 0:
        raise OptionError(f"holes of {fill_holes} edges cannot be filled; the number is at least 0")
    if within is not None and not 0.0 <= within < float("inf"):
        raise OptionError(f"the distance is {within}; it must be a finite number that is not negative")
    options = {
        "weld": None if weld is None else float(weld),
        "fill_holes": fill_holes,
        "measure": within is not None,
    }
    made, text, measured = _native.repair(as_mesh(mesh), options)
    distance = None if measured is None else SymmetricReport._of(json.loads(measured))
    if within is not None and distance is not None and distance.upper > within:
        raise SurfaceError(
            f"the result is not proven to be within {within:g} of the input: its distance lies between "
            f"{distance.lower:.6g} and {distance.upper:.6g}; allow more, or repair less"
        )
    report = json.loads(text)
    added = report.pop("faces_added")
    changes = {
        name: Change(change["count"], np.asarray(change["places"], dtype=np.float64).reshape(-1, 3))
        for name, change in report.items()
        if change["count"] > 0
    }
    return Repaired(made, changes, added, distance)
