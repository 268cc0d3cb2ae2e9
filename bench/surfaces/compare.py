"""Remeshing, simplification and flow beside other programs, in one run; every mesh is judged by `pompeiu`.

Writes ../record/DATE-surfaces.csv: date, commit, processor, load of the machine, task, mesh, what was asked for, program, faces,
processor seconds, wall-clock seconds, threads, and what the judge says of the result.
"""

import argparse
import datetime
import json
import math
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time

for name in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"]:
    os.environ[name] = "1"

import fast_simplification
import gpytoolbox
import meshoptimizer
import numpy as np
import pymeshlab

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "peers"))

import record  # noqa: E402

ITERATIONS = 10
SHARES = [0.001, 0.005, 0.01]
SHARES_OF_FACES = [0.1, 0.02]
HALVINGS = 9
FIELDS = ["date", "commit", "cpu", "load", "task", "mesh", "asked", "program", "faces", "cpu_s", "wall_s", "threads", "judged"]
CATENOID = (5.991796975802282, 0.8483379380949789)


class Session:
    """The program under test, files, and the rows that were measured."""

    def __init__(self, program, record):
        self.program, self.record = program, record
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="surfaces-"))
        self.count = 0
        self.cgal = self.folder / "cgal"
        compiler = ["g++", "-O3", "-DNDEBUG", "-std=c++17", HERE / "cgal.cpp", "-o", self.cgal, "-lgmp", "-lmpfr"]
        if shutil.which("g++") is None or subprocess.run(compiler, capture_output=True, check=False).returncode != 0:
            print("CGAL: not there (libcgal-dev and g++ of Debian), left out", flush=True)
            self.cgal = None

    def path(self, suffix):
        self.count += 1
        return self.folder / f"{self.count}.{suffix}"

    def pompeiu(self, *words, threads=1):
        """The answer of a command as data, with its processor and wall-clock seconds."""
        environment = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
        before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        words = [str(word) for word in words]
        done = subprocess.run([self.program, *words], capture_output=True, text=True, env=environment, check=False)
        wall = time.perf_counter() - started
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(words)}: {done.stderr.strip()}")
        cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        answer = json.loads(done.stdout) if "--json" in words else None
        return answer, cpu, wall

    def run_cgal(self, task, source, *words):
        """What CGAL makes of a mesh, with the seconds of the operation alone by its own clocks."""
        out = self.path("obj")
        command = [self.cgal, task, source, *[str(word) for word in words], out]
        cpu, wall = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
        return read_obj(out), float(cpu), float(wall)

    def add(self, task, mesh, asked, program, faces, cpu, wall, judged, threads=1):
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
            "threads": threads,
            "judged": judged,
        }
        print(", ".join(f"{key} {row[key]}" for key in FIELDS[4:]), flush=True)
        record.append(self.record, FIELDS, row)


def read_obj(path):
    vertices, faces = [], []
    for line in open(path):
        words = line.split()
        if words and words[0] == "v":
            vertices.append([float(w) for w in words[1:4]])
        elif words and words[0] == "f":
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
    return np.array(vertices), np.array(faces, dtype=np.int32)


def write_obj(path, vertices, faces):
    with open(path, "w") as file:
        for v in vertices:
            file.write("v " + " ".join(repr(float(x)) for x in v) + "\n")
        for f in faces:
            file.write("f " + " ".join(str(i + 1) for i in f) + "\n")


def timed(work):
    cpu, wall = time.process_time(), time.perf_counter()
    result = work()
    return result, time.process_time() - cpu, time.perf_counter() - wall


def edges(faces):
    both = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    return np.unique(both, axis=0)


def quality(vertices, faces, length):
    """Least angle, mean least angle, share of vertices with 5 to 7 neighbours, share of edges of 0.8 to 1.33 lengths."""
    corners = vertices[faces]
    angles = []
    for i in range(3):
        u, v = corners[:, (i + 1) % 3] - corners[:, i], corners[:, (i + 2) % 3] - corners[:, i]
        angles.append(np.arctan2(np.linalg.norm(np.cross(u, v), axis=1), (u * v).sum(1)))
    least = np.degrees(np.min(angles, axis=0))
    pairs = edges(faces)
    lengths = np.linalg.norm(vertices[pairs[:, 0]] - vertices[pairs[:, 1]], axis=1)
    valence = np.bincount(pairs.ravel())
    valence = valence[valence > 0]
    near = (lengths >= 0.8 * length) & (lengths <= 4 / 3 * length)
    shares = 100 * np.mean((valence >= 5) & (valence <= 7)), 100 * near.mean()
    return f"least {least.min():.1f} mean {least.mean():.2f} valence5-7 {shares[0]:.1f}% lengths {shares[1]:.1f}%"


def distance(session, one, two):
    answer, *_ = session.pompeiu("distance", one, two, "--json")
    return answer["report"]["hausdorff"]["upper"]


def remeshing(session, mesh):
    """All programs with the length for which they make about as many faces as ours does with the mean length of the input."""
    vertices, faces = read_obj(mesh)
    pairs = edges(faces)
    length = float(np.linalg.norm(vertices[pairs[:, 0]] - vertices[pairs[:, 1]], axis=1).mean())
    name = mesh.stem

    def add(program, made, cpu, wall, target):
        out = session.path("obj")
        write_obj(out, *made)
        judged = quality(*made, target) + f" H {distance(session, mesh, out):.4g}"
        session.add("remesh", name, f"length {target:.6g}", program, len(made[1]), cpu, wall, judged)

    out = session.path("obj")
    words = ["remesh", mesh, "--edge-length", length, "--iterations", ITERATIONS, "--intersections", "ignore", "-o", out]
    answer, cpu, wall = session.pompeiu(*words, "--json")
    ours = read_obj(out)
    # Of one thread: the command's processor time is shared out by the clock.
    share = answer["report"]["timing_ms"]["remesh"] / answer["timing_ms"]["total"]
    add("pompeiu", ours, cpu * share, wall * share, length)

    def gpy(target):
        made = gpytoolbox.remesh_botsch(vertices, faces, i=ITERATIONS, h=target, project=True)
        return made[0], made[1]

    def meshlab(target):
        meshes = pymeshlab.MeshSet()
        meshes.add_mesh(pymeshlab.Mesh(vertices, faces))
        meshes.meshing_isotropic_explicit_remeshing(iterations=ITERATIONS, targetlen=pymeshlab.PureValue(target))
        made = meshes.current_mesh()
        return made.vertex_matrix(), made.face_matrix()

    def cgal(target):
        return session.run_cgal("remesh", mesh, target, ITERATIONS)

    for program, work in [
        ("gpytoolbox", lambda target: timed(lambda: gpy(target))),
        ("pymeshlab", lambda target: timed(lambda: meshlab(target))),
        *([("cgal", cgal)] if session.cgal else []),
    ]:
        # The first length gives too few faces or too many; the second is corrected by that.
        first, *_ = work(length)
        target = length * math.sqrt(len(first[1]) / len(ours[1]))
        made, cpu, wall = work(target)
        add(program, made, cpu, wall, target)


class Peers:
    """Programs that simplify to a number of faces."""

    def __init__(self, session, mesh):
        self.vertices, self.faces = read_obj(mesh)
        self.source = session.path("obj")
        write_obj(self.source, self.vertices, self.faces)
        self.diagonal = float(np.linalg.norm(self.vertices.max(0) - self.vertices.min(0)))
        self.works = {
            "pymeshlab": lambda count: timed(lambda: self.pymeshlab(count)),
            "meshoptimizer": lambda count: timed(lambda: self.meshoptimizer(count)),
            "gpytoolbox": lambda count: timed(lambda: gpytoolbox.decimate(self.vertices, self.faces, num_faces=count)[:2]),
            "fast-simplification": lambda count: timed(lambda: self.fast(count)),
        }
        if session.cgal:
            self.works["cgal"] = lambda count: session.run_cgal("simplify", self.source, count)

    def pymeshlab(self, count):
        meshes = pymeshlab.MeshSet()
        meshes.add_mesh(pymeshlab.Mesh(self.vertices, self.faces))
        meshes.meshing_decimation_quadric_edge_collapse(targetfacenum=count)
        made = meshes.current_mesh()
        return made.vertex_matrix(), made.face_matrix()

    def meshoptimizer(self, count):
        indices = self.faces.astype(np.uint32).ravel()
        found = np.zeros_like(indices)
        n = meshoptimizer.simplify(
            found, indices, self.vertices.astype(np.float32), target_index_count=3 * count, target_error=1.0
        )
        return self.vertices, found[:n].reshape(-1, 3)

    def fast(self, count):
        return fast_simplification.simplify(self.vertices.astype(np.float32), self.faces, target_count=count)

    def judged(self, session, path):
        """How far a result is, and that in words."""
        upper = distance(session, self.source, path)
        return upper, f"H {100 * upper / self.diagonal:.5f} % of the diagonal"


def to_faces(session, mesh):
    """What is left of the surface at a share of its faces, by default and as fast as each can."""
    peers = Peers(session, mesh)
    for share in SHARES_OF_FACES:
        count = round(share * len(peers.faces))
        asked = f"{100 * share:g} % of the faces"
        for effort in ["best", "fast"]:
            out = session.path("obj")
            words = ["--faces", count, "--effort", effort, "--intersections", "ignore", "-o", out]
            answer, cpu, wall = session.pompeiu("simplify", peers.source, *words, "--json")
            judged = peers.judged(session, out)[1]
            session.add("faces", mesh.stem, asked, f"pompeiu {effort}", answer["report"]["faces"], cpu, wall, judged)
        for program, work in peers.works.items():
            made, cpu, wall = work(count)
            out = session.path("obj")
            write_obj(out, *made)
            session.add("faces", mesh.stem, asked, program, len(made[1]), cpu, wall, peers.judged(session, out)[1])


def simplification(session, mesh):
    peers = Peers(session, mesh)
    for share in SHARES:
        limit = share * peers.diagonal
        asked = f"H <= {100 * share:g} %"
        for threads in [1, 2]:
            out = session.path("obj")
            answer, cpu, wall = session.pompeiu(
                "simplify", peers.source, "--within", limit, "--intersections", "ignore", "-o", out, "--json", threads=threads
            )
            judged = peers.judged(session, out)[1]
            session.add("simplify", mesh.stem, asked, "pompeiu", answer["report"]["faces"], cpu, wall, judged, threads)
        for program, work in peers.works.items():
            # The fewest faces whose distance, as the judge measures it, is at most the limit.
            low, high, best = 100, len(peers.faces), None
            for _ in range(HALVINGS):
                middle = round(math.sqrt(low * high))
                made, cpu, wall = work(middle)
                out = session.path("obj")
                write_obj(out, *made)
                upper, judged = peers.judged(session, out) if len(made[1]) else (math.inf, "")
                if upper <= limit:
                    high = middle
                    if best is None or len(made[1]) < best[0]:
                        best = (len(made[1]), cpu, wall, judged)
                else:
                    low = middle
                if high <= low + 1:
                    break
            found = best or ("", 0, 0, "no number of faces tried is within the distance")
            session.add("simplify", mesh.stem, asked, program, *found)


# Vertices are averaged first: from the tube itself the steps do not converge.
EVOLVER_STEPS = """V 10; u;
hessian_normal
do { old := total_area; hessian; } while (abs(old - total_area) > 1e-13*total_area);
"""


def evolve(session, evolver, vertices, faces, fixed):
    """Hessian steps of the Surface Evolver on the same triangles: seconds of its own clock, wall-clock seconds with reading, and what it
    prints at the end."""
    pairs = edges(faces)
    number = {tuple(pair): i + 1 for i, pair in enumerate(pairs.tolist())}
    datafile = session.path("fe")
    with open(datafile, "w") as file:
        file.write("vertices\n")
        for i, v in enumerate(vertices.tolist()):
            file.write(f"{i + 1} {v[0]!r} {v[1]!r} {v[2]!r}{' fixed' if fixed[i] else ''}\n")
        file.write("edges\n")
        for (u, v), i in number.items():
            file.write(f"{i} {u + 1} {v + 1}{' fixed' if fixed[u] and fixed[v] else ''}\n")
        file.write("faces\n")
        for f, face in enumerate(faces.tolist()):
            ring = []
            for k in range(3):
                u, v = face[k], face[(k + 1) % 3]
                ring.append(number[(u, v)] if u < v else -number[(v, u)])
            file.write(f"{f + 1} {' '.join(map(str, ring))}\n")
        file.write("read\nold := 0;\nstart := clock;\n" + EVOLVER_STEPS + 'printf "spent %f area %.12f\\n", clock - start, total_area;\nq\nq\n')
    started = time.perf_counter()
    done = subprocess.run([evolver, datafile], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    wall = time.perf_counter() - started
    found = re.search(r"spent ([-\d.]+) area ([\d.]+)", done.stdout)
    return float(found[1]) if found else 0.0, wall, found


def flow(session, evolver):
    for segments, bands in [(48, 12), (96, 24), (192, 48)]:
        tube = session.path("obj")
        session.pompeiu("generate", "schwarz-lantern", "--segments", segments, "--bands", bands, "--height", 1, "-o", tube)
        answer, cpu, wall = session.pompeiu("flow", tube, "--json", "--intersections", "ignore")
        error = answer["report"]["area"]["final"] / CATENOID[0] - 1
        judged = (
            f"{answer['report']['stop']} area error {error:.3e} normal gradient {answer['report']['gradient']['normal']:.1e}"
            f" least eigenvalue {answer['report']['stability']['least_eigenvalue']:.4f}"
        )
        session.add("flow", "tube R=1 h=0.5", "stationary", "pompeiu", answer["inputs"][0]["faces"], cpu, wall, judged)
    # The catenoid of waist 1 between rings at heights 1 and -1: its area is pi (2 + sinh 2).
    exact = math.pi * (2 + math.sinh(2))
    tube = session.path("obj")
    words = ["--radius", math.cosh(1), "--segments", 192, "--bands", 64, "--height", 2]
    session.pompeiu("generate", "schwarz-lantern", *words, "-o", tube)
    answer, cpu, wall = session.pompeiu("flow", tube, "--json", "--intersections", "ignore")
    share = (answer["report"]["timing_ms"]["steps"] + answer["report"]["timing_ms"]["remesh"]) / answer["timing_ms"]["total"]
    judged = f"{answer['report']['stop']} area error {answer['report']['area']['final'] / exact - 1:.3e}"
    session.add("flow", "tube R=cosh 1 h=1", "stationary", "pompeiu", answer["inputs"][0]["faces"], cpu * share, wall * share, judged)
    neck(session)
    if evolver is None:
        return
    vertices, faces = read_obj(tube)
    fixed = np.abs(np.abs(vertices[:, 2]) - 1) < 1e-9
    cpu, wall, found = evolve(session, evolver, vertices, faces, fixed)
    judged = f"area error {float(found[2]) / exact - 1:.3e}" if found else "no answer"
    session.add("flow", "tube R=cosh 1 h=1", "hessian steps", "evolver", len(faces), cpu, wall, judged)


# Times at which a neck of radius 0.3 + 0.1 (1 - cos pi z) between planes at z = -1 and 1 has these radii: the flow of its profile,
# solved in one dimension.
NECK = {0.1: 0.052177, 0.05: 0.056615}


def neck(session, around=48, along=60, length=0.04):
    """Mean curvature flow of a neck with remeshing: how far the time of a radius is from that of the profile."""
    start, out = session.path("obj"), session.path("obj")
    rings = [(-1 + 2 * j / along, j) for j in range(along + 1)]
    vertices = [
        (r * math.cos(a), r * math.sin(a), z)
        for z, j in rings
        for r in [0.3 + 0.1 * (1 - math.cos(math.pi * z))]
        for a in [2 * math.pi * (i + 0.5 * (j % 2)) / around for i in range(around)]
    ]
    faces = []
    for j in range(along):
        below, above = (1, 0) if j % 2 == 0 else (0, 1)
        for i in range(around):
            at = lambda row, k: row * around + k % around
            faces.append((at(j, i), at(j, i + 1), at(j + 1, i + above)))
            faces.append((at(j, i + below), at(j + 1, i + 1), at(j + 1, i)))
    write_obj(start, vertices, faces)
    for radius, time_there in NECK.items():
        words = ["--planes", "z", "--remesh", length, "--until", f"time:{time_there}", "--intersections", "ignore"]
        answer, cpu, wall = session.pompeiu("flow", start, *words, "-o", out, "--json")
        points, _ = read_obj(out)
        found = np.hypot(*points[np.abs(points[:, 2]) < length, :2].T).min()
        ended = answer["report"]["history"][-1]["time"]
        # Near the end the squared radius falls by about 1.7 in each unit of time.
        reached = ended + (found**2 - radius**2) / 1.7
        judged = f"{answer['report']['stop']} at {ended:.6f} radius {found:.4f}; radius {radius} at {reached:.6f}, {100 * (reached / time_there - 1):+.2f} %"
        asked = f"time {time_there}, edges {length}"
        session.add("flow", "neck between planes", asked, "pompeiu", len(faces), cpu, wall, judged)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("meshes", type=pathlib.Path, nargs="+", metavar="MESH", help="an OBJ file of a closed surface")
    parser.add_argument("--pompeiu", default=shutil.which("pompeiu") or "target/release/pompeiu")
    parser.add_argument("--evolver", default=shutil.which("evolver-nox-d") or shutil.which("evolver"))
    parser.add_argument("--tasks", nargs="+", default=["remesh", "faces", "simplify", "flow"])
    today = datetime.date.today().isoformat()
    parser.add_argument("--record", type=pathlib.Path, default=HERE.parent / "record" / f"{today}-surfaces.csv")
    arguments = parser.parse_args()
    session = Session(arguments.pompeiu, arguments.record)
    try:
        if "flow" in arguments.tasks:
            flow(session, arguments.evolver)
        for task, work in [("remesh", remeshing), ("faces", to_faces), ("simplify", simplification)]:
            for mesh in arguments.meshes if task in arguments.tasks else []:
                work(session, mesh)
    finally:
        shutil.rmtree(session.folder)


if __name__ == "__main__":
    main()
