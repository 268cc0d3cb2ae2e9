"""Splitting tangent fields into gradient, rotated gradient and harmonic part."""

from __future__ import annotations

from typing import Any, Iterable, List, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from .results import Audit, FieldParts
from .sources import MeshLike, as_mesh

__all__ = ["HodgeDecomposition", "field_audit"]

Splitting = Literal["primal", "dual"]
Boundary = Literal["tangential", "normal"]


class HodgeDecomposition:
    """A surface made ready to split tangent fields: factored once, used for as many fields as there are.

    Fields are constant on each face. Each is the sum of a gradient, a rotated gradient and a harmonic part, orthogonal to each
    other; the harmonic part is a projection, so that what the three leave over measures all of them.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold without degenerate faces or unreferenced vertices (:meth:`Mesh.without_unreferenced`).
    splitting : {"primal", "dual"}
        Whether the gradient is that of a continuous function (``"primal"``), or the rotated gradient is.
    boundary : {"tangential", "normal"}
        How the harmonic part meets the boundary: along it, or straight through it.

    Raises
    ------
    SurfaceError
        If the mesh is no surface; the message names the face, edge or vertex.
    FieldError
        If a system cannot be factored, which very thin faces can cause.

    Examples
    --------
    >>> import numpy as np, pompeiu
    >>> torus = pompeiu.shapes.torus()
    >>> hodge = pompeiu.HodgeDecomposition(torus)
    >>> hodge.harmonic_dimension
    2
    >>> field = np.tile([0.0, 0.0, 1.0], (torus.n_faces, 1))
    >>> hodge.decompose(field).quality.residual < 1e-12
    True
    """

    __slots__ = ("_native", "_shape")

    def __init__(self, mesh: MeshLike, splitting: Splitting = "primal", boundary: Boundary = "tangential") -> None:
        mesh = as_mesh(mesh)
        self._native = _native.HodgeDecomposition(mesh, splitting, boundary)
        self._shape = (mesh.n_faces, splitting, boundary)

    def decompose(self, field: ArrayLike) -> FieldParts:
        """Splits a field.

        Parameters
        ----------
        field : array_like of float, shape (m, 3)
            A vector in space for each face; what is normal to the face is left out.

        Raises
        ------
        FieldError
            If there is not one finite vector for each face.
        """
        return FieldParts._of(self._native.decompose(field))

    def decompose_many(self, fields: Iterable[ArrayLike]) -> List[FieldParts]:
        """Splits many fields in parallel, each as :meth:`decompose` would; an array of shape (k, m, 3) will do."""
        return [FieldParts._of(parts) for parts in self._native.decompose_many(fields)]

    @property
    def harmonic_dimension(self) -> int:
        """Dimension of the harmonic fields: 2 g for a closed component, 2 g + b − 1 with b boundary loops."""
        return self._native.harmonic_dimension

    @property
    def harmonic_fields(self) -> NDArray[np.float64]:
        """An orthonormal basis of the harmonic fields: shape (k, m, 3)."""
        fields = self._native.harmonic_fields()
        return np.stack(fields) if fields else np.empty((0, self._shape[0], 3))

    @property
    def edges(self) -> NDArray[np.uint32]:
        """Both vertices of every edge, in the order of potentials at edges: shape (e, 2)."""
        return self._native.edges()

    @property
    def face_areas(self) -> NDArray[np.float64]:
        """The areas of faces: the weights of the inner product of fields, shape (m,)."""
        return self._native.face_areas()

    @property
    def audit(self) -> Audit:
        """The degrees of freedom, counted; see :func:`field_audit`."""
        return Audit._of(self._native.audit())

    def __repr__(self) -> str:
        faces, splitting, boundary = self._shape
        return f"HodgeDecomposition({faces} faces, {splitting!r}, {boundary!r}, {self.harmonic_dimension} harmonic fields)"


def field_audit(mesh: MeshLike, boundary: Boundary = "tangential") -> Audit:
    """Counts the degrees of freedom of tangent fields, without solving anything.

    With continuous functions for both potentials too little is covered, with functions that agree at midpoints too much; the
    mixture fills all but the harmonic fields.

    Raises
    ------
    SurfaceError
        If the mesh is no oriented manifold.
    """
    return Audit._of(_native.audit(as_mesh(mesh), boundary))
