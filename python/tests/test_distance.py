"""Distances: closed forms, invariants, options."""

import math

import numpy as np
import pompeiu
import pytest
from shapes_with_answers import ROUNDING, cases, cube, grid


def size(*meshes):
    """The largest coordinate, at least that of a unit."""
    return max(1.0, *(float(np.abs(vertices).max()) for vertices, _ in meshes))


@pytest.mark.parametrize("case", list(cases()), ids=lambda case: case.name)
def test_closed_forms_are_enclosed(case):
    report = pompeiu.hausdorff(case.a, case.b)
    slack = ROUNDING * size(case.a, case.b)
    for directed, expected in ((report.a_to_b, case.a_to_b), (report.b_to_a, case.b_to_a)):
        assert directed.lower - slack <= expected <= directed.upper + slack
        assert directed.gap <= max(directed.tolerance, 1e-13 * size(case.a, case.b)) + slack
    assert report.lower == max(report.a_to_b.lower, report.b_to_a.lower)
    assert report.upper == max(report.a_to_b.upper, report.b_to_a.upper)


@pytest.mark.parametrize("case", list(cases()), ids=lambda case: case.name)
def test_witnesses_are_as_far_apart_as_they_say(case):
    report = pompeiu.hausdorff(case.a, case.b)
    slack = ROUNDING * size(case.a, case.b)
    for directed, (vertices, faces), other in ((report.a_to_b, case.a, case.b), (report.b_to_a, case.b, case.a)):
        start, end = directed.witness.from_, directed.witness.to
        assert np.allclose(np.dot(start.barycentric, vertices[faces[start.face]]), start.position, rtol=0, atol=slack)
        assert np.allclose(np.dot(end.barycentric, other[0][other[1][end.face]]), end.position, rtol=0, atol=slack)
        assert math.dist(start.position, end.position) >= directed.lower - slack


def test_the_same_bits_for_any_number_of_threads():
    a, b = pompeiu.shapes.torus(2.0, 0.7, 60, 40), pompeiu.shapes.torus(2.0, 0.71, 50, 30)
    one = pompeiu.hausdorff(a, b, threads=1)
    assert one == pompeiu.hausdorff(a, b, threads=2) == pompeiu.hausdorff(a, b, threads=8) == pompeiu.hausdorff(a, b)


def test_a_target_answers_as_the_mesh_does():
    lantern, cylinder = pompeiu.shapes.schwarz_lantern(), pompeiu.shapes.cylinder(segments=64)
    target = pompeiu.Target(cylinder)
    assert target.n_faces == cylinder.n_faces
    assert target.bounds == (tuple(cylinder.vertices.min(axis=0)), tuple(cylinder.vertices.max(axis=0)))
    assert repr(target).startswith("Target(128 faces, ")
    alone, prepared = pompeiu.directed_hausdorff(lantern, cylinder), pompeiu.directed_hausdorff(lantern, target)
    assert (alone.lower, alone.upper, alone.witness) == (prepared.lower, prepared.upper, prepared.witness)
    with pytest.raises(TypeError, match="directed_hausdorff"):
        pompeiu.hausdorff(lantern, target)


def test_a_threshold_is_proven_or_refuted():
    a, b = cube(1.0), cube(2.0)
    assert pompeiu.hausdorff(a, b, threshold=0.9).is_below(0.9) is True
    assert pompeiu.hausdorff(a, b, threshold=0.8).is_below(0.8) is False
    at = pompeiu.hausdorff(a, b)
    assert at.is_below((at.lower + at.upper) / 2) is None
    spheres = pompeiu.shapes.icosphere(1.0, 4), pompeiu.shapes.icosphere(1.5, 4)
    assert pompeiu.directed_hausdorff(*spheres, threshold=0.1).stop == "threshold"


@pytest.mark.parametrize(
    ("kind", "tolerance", "width"),
    [("absolute", 0.01, 0.01), ("relative", 0.01, 0.01), ("diagonal", 0.01, 0.01 * math.sqrt(4 * 3))],
)
def test_tolerances_mean_what_they_say(kind, tolerance, width):
    report = pompeiu.directed_hausdorff(cube(1.0), cube(2.0), tolerance=tolerance, tolerance_kind=kind)
    assert 0.5 in report
    assert report.gap <= width
    if kind != "relative":
        assert report.tolerance == pytest.approx(width, rel=1e-12)


def test_limits_widen_the_enclosure_and_keep_it_true():
    a, b = pompeiu.shapes.icosphere(1.0, 4), pompeiu.shapes.icosphere(1.5, 3)
    exact = pompeiu.hausdorff(a, b)
    for limits in ({"time_limit": 0.0}, {"memory_limit": 1}):
        report = pompeiu.hausdorff(a, b, **limits)
        assert report.lower <= exact.upper and exact.lower <= report.upper
        assert report.a_to_b.stop in ("time", "memory") and report.gap > exact.gap


def test_both_methods_agree():
    a, b = cube(1.0), cube(2.0)
    classic = pompeiu.directed_hausdorff(b, a, method="classic", tolerance=1e-3)
    assert math.sqrt(3) / 2 in classic
    assert classic.work.pieces > pompeiu.directed_hausdorff(b, a).work.pieces


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"tolerance": -1.0}, "the tolerance is -1; it must be a finite number that is not negative"),
        ({"tolerance": math.nan}, "tolerance is nan; it must be a finite number"),
        ({"threshold": math.inf}, "threshold is inf; it must be a finite number"),
        ({"threads": 0}, "the number of threads is 0; at least 1 is needed"),
        ({"time_limit": -1.0}, "the time limit is -1 seconds; it must be a finite number that is not negative"),
        (
            {"tolerance_kind": "percent"},
            "option `tolerance_kind` of distance: found `percent`, expected one of `diagonal`, `relative`, `absolute`",
        ),
        ({"method": "slow"}, "option `method` of distance: found `slow`, expected `fast` or `classic`"),
    ],
)
def test_options_that_mean_nothing_are_named(options, sentence):
    with pytest.raises(pompeiu.OptionError) as raised:
        pompeiu.hausdorff(grid(1.0, 1), grid(1.0, 1), **options)
    assert str(raised.value) == sentence
    assert isinstance(raised.value, ValueError)


def test_clouds_of_points_are_measured_one_way(tmp_path):
    cube = pompeiu.shapes.cube(2.0)
    points = cube.vertices * 1.5
    (tmp_path / "cloud.xyz").write_text("\n".join(" ".join(map(repr, p)) for p in points.tolist()))
    for cloud in (points, tmp_path / "cloud.xyz"):
        found = pompeiu.distance(cube, cloud)
        assert found.a_to_b is None and found.hausdorff is None and 3**0.5 / 2 in found.b_to_a
        assert pompeiu.distance(cloud, cube).distance == pompeiu.distance(cloud, cube).a_to_b
        with pytest.raises(pompeiu.OptionError, match="direction can be 'b-to-a'"):
            pompeiu.distance(cube, cloud, direction="a-to-b")


def test_errors_name_the_option_and_what_it_takes():
    cube = pompeiu.shapes.cube()
    for options, sentence in [
        ({"tolerance": "fine"}, "option `tolerance` of distance: found the text \"fine\", expected a number"),
        ({"direction": "up"}, "option `direction` of distance: found `up`, expected one of `both`, `a-to-b`, `b-to-a`"),
        ({"trace": 3}, "option `trace` of distance: found the number `3`, expected true or false"),
    ]:
        with pytest.raises(pompeiu.OptionError) as raised:
            pompeiu.distance(cube, cube, **options)
        assert sentence in str(raised.value)


def test_lengths_have_units_and_percentages():
    a, b = pompeiu.shapes.cube(2.0), pompeiu.shapes.cube(2.2)
    diagonal = 2.2 * 3**0.5
    asked = {"0.2": "below", "0.1": "above", "200um": "below", f"{18 / diagonal:.3f}%": "below", "1%": "above"}
    for length, answer in asked.items():
        assert pompeiu.distance(a, b, assert_below=length, unit="mm").answer == answer
    with pytest.raises(pompeiu.OptionError, match="mesh files have none"):
        pompeiu.distance(a, b, assert_below="1mm")
    sphere = pompeiu.shapes.icosphere(1.0, 3)
    few = pompeiu.simplify(sphere, within="1%")
    assert few.report["within"] == pytest.approx(0.01 * 2 * 3**0.5, rel=1e-2)
    assert pompeiu.simplify(sphere, within="20um", unit="mm").report["within"] == pytest.approx(0.02)
    assert pompeiu.remesh(sphere, edge_length="5%").report["edge_length"] == pytest.approx(0.05 * 2 * 3**0.5, rel=1e-2)
