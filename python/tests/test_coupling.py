"""Two solvers of one's own, and scenes."""

import numpy as np
import pompeiu
import pytest


def pressure(x):
    """A fluid that reacts eight times as much as the wall lets plain iteration bear."""
    return -8.0 * (x - 1.0)


def wall(y):
    return 0.5 * y


def test_functions_agree_where_plain_iteration_diverges():
    found = pompeiu.couple(pressure, wall, np.zeros(3), tolerance=1e-10)
    assert found.stop == "tolerance" and found.failure is None
    assert found.x.shape == (1, 3) and np.allclose(found.x, 0.8) and np.allclose(found.y, pressure(found.x))
    assert found.runs[0]["added_mass"]["number"] == pytest.approx(4, rel=1e-6)
    plain = pompeiu.couple(pressure, wall, np.zeros(3), scheme="fixed")
    assert plain.stop == "stalled" and "added-mass number" in plain.failure and plain.x.shape == (0, 0)


class Relaxing:
    """A solver with a state: the wall follows half of the way in each window."""

    def __init__(self):
        self.state, self.last, self.rejected = np.zeros(1), None, 0

    def solve(self, y):
        self.last = 0.5 * (self.state + 0.1 * y)
        return self.last

    def accept(self):
        self.state = self.last

    def reject(self):
        self.rejected += 1


def test_objects_with_a_state_go_from_window_to_window():
    solver, shares = Relaxing(), []
    found = pompeiu.couple(lambda x: 1.0 - x, solver, [0.0], windows=5, tolerance=1e-12, progress=shares.append)
    expected, state = [], 0.0
    for _ in range(5):
        # x = (state + 0.1 (1 - x)) / 2
        state = (state + 0.1) / 2.1
        expected.append(state)
    assert found.x[:, 0] == pytest.approx(expected, rel=1e-9) and solver.state[0] == pytest.approx(state)
    assert shares[-1] == 1.0
    assert pompeiu.couple(lambda x: 1.0 - x, Relaxing(), [0.0], windows=5, progress=lambda share: False).stop == "cancelled"


def test_exceptions_of_solvers():
    def broken(x):
        raise RuntimeError("out of order")

    with pytest.raises(RuntimeError, match="out of order"):
        pompeiu.couple(pressure, broken, np.zeros(2))
    with pytest.raises(pompeiu.OptionError, match="output of the second solver has 1 values, expected 2"):
        pompeiu.couple(pressure, lambda y: y[:1], np.zeros(2))

    def refuses(y):
        raise FloatingPointError("the wall tears")

    torn = pompeiu.couple(pressure, refuses, np.zeros(2))
    assert torn.stop == "stalled" and "the wall tears" in torn.failure
    with pytest.raises(pompeiu.OptionError, match="solvers that are given can run once only"):
        pompeiu.couple(pressure, wall, np.zeros(2), compare=True)
    with pytest.raises(pompeiu.OptionError, match="second solver"):
        pompeiu.couple(pressure, None, None)


def test_scenes_are_those_of_the_command(tmp_path):
    scene = tmp_path / "tube.toml"
    scene.write_text("kind = 'tube'\nwindows = 3\n")
    found = pompeiu.couple(scene, tolerance=1e-5)
    assert found.x.shape == (3, 101) and found.runs[0]["from_monolithic"] < 1e-4
    found.save_html(tmp_path / "tube.html")
    page = (tmp_path / "tube.html").read_text()
    assert page.startswith("<!DOCTYPE html>") and "Coupling: tube" in page
    compared = pompeiu.couple(scene, compare=True)
    assert len(compared.runs) == 7
    with pytest.raises(pompeiu.OptionError, match="one run of a scene"):
        compared.save_html(tmp_path / "all.html")
    assert pompeiu.couple(scene, time_limit=0).stop == "time"
    scene.write_text("kind = 'tube'\n[tube]\nmodulos = 1\n")
    with pytest.raises(pompeiu.ReadError, match="did you mean `modulus`"):
        pompeiu.couple(scene)
    with pytest.raises(pompeiu.MissingFileError):
        pompeiu.couple(tmp_path / "none.toml")
