"""Flow to least area and simplification: closed forms, limits, errors."""

import numpy as np
import pompeiu
import pytest


def test_a_sphere_shrinks_in_time():
    steps = []
    found = pompeiu.flow(pompeiu.shapes.icosphere(1.0, 3), until="time:0.1", progress=lambda *told: steps.append(told))
    assert found.stop == "time" and found.history[-1]["time"] == pytest.approx(0.1)
    # R^2 = 1 - 4 t.
    assert np.linalg.norm(found.mesh.vertices, axis=1).mean() == pytest.approx(0.6**0.5, rel=1e-2)
    assert all(step >= 0 and area > 0 for step, area, _ in steps)


def test_a_film_between_distant_rings_breaks():
    found = pompeiu.flow(pompeiu.shapes.schwarz_lantern(1.0, 1.6, 32, 12))
    assert found.stop == "pinched" and found.report["cone"] is not None and found.least_eigenvalue is None
    assert np.isfinite(found.mesh.vertices).all()


def test_a_flow_ends_when_it_is_told_to():
    found = pompeiu.flow(pompeiu.shapes.icosphere(1.0, 2), until="time:0.2", time_step=1e-5, progress=lambda *told: False)
    assert found.stop == "cancelled"


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"until": "never"}, "expected stationary"),
        ({"scheme": "fast"}, "option `scheme` of flow: found `fast`"),
        ({"scheme": "newton", "until": "time:1"}, "has no time"),
        ({"volume": "keep", "scheme": "explicit"}, "does not keep the volume"),
        ({"time_limit": -1.0}, "time limit"),
    ],
)
def test_options_that_make_no_sense(options, words):
    with pytest.raises(pompeiu.OptionError, match=words):
        pompeiu.flow(pompeiu.shapes.icosphere(1.0, 1), **options)


def test_what_is_no_surface():
    folded = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, -1, 0]], [[0, 1, 2], [0, 1, 3], [0, 1, 4]])
    with pytest.raises(pompeiu.SurfaceError, match="repair"):
        pompeiu.flow(folded)
    with pytest.raises(pompeiu.SurfaceError):
        pompeiu.simplify(folded, within=0.1)


def test_fewer_faces_within_a_distance():
    sphere = pompeiu.shapes.icosphere(1.0, 4)
    found = pompeiu.simplify(sphere, within=0.02)
    assert found.mesh.n_faces < sphere.n_faces / 8
    assert found.distance.upper <= 0.02
    assert found.distance.upper == pytest.approx(pompeiu.hausdorff(sphere, found.mesh).upper, abs=1e-9)
    assert pompeiu.simplify(sphere, faces=100).mesh.n_faces <= 100
    for options in ({}, {"within": 0.1, "faces": 3}, {"within": -1.0}, {"faces": -1}):
        with pytest.raises(pompeiu.OptionError):
            pompeiu.simplify(sphere, **options)


def test_features_and_repair():
    cube = pompeiu.shapes.cube(2.0, 6)
    found = pompeiu.simplify(cube, within=0.5, features=30.0)
    # All corners stay; without features some would be cut off.
    corners = {tuple(v) for v in np.abs(found.mesh.vertices)}
    assert found.mesh.n_faces == 12 and corners == {(1.0, 1.0, 1.0)}
    folded = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, -1, 0]], [[0, 1, 2], [0, 1, 3], [0, 1, 4]])
    assert pompeiu.simplify(folded, within=1e-6, repair=True).mesh.n_faces == 3
    with pytest.raises(pompeiu.OptionError, match="angle of features"):
        pompeiu.simplify(cube, within=0.1, features=-1.0)


def test_texture_and_colours_are_carried_over():
    mesh = pompeiu.shapes.grid((2.0, 1.0), (40, 20))
    points = np.asarray(mesh.vertices)
    # Two charts, side by side in space and apart in the picture.
    right = points[mesh.faces][:, :, 0].mean(axis=1) > np.median(points[:, 0])
    coordinates = np.concatenate([points[:, :2], points[:, :2] + 10.0])
    corners = mesh.faces + len(points) * right[:, None]
    colors = np.zeros((len(points), 3), np.uint8)
    colors[:, 0] = np.round(100 * (points[:, 0] - points[:, 0].min()))
    found = pompeiu.simplify(mesh, within=1e-3, texture=(coordinates, corners), colors=colors)
    assert found.mesh.n_faces < 40
    places, of_corners = found.texture
    moved = places[of_corners] - found.mesh.vertices[found.mesh.faces][:, :, :2]
    # Each face lies in one chart, and where it was in it.
    assert np.allclose(moved, np.round(moved / 10.0) * 10.0, atol=1e-9)
    assert (np.ptp(moved[:, :, 0], axis=1) < 1e-9).all() and set(np.round(moved[:, 0, 0])) == {0.0, 10.0}
    expected = 100 * (found.mesh.vertices[:, 0] - points[:, 0].min())
    assert np.abs(found.colors[:, 0] - expected).max() <= 0.5
    assert pompeiu.simplify(mesh, within=1e-3).texture is None
    with pytest.raises(pompeiu.OptionError, match="repair it before"):
        pompeiu.simplify(mesh, within=1e-3, colors=colors, repair=True)
    with pytest.raises(pompeiu.PompeiuError, match="vertices"):
        pompeiu.simplify(mesh, within=1e-3, colors=colors[1:])
    with pytest.raises(pompeiu.OptionError, match="names value"):
        pompeiu.simplify(mesh, within=1e-3, texture=(coordinates[:5], corners))


def test_nearly_equilateral_faces():
    told = []
    sphere = pompeiu.shapes.icosphere(1.0, 4)
    found = pompeiu.remesh(sphere, edge_length=0.12, progress=told.append)
    assert found.before["faces"] == sphere.n_faces and found.after["faces"] == found.mesh.n_faces
    assert found.after["least_angle"]["mean"] > 54 and found.stop == "tolerance"
    assert found.distance.upper == pytest.approx(pompeiu.hausdorff(sphere, found.mesh).upper, abs=1e-9)
    within = pompeiu.remesh(sphere, edge_length=0.5, within=0.01)
    assert within.distance.upper <= 0.01
    as_it_was = pompeiu.remesh(sphere)
    assert as_it_was.report["edge_length"] == as_it_was.before["edge_length"]["mean"]
    for options in ({"edge_length": 0.1, "adaptive": 0.1}, {"edge_length": -1.0}, {"edge_length": 1e9}):
        with pytest.raises(pompeiu.OptionError):
            pompeiu.remesh(sphere, **options)


def test_faces_that_intersect():
    ball = pompeiu.shapes.icosphere(1.0, 2)
    assert len(pompeiu.intersections(ball)) == 0
    both = (np.concatenate([ball.vertices, ball.vertices + 0.5]), np.concatenate([ball.faces, ball.faces + 162]))
    found = pompeiu.intersections(both)
    assert found.complete and found.faces.shape == (len(found), 2) and found.places.shape == (len(found), 3)
    assert (found.faces[:, 0] < 320).all() and (found.faces[:, 1] >= 320).all()
    # Common points lie near both spheres.
    assert np.abs(np.linalg.norm(found.places, axis=1) - 1).max() < 0.05
    few = pompeiu.intersections(both, most=3)
    assert len(few) == 3 and not few.complete


def test_a_closed_surface_is_never_stationary():
    with pytest.raises(pompeiu.SurfaceError, match="no closed surface is minimal"):
        pompeiu.flow(pompeiu.shapes.icosphere(1.0, 2))
