"""Outlines and their measures: closed forms, files, errors."""

import math

import kmedoids
import numpy as np
import pompeiu
import pytest


def circle(corners):
    angles = 2 * np.pi * np.arange(corners) / corners
    return np.column_stack([np.cos(angles), np.sin(angles)])


def test_a_circle_has_its_boundary_ratio():
    result = pompeiu.complexity({"circle": circle(1000)})
    exact = 8 * math.sin(math.pi / 8) / (1000 * math.sin(math.pi / 1000))
    assert result.shapes[0]["boundary"]["8"] == pytest.approx(exact, abs=1e-12)
    assert result.table()["compactness"][0] == pytest.approx(1, abs=1e-4)


def test_points_make_shapes_more_complex():
    shapes = {f"{n}-{seed}": pompeiu.polyline(n, seed=seed) for n in (5, 25) for seed in range(5)}
    told = []
    result = pompeiu.complexity(
        shapes, against={name: float(name.split("-")[0]) for name in shapes}, clusters=2, progress=told.append
    )
    assert result.agreement["kendall"] > 0.7
    columns = result.table()
    assert {len(column) for column in columns.values()} == {10}
    assert len({(name.split("-")[0], label) for name, label in zip(columns["file"], columns["cluster"])}) == 2
    assert result.ranking[0].startswith("5-")


def test_files_are_read(tmp_path):
    path = tmp_path / "ring.svg"
    path.write_text('<svg><path d="M3 3H6V6H3Z"/><path d="M0 0H9V9H0Z"/></svg>')
    assert [len(outline) for outline in pompeiu.read_outlines(path)] == [4, 4]
    result = pompeiu.complexity([path, pompeiu.noisy_circle(20, 2, seed=1)])
    assert [shape["area"] for shape in result.shapes[:2]] == [9, 81] and result.shapes[2]["file"] == "1"


def test_folders_are_measured_and_what_is_left_out_is_said(tmp_path):
    for n in (5, 9):
        points = "\n".join(f"{x} {y}" for x, y in pompeiu.polyline(n, seed=1, order="angle"))
        (tmp_path / f"{n}.txt").write_text(points)
    (tmp_path / "open.svg").write_text("<svg><path fill='none' d='M0 0H9V9'/></svg>")
    (tmp_path / "mine.rank").write_text("name,place\n5,1\n9,2\n")
    with pytest.warns(UserWarning, match="open.svg: curve 0"):
        result = pompeiu.complexity(tmp_path, against=str(tmp_path / "mine.rank"))
    assert len(result.shapes) == 2 and result.failed[0]["path"].endswith("open.svg")
    assert result.agreement["count"] == 2
    limited = pompeiu.complexity([circle(9)], time_limit=0)
    assert limited.report["stop"] == "time" and limited.shapes == []
    with pytest.raises(pompeiu.ReadError, match="no shapes to measure"):
        pompeiu.complexity(tmp_path / "none.svg")


def test_what_makes_no_sense(tmp_path):
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    with pytest.raises(pompeiu.OptionError, match="there is no measure `size`"):
        pompeiu.complexity([square], rank_by="size")
    with pytest.raises(pompeiu.OptionError, match="2 clusters are asked for of 1 shapes"):
        pompeiu.complexity([square], clusters=2)
    with pytest.raises(pompeiu.OutlineError, match="no area"):
        pompeiu.complexity([[(0, 0), (1, 1), (2, 2)]])
    with pytest.raises(pompeiu.OptionError, match="random"):
        pompeiu.polyline(5, order="sideways")
    broken = tmp_path / "broken.png"
    broken.write_bytes(b"\x89PNG\r\n\x1a\n")
    with pytest.raises(pompeiu.ReadError, match="broken.png: the PNG picture cannot be read"):
        pompeiu.read_outlines(broken)
    with pytest.raises(pompeiu.MissingFileError):
        pompeiu.read_outlines(tmp_path / "none.svg")


@pytest.mark.parametrize("seed", range(12))
def test_medoids_have_the_loss_of_the_package_kmedoids_from_the_same_start(seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(40 + 10 * seed, 3))
    distances = np.linalg.norm(points[:, None] - points, axis=2)
    start = rng.choice(len(points), size=2 + seed % 7, replace=False)
    loss, medoids = pompeiu.k_medoids(distances, start)
    theirs = kmedoids.fasterpam(distances, start.astype(np.uint64), n_cpu=1)
    assert loss == pytest.approx(theirs.loss, rel=1e-12)
    assert loss == pytest.approx(distances[medoids].min(axis=0).sum(), rel=1e-12)


def test_what_are_no_distances_is_refused():
    for distances, start in [([[0, 1]], [0]), ([[0, -1], [1, 0]], [0]), ([[0.0]], [1]), ([[0, 1], [1, 0]], [1, 1]), ([[0.0]], [])]:
        with pytest.raises(pompeiu.OptionError):
            pompeiu.k_medoids(distances, start)
