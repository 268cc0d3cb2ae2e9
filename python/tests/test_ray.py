"""On a Ray cluster of two worker processes: the same bits, and a worker that is killed loses nothing."""

import os
import signal
import time

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


def working():
    """The processes of this cluster that do a task just now."""
    found = []
    for process in psutil.Process().children(recursive=True):
        try:
            if " ".join(process.cmdline()).startswith(("ray::_perform", "ray::_measure")):
                found.append(process)
        except psutil.Error:
            pass
    return found


class KillOneHalfWay:
    """Kills a process that is at work when half of the tasks of a round are done, once."""

    def __init__(self):
        self.killed = None

    def __call__(self, done, all, settled, of):
        if self.killed is None and done == all // 2:
            while not (at_work := working()):
                time.sleep(0.001)
            self.killed = at_work[0].pid
            os.kill(self.killed, signal.SIGKILL)


def test_a_ranking_is_the_same_to_the_last_bit(cluster):
    for options in ({"top": 3}, {"top": 2, "all": True, "measure": "target_to_template"}, {"alignment": "centroid", "top": 1}):
        assert distributed.rank(TEMPLATE, TORI, **options) == pompeiu.rank(TEMPLATE, TORI, **options)


def test_a_worker_that_is_killed_half_way_loses_nothing(cluster):
    kill = KillOneHalfWay()
    assert distributed.rank(TEMPLATE, TORI, top=4, all=True, progress=kill) == pompeiu.rank(TEMPLATE, TORI, top=4, all=True)
    assert kill.killed is not None and not psutil.pid_exists(kill.killed)


def test_a_matrix_is_the_same_to_the_last_bit_though_a_worker_is_killed(cluster):
    kill = KillOneHalfWay()
    meshes = TORI[:5]
    assert distributed.distance_matrix(meshes, progress=kill) == pompeiu.distance_matrix(meshes)
    assert kill.killed is not None


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
    with pytest.raises(pompeiu.OptionError, match="the template cannot be aligned to: none of the 1 faces has an area"):
        distributed.rank(([[0, 0, 0]], [[0, 0, 0]]), TORI, alignment="rigid")
    with pytest.raises(pompeiu.OptionError, match="the tolerance is -1"):
        distributed.distance_matrix(TORI, tolerance=-1)
