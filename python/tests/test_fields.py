"""Splitting fields: closed forms, invariants, errors."""

import math

import numpy as np
import pompeiu
import pytest

TORUS = pompeiu.shapes.torus(2.0, 0.7, 24, 16)


def gradient(mesh, values):
    """The gradient of the function with these values at vertices, by definition."""
    vertices, faces = mesh.vertices, mesh.faces
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    double_area_sq = (normal**2).sum(axis=1, keepdims=True)
    opposite = (c - b, a - c, b - a)
    return sum(values[faces[:, i], None] * np.cross(normal, opposite[i]) for i in range(3)) / double_area_sq


def inner(hodge, u, w):
    return float(((u * w).sum(axis=1) * hodge.face_areas).sum())


@pytest.mark.parametrize("splitting", ["primal", "dual"])
@pytest.mark.parametrize("boundary", ["tangential", "normal"])
@pytest.mark.parametrize(
    ("mesh", "tangential"),
    [(TORUS, 2), (pompeiu.shapes.icosphere(1.0, 2), 0), (pompeiu.shapes.cylinder(rows=3), 1), (pompeiu.shapes.grid(cells=(4, 5)), 0)],
    ids=["torus", "sphere", "cylinder", "square"],
)
def test_the_parts_are_orthogonal_and_add_up(mesh, tangential, splitting, boundary):
    hodge = pompeiu.HodgeDecomposition(mesh, splitting, boundary)
    assert hodge.harmonic_dimension == hodge.degrees_of_freedom.harmonic == tangential
    assert hodge.degrees_of_freedom == pompeiu.field_degrees_of_freedom(mesh, boundary) and hodge.degrees_of_freedom.adds_up
    field = np.random.default_rng(1).normal(size=(mesh.n_faces, 3))
    parts = hodge.decompose(field)
    pieces = (parts.gradient, parts.rotated, parts.harmonic)
    norm_sq = parts.quality.field_norm**2
    vertices, faces = mesh.vertices, mesh.faces
    normal = np.cross(*(vertices[faces[:, i]] - vertices[faces[:, 0]] for i in (1, 2)))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    along = (field * normal).sum(axis=1, keepdims=True)
    assert np.allclose(sum(pieces), field - along * normal, atol=1e-10)
    assert parts.normal_part == pytest.approx(np.abs(along).max())
    assert norm_sq == pytest.approx(inner(hodge, field - along * normal, field - along * normal))
    for i in range(3):
        for j in range(i):
            assert abs(inner(hodge, pieces[i], pieces[j])) < 1e-12 * norm_sq
    assert parts.quality.residual < 1e-12 and parts.quality.part_error < 1e-10
    assert len(parts.vertex_potential) == mesh.n_vertices and len(parts.edge_potential) == len(hodge.edges)


def test_the_potential_of_a_gradient_is_found():
    mesh = pompeiu.shapes.icosphere(1.0, 3)
    values = np.random.default_rng(2).normal(size=mesh.n_vertices)
    field = gradient(mesh, values)
    parts = pompeiu.HodgeDecomposition(mesh).decompose(field)
    assert np.allclose(parts.gradient, field, atol=1e-10)
    difference = parts.vertex_potential - values
    assert np.ptp(difference) < 1e-10, "up to a constant"


def test_harmonic_fields_are_orthonormal_and_their_own_parts():
    hodge = pompeiu.HodgeDecomposition(TORUS)
    basis = hodge.harmonic_fields
    assert basis.shape == (2, TORUS.n_faces, 3)
    assert np.allclose([[inner(hodge, u, w) for u in basis] for w in basis], np.eye(2), atol=1e-12)
    parts = hodge.decompose(3.0 * basis[0] - 4.0 * basis[1])
    assert np.allclose(parts.harmonic_coefficients, [3.0, -4.0])
    assert parts.quality.harmonic_norm == pytest.approx(5.0)
    assert np.allclose(parts.harmonic, 3.0 * basis[0] - 4.0 * basis[1], atol=1e-12)
    assert pompeiu.HodgeDecomposition(pompeiu.shapes.icosphere()).harmonic_fields.shape == (0, 1280, 3)


def test_many_fields_are_split_as_each_would_be():
    hodge = pompeiu.HodgeDecomposition(TORUS)
    fields = np.random.default_rng(3).normal(size=(5, TORUS.n_faces, 3))
    assert hodge.decompose_many(fields) == [hodge.decompose(field) for field in fields]
    assert hodge.decompose_many([]) == []


def test_a_single_function_space_does_not_add_up():
    counted = pompeiu.field_degrees_of_freedom(TORUS)
    assert counted.total == 2 * TORUS.n_faces
    assert counted.mixed.residual_dimension == counted.harmonic == 2
    assert counted.conforming.residual_dimension > 2 and counted.nonconforming.residual_dimension < 0


def test_what_is_no_surface_is_named():
    fan = pompeiu.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, -1, 0]], [[0, 1, 2], [0, 1, 3], [0, 1, 4]])
    for ask in (pompeiu.HodgeDecomposition, pompeiu.field_degrees_of_freedom):
        with pytest.raises(pompeiu.SurfaceError, match="the edge from vertex 0 to vertex 1 is in 3 faces"):
            ask(fan)
    spare = pompeiu.Mesh([[9, 9, 9], [0, 0, 0], [1, 0, 0], [0, 1, 0]], [[1, 2, 3]])
    with pytest.raises(pompeiu.SurfaceError, match="vertex 0 is in no face"):
        pompeiu.HodgeDecomposition(spare)
    assert pompeiu.HodgeDecomposition(spare.without_unreferenced()).harmonic_dimension == 0
    with pytest.raises(pompeiu.SurfaceError, match="face 0 is degenerate"):
        pompeiu.HodgeDecomposition(([[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 1, 2]]))


def test_fields_that_do_not_fit_are_named():
    hodge = pompeiu.HodgeDecomposition(TORUS)
    assert repr(hodge) == "HodgeDecomposition(768 faces, 'primal', 'tangential', 2 harmonic fields)"
    with pytest.raises(pompeiu.FieldError, match="the field has 3 vectors, expected 768, one for each face"):
        hodge.decompose(np.zeros((3, 3)))
    with pytest.raises(pompeiu.FieldError, match="on face 7, expected finite numbers"):
        field = np.zeros((768, 3))
        field[7, 1] = math.nan
        hodge.decompose(field)
    with pytest.raises(pompeiu.MeshError, match=r"vectors of the field have shape \(768, 2\), expected \(m, 3\)"):
        hodge.decompose(np.zeros((768, 2)))
    with pytest.raises(pompeiu.OptionError, match='splitting is "both", expected "primal" or "dual"'):
        pompeiu.HodgeDecomposition(TORUS, "both")
    with pytest.raises(pompeiu.OptionError, match='boundary is "none", expected "tangential" or "normal"'):
        pompeiu.HodgeDecomposition(TORUS, boundary="none")


def test_a_field_is_split_once_as_by_a_prepared_surface():
    field = np.random.default_rng(4).normal(size=(TORUS.n_faces, 3))
    for splitting, boundary in [("primal", "tangential"), ("dual", "normal")]:
        split = pompeiu.decompose(TORUS, field=field, splitting=splitting, boundary=boundary)
        assert split.parts == pompeiu.HodgeDecomposition(TORUS, splitting, boundary).decompose(field)
    assert pompeiu.decompose(TORUS).parts is None
    assert pompeiu.decompose(TORUS).degrees_of_freedom == pompeiu.field_degrees_of_freedom(TORUS)
    named = pompeiu.decompose(TORUS, field="gradient:x*y").parts.gradient
    assert np.allclose(named, pompeiu.HodgeDecomposition(TORUS).decompose(named).gradient)


def test_fields_that_cannot_be_named(tmp_path):
    for options, error in [
        ({"field": "rotation:w"}, pompeiu.OptionError),
        ({"field": "gradient:w"}, pompeiu.OptionError),
        ({"field": "harmonic:2"}, pompeiu.OptionError),
        ({"name": "wind"}, pompeiu.OptionError),
        ({"field": tmp_path / "missing.csv"}, pompeiu.MissingFileError),
        ({"field": np.zeros((3, 3))}, pompeiu.FieldError),
        ({"field": np.full((TORUS.n_faces, 3), np.nan)}, pompeiu.OptionError),
    ]:
        with pytest.raises(error):
            pompeiu.decompose(TORUS, **options)
