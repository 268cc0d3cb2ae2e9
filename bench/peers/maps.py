#!/usr/bin/env python3
"""Maps of distances at growing sizes, by `pompeiu deviation` and by programs that map; writes a CSV record. See README.md.

Two regimes: `near`, a torus and a noisy copy of as many faces, and `apart`, a torus and 1.03 times itself, which from ten thousand
faces on is farther away than its faces are long. Each program answers in a process of its own, from two OBJ files to numbers. The largest
distance and the mean that it finds at the vertices of A are compared with pompeiu's enclosures of those over all points of A.
"""

import argparse
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time

import deviation
import environment
import record
import session

FIELDS = ["family", "faces_a", "faces_b", "tool", "version", "gives", "wall_s", "cpu_s", "peak_mib", "largest", "largest_off", "mean", "mean_off", "status"]
SIZES = [10_000, 100_000, 1_000_000, 10_000_000]
APART = 1.03
ACCURACIES = ["0.01", "0.1"]
VERTICES = "vertices of A"
POINTS = "all points of both, enclosed"


def make(program, family, faces, folder):
    """The files of a pair."""
    files = [folder / "a.obj", folder / "b.obj"]
    of_b = deviation.torus(faces, deviation.NOISE) if family == "near" else f"{deviation.torus(faces)} --scale {APART}"
    for arguments, path in zip((deviation.torus(faces), of_b), files):
        subprocess.run([program, "--quiet", "generate", *arguments.split(), "-o", path], check=True)
    return files


def vertices_of(values):
    """What a program that measures vertices found."""
    return {"largest": float(max(values)), "mean": float(sum(values) / len(values))}


def open3d(a, b):
    import numpy
    import open3d
    began = clocks()
    a, b = (open3d.io.read_triangle_mesh(str(path)) for path in (a, b))
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(open3d.t.geometry.TriangleMesh.from_legacy(b))
    points = numpy.asarray(a.vertices).astype("float32")
    values = scene.compute_distance(open3d.core.Tensor(points)).numpy().astype(float)
    return began, open3d.__version__, values


def pymeshlab(a, b):
    import pymeshlab
    from importlib.metadata import version
    began = clocks()
    meshes = pymeshlab.MeshSet(verbose=False)
    for path in (a, b):
        meshes.load_new_mesh(str(path))
    meshes.compute_scalar_by_distance_from_another_mesh_per_vertex(measuremesh=0, refmesh=1, signeddist=False)
    return began, version("pymeshlab"), meshes.mesh(0).vertex_scalar_array()


def trimesh(a, b):
    import trimesh
    began = clocks()
    a, b = (trimesh.load(path, process=False) for path in (a, b))
    return began, trimesh.__version__, trimesh.proximity.closest_point(b, a.vertices)[1]


WORKERS = {"Open3D": open3d, "PyMeshLab": pymeshlab, "trimesh": trimesh}


def clocks():
    """Imports are not counted."""
    return time.perf_counter(), time.process_time()


def work(tool, a, b):
    """In a process of its own: prints what a package finds."""
    began, version, values = WORKERS[tool](a, b)
    ended = clocks()
    print(json.dumps({"version": version, "wall_s": ended[0] - began[0], "cpu_s": ended[1] - began[1]} | vertices_of(values)))


def ask_package(tool, files, seconds):
    out, peak, _ = session.measured([environment.PYTHON, __file__, "--work", tool, *files], seconds)
    return json.loads(out.splitlines()[-1]) | {"peak_mib": peak}


def ask_cloudcompare(files, folder, seconds):
    """Its distances are signed: those of the mesh that it writes are taken without their signs. Reading that is not counted, writing is."""
    program = shutil.which("CloudCompare")
    if program is None:
        raise session.NoAnswer("absent", "no CloudCompare (Debian: cloudcompare)")
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    began = time.perf_counter()
    _, peak, cpu = session.measured(
        [program, "-SILENT", "-AUTO_SAVE", "OFF", "-NO_TIMESTAMP", "-O", files[0], "-O", files[1], "-C2M_DIST", "-M_EXPORT_FMT", "PLY",
         "-SAVE_MESHES"], seconds)
    wall = time.perf_counter() - began
    version = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "cloudcompare"], capture_output=True, text=True).stdout
    written = next(folder.glob("a_C2M*.ply"), None)
    if written is None:
        raise session.NoAnswer("refused", "it wrote no mesh with distances")
    return {"version": version, "wall_s": wall, "cpu_s": cpu / 1e3, "peak_mib": peak} | vertices_of(magnitudes_in(written))


def magnitudes_in(path):
    """Those of the last property of the vertices of a binary PLY file."""
    kinds = {"float": "f", "double": "d", "uchar": "B", "int": "i", "uint": "I"}
    with open(path, "rb") as file:
        row, count, of_vertices = "<", 0, False
        while (line := file.readline().decode("ascii").split())[:1] != ["end_header"]:
            if line[0] == "element":
                of_vertices = line[1] == "vertex"
                count = int(line[2]) if of_vertices else count
            elif line[0] == "property" and of_vertices:
                row += kinds[line[1]]
        row = struct.Struct(row)
        values = (row.unpack(file.read(row.size))[-1] for _ in range(count))
        return [abs(value) for value in values if value == value]


def ask_pompeiu(program, files, accuracy):
    began = time.perf_counter()
    out, peak, cpu = session.measured([program, "deviation", *files, "--accuracy", accuracy, "--json", "--quiet"])
    answer = json.loads(out)
    found = answer["report"]["a_to_b"]
    ends = {"largest": found["distance"], "mean": found["statistics"]["mean"]}
    show = {key: f"{value['lower']:.9g} to {value['upper']:.9g}" for key, value in ends.items()}
    version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout.split()[-1]
    return ends, {"version": version, "wall_s": time.perf_counter() - began, "cpu_s": cpu / 1e3, "peak_mib": peak} | show


def off(value, ends):
    """How far a number is from an enclosure, as a part of it."""
    lower, upper = ends["lower"], ends["upper"]
    return 0.0 if lower <= value <= upper else (value - (lower if value < lower else upper)) / upper


def of_pair(program, family, faces, seconds, slow):
    """The rows of a pair; who takes too long is not asked about larger ones."""
    rows = []
    with tempfile.TemporaryDirectory(prefix="maps-") as name:
        folder = pathlib.Path(name)
        files = make(program, family, faces, folder)
        counts = [sum(line.startswith("f") for line in open(path)) for path in files]
        shared = {"family": family, "faces_a": counts[0], "faces_b": counts[1]}
        truth = None
        for accuracy in ACCURACIES:
            ends, row = ask_pompeiu(program, files, accuracy)
            truth = truth or ends
            rows.append(shared | row | {"tool": f"pompeiu, {float(accuracy):.0%}", "gives": POINTS, "status": "answered"})
        for tool in [*WORKERS, "CloudCompare"]:
            row = shared | {"tool": tool, "gives": VERTICES, "status": "answered"}
            try:
                if (family, tool) in slow:
                    raise session.NoAnswer("timeout", "not asked again")
                found = ask_cloudcompare(files, folder, seconds) if tool == "CloudCompare" else ask_package(tool, files, seconds)
                row |= found | {f"{key}_off": f"{off(found[key], truth[key]):.2g}" for key in ("largest", "mean")}
            except session.NoAnswer as error:
                row["status"] = f"{error.status}: {error}"
                slow.add((family, tool))
            rows.append(row)
            environment.say(f"{family:6} {faces:>10,} {tool:13} {row.get('cpu_s', '-')} s {row['status']}")
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--most", type=float, default=2e6, metavar="FACES", help="leave out meshes of more faces")
    parser.add_argument("--timeout", type=float, default=600, metavar="SECONDS", help="for one answer of another program")
    parser.add_argument("--program", type=pathlib.Path, help="the program to measure instead of a release build of this repository")
    parser.add_argument("--work", nargs=3, help=argparse.SUPPRESS)
    parser.add_argument("--record", type=pathlib.Path, help="the CSV file to write")
    options = parser.parse_args()
    if options.work:
        return work(*options.work)
    program, rows, slow = options.program or environment.pompeiu(), [], set()
    if not environment.PYTHON.exists():
        environment.packages()
    for family in ("near", "apart"):
        for faces in (size for size in SIZES if size <= options.most):
            rows += of_pair(program, family, faces, options.timeout, slow)
    to = options.record or record.path("maps")
    rounded = ("wall_s", "cpu_s", "peak_mib")
    record.write(to, FIELDS, [row | {key: round(row[key], 3) for key in rounded if key in row} for row in rows])
    print(to)
    return None


if __name__ == "__main__":
    sys.exit(main())
