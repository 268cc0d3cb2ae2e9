"""Bodies in contact: scenes, meshes in memory, a callback after each step."""

import pickle

import numpy as np
import pompeiu
import pytest

FLOOR = {"obstacle": [{"normal": [0, 0, 1]}], "body": [{"move": [0, 0, 1.1]}]}
BALL = pompeiu.shapes.icosphere(1.0, 1)


def test_a_scene_gives_arrays_and_a_certificate():
    found = pompeiu.contact("collision", steps=2)
    assert found.stop == "steps" and found.intersections == 0 and found.failure is None
    assert found.positions.shape == found.velocities.shape == (128, 3) and found.faces.shape == (216, 3)
    assert [step["intersections"] for step in found.steps] == [0, 0]
    assert pompeiu.contact("collision", steps=2, check="never").intersections is None


def test_a_callback_gets_each_step_and_may_end_the_run():
    heights = []

    def on_step(step, positions, velocities):
        heights.append(positions[:, 2].min())
        assert step["intersections"] == 0 and velocities.shape == positions.shape
        return len(heights) < 3

    found = pompeiu.contact(FLOOR, [BALL], on_step, steps=9, dt=0.01)
    assert found.stop == "cancelled" and len(found.steps) == len(heights) == 3
    assert heights[0] > heights[1] > heights[2] == found.positions[:, 2].min() > 0


def test_the_page_of_a_run(tmp_path):
    found = pompeiu.contact("collision", steps=2)
    found.save_html(tmp_path / "collision.html")
    page = (tmp_path / "collision.html").read_text()
    assert page.startswith("<!DOCTYPE html>") and "Contact: collision" in page and "0 intersecting pairs in 2 of 2 steps, exact" in page
    again = pickle.loads(pickle.dumps(found))
    assert (again.positions == found.positions).all()
    with pytest.raises(ValueError, match="pickled"):
        again.save_html(tmp_path / "again.html")


def test_an_exception_of_the_callback_is_raised():
    def on_step(step, positions, velocities):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        pompeiu.contact(FLOOR, [BALL], on_step, steps=9, dt=0.01)


def test_tetrahedra_are_solids_and_surfaces_are_not():
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    # In either orientation.
    for cell in ([0, 1, 2, 3], [0, 2, 1, 3]):
        found = pompeiu.contact(FLOOR, [(vertices, np.array([cell]))], steps=2, dt=0.01)
        assert found.report["tetrahedra"] == 1 and found.faces.shape == (4, 3)
    with pytest.raises(pompeiu.OptionError, match="fill it with tetrahedra"):
        pompeiu.contact({"body": [{"kind": "solid"}]}, [BALL], steps=1)
    with pytest.raises(pompeiu.OptionError, match="the start intersects: face"):
        pompeiu.contact({"body": [{}, {"move": [0.5, 0, 0]}]}, [BALL, BALL], steps=1)
    with pytest.raises(pompeiu.ReadError, match="did you mean `friction`"):
        pompeiu.contact({"fricton": 1}, [BALL])
    with pytest.raises(pompeiu.MissingFileError, match="there is no scene"):
        pompeiu.contact("nowhere.toml")


def test_a_run_goes_on_from_a_checkpoint_bit_for_bit(tmp_path):
    whole = pompeiu.contact("collision", steps=4)
    half = pompeiu.contact("collision", steps=2)
    half.save_checkpoint(tmp_path / "half.json")
    seen = []
    for state in (half.checkpoint, tmp_path / "half.json"):
        rest = pompeiu.contact("collision", (), lambda step, *_: seen.append(step["time"]), state, steps=4)
        assert (rest.positions == whole.positions).all() and (rest.velocities == whole.velocities).all()
        assert rest.steps == whole.steps
    assert len(seen) >= 4
    with pytest.raises(pompeiu.OptionError, match="other bodies"):
        pompeiu.contact("stack", resume=half.checkpoint)
    with pytest.raises(pompeiu.ReadError, match="nothing.json"):
        pompeiu.contact("collision", resume=tmp_path / "nothing.json")
