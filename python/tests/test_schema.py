"""Real answers of every command are what the published schemas say, and those of the package are the same."""

import json
import math
import os
import subprocess

import jsonschema
import pompeiu
import pytest

COMMANDS = {
    "distance": [
        "distance tent.obj square.obj",
        "distance tent.obj square.obj --direction a-to-b --tolerance 1e-3 --tolerance-kind relative",
        "distance tent.obj square.obj --trace --within 2",
        "distance tent.obj square.obj --certificate again.phc",
        "distance tent.obj square.obj --certificate none.phc --time-limit 0s",
        "distance rough.obj square.obj --time-limit 1ns",
        "distance huge.obj square.obj --tolerance-kind absolute --tolerance 1",
    ],
    "deviation": [
        "deviation tent.obj square.obj",
        "deviation tent.obj square.obj --within 0.3 --signed --regions 2 --percentiles 5,50 --unit mm",
        "deviation tent.obj square.obj --band -0.1..0.3 --band -0.2..0 --allow 10%",
        "deviation tent.obj square.obj --only-overlap --ignore-components 0.1%",
        "deviation points.obj square.obj",
        "deviation huge.obj square.obj",
        "deviation rough.obj square.obj --time-limit 1ns",
    ],
    "rank": [
        "rank tent.obj square.obj rough.obj points.obj --top 1",
        "rank tent.obj square.obj missing.obj nothing/*.obj --align rigid --all --tolerance 1e-3",
        "rank tent.obj square.obj --direction to-template --align centroid",
        "rank tent.obj square.obj rough.obj --time-limit 0s --tolerance-kind absolute",
    ],
    "matrix": [
        "matrix tent.obj square.obj missing.obj",
        "matrix tent.obj square.obj --directed --tolerance 0.1",
        "matrix tent.obj square.obj --time-limit 0s",
    ],
    "info": ["info tent.obj", "info points.obj", "info huge.obj --intersections", "info torus.ply.gz"],
    "repair": [
        "repair rough.obj repaired.ply",
        "repair rough.obj repaired.obj --within 0.1",
        "repair rough.obj proven.obj --within 0.1 --certificate proven.phc",
    ],
    "align": [
        "align rough.obj tube.obj",
        "align tube.obj rough.obj --scale --robust 0.9 -o moved.obj",
    ],
    "remesh": [
        "remesh rough.obj -o even.ply --edge-length 0.1",
        "remesh rough.obj -o adapted.ply --adaptive 0.02 --within 0.1 --features 60",
    ],
    "cut": ["cut torus.ply.gz -o opened.obj", "cut rough.obj --strategy euclidean --cuts 2"],
    "medial": ["medial torus.ply.gz --balls 12 --samples 300", "medial torus.ply.gz --samples 300 -o balls.ma --time-limit 0s"],
    "complexity": [
        "complexity shapes missing.png",
        "complexity shapes --clusters 2 --against places.csv",
    ],
    "puzzle": ["puzzle --pieces 9", "puzzle --pieces 12 --tab none --layout voronoi", "puzzle --pieces 6 --piece square", "puzzle --pieces 6 --kerf 0.2"],
    "verify": ["verify proof.phc tent.obj square.obj", "verify proof.phc square.obj tent.obj"],
    "flatten": [
        "flatten torus.ply.gz -o flat.glb",
        "flatten torus.ply.gz --boundary circle --weights uniform -o flat.svg",
        "flatten tent.obj --time-limit 0s",
    ],
    "flow": [
        "flow tube.obj",
        "flow rough.obj --until time:0.01 -o flowed.ply",
        "flow rough.obj --volume keep --until steps:3 -o bubble.ply",
    ],
    "fluid": [
        "fluid torus.ply.gz --velocity rotation:z --viscosity 0.1 --steps 3 --dt 0.1 --density x^2",
        "fluid rough.obj --vorticity x*y --steps 2 --dt 0.05 --scheme any-step",
        "fluid --square 12 --lid 1 --viscosity 0.01 --steps 2 --dt 0.1",
    ],
    "contact": ["contact collision --steps 2", "contact incline --steps 3 --check never", "contact stack --time-limit 0s"],
    "couple": ["couple tube.toml", "couple tube.toml --compare", "couple tube.toml --scheme fixed"],
    "simplify": [
        "simplify rough.obj -o simple.ply --within 0.1",
        "simplify rough.obj -o few.ply --faces 200",
    ],
    "neuron": [
        "neuron check cell.swc",
        "neuron check cell.swc --repair --smooth 2 --spacing 0.5 -o smooth.swc",
        "neuron mesh cell.swc --repair --parts 1 -o cell.vtu",
        "neuron spline fork.swc -o patches.vtu",
        "neuron spline fork.swc --refine nodes -o refined.vtu",
        "neuron flow fork.swc -o flow.vtu --bezier",
        "neuron transport cell.swc --repair --parts 1 --config run.toml -o run.pvd",
        "neuron fork.swc --parts 1 --config run.toml --tips tips.csv",
        "neuron mesh fork.swc --parts 1 --partition 3 --extraction splines",
    ],
    "decompose": ["decompose torus.ply.gz", "decompose torus.ply.gz --field rotation:z --splitting dual"],
}

SHAPES = [
    "tent -o tent.obj",
    "grid --size 2,2 -o square.obj",
    "schwarz-lantern --segments 24 --bands 8 --height 1 -o tube.obj",
    "icosphere --noise 0.05 -o rough.obj",
    "point-lattice --cells 2 -o points.obj",
    "cube --side 1e160 -o huge.obj",
    "torus --major-segments 12 --minor-segments 8 -o torus.ply.gz",
]


@pytest.fixture(scope="module")
def run(repository, tmp_path_factory):
    """Runs the command in a folder of meshes; gives what it printed, without times."""
    target = os.environ.get("CARGO_TARGET_DIR") or repository / "target"
    folder = tmp_path_factory.mktemp("meshes")

    def run(arguments):
        done = subprocess.run([f"{target}/debug/pompeiu", *arguments.split()], cwd=folder, capture_output=True, text=True)
        assert done.stdout or done.returncode == 0, done.stderr
        return done.stdout

    for shape in SHAPES:
        run(f"generate {shape}")
    run("distance tent.obj square.obj --certificate proof.phc")
    (folder / "cell.swc").write_text("1 1 0 0 0 5 -1\n2 3 6 0 0 1 1\n3 3 20 0 0 1 2\n4 3 20 1 0 0 1\n", encoding="utf-8")
    (folder / "shapes").mkdir()
    (folder / "shapes" / "circle.svg").write_text('<svg><circle r="9"/></svg>')
    (folder / "shapes" / "arch.svg").write_text('<svg><path d="M0 0h9v9h-3V3H3v6H0z"/></svg>')
    (folder / "tube.toml").write_text('kind = "tube"\nwindows = 3\n')
    (folder / "places.csv").write_text("circle,1\narch,2\n")
    (folder / "fork.swc").write_text("1 2 0 0 0 1 -1\n2 2 6 0 0 1 1\n3 2 12 5 0 1 2\n4 2 12 -5 0 1 2\n", encoding="utf-8")
    (folder / "run.toml").write_text("[transport]\nsteps = 3\n[inlet]\nsample = 3\n", encoding="utf-8")
    run.folder = folder
    return run


def schema(repository, name):
    return json.loads((repository / "docs" / "guide" / "pages" / "schema" / f"{name}.json").read_text(encoding="utf-8"))


def closed(part, branch=False):
    """The same schema, but a key that neither it nor a branch of it names is an error."""
    if isinstance(part, dict):
        is_object = "properties" in part and isinstance(part["properties"], dict) and part.get("type") == "object"
        branches = {key: [closed(one, is_object) for one in part[key]] for key in ("oneOf", "anyOf") if key in part}
        part = {key: closed(value) for key, value in part.items() if key not in branches} | branches
        if is_object and not branch:
            part["unevaluatedProperties"] = False
        return part
    return [closed(one) for one in part] if isinstance(part, list) else part


def test_there_is_a_schema_for_every_command_that_has_answers(repository):
    files = (repository / "docs" / "guide" / "pages" / "schema").iterdir()
    assert sorted(file.stem for file in files) == sorted(COMMANDS)
    page = (repository / "docs" / "guide" / "pages" / "json.md").read_text(encoding="utf-8")
    assert all(f"(schema/{name}.json)" in page for name in COMMANDS)


@pytest.mark.parametrize("name, arguments", [(name, one) for name, all in COMMANDS.items() for one in all])
def test_answers_are_what_their_schema_says(repository, run, name, arguments):
    strict = closed(schema(repository, name))
    jsonschema.Draft202012Validator.check_schema(strict)
    answer = json.loads(run(f"{arguments} --json"))
    jsonschema.Draft202012Validator(strict).validate(answer)
    # A key that is always there cannot be left out, and none can be added.
    for required in strict["required"]:
        less = {key: value for key, value in answer.items() if key != required}
        assert not jsonschema.Draft202012Validator(strict).is_valid(less), required
    assert not jsonschema.Draft202012Validator(strict).is_valid({**answer, "other": 1})


def test_the_package_and_the_command_give_the_same_answers(run):
    paths = [run.folder / "tent.obj", run.folder / "square.obj"]
    answer = json.loads(run("deviation tent.obj square.obj --within 0.3 --json"))["report"]
    report = pompeiu.deviation(*paths, threshold=0.3)
    for way in ("a_to_b", "b_to_a"):
        ours, theirs = getattr(report, way), answer[way]
        assert (ours.lower, ours.upper) == (theirs["distance"]["lower"], theirs["distance"]["upper"])
        assert ours.statistics.mean == pompeiu.Enclosure(**theirs["statistics"]["mean"])
        assert ours.statistics.above == pompeiu.ShareAbove(
            0.3, pompeiu.Enclosure(**theirs["statistics"]["share_above_threshold"])
        )
        assert ours.statistics.histogram.edges.tolist() == theirs["statistics"]["histogram"]["edges"]
        assert [region.faces.tolist() for region in ours.regions] == [region["faces"] for region in theirs["regions"]]
        ends = (ours.witness.from_, ours.witness.to) if way == "a_to_b" else (ours.witness.to, ours.witness.from_)
        for ours, theirs in zip(ends, (theirs["witness"]["a"], theirs["witness"]["b"])):
            assert json.loads(json.dumps(ours.to_dict())) == theirs
    answer = json.loads(run("distance tent.obj square.obj --json"))["report"]
    report = pompeiu.hausdorff(*paths)
    assert (report.lower, report.upper) == (answer["hausdorff"]["lower"], answer["hausdorff"]["upper"])
    assert vars(report.b_to_a.work) == answer["b_to_a"]["work"] and report.b_to_a.stop == answer["b_to_a"]["stop"]


def test_an_area_beyond_double_precision_is_null_in_json_and_infinite_here(run):
    assert json.loads(run("info huge.obj --json"))["report"]["area"] is None
    huge = pompeiu.read_mesh(run.folder / "huge.obj")
    assert pompeiu.mesh_summary(huge).area == math.inf
