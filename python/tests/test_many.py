"""Ranking, and matrices of distances: on this machine."""

import json
import math
import pickle

import numpy as np
import pompeiu
import pytest
from shapes_with_answers import cube, grid

TEMPLATE = pompeiu.shapes.icosphere(1.0, 2)
RADII = [1.5, 1.01, 9.0, 1.25, 0.9, 3.0]
SPHERES = [pompeiu.shapes.icosphere(radius, 2) for radius in RADII]


def test_the_nearest_come_first_and_their_distances_are_enclosed():
    report = pompeiu.rank(TEMPLATE, SPHERES, top=3)
    assert [s.target for s in report.ranked] == [1, 4, 3]
    assert [s.ranks for s in report.ranked] == [(1, 1), (2, 2), (3, 3)]
    assert {s.status for s in report.standings[3:]} == {"discarded"} and report.finished
    for standing in report:
        if standing.status == "ranked":
            alone = pompeiu.hausdorff(TEMPLATE, SPHERES[standing.target])
            assert standing.lower <= alone.upper and alone.lower <= standing.upper
            assert standing.upper - standing.lower < 1e-10
        else:
            assert standing.bound in ("supports", "probes", "search") and standing.lower > report.ranked[-1].upper
    assert len(report) == 6 and report.ranked[0].name == "1" and report.ranked[0].size == (162, 320)


def test_everything_is_measured_where_that_is_wanted():
    report = pompeiu.rank(TEMPLATE, dict(zip("abcdef", SPHERES)), top=1, all=True)
    assert [s.name for s in report] == ["b", "e", "d", "a", "f", "c"]
    assert [s.ranks for s in report] == [(i, i) for i in range(1, 7)]


def test_the_same_bits_for_any_number_of_threads():
    reports = [pompeiu.rank(TEMPLATE, SPHERES, top=2, threads=threads) for threads in (1, 2, 8, None)]
    assert all(report == reports[0] for report in reports)


def test_equals_tie():
    report = pompeiu.rank(TEMPLATE, [SPHERES[1], SPHERES[1], SPHERES[0]], top=1)
    assert [s.ranks for s in report.ranked] == [(1, 2), (1, 2)]


def test_directions_differ():
    square, sheet = pompeiu.shapes.grid((1.0, 1.0)), pompeiu.shapes.grid((3.0, 3.0))
    part = pompeiu.rank(square, [sheet], direction="from-template").ranked[0]
    whole = pompeiu.rank(square, [sheet], direction="to-template").ranked[0]
    assert part.upper < 1e-10 and whole.lower <= math.sqrt(2) <= whole.upper


def test_targets_are_moved_onto_the_template():
    vertices, faces = TEMPLATE.vertices, TEMPLATE.faces
    moved = pompeiu.rank(TEMPLATE, [(vertices + [5.0, 0.0, 0.0], faces)], align="centroid").ranked[0]
    assert moved.upper < 1e-10
    assert np.allclose(moved.transform, [[1, 0, 0, -5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    assert pompeiu.rank(TEMPLATE, SPHERES[:1]).ranked[0].transform is None


def test_files_are_read_and_one_that_cannot_be_has_failed(tmp_path):
    pompeiu.write_mesh(tmp_path / "near.ply", SPHERES[1])
    (tmp_path / "broken.obj").write_text("v 0 0\n")
    report = pompeiu.rank(TEMPLATE, [tmp_path / "near.ply", str(tmp_path / "broken.obj"), tmp_path / "missing.stl", SPHERES[0]])
    assert [s.status for s in report] == ["ranked", "ranked", "failed", "failed"]
    assert report.standings[0].name == str(tmp_path / "near.ply")
    failed = {s.target: s.message for s in report if s.status == "failed"}
    assert "broken.obj: line 1" in failed[1] and "missing.stl: No such file" in failed[2]
    assert all(s.lower is None and s.ranks is None for s in report.standings[2:])


def test_reports_are_frozen_comparable_and_can_be_pickled():
    report = pompeiu.rank(TEMPLATE, SPHERES, top=1)
    assert pickle.loads(pickle.dumps(report)) == report and hash(report) is not None
    assert json.loads(json.dumps(report.to_dict()))["standings"][0]["name"] == "1"
    assert repr(report) == "RankReport(1 ranked, 5 discarded, 0 failed, best '1')"
    assert report._repr_html_().count("<tr>") == 6


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"top": 0}, "the number of places asked for is 0; at least 1 is needed"),
        ({"top": -1}, "option `top` of rank: found the number `-1`, expected a whole number of at least 0"),
        ({"tolerance": -1.0}, "the tolerance is -1; it must be a finite number that is not negative"),
        ({"tolerance": math.nan}, "tolerance is nan; it must be a finite number"),
        ({"direction": "a"}, "option `direction` of rank: found `a`, expected one of `both`, `from-template`, `to-template`"),
        ({"align": "best"}, "option `align` of rank: found `best`, expected one of `none`, `centroid`, `scale`, `rigid`"),
    ],
)
def test_options_that_mean_nothing_are_named(options, sentence):
    with pytest.raises(pompeiu.OptionError) as raised:
        pompeiu.rank(TEMPLATE, SPHERES, **options)
    assert str(raised.value) == sentence


def test_there_must_be_targets_of_which_some_can_be_used(tmp_path):
    with pytest.raises(pompeiu.OptionError, match="there are no targets"):
        pompeiu.rank(TEMPLATE, [])
    with pytest.raises(pompeiu.ReadError, match="none of the 2 targets can be used; the first: .*missing.ply"):
        pompeiu.rank(TEMPLATE, [tmp_path / "missing.ply", tmp_path / "nothing.ply"])


def test_a_ranking_that_is_stopped_says_what_it_knows():
    told = []
    report = pompeiu.rank(TEMPLATE, SPHERES, threads=1, progress=lambda *steps: told.append(steps) or False)
    assert not report.finished and len(report) == 6 and report.stop == "cancelled"
    assert {s.stop for s in report if s.status == "open"} == {"cancelled"} and " open, " in repr(report)
    assert told[0][1] == 6 and told[0][3] == 6
    with pytest.raises(LookupError):
        pompeiu.rank(TEMPLATE, SPHERES, progress=lambda *steps: {}[steps])


def test_limits_end_a_ranking_and_a_matrix_with_what_is_proven():
    report = pompeiu.rank(TEMPLATE, SPHERES, top=2, time_limit=0)
    assert report.stop == "time" and [s.ranks for s in report] == [(1, 6)] * 6
    report = pompeiu.rank(TEMPLATE, SPHERES, top=2, memory_limit=1)
    assert report.stop == "memory" and not report.finished
    assert all(s.lower - 1e-12 <= abs(RADII[s.target] - 1) <= s.upper + 1e-12 for s in report)
    matrix = pompeiu.matrix(SPHERES[:3], time_limit=0)
    assert matrix.stop == "time" and len(matrix.open) == 6 and np.isnan(matrix.lower[0, 1])
    assert pompeiu.matrix(SPHERES[:3], memory_limit=1 << 30) == pompeiu.matrix(SPHERES[:3])
    assert pompeiu.matrix(SPHERES[:3], tolerance=0.1, tolerance_kind="absolute").open == ()
    with pytest.raises(pompeiu.OptionError, match="the time limit is -1"):
        pompeiu.rank(TEMPLATE, SPHERES, time_limit=-1)


def test_a_matrix_holds_the_distances_of_all_pairs():
    meshes = [cube(1.0), cube(2.0), grid(1.0, 2)]
    matrix = pompeiu.matrix(meshes)
    assert matrix.lower.shape == (3, 3) and len(matrix) == 3
    assert np.array_equal(np.diag(matrix.directed_upper), np.zeros(3))
    for i, a in enumerate(meshes):
        for j, b in enumerate(meshes):
            if i != j:
                report = pompeiu.directed_hausdorff(a, pompeiu.Target(b))
                assert (matrix.directed_lower[i, j], matrix.directed_upper[i, j]) == (report.lower, report.upper)
    assert np.array_equal(matrix.lower, matrix.lower.T) and matrix.lower[0, 1] <= math.sqrt(3) / 2 <= matrix.upper[0, 1]
    assert matrix == pompeiu.matrix(meshes, threads=1) == pickle.loads(pickle.dumps(matrix))
    assert repr(matrix).startswith("DistanceMatrix(directed_lower=<float64 (3, 3)>, ")
    assert len(pompeiu.matrix([])) == 0
    directed = pompeiu.matrix(meshes, directed=True)
    assert np.array_equal(directed.upper, matrix.directed_upper) and not np.array_equal(directed.upper, matrix.upper)
    with pytest.raises(pompeiu.OptionError, match="the tolerance is -1"):
        pompeiu.matrix(meshes, tolerance=-1.0)


def test_a_matrix_takes_what_a_ranking_takes(tmp_path):
    for name, side in (("a.obj", 1.0), ("c.obj", 2.0)):
        pompeiu.write_mesh(tmp_path / name, pompeiu.shapes.cube(side))
    (tmp_path / "b.obj").write_text("v 0 0 zero\n")
    (tmp_path / "notes.txt").write_text("no mesh")
    for targets in (tmp_path, [tmp_path]):
        names = [str(tmp_path / name) for name in ("a.obj", "b.obj", "c.obj")]
        found = pompeiu.matrix(targets)
        assert list(found.names) == names and list(found.failed) == [names[1]] and "b.obj" in found.failed[names[1]]
        assert np.isnan(found.lower[1]).all() and np.isnan(found.lower[:, 1]).all()
        assert found.lower[0, 2] <= math.sqrt(3) / 2 <= found.upper[0, 2]
        ranking = pompeiu.rank(pompeiu.shapes.cube(1.0), targets)
        assert [s.name for s in ranking.ranked] == [names[0], names[2]] and ranking.standings[-1].name == names[1]
    for ask in (pompeiu.matrix, lambda all: pompeiu.rank(TEMPLATE, all)):
        with pytest.raises(pompeiu.ReadError, match="none of the"):
            ask([tmp_path / "b.obj", tmp_path / "missing.obj"])
    (tmp_path / "empty").mkdir()
    with pytest.raises(pompeiu.OptionError, match="holds no file with the suffix of a mesh"):
        pompeiu.matrix(tmp_path / "empty")
