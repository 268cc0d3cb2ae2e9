"""While a search runs: other threads run too, progress is told, and it can be stopped."""

import os
import signal
import subprocess
import sys
import threading

import pompeiu
import pytest
from interrupting import ends_by_interrupt

#: Takes the textbook method longer than anyone would wait; nothing here waits for it to end.
ENDLESS = {"method": "classic", "tolerance": 1e-12}
SPHERES = (pompeiu.shapes.icosphere(1.0, 4), pompeiu.shapes.icosphere(1.01, 4))


def test_false_from_the_callback_ends_the_search_with_what_is_proven():
    told = []

    def watch(progress):
        told.append(progress)
        return len(told) < 3

    report = pompeiu.directed_hausdorff(*SPHERES, progress=watch, **ENDLESS)
    assert report.stop == "cancelled" and len(told) == 3
    assert report.lower <= pompeiu.directed_hausdorff(*SPHERES).upper
    assert pompeiu.directed_hausdorff(*SPHERES).lower <= report.upper
    assert all(isinstance(progress, pompeiu.Progress) and progress.direction == "a_to_b" for progress in told)
    assert [progress.examined for progress in told] == sorted(progress.examined for progress in told)
    assert told[-1].left > 0 and told[-1].lower <= told[-1].upper


def test_what_the_callback_raises_is_raised():
    def watch(progress):
        raise LookupError(f"at {progress.examined}")

    with pytest.raises(LookupError, match="at [0-9]+"):
        pompeiu.hausdorff(*SPHERES, progress=watch, **ENDLESS)


def test_other_threads_run_and_the_callback_is_called_where_the_search_was_asked_for():
    steps, where, enough = [], [], threading.Event()

    def count():
        while not enough.is_set():
            steps.append(None)
            enough.wait(0.001)

    def watch(progress):
        where.append(threading.current_thread())
        return len(steps) < 20

    other = threading.Thread(target=count)
    other.start()
    try:
        report = pompeiu.directed_hausdorff(*SPHERES, progress=watch, **ENDLESS)
    finally:
        enough.set()
        other.join()
    assert report.stop == "cancelled" and len(steps) >= 20
    assert set(where) == {threading.main_thread()}


def test_searches_of_two_threads_do_not_meet():
    expected = pompeiu.hausdorff(*SPHERES)
    answers = []
    threads = [threading.Thread(target=lambda: answers.append(pompeiu.hausdorff(*SPHERES))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert answers == [expected] * 4


INTERRUPTED = """
import pompeiu, threading
a, b = pompeiu.shapes.icosphere(1.0, 4), pompeiu.shapes.icosphere(1.01, 4)
searching = lambda *told: print("searching", flush=True)
try:
    if WATCHED:
        watch = searching
    else:
        watch = None
        threading.Timer(0.2, searching).start()
    pompeiu.hausdorff(a, b, method="classic", tolerance=1e-12, progress=watch)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.skipif(os.name == "nt", reason="signals are sent otherwise there")
@pytest.mark.parametrize("watched", [True, False])
def test_ctrl_c_stops_a_search(watched):
    program = INTERRUPTED.replace("WATCHED", str(watched))
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout.readline() == "searching\n"
        child.send_signal(signal.SIGINT)
        rest = child.stdout.read()
    assert rest.endswith("interrupted\n") and child.returncode == 0


#: Calls beside requests that take far longer than a signal, each with what it needs, which is made first.
LONG = {
    "Template": "sphere = pompeiu.shapes.icosphere(1.0, 8)|pompeiu._native.Template(sphere, '{\"align\": \"rigid\"}')",
    "Target": "sphere = pompeiu.shapes.icosphere(1.0, 8)|pompeiu.Target(sphere)",
    "HodgeDecomposition": "torus = pompeiu.shapes.torus(2.0, 1.0, 500, 250)|pompeiu.HodgeDecomposition(torus)",
    "Simulation": "torus = pompeiu.shapes.torus(2.0, 1.0, 500, 250)|pompeiu.Simulation(torus, viscosity=0.1, dt=0.01)",
}


@pytest.mark.parametrize("call", LONG)
def test_ctrl_c_ends_whatever_is_under_way(call):
    ends_by_interrupt(LONG[call])


def test_a_bar_is_drawn_where_tqdm_is(capsys):
    pytest.importorskip("tqdm")
    pompeiu.hausdorff(pompeiu.shapes.icosphere(1.0, 6), pompeiu.shapes.icosphere(1.01, 6), progress=True)
    assert "A to B: " in capsys.readouterr().err


def test_without_tqdm_there_is_no_bar(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    assert pompeiu.hausdorff(*SPHERES, progress=True) == pompeiu.hausdorff(*SPHERES)
    assert capsys.readouterr().err == ""
