"""Splitting tangent fields into gradient, rotated gradient and harmonic part."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, fields
from typing import Any, Dict, Iterable, List, Literal, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from ._asking import ask
from .results import _Arrays, _read_only, _table
from .sources import MeshLike, as_mesh

__all__ = [
    "DegreesOfFreedom",
    "FieldParts",
    "FieldQuality",
    "HodgeDecomposition",
    "Ranks",
    "SplitField",
    "decompose",
    "field_degrees_of_freedom",
]

Splitting = Literal["primal", "dual"]
Boundary = Literal["tangential", "normal"]


@dataclass(frozen=True)
class Ranks:
    """Dimensions of the gradients and of the rotated gradients, and what both lack of all degrees of freedom."""

    gradient: int
    rotated: int
    residual_dimension: int


@dataclass(frozen=True)
class DegreesOfFreedom:
    """How the dimensions of the spaces of a splitting add up, and how they do not with a single function space.

    Counted from the numbers of elements. ``mixed`` is what :class:`pompeiu.HodgeDecomposition` uses; ``conforming`` takes
    continuous functions for both potentials, ``nonconforming`` functions that agree at midpoints of edges.
    """

    total: int
    harmonic: int
    mixed: Ranks
    conforming: Ranks
    nonconforming: Ranks
    adds_up: bool

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of plain values."""
        return asdict(self)

    @classmethod
    def _of(cls, data: Mapping[str, Any]) -> "DegreesOfFreedom":
        counted = data["degrees_of_freedom"]
        ranks = {name: Ranks(**counted[name]) for name in ("mixed", "conforming", "nonconforming")}
        harmonic = data["harmonic_dimension"]
        return cls(counted["total"], harmonic, **ranks, adds_up=ranks["mixed"].residual_dimension == harmonic)


@dataclass(frozen=True)
class FieldQuality:
    """What was measured of a splitting: how far it can be trusted.

    Attributes
    ----------
    residual : float
        Norm of the field less its three parts, over the norm of the field.
    part_error : float
        No part is farther from the true one than this, over the norm of the field.
    gradient_rotated, gradient_harmonic, rotated_harmonic : float
        Inner products of the parts over the squared norm of the field; zero in exact arithmetic.
    field_norm, gradient_norm, rotated_norm, harmonic_norm : float
        Norms: roots of integrals of squared lengths.
    """

    residual: float
    part_error: float
    gradient_rotated: float
    gradient_harmonic: float
    rotated_harmonic: float
    field_norm: float
    gradient_norm: float
    rotated_norm: float
    harmonic_norm: float

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of plain values."""
        return asdict(self)

    @classmethod
    def _of(cls, data: Mapping[str, Any]) -> "FieldQuality":
        norms = {f"{part}_norm": norm for part, norm in data["norms"].items()}
        return cls(data["residual"], data["part_error"], **data["inner_products"], **norms)

    def _repr_html_(self) -> str:
        return _table("splitting", [(f.name.replace("_", " "), f"{getattr(self, f.name):.6g}") for f in fields(self)])


@dataclass(frozen=True, eq=False, repr=False)
class FieldParts(_Arrays):
    """A tangent field as the sum of three orthogonal parts.

    Attributes
    ----------
    gradient, rotated, harmonic : ndarray, float64, shape (m, 3)
        The gradient, the rotated gradient and the harmonic part: one vector in space for each face.
    vertex_potential : ndarray, float64, shape (n,)
        Potential at vertices: of the gradient in the primal splitting, of the rotated gradient in the dual.
    edge_potential : ndarray, float64, shape (e,)
        Potential at midpoints of edges, in the order of :attr:`pompeiu.HodgeDecomposition.edges`: of the other of the two.
    harmonic_coefficients : ndarray, float64, shape (k,)
        Coefficients of the harmonic part in the orthonormal basis of harmonic fields.
    normal_part : float
        Length of the longest part of the given vectors along the normal, which was left out.
    quality : FieldQuality
        How far the parts can be trusted.
    """

    gradient: NDArray[np.float64]
    rotated: NDArray[np.float64]
    harmonic: NDArray[np.float64]
    vertex_potential: NDArray[np.float64]
    edge_potential: NDArray[np.float64]
    harmonic_coefficients: NDArray[np.float64]
    normal_part: float
    quality: FieldQuality

    def to_dict(self) -> "dict[str, Any]":
        """A dictionary of lists and numbers, ready for ``json.dumps``."""
        arrays = {f.name: getattr(self, f.name) for f in fields(self)}
        plain = {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in arrays.items()}
        return {**plain, "quality": self.quality.to_dict()}

    def _repr_html_(self) -> str:
        return self.quality._repr_html_()

    @classmethod
    def _of(cls, data: Mapping[str, Any]) -> "FieldParts":
        return cls(**{**data, "quality": FieldQuality._of(json.loads(data["quality"]))})


@dataclass(frozen=True, eq=False, repr=False)
class SplitField:
    """The degrees of freedom of a surface, and the parts of a field on it.

    Attributes
    ----------
    degrees_of_freedom : DegreesOfFreedom
        The degrees of freedom, counted.
    parts : FieldParts or None
        The parts, if there was a field.
    report : dict
        What ``pompeiu decompose --json`` reports.
    """

    degrees_of_freedom: DegreesOfFreedom
    parts: Optional[FieldParts]
    report: Dict[str, Any]

    def __repr__(self) -> str:
        split = "no field" if self.parts is None else f"residual {self.parts.quality.residual:.1e}"
        return f"SplitField({self.degrees_of_freedom.total} degrees of freedom, {split})"


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
        return _read_only(np.stack(fields) if fields else np.empty((0, self._shape[0], 3)))

    @property
    def edges(self) -> NDArray[np.uint32]:
        """Both vertices of every edge, in the order of potentials at edges: shape (e, 2)."""
        return self._native.edges()

    @property
    def face_areas(self) -> NDArray[np.float64]:
        """The areas of faces: the weights of the inner product of fields, shape (m,)."""
        return self._native.face_areas()

    @property
    def degrees_of_freedom(self) -> DegreesOfFreedom:
        """The degrees of freedom, counted; see :func:`field_degrees_of_freedom`."""
        return DegreesOfFreedom._of(json.loads(self._native.degrees_of_freedom()))

    def __repr__(self) -> str:
        faces, splitting, boundary = self._shape
        return f"HodgeDecomposition({faces} faces, {splitting!r}, {boundary!r}, {self.harmonic_dimension} harmonic fields)"


def field_degrees_of_freedom(mesh: MeshLike, boundary: Boundary = "tangential") -> DegreesOfFreedom:
    """Counts the degrees of freedom of tangent fields, without solving anything.

    With continuous functions for both potentials too little is covered, with functions that agree at midpoints too much; the
    mixture fills all but the harmonic fields.

    Raises
    ------
    SurfaceError
        If the mesh is no oriented manifold.
    """
    return DegreesOfFreedom._of(json.loads(_native.degrees_of_freedom(as_mesh(mesh), boundary)))


def decompose(
    mesh: MeshLike,
    *,
    field: Optional[Union[str, Sequence[Sequence[float]]]] = None,
    name: Optional[str] = None,
    splitting: Literal["primal", "dual"] = "primal",
    boundary: Literal["tangential", "normal"] = "tangential",
) -> SplitField:
    """Splits a tangent field into a gradient, a rotated gradient and a harmonic part.

    To split many fields on one surface, use :class:`HodgeDecomposition`, which factors once.

    Parameters
    ----------
    mesh : MeshLike
        An oriented manifold without degenerate faces or unreferenced vertices (:meth:`Mesh.without_unreferenced`).
    field : Union[str, Sequence[Sequence[float]]], optional
        The field to split: a file of vectors on faces, rotation:AXIS, gradient:WHAT, random:SEED or harmonic:K; without
        one only the degrees of freedom are counted.
    name : str, optional
        The name of the vectors in the file, if it has several.
    splitting : str
        The kind of function whose gradients are one part. ``"primal"``: gradients of continuous functions, rotated
        gradients of functions that agree at midpoints of edges; ``"dual"``: gradients of functions that agree at
        midpoints of edges, rotated gradients of continuous functions.
    boundary : str
        The boundary condition of the harmonic part. ``"tangential"``: harmonic Neumann fields, tangential to the
        boundary: the potential of the rotated gradient is zero there, so that neither the rotated gradient nor the
        harmonic part has a normal component; ``"normal"``: harmonic Dirichlet fields, normal to the boundary: the
        potential of the gradient is zero there, so that neither the gradient nor the harmonic part has a tangential
        component.

    Raises
    ------
    SurfaceError
        If the mesh is no surface; the message names the face, edge or vertex.
    FieldError
        If there is not one finite vector for each face, or a system cannot be factored.
    OptionError
        If options make no sense.

    Examples
    --------
    >>> import pompeiu
    >>> split = pompeiu.decompose(pompeiu.shapes.torus(), field="rotation:z")
    >>> split.degrees_of_freedom.harmonic, split.parts.quality.residual < 1e-12
    (2, True)
    """
    answer, beside = ask("decompose", locals())
    report = answer["report"]
    found = report["decomposition"]
    parts = None
    if found is not None:
        parts = FieldParts(normal_part=found["normal_part"], quality=FieldQuality._of(found), **beside)
    return SplitField(DegreesOfFreedom._of(report), parts, report)
