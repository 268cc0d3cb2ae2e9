"""On a Ray cluster of two worker processes: the same bits, and a worker that is killed loses nothing."""

import os
import signal
import uuid

import numpy as np
import pompeiu
import pytest

ray = pytest.importorskip("ray")
psutil = pytest.importorskip("psutil")
distributed = pytest.importorskip("pompeiu.ray")

TEMPLATE = pompeiu.shapes.torus(2.0, 0.7, 60, 40)
RNG = np.random.default_rng(7)
TORI = [
    (TEMPLATE.vertices + RNG.normal(scale=scale, size=(TEMPLATE.n_vertices, 3)), TEMPLATE.faces)
    for scale in (0.02, 0.01, 0.05, 0.03, 0.04, 0.015, 0.06, 0.025, 0.035, 0.045)
]


@pytest.fixture(scope="module")
def cluster():
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, configure_logging=False)
    yield
    ray.shutdown()


def dying_once(task, folder, at):
    """The same task, except that the worker kills itself in the midst of the one that is begun as number ``at``, once."""
    perform = task._function

    def performed(*args):
        number = len(os.listdir(folder))
        (folder / str(uuid.uuid4())).touch()
        if number >= at:
            try:
                (folder.parent / "killed").open("x").write(str(os.getpid()))
            except FileExistsError:
                pass
            else:
                os.kill(os.getpid(), signal.SIGKILL)
        return perform(*args)

    return ray.remote(max_retries=distributed.RETRIES)(performed)


@pytest.fixture
def killed(monkeypatch, tmp_path):
    """Makes a task of this name kill its worker half way; gives what tells which worker that was."""

    def kill(name, at):
        folder = tmp_path / "begun"
        folder.mkdir()
        monkeypatch.setattr(distributed, name, dying_once(getattr(distributed, name), folder, at))
        return lambda: int((tmp_path / "killed").read_text())

    return kill


def test_a_ranking_is_the_same_to_the_last_bit(cluster):
    for options in ({"top": 3}, {"top": 2, "all": True, "direction": "to-template"}, {"align": "centroid", "top": 1}):
        assert distributed.rank(TEMPLATE, TORI, **options) == pompeiu.rank(TEMPLATE, TORI, **options)


def test_a_worker_that_is_killed_half_way_loses_nothing(cluster, killed):
    worker = killed("_perform", len(TORI) // 2)
    assert distributed.rank(TEMPLATE, TORI, top=4, all=True) == pompeiu.rank(TEMPLATE, TORI, top=4, all=True)
    assert not psutil.pid_exists(worker())


def test_a_matrix_is_the_same_to_the_last_bit_though_a_worker_is_killed(cluster, killed):
    meshes = TORI[:5]
    worker = killed("_measure", len(meshes) // 2)
    assert distributed.matrix(meshes) == pompeiu.matrix(meshes)
    assert not psutil.pid_exists(worker())


def test_a_file_that_cannot_be_read_has_failed_as_it_does_here(cluster, tmp_path):
    pompeiu.write_mesh(tmp_path / "one.ply", TORI[0])
    files = [tmp_path / "one.ply", tmp_path / "missing.ply"]
    report = distributed.rank(TEMPLATE, files)
    assert report == pompeiu.rank(TEMPLATE, files)
    assert [s.status for s in report] == ["ranked", "failed"]


def test_a_ranking_that_is_stopped_says_what_it_knows(cluster):
    report = distributed.rank(TEMPLATE, TORI, progress=lambda *steps: False)
    assert not report.finished and len(report) == len(TORI)


def test_what_is_wrong_is_said_before_anything_is_sent(cluster):
    with pytest.raises(pompeiu.OptionError, match="the number of threads of a task is 0"):
        distributed.rank(TEMPLATE, TORI, threads=0)
    with pytest.raises(pompeiu.OptionError, match="there are no targets"):
        distributed.rank(TEMPLATE, [])
    with pytest.raises(pompeiu.OptionError, match="the template cannot be aligned to: no face .of 1. has an area"):
        distributed.rank(([[0, 0, 0]], [[0, 0, 0]]), TORI, align="rigid")
    with pytest.raises(pompeiu.OptionError, match="the tolerance is -1"):
        distributed.matrix(TORI, tolerance=-1)


def test_a_sweep_over_neurons_is_the_same_to_the_last_bit(cluster):
    tube = b"1 2 0 0 0 1 -1\n2 2 8 0 0 1 1\n"
    configs = [f'[transport]\nspeed_plus = "{speed} um/s"\nsteps = 3\n' for speed in (0.5, 1)]
    there = pompeiu.ray.sweep_neurons([tube, tube], configs, parts=1)
    here = pompeiu.sweep_neurons([tube, tube], configs, parts=1)
    assert [[found.report for found in row] for row in there] == [[found.report for found in row] for row in here]
    assert all((a.ends == b.ends).all() for rows in zip(there, here) for a, b in zip(*rows))
