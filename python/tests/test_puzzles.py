"""Puzzles: exact areas, locks, drawings, errors."""

import pickle

import numpy as np
import pompeiu
import pytest


def area(points):
    x, y = points.T
    return 0.5 * (np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


@pytest.mark.parametrize("layout", ["grid", "hexagons", "voronoi"])
def test_pieces_tile_and_lock(layout):
    made = pompeiu.puzzle(20, layout=layout, seed=2)
    assert sum(map(area, made.outlines)) == pytest.approx(60000, rel=1e-12)
    assert made.is_locked and len(made.clusters) == 1
    for piece, told in zip(made.outlines, made.report["pieces"]):
        assert area(piece) == pytest.approx(told["area"], rel=1e-9)
        shared = set(map(tuple, piece.tolist()))
        assert all(shared & set(map(tuple, made.outlines[other].tolist())) for other in told["neighbours"])


def test_without_tabs_a_motion_is_told():
    made = pompeiu.puzzle(12, tab="none")
    assert not made.is_locked
    assert any(len(piece["escape"]) == 3 for piece in made.report["pieces"])


def test_an_outline_is_filled():
    angles = 2 * np.pi * np.arange(60) / 60
    made = pompeiu.puzzle(15, outline=np.column_stack([np.cos(angles), np.sin(angles)]), size=(80, 80), layout="voronoi")
    assert sum(map(area, made.outlines)) == pytest.approx(np.pi * 1600, rel=5e-3)
    assert made.report["area"]["sum"] == pytest.approx(made.report["area"]["outline"], rel=1e-12)
    with pytest.raises(pompeiu.OptionError, match="crosses itself"):
        pompeiu.puzzle(15, outline=[(0, 0), (4, 0), (0.5, 3), (4, 5)])


def test_pieces_are_like_a_shape():
    shares = []
    square = pompeiu.puzzle(6, piece="square", tab="none", progress=shares.append)
    assert shares and len(square.outlines) == 6
    assert np.mean([piece["similarity"]["iou"] for piece in square.report["pieces"]]) > 0.97
    energy = square.report["energy"]
    assert all(later < earlier for earlier, later in zip(energy, energy[1:]))
    triangle = pompeiu.puzzle(6, piece=[(0, 0), (1, 0), (0, 1)], method="lloyd", metric="least", seed=3)
    assert triangle.is_locked
    assert sum(map(area, triangle.outlines)) == pytest.approx(60000, rel=1e-12)
    with pytest.raises(pompeiu.OptionError, match="expected \"square\""):
        pompeiu.puzzle(6, piece="dragon")
    with pytest.raises(pompeiu.OptionError, match="crosses itself"):
        pompeiu.puzzle(6, piece=[(0, 0), (4, 0), (0.5, 3), (4, 5)])


def test_drawings(tmp_path):
    made = pompeiu.puzzle(6)
    made.write(tmp_path / "pieces.svg")
    assert (tmp_path / "pieces.svg").read_text().count("<path") == 6
    assert [outline.shape for outline in pompeiu.read_outlines(tmp_path / "pieces.svg")] == [
        outline.shape for outline in made.outlines
    ]
    made.write(tmp_path / "cuts.dxf", cuts=True)
    made.write(tmp_path / "page.html")
    assert "</html>" in (tmp_path / "page.html").read_text()
    with pytest.raises(pompeiu.WriteError, match="puzzles are written as"):
        made.write(tmp_path / "pieces.jpg")
    made.write(tmp_path / "pieces.png")
    assert (tmp_path / "pieces.png").read_bytes().startswith(b"\x89PNG")
    with pytest.raises(pompeiu.WriteError, match="no motion"):
        made.write(tmp_path / "motion.svg", motion=True)


def test_the_motion_of_a_free_puzzle_is_drawn(tmp_path):
    free = pompeiu.puzzle(6, tab="none")
    free.write(tmp_path / "motion.svg", motion=True)
    assert "animateTransform" in (tmp_path / "motion.svg").read_text()


def test_a_cut_leaves_a_gap_and_a_picture_lies_on_the_pieces(tmp_path):
    pompeiu.puzzle(6).write(tmp_path / "any.png")
    made = pompeiu.puzzle(6, kerf=0.2)
    assert made.holds and made.report["kerf"]["widest"] >= 0.2 and pompeiu.puzzle(6).holds is None
    assert not pompeiu.puzzle(6, tab="none", kerf=0.2).holds
    made.write(tmp_path / "pieces.svg", image=tmp_path / "any.png")
    assert "data:image/png" in (tmp_path / "pieces.svg").read_text()
    with pytest.raises(pompeiu.ReadError):
        made.write(tmp_path / "pieces.png", image=tmp_path / "none.png")
    with pytest.raises(pompeiu.OptionError, match="kerf"):
        pompeiu.puzzle(6, kerf=-1)


def test_what_makes_no_sense():
    for options, words in [
        ({"pieces": 1}, "the number of pieces is 1"),
        ({"size": (0, 1)}, "width"),
        ({"size": (1,)}, "option `size` of puzzle: found a sequence of length 1"),
        ({"layout": "spiral"}, "option `layout` of puzzle: found `spiral`"),
        ({"corners": True}, "corners is for pieces of a given shape"),
        ({"piece": "star", "layout": "voronoi"}, "piece and layout exclude each other"),
        ({"tab": "glue"}, "option `tab` of puzzle: found `glue`"),
    ]:
        with pytest.raises(pompeiu.OptionError, match=words):
            pompeiu.puzzle(**options)


def test_whimsies_and_outlines_of_whole_pieces():
    angles = 2 * np.pi * np.arange(12) / 12
    star = np.column_stack([np.cos(angles), np.sin(angles)]) * np.where(np.arange(12) % 2, 0.6, 1.0)[:, None]
    made = pompeiu.puzzle(40, layout="voronoi", whimsy=[star], seed=5)
    assert made.is_locked and sum(map(area, made.outlines)) == pytest.approx(60000, rel=1e-9)
    assert max(map(area, made.outlines)) == pytest.approx(2 * 60000 / 40, rel=0.1)
    with pytest.raises(pompeiu.OptionError, match="piece and whimsy exclude each other"):
        pompeiu.puzzle(9, piece="square", whimsy=[star])


def test_a_limit_ends_every_part_early_and_says_so(tmp_path):
    made = pompeiu.puzzle(60, layout="voronoi", kerf=0.2, time_limit=0)
    assert made.stop == "time" and not made.is_locked and not made.holds
    assert sum(map(area, made.outlines)) == pytest.approx(60000, rel=1e-12)
    assert pompeiu.puzzle(4).stop == "tolerance"
    stopped = pompeiu.puzzle(6, piece="square", progress=lambda share: False)
    assert stopped.stop == "cancelled"


def test_a_pickled_puzzle_has_its_outlines_but_no_drawings(tmp_path):
    made = pompeiu.puzzle(4)
    again = pickle.loads(pickle.dumps(made))
    assert again.report == made.report and all(map(np.array_equal, again.outlines, made.outlines))
    with pytest.raises(ValueError, match="pickled"):
        again.write(tmp_path / "pieces.svg")


def test_shapes_in_files_are_read(tmp_path):
    (tmp_path / "star.svg").write_text("<svg><path d='M0-10 2.4-3.2 9.5-3.1 3.8 1.2 5.9 8.1 0 4-5.9 8.1-3.8 1.2-9.5-3.1-2.4-3.2z'/></svg>")
    made = pompeiu.puzzle(8, outline=tmp_path / "star.svg", layout="voronoi")
    assert made.report["area"]["sum"] == pytest.approx(made.report["area"]["outline"], rel=1e-12)
    with pytest.raises(pompeiu.MissingFileError, match="none.svg"):
        pompeiu.puzzle(8, outline=tmp_path / "none.svg")
