"""Flow to least area and simplification: closed forms, limits, errors."""

import numpy as np
import pompeiu
import pytest


def test_a_sphere_shrinks_in_time():
    steps = []
    found = pompeiu.flow(pompeiu.shapes.icosphere(1.0, 3), time=0.1, progress=lambda *told: steps.append(told))
    assert found.stop == "time" and found.history[-1]["time"] == pytest.approx(0.1)
    # R^2 = 1 - 4 t.
    assert np.linalg.norm(found.mesh.vertices, axis=1).mean() == pytest.approx(0.6**0.5, rel=1e-2)
    assert all(step >= 0 and area > 0 for step, area, _ in steps)


def test_a_film_between_distant_rings_breaks():
    found = pompeiu.flow(pompeiu.shapes.schwarz_lantern(1.0, 1.6, 32, 12))
    assert found.stop == "pinched" and found.report["cone"] is not None and found.least_eigenvalue is None
    assert np.isfinite(found.mesh.vertices).all()


def test_a_flow_ends_when_it_is_told_to():
    found = pompeiu.flow(pompeiu.shapes.icosphere(1.0, 2), time=0.2, time_step=1e-5, progress=lambda *told: False)
    assert found.stop == "cancelled"


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"time": 1.0, "steps": 2}, "one end"),
        ({"scheme": "fast"}, "expected the name of a scheme"),
        ({"scheme": "newton", "time": 1.0}, "has no time"),
        ({"keep_volume": True, "scheme": "explicit"}, "does not keep the volume"),
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
