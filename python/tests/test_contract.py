"""What holds of every function that asks a request: options of a file, limits, answers as of the command, Ctrl-C."""

import inspect
import json
import os
import subprocess

import numpy as np
import pompeiu
import pytest
from interrupting import ends_by_interrupt

#: For each function the files, and options as `--config` has them. The first of two are the arguments of the command.
CALLS = {
    "align": ("dense.obj turned.obj", ["dense.obj", "turned.obj"], "overlap = 0.9\nmeasure = false\n"),
    "complexity": ("shapes", ["shapes"], 'rank_by = "boundary-25"\nfeatures = ["convexity"]\nclusters = 2\n'),
    "contact": ("crash.toml", ["crash.toml"], 'steps = 2\ndt = 0.02\npairs = "plain"\ncheck = "last"\n'),
    "couple": ("tube.toml", ["tube.toml"], 'windows = 3\nscheme = "two-models"\nextrapolate = 1\n'),
    "cut": ("dense.obj", ["dense.obj"], 'strategy = "tips"\navoid_curvature = 0.5\n'),
    "decompose": ("dense.obj", ["dense.obj"], 'field = "gradient:x*y"\nsplitting = "dual"\nboundary = "normal"\n'),
    "deviation": (
        "dense.obj turned.obj",
        ["dense.obj", "turned.obj"],
        'bands = [["-1000um", "2mm"]]\nunit = "mm"\nallow = 0.05\naccuracy = 0.1\npercentiles = [50, 99]\n',
    ),
    "distance": (
        "dense.obj turned.obj",
        ["dense.obj", "turned.obj"],
        'direction = "b-to-a"\ntolerance = 1e-3\ntolerance_kind = "relative"\n',
    ),
    "flatten": ("dense.obj", ["dense.obj"], 'strategy = "genus"\nboundary = "circle"\nvirtual_layers = 1\npack = false\n'),
    "flow": ("dense.obj", ["dense.obj"], 'until = "steps:2"\nscheme = "conformalized"\ntime_step = 0.001\nkeep_angles = false\n'),
    "fluid": ("dense.obj", ["dense.obj"], 'steps = 2\ndt = 0.01\nvorticity = "z"\n[[density]]\ninitial = "x^2"\n'),
    "info": ("dense.obj", ["dense.obj"], "intersections = true\n"),
    "matrix": ("dense.obj turned.obj", [["dense.obj", "turned.obj"]], "directed = true\ntolerance = 1e-3\n"),
    "medial": ("dense.obj", ["dense.obj"], "balls = 4\nsamples = 40\ntolerance = 0.01\n"),
    "neuron": ("rod.swc", ["rod.swc"], 'stage = "transport"\nparts = 1\nwithin = 0.3\nlayer = 3\n[transport]\nsteps = 5\norder = 2\n'),
    "puzzle": ("", [], 'pieces = 9\nlayout = "voronoi"\ntab = "dovetail"\nsize = [80, 80]\n'),
    "rank": ("dense.obj turned.obj dense.obj", ["dense.obj", ["turned.obj", "dense.obj"]], 'top = 1\nalign = "centroid"\n'),
    "remesh": ("dense.obj -o even.obj", ["dense.obj"], "relative = 0.1\nfeatures = 60\niterations = 3\n"),
    "repair": ("dense.obj mended.obj", ["dense.obj"], "weld = 0.001\nfill_holes = 5\nwithin = 0.1\n"),
    "simplify": ("dense.obj -o few.obj", ["dense.obj"], 'faces = 300\neffort = "fast"\nlevels = 2\nprecision = "single"\n'),
}

#: The limits that a function may offer, each with a value that ends it at once.
LIMITS = {"threads": 1, "time_limit": 0, "memory_limit": 1}


@pytest.fixture(scope="module")
def run(repository, tmp_path_factory):
    """Runs the command in a folder of files; gives what it printed, and its exit code."""
    target = os.environ.get("CARGO_TARGET_DIR") or repository / "target"
    folder = tmp_path_factory.mktemp("contract")

    def run(arguments):
        done = subprocess.run([f"{target}/debug/pompeiu", *arguments.split()], cwd=folder, capture_output=True, text=True)
        assert done.returncode in (0, 3), done.stderr
        return done.stdout

    run("generate torus --major-segments 48 --minor-segments 32 -o dense.obj")
    run("generate torus --major-segments 40 --minor-segments 24 --rotate 1,0,0,30 -o turned.obj")
    (folder / "shapes").mkdir()
    run("generate polyline --order angle --points 9 -o shapes/a.svg")
    run("generate noisy-circle --radius 8 -o shapes/b.svg")
    (folder / "tube.toml").write_text("kind = 'tube'\nwindows = 4\n[tube]\nsegments = 20\n")
    (folder / "crash.toml").write_text("kind = 'collision'\ncells = 1\n")
    (folder / "rod.swc").write_text("1 2 0 0 0 1 -1\n2 2 12 0 0 1 1\n")
    run.folder = folder
    return run


@pytest.fixture
def asked(run, monkeypatch):
    """Calls a function in the folder of the files; gives the whole answer, which is what the command prints."""
    monkeypatch.chdir(run.folder)
    answers = []

    def spied(native):
        def spy(*arguments):
            answer, beside = native(*arguments)
            answers.append(json.loads(answer))
            return answer, beside

        return spy

    for name in ("ask", "simplify"):
        monkeypatch.setattr(pompeiu._native, name, spied(getattr(pompeiu._native, name)))

    def asked(name, **options):
        answers.clear()
        getattr(pompeiu, name)(*CALLS[name][1], **options)
        (answer,) = answers
        return answer

    return asked


def options_of(run, name):
    (run.folder / f"{name}-options.toml").write_text(CALLS[name][2])
    return pompeiu.read_options(run.folder / f"{name}-options.toml")


def without_times(value):
    """An answer without its times, and without what is said of files alone."""
    if isinstance(value, dict):
        kept = {key: item for key, item in value.items() if not key.endswith("_ms") and key not in ("file", "path")}
        return {key: without_times(item) for key, item in kept.items()}
    return [without_times(item) for item in value] if isinstance(value, list) else value


def test_every_function_that_asks_a_request_is_here(repository):
    schemas = {file.stem for file in (repository / "docs" / "guide" / "pages" / "schema").iterdir()}
    # A certificate is checked by a program of its own, without options.
    assert schemas == set(CALLS) | {"verify"} and all(callable(getattr(pompeiu, name)) for name in schemas)


@pytest.mark.parametrize("name", CALLS)
def test_options_of_a_file_give_the_answer_of_the_command(run, asked, name):
    ours = asked(name, **options_of(run, name))
    config = f"{name}-options.toml"
    stage = "transport " if name == "neuron" else ""
    theirs = json.loads(run(f"{name} {stage}{CALLS[name][0]} --config {config} --json"))
    assert without_times(ours["request"]) == without_times(theirs["request"])
    assert without_times(ours["report"]) == without_times(theirs["report"])
    assert (ours["command"], ours["version"], ours["stop"]) == (theirs["command"], theirs["version"], theirs["stop"])


@pytest.mark.parametrize("name", CALLS)
def test_limits_that_are_offered_act_and_others_are_not_there(run, asked, name):
    offered = inspect.signature(getattr(pompeiu, name)).parameters
    # Memory is limited for the proof, which `measure` leaves out.
    given = {key: value for key, value in options_of(run, name).items() if key != "measure"}
    for limit, value in LIMITS.items():
        options = {**given, limit: value}
        if limit not in offered:
            with pytest.raises(TypeError, match=limit):
                asked(name, **options)
        elif limit == "threads":
            with pytest.raises(pompeiu.OptionError, match="the number of threads is 0"):
                asked(name, **{**options, "threads": 0})
        else:
            assert asked(name, **options)["stop"] == limit.split("_")[0], limit


@pytest.mark.parametrize("name", CALLS)
def test_unknown_options_and_wrong_ones_are_named(run, asked, name):
    with pytest.raises(TypeError, match="no_such_option"):
        asked(name, **options_of(run, name), no_such_option=1)
    options = options_of(run, name)
    numbers = [key for key, value in options.items() if isinstance(value, (int, float)) and not isinstance(value, bool)]
    for key in numbers:
        with pytest.raises(pompeiu.OptionError, match=key):
            asked(name, **{**options, key: float("nan")})


#: A call of each function that takes far longer than a signal, with what it needs, which is made first.
LONG = {
    "align": "ball = pompeiu.shapes.icosphere(1.0, 7)|pompeiu.align(ball, ball)",
    "complexity": "import numpy as np; t = np.linspace(0, 6.28, 40000); shapes = [np.stack([np.cos(t) * (9 + np.sin(k * t)), np.sin(t)], 1) for k in range(99)]"
    "|pompeiu.complexity(shapes)",
    "contact": "pass|pompeiu.contact('rod-twist', steps=5000)",
    "couple": "open('long.toml', 'w').write(\"kind = 'box'\\nwindows = 5000\\n\")|pompeiu.couple('long.toml')",
    "cut": "torus = pompeiu.shapes.torus(2.0, 1.0, 800, 400)|pompeiu.cut(torus)",
    "decompose": "torus = pompeiu.shapes.torus(2.0, 1.0, 500, 250)|pompeiu.decompose(torus, field='rotation:z')",
    "deviation": "a, b = pompeiu.shapes.icosphere(1.0, 7), pompeiu.shapes.icosphere(1.01, 6)|pompeiu.deviation(a, b, accuracy=1e-6)",
    "distance": "ball = pompeiu.shapes.icosphere(1.0, 8)|pompeiu.distance(ball, ball, tolerance=1e-15)",
    "flatten": "ball = pompeiu.shapes.icosphere(1.0, 7)|pompeiu.flatten(ball)",
    "flow": "ball = pompeiu.shapes.icosphere(1.0, 7)|pompeiu.flow(ball, until='steps:500')",
    "fluid": "torus = pompeiu.shapes.torus(2.0, 1.0, 200, 100)|pompeiu.fluid(torus, vorticity='z', steps=5000, dt=0.001)",
    "info": "ball = pompeiu.shapes.icosphere(1.0, 9)|pompeiu.info(ball, intersections=True)",
    "matrix": "ball = pompeiu.shapes.icosphere(1.0, 8)|pompeiu.matrix([ball, ball], tolerance=1e-15)",
    "medial": "ball = pompeiu.shapes.icosphere(1.0, 6)|pompeiu.medial(ball, balls=200)",
    "neuron": "cell = b'1 2 0 0 0 1 -1\\n' + b''.join(b'%d 2 %d %d 0 1 %d\\n' % (i, 3 * i, i % 3, i - 1) for i in range(2, 400))|pompeiu.neuron(cell, parts=1)",
    "puzzle": "pass|pompeiu.puzzle(3000, layout='voronoi')",
    "rank": "ball = pompeiu.shapes.icosphere(1.0, 8)|pompeiu.rank(ball, [ball], align='rigid')",
    "remesh": "ball = pompeiu.shapes.icosphere(1.0, 7)|pompeiu.remesh(ball, relative=0.003)",
    "repair": "ball = pompeiu.shapes.icosphere(1.0, 8)|pompeiu.repair(ball, within=0.1)",
    "simplify": "ball = pompeiu.shapes.icosphere(1.0, 7)|pompeiu.simplify(ball, faces=100)",
}

@pytest.mark.parametrize("name", CALLS)
def test_ctrl_c_ends_every_function(name, tmp_path):
    ends_by_interrupt(LONG[name], tmp_path)


def arrays_of(answer):
    """The arrays of an answer by name, also those in lists and dictionaries, and those of what it consists of."""
    for name in dir(answer):
        if name.startswith("_"):
            continue
        value = getattr(answer, name)
        if isinstance(value, (list, tuple)):
            members = value
        elif isinstance(value, dict):
            members = list(value.values())
        else:
            members = [value]
        for member in members:
            if isinstance(member, np.ndarray):
                yield f"{type(answer).__name__}.{name}", member
            elif type(member).__module__.startswith("pompeiu") and not callable(member):
                yield from arrays_of(member)


def test_arrays_of_answers_are_read_only():
    torus = pompeiu.shapes.torus(1.0, 0.4, 16, 12)
    fluid = pompeiu.Simulation(torus, dt=0.01, densities={"dye": {"initial": np.ones(torus.n_vertices)}})
    square = pompeiu.SquareSimulation(8, dt=0.01, densities={"dye": {"initial": np.ones((8, 8))}})
    decomposition = pompeiu.HodgeDecomposition(torus)
    skeleton = pompeiu.read_skeleton(b"1 2 0 0 0 1 -1\n2 2 9 0 0 1 1\n")
    answers = [
        fluid,
        square,
        decomposition,
        decomposition.decompose(np.ones((torus.n_faces, 3))),
        skeleton,
        pompeiu.cut(torus),
        pompeiu.couple(lambda x: 0.5 * x, lambda y: 0.5 * y, np.zeros(2)),
        pompeiu.align(torus, torus),
        pompeiu.repair(torus, weld=0.0),
    ]
    found = [pair for answer in answers for pair in arrays_of(answer)]
    assert len({name for name, _ in found}) >= 20, {name for name, _ in found}
    assert [name for name, array in found if array.flags.writeable] == []
