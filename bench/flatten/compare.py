"""Flattening beside libigl, xatlas and CGAL, in one run; all maps are measured alike.

Writes ../record/DATE-flatten.csv: date, commit, processor, load of the machine, task, mesh, what was asked for, program, faces,
processor seconds, wall-clock seconds, and what was measured of the map.
"""

import argparse
import datetime
import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time

for name in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"]:
    os.environ[name] = "1"

import igl
import numpy as np
import xatlas

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "peers"))

import record  # noqa: E402

MESHES = ["spot.obj", "cow.off", "bunny.off", "3holes.off", "fertility.off", "camelhead.off", "armadillo.obj"]
FIELDS = ["date", "commit", "cpu", "load", "task", "mesh", "asked", "program", "faces", "cpu_s", "wall_s", "measured"]
MOST_STEPS = 200
DISTORTION = 4.05


class Session:
    """The program under test, files, and the rows that were measured."""

    def __init__(self, program, record):
        self.program, self.record = program, record
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="flatten-"))
        self.count = 0

    def path(self, suffix):
        self.count += 1
        return self.folder / f"{self.count}.{suffix}"

    def pompeiu(self, *words):
        """The answer as data; processor and wall-clock seconds from the surface to the map, without its check."""
        before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        words = [self.program, *map(str, words), "--json"]
        environment = {**os.environ, "RAYON_NUM_THREADS": "1"}
        done = subprocess.run(words, capture_output=True, text=True, env=environment, check=False)
        wall = time.perf_counter() - started
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if not done.stdout:
            raise RuntimeError(f"{' '.join(words)}: {done.stderr.strip()}")
        answer = json.loads(done.stdout)["report"]
        cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        timing = answer["timing_ms"]
        spent = (timing["total"] - timing.get("check", 0)) / 1000
        return answer, cpu * spent / wall, spent

    def add(self, task, mesh, asked, program, faces, cpu, wall, measured):
        row = {
            "date": datetime.date.today().isoformat(),
            "commit": record.git("rev-parse", "--short=10", "HEAD"),
            "cpu": record.cpu(),
            "load": f"{os.getloadavg()[0]:.1f}",
            "task": task,
            "mesh": mesh,
            "asked": asked,
            "program": program,
            "faces": faces,
            "cpu_s": f"{cpu:.3f}",
            "wall_s": f"{wall:.3f}",
            "measured": measured,
        }
        print(", ".join(f"{key} {row[key]}" for key in FIELDS[4:]), flush=True)
        record.append(self.record, FIELDS, row)


def read(path):
    """Vertices, faces, and for OBJ files the places of corners."""
    if path.suffix == ".off":
        words = " ".join(line.split("#")[0] for line in open(path)).split()
        n, m = int(words[1]), int(words[2])
        vertices = np.array(words[4 : 4 + 3 * n], dtype=float).reshape(-1, 3)
        faces = np.array(words[4 + 3 * n : 4 + 3 * n + 4 * m], dtype=np.int64).reshape(-1, 4)[:, 1:]
        return vertices, faces, None
    vertices, places, faces, corners = [], [], [], []
    for line in open(path):
        words = line.split()
        if words and words[0] == "v":
            vertices.append([float(w) for w in words[1:4]])
        elif words and words[0] == "vt":
            places.append([float(w) for w in words[1:3]])
        elif words and words[0] == "f":
            parts = [w.split("/") for w in words[1:]]
            for k in range(1, len(parts) - 1):
                three = [parts[0], parts[k], parts[k + 1]]
                faces.append([int(p[0]) - 1 for p in three])
                if len(parts[0]) > 1 and parts[0][1]:
                    corners.append([int(p[1]) - 1 for p in three])
    uv = np.array(places)[np.array(corners)] if corners else None
    return np.array(vertices), np.array(faces, dtype=np.int64), uv


def write_off(path, vertices, faces):
    with open(path, "w") as file:
        file.write(f"OFF\n{len(vertices)} {len(faces)} 0\n")
        file.writelines(" ".join(repr(float(x)) for x in v) + "\n" for v in vertices)
        file.writelines(f"3 {f[0]} {f[1]} {f[2]}\n" for f in faces)


def measure(vertices, faces, uv, may_mirror=False):
    """Mean symmetric Dirichlet energy at the best scale, and the number of faces that are not counter-clockwise; or of those without area,
    where whole charts may be mirrored."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    length = np.linalg.norm(b - a, axis=1)
    first = (b - a) / length[:, None]
    x = ((c - a) * first).sum(1)
    y = np.linalg.norm(c - a - x[:, None] * first, axis=1)
    p, q = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    du = p / length[:, None]
    dv = (q - x[:, None] * du) / y[:, None]
    squares = (du**2).sum(1) + (dv**2).sum(1)
    determinant = du[:, 0] * dv[:, 1] - du[:, 1] * dv[:, 0]
    if may_mirror:
        determinant = np.abs(determinant)
    area = 0.5 * length * y
    if (determinant <= 0).any():
        return float("inf"), int((determinant <= 0).sum())
    direct, inverse = (area * squares).sum(), (area * squares / determinant**2).sum()
    return float(2 * np.sqrt(direct * inverse) / area.sum()), 0


def timed(work):
    cpu, wall = time.process_time(), time.perf_counter()
    result = work()
    return result, time.process_time() - cpu, time.perf_counter() - wall


def default(session, path):
    """Without options, beside xatlas."""
    vertices, faces, _ = read(path)
    out = session.path("obj")
    answer, cpu, wall = session.pompeiu("flatten", path, "-o", out)
    distortion = answer["distortion"]["symmetric_dirichlet"]["mean"]
    written = read(out)
    again, _ = measure(written[0], written[1], written[2])
    assert abs(again / distortion - 1) < 1e-6, (again, distortion)
    seam = answer["cut"]["relative_length"]
    flaws = f"flipped {answer['flipped']} overlapping {answer['overlapping']}"
    measured = f"charts {answer['charts']} seam {seam:.2f} energy {distortion:.3f} {flaws}"
    session.add("default", path.stem, "no options", "pompeiu", len(faces), cpu, wall, measured)

    def work():
        atlas = xatlas.Atlas()
        atlas.add_mesh(vertices.astype(np.float32), faces.astype(np.uint32))
        atlas.generate()
        return atlas

    atlas, cpu, wall = timed(work)
    origin, corners, places = atlas[0]
    energy, flipped = measure(vertices, origin[corners].astype(np.int64), places[corners].astype(float), may_mirror=True)
    # Sides that two faces do not share in the map, but on the surface.
    sides = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    ends = np.sort(origin[sides], axis=1)
    lengths = np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1)
    _, in_map, counts = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True, return_counts=True)
    _, on_surface, both = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    is_seam = (counts[in_map.ravel()] == 1) & (both[on_surface.ravel()] == 2)
    area = 0.5 * np.linalg.norm(
        np.cross(vertices[faces[:, 1]] - vertices[faces[:, 0]], vertices[faces[:, 2]] - vertices[faces[:, 0]]), axis=1
    )
    seam = 0.5 * lengths[is_seam].sum() / np.sqrt(area.sum())
    measured = f"charts {atlas.chart_count} seam {seam:.2f} energy {energy:.3f} flipped {flipped}"
    session.add("default", path.stem, "no options", "xatlas", len(faces), cpu, wall, measured)
    # As little distortion as that of xatlas, where its map has any.
    most = energy if np.isfinite(energy) and not flipped else DISTORTION
    answer, cpu, wall = session.pompeiu("flatten", path, "--max-distortion", f"{most:.6f}")
    reached = answer["distortion"]["symmetric_dirichlet"]["mean"]
    flaws = f"flipped {answer['flipped']} overlapping {answer['overlapping']}"
    measured = f"charts {answer['charts']} seam {answer['cut']['relative_length']:.2f} energy {reached:.3f} {flaws}"
    session.add("charts", path.stem, f"energy {most:.3f}", "pompeiu", len(faces), cpu, wall, measured)


def subdivided(vertices, faces):
    sides = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    unique, inverse = np.unique(sides, axis=0, return_inverse=True)
    middles = 0.5 * (vertices[unique[:, 0]] + vertices[unique[:, 1]])
    m = len(faces)
    ab, bc, ca = (len(vertices) + inverse.ravel()[k * m : (k + 1) * m] for k in range(3))
    a, b, c = faces.T
    parts = [np.stack(t, axis=1) for t in [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]]
    return np.concatenate([vertices, middles]), np.concatenate(parts)


def convex(session, path, cgal):
    """The same disk, subdivided twice, to the same circle."""
    vertices, faces, _ = read(path)
    for _ in range(2):
        vertices, faces = subdivided(vertices, faces)
    off = session.path("off")
    write_off(off, vertices, faces)
    name = f"{path.stem} subdivided twice"

    def ours(asked, *words):
        answer, cpu, wall = session.pompeiu("flatten", off, "--no-pack", *words)
        energy = answer["distortion"]["symmetric_dirichlet"]["mean"]
        shown = f"energy {energy:.3f}" if energy else "no energy"
        measured = f"{shown} flipped {answer['flipped']} angle {answer['distortion']['angle']['mean'] or float('inf'):.3f}"
        session.add("convex", name, asked, "pompeiu", len(faces), cpu, wall, measured)

    def theirs(asked, program, work):
        uv, cpu, wall = timed(work)
        energy, flipped = measure(vertices, faces, uv[faces])
        session.add("convex", name, asked, program, len(faces), cpu, wall, f"energy {energy:.3f} flipped {flipped}")

    # The longest loop goes to the circle; pompeiu cuts nothing of a disk.
    border = igl.boundary_loop(faces)
    lengths = np.linalg.norm(vertices[np.roll(border, -1)] - vertices[border], axis=1)
    angles = 2 * np.pi * np.concatenate([[0], np.cumsum(lengths)[:-1]]) / lengths.sum()
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    ours("cotangent weights", "--boundary", "circle", "--weights", "cotangent")
    theirs("cotangent weights", "libigl", lambda: igl.harmonic(vertices, faces, border, circle, 1))
    ours("mean value weights", "--boundary", "circle", "--weights", "mean-value")
    if cgal:
        seconds = float(subprocess.run([cgal, off], capture_output=True, text=True, check=True).stdout)
        session.add("convex", name, "mean value weights", "CGAL", len(faces), seconds, seconds, "seconds of its own clock")
    ours("conformal", "--energy", "lscm")
    pair = np.array([border[0], border[len(border) // 2]])
    places = np.array([[0.0, 0.0], [1.0, 0.0]])
    theirs("conformal", "libigl", lambda: igl.lscm(vertices, faces, pair, places)[0])


def descent(session, path):
    """The same disk from the same map onto a circle, beside SLIM."""
    opened, start = session.path("obj"), session.path("obj")
    session.pompeiu("cut", path, "--strategy", "tips", "-o", opened)
    words = ["flatten", opened, "--no-pack", "--strategy", "genus"]
    answer, cpu, wall = session.pompeiu(*words)
    energy = answer["distortion"]["symmetric_dirichlet"]["mean"]
    vertices, faces, _ = read(opened)
    measured = f"energy {energy:.4f} steps {answer['steps']} overlapping {answer['overlapping']}"
    session.add("descent", path.stem, "least energy", "pompeiu", len(faces), cpu, wall, measured)
    session.pompeiu(*words, "--boundary", "circle", "-o", start)
    _, triangles, corners = read(start)
    uv = np.zeros((len(vertices), 2))
    uv[triangles] = corners
    area = 0.5 * np.linalg.norm(
        np.cross(vertices[faces[:, 1]] - vertices[faces[:, 0]], vertices[faces[:, 2]] - vertices[faces[:, 0]]), axis=1
    )
    # All areas alike in the sum, as SLIM knows no scale.
    p, q = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    uv *= np.sqrt(area.sum() / (0.5 * (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0])).sum())
    fixed, places = np.zeros(0, dtype=np.int32), np.zeros((0, 2), order="F")
    small = np.asfortranarray(faces.astype(np.int32))
    kind = igl.MappingEnergyType.SYMMETRIC_DIRICHLET

    def prepare():
        return igl.slim_precompute(
            np.asfortranarray(vertices), small, np.asfortranarray(uv), kind, fixed, places, 0.0
        )

    data, cpu, wall = timed(prepare)
    steps, found = 0, float("inf")
    while steps < MOST_STEPS and found > 1.001 * energy:
        result, more, longer = timed(lambda: igl.slim_solve(data, 1))
        cpu, wall, steps = cpu + more, wall + longer, steps + 1
        found, _ = measure(vertices, faces, result[:, :2][faces])
    measured = f"energy {found:.4f} steps {steps}" + ("" if found <= 1.001 * energy else " not reached")
    session.add("descent", path.stem, "that energy", "libigl SLIM", len(faces), cpu, wall, measured)


def compile_cgal(folder):
    """The program of CGAL, or None where it is not installed."""
    program = folder / "mean_value"
    words = ["g++", "-O2", "-DNDEBUG", "-DCGAL_EIGEN3_ENABLED", "-I/usr/include/eigen3", HERE / "mean_value.cpp", "-o", program]
    done = subprocess.run([*words, "-lgmp", "-lmpfr"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        print("CGAL is left out:", done.stderr.strip().splitlines()[:1])
    return program if done.returncode == 0 else None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("meshes", type=pathlib.Path, help="the folder of the meshes")
    parser.add_argument("--pompeiu", default=shutil.which("pompeiu") or "target/release/pompeiu")
    parser.add_argument("--tasks", nargs="+", default=["default", "convex", "descent"])
    parser.add_argument("--only", nargs="+", default=MESHES)
    today = datetime.date.today().isoformat()
    parser.add_argument("--record", type=pathlib.Path, default=HERE.parent / "record" / f"{today}-flatten.csv")
    arguments = parser.parse_args()
    session = Session(arguments.pompeiu, arguments.record)
    paths = [arguments.meshes / name for name in arguments.only]
    try:
        if "convex" in arguments.tasks:
            convex(session, arguments.meshes / "camelhead.off", compile_cgal(session.folder))
        for path in paths:
            if "default" in arguments.tasks:
                default(session, path)
            if "descent" in arguments.tasks:
                descent(session, path)
    finally:
        shutil.rmtree(session.folder)


if __name__ == "__main__":
    main()
