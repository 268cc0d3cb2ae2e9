"""The pairs of meshes that are measured: made by `pompeiu generate`, or found in a folder.

A folder of pairs holds one folder for each pair, and that a mesh `a` and a mesh `b`, each in any format that pompeiu
reads: `scans/left/a.ply`, `scans/left/b.stl.gz`, `scans/right/a.obj`, ... What is measured is the distance from a to b.
"""

import dataclasses
import json
import pathlib
import subprocess

import arrays
import environment

# Name: what it stands for, and how both meshes are made.
GENERATED = {
    "waved_sphere": (
        "curved, deformed smoothly",
        "icosphere --subdivisions 6", "icosphere --subdivisions 6 --ripple 0.02,1",
    ),
    "lantern_vs_cylinder": (
        "curved, many nearly largest places",
        "schwarz-lantern --segments 48 --bands 192", "cylinder --segments 256 --rows 64",
    ),
    "noisy_sphere": (
        "curved, noisy",
        "icosphere --subdivisions 6", "icosphere --subdivisions 6 --noise 1e-4 --seed 1",
    ),
    "coarse_torus": (
        "fine against coarse",
        "torus --major-segments 256 --minor-segments 128", "torus --major-segments 64 --minor-segments 32",
    ),
    "fine_torus": (
        "coarse against fine",
        "torus --major-segments 64 --minor-segments 32", "torus --major-segments 256 --minor-segments 128",
    ),
    "thin_plate": (
        "thin: two sides closer than the noise",
        "box --size 1,1,0.001 --cells 60 --noise 0.002 --seed 1", "box --size 1,1,0.001 --cells 60 --noise 0.002 --seed 2",
    ),
    "needles": (
        "faces 600 times as long as wide",
        "cylinder --segments 2000 --rows 1", "cylinder --segments 150 --rows 40",
    ),
    "lattice": (
        "many largest places, faces that are points",
        "grid --cells 40,40", "point-lattice --cells 33",
    ),
    # The distance is zero, or a few roundings, on all that follow.
    "zero_same": (
        "h = 0: a mesh against itself",
        "torus --major-segments 320 --minor-segments 156", "torus --major-segments 320 --minor-segments 156",
    ),
    "zero_shuffled": (
        "h = 0: faces in another order",
        "torus --major-segments 320 --minor-segments 156",
        "torus --major-segments 320 --minor-segments 156 --shuffle 1",
    ),
    "zero_subdivided": (
        "h = 0: its own subdivision",
        "torus --major-segments 160 --minor-segments 78",
        "torus --major-segments 160 --minor-segments 78 --subdivide 1 --shuffle 1",
    ),
    "zero_turned": (
        "h = 0: its own subdivision, scaled, turned, shuffled",
        "icosphere --subdivisions 5 --scale 37 --rotate 1,2,3,40",
        "icosphere --subdivisions 5 --scale 37 --rotate 1,2,3,40 --subdivide 1 --shuffle 2",
    ),
    "zero_coarse": (
        "h = 0: the subdivision against the mesh",
        "torus --major-segments 160 --minor-segments 78 --rotate 1,2,3,40 --subdivide 1 --shuffle 1",
        "torus --major-segments 160 --minor-segments 78 --rotate 1,2,3,40",
    ),
    "zero_cubes": (
        "h = 0: coplanar, meshed twice, turned",
        "cube --cells 60 --rotate 1,2,3,40", "cube --cells 37 --rotate 1,2,3,40",
    ),
}

# The same of real meshes, from a folder of meshes.
FROM_MESHES = {
    "zero_armadillo": (
        "h = 0: scaled, turned, shuffled",
        "mesh {meshes}/armadillo.obj --scale 37 --rotate 1,2,3,40",
        "mesh {meshes}/armadillo.obj --scale 37 --rotate 1,2,3,40 --shuffle 1",
    ),
    "zero_fertility": (
        "h = 0: its own subdivision, turned, shuffled",
        "mesh {meshes}/fertility.off --rotate 1,2,3,40",
        "mesh {meshes}/fertility.off --rotate 1,2,3,40 --subdivide 1 --shuffle 1",
    ),
}

SUFFIXES = ("obj", "ply", "stl", "off", "glb", "gltf", "vtk", "vtp", "vtu")


@dataclasses.dataclass
class Pair:
    """Where a pair comes from: two files."""

    name: str
    about: str
    a: pathlib.Path
    b: pathlib.Path


@dataclasses.dataclass
class Prepared:
    """A pair as every program gets it: as OBJ for ours, as arrays for the others."""

    name: str
    about: str
    files: tuple
    arrays: tuple
    faces: tuple
    diagonal: float  # of the box around A


def generated(folder, recipes, meshes=""):
    """Makes the pairs of a table such as GENERATED in a folder, unless they are there."""
    for name, (about, *templates) in recipes.items():
        made = [template.format(meshes=meshes) for template in templates]
        paths = [folder / name / f"{mesh}.obj" for mesh in "ab"]
        recipe = folder / name / "recipe.txt"
        if not recipe.exists() or recipe.read_text() != "\n".join(made):
            recipe.parent.mkdir(parents=True, exist_ok=True)
            for path, arguments in zip(paths, made):
                generate(arguments, path)
            recipe.write_text("\n".join(made))
        yield Pair(name, about, *paths)


def generate(arguments, path):
    subprocess.run([environment.pompeiu(), "--quiet", "generate", *arguments.split(), "-o", path], check=True)


def found(folder):
    """The pairs of a folder."""
    for sub in sorted(path for path in folder.iterdir() if path.is_dir()):
        ends = [mesh_file(sub, mesh) for mesh in "ab"]
        if all(ends):
            yield Pair(sub.name, "", *ends)


def mesh_file(folder, mesh):
    names = [f"{mesh}.{suffix}{packed}" for suffix in SUFFIXES for packed in ("", ".gz")]
    return next((folder / name for name in names if (folder / name).exists()), None)


def prepare(pair, folder):
    """Reads a pair, checks it, and writes what the programs read to a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    files, written, faces = [], [], []
    for mesh, path in zip("ab", (pair.a, pair.b)):
        obj = folder / f"{mesh}.obj"
        # Through our own program: polygons become triangles, and what it refuses is refused here.
        subprocess.run([environment.pompeiu(), "--quiet", "convert", path, obj], check=True)
        files.append(obj)
        written.append(folder / f"{mesh}.arrays")
        faces.append(arrays.from_obj(obj, written[-1])[1])
    return Prepared(pair.name, pair.about, tuple(files), tuple(written), tuple(faces), diagonal(files[0]))


def diagonal(path):
    """Of the box around a mesh."""
    done = subprocess.run([environment.pompeiu(), "info", path, "--json"], check=True, capture_output=True, text=True)
    return json.loads(done.stdout)["report"]["bounding_box"]["diagonal"]
