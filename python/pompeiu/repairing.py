"""Repairing meshes: what algorithms on surfaces stumble over is removed, and told."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Dict, Literal, NamedTuple, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from ._asking import ask
from .certificates import _Within
from .deviations import Enclosure
from .errors import SurfaceError
from .results import _read_only
from .sources import Mesh, MeshLike, as_mesh

__all__ = ["Change", "Repaired", "repair"]


class Change(NamedTuple):
    """How often something was done or found, and where at first."""

    #: How often.
    count: int
    #: A point of each of the first ten, in the coordinates of the mesh; shape (k, 3).
    places: NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class Repaired(_Within):
    """A repaired mesh, and what was done.

    Attributes
    ----------
    mesh : Mesh
        The result: an oriented manifold with boundary. Faces that were kept keep their order.
    changes : dict of str to Change
        What was done or found at least once, in the order of the operations: ``"unreferenced_vertices"``,
        ``"welded_vertices"``, ``"degenerate_faces"``, ``"duplicate_faces"``, ``"split_edges"``, ``"split_vertices"``,
        ``"turned_faces"``, ``"non_orientable_components"``, ``"opened_edges"``, ``"filled_holes"``, ``"holes_left"``.
    faces_added : int
        Number of faces that fill holes: the last of the mesh.
    distance : Enclosure or None
        The Pompeiu–Hausdorff distance of input and result, where one was to be proven.
    """

    mesh: Mesh
    changes: Dict[str, Change]
    faces_added: int
    distance: Optional[Enclosure]
    _proven: "Tuple[Optional[Mesh], Optional[float]]" = field(default=(None, None), repr=False)

    def __repr__(self) -> str:
        done = ", ".join(f"{name} {change.count}" for name, change in self.changes.items())
        return f"Repaired({self.mesh.n_faces} faces; {done or 'nothing to do'})"


def repair(
    mesh: MeshLike,
    *,
    weld: Optional[Union[float, str]] = None,
    no_weld: bool = False,
    fill_holes: int = 0,
    within: Optional[Union[float, str]] = None,
    unit: str = "",
    precision: Literal["double", "single"] = "double",
    center: bool = False,
) -> Repaired:
    """Makes a mesh an oriented manifold with boundary, and says what was done.

    In this order: vertices in no face are dropped, vertices at one position become one, faces of area zero and duplicates
    are dropped, each fan of faces around a vertex gets a vertex of its own so that no edge has more than two faces, faces
    are turned to agree, and holes are filled when asked.

    Parameters
    ----------
    mesh : MeshLike
        Any mesh. ``as_mesh`` of what other packages hold welds nothing.
    weld : Union[float, str], optional
        Make one vertex of those within this length of each other, not only of those at one position.
    no_weld : bool
        Leave vertices at one position apart.
    fill_holes : int
        Fill boundary loops with at most this many edges.
    within : Union[float, str], optional
        Largest distance from the input, to be proven, such as 0.1, 0.1mm with the unit given, or 0.5% of the diagonal.
    unit : str
        The unit of the coordinates, such as mm; files have none.
    precision : str
        Numbers in which the coordinates of the result are kept; single where the file that is written holds no others,
        as STL and GLB do. ``"double"``: 53 bits: every mesh in memory; ``"single"``: 24 bits: files such as STL and
        GLB.
    center : bool
        Count the coordinates of the result from a point near the centre of the mesh, which is reported: far from zero
        this keeps digits for which single precision has no room.

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
    source = as_mesh(mesh)
    given = {**locals(), "mesh": source}
    del given["source"]
    answer, beside = ask("repair", given)
    report = answer["report"]
    distance = None if report["distance"] is None else Enclosure(**report["distance"])
    if not report["written"] and distance is not None:
        raise SurfaceError(
            f"the result is not proven to be within {report['within']:g} of the input: its distance lies between "
            f"{distance.lower:.6g} and {distance.upper:.6g}; allow more, or repair less"
        )
    changes = {
        name: Change(change["count"], _read_only(np.array(change["places"], dtype=np.float64).reshape(-1, 3)))
        for name, change in report.items()
        if isinstance(change, dict) and change.get("count", 0) > 0
    }
    proven = (None if center else source, report["within"])
    return Repaired(beside["mesh"], changes, report["faces_added"], distance, proven)
