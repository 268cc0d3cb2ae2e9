"""Times the operators beside SciPy, CHOLMOD and potpourri3d on one mesh, one thread each, in one run.

Adds rows to ../record/DATE-operators.csv: date, commit, processor, load of the machine, mesh, faces, what is timed, ours, the
peer's, the peer's name, difference of the results.
"""

import argparse
import csv
import datetime
import json
import os
import pathlib
import subprocess
import tempfile
import time

for name in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "RAYON_NUM_THREADS"]:
    os.environ[name] = "1"

import numpy as np
import potpourri3d
import scipy.sparse
import scipy.sparse.linalg
import sksparse.cholmod

HERE = pathlib.Path(__file__).parent
RUNS = 3
RAYS = 2000


def read_obj(path):
    vertices, faces = [], []
    for line in open(path):
        words = line.split()
        if words and words[0] == "v":
            vertices.append([float(w) for w in words[1:4]])
        elif words and words[0] == "f":
            faces.append([int(w) - 1 for w in words[1:4]])
    return np.array(vertices), np.array(faces)


def cotan(vertices, faces):
    n = len(vertices)
    rows, columns, values = [], [], []
    for i in range(3):
        a, b, c = faces[:, i], faces[:, (i + 1) % 3], faces[:, (i + 2) % 3]
        u, v = vertices[a] - vertices[c], vertices[b] - vertices[c]
        weight = 0.5 * (u * v).sum(1) / np.linalg.norm(np.cross(u, v), axis=1)
        rows += [a, b, a, b]
        columns += [b, a, a, b]
        values += [-weight, -weight, weight, weight]
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return scipy.sparse.coo_matrix(entries, shape=(n, n)).tocsc()


def commit():
    def git(*words):
        return subprocess.run(["git", "-C", HERE, *words], check=True, capture_output=True, text=True).stdout.strip()

    return git("rev-parse", "--short=10", "HEAD") + ("+changes" if git("status", "--porcelain") else "")


def cpu():
    for line in open("/proc/cpuinfo"):
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return "unknown"


def least(run):
    best, result = float("inf"), None
    for _ in range(RUNS):
        start = time.perf_counter()
        result = run()
        best = min(best, time.perf_counter() - start)
    return result, best * 1e3


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mesh")
    parser.add_argument("--subdivide", type=int, default=0)
    parser.add_argument("--program", default=HERE / "target/release/operators-bench")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        command = [arguments.program, arguments.mesh, str(arguments.subdivide), folder]
        ours = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        folder = pathlib.Path(folder)
        vertices, faces = read_obj(folder / "mesh.obj")
        rows = [(what, ours[what], None, "", None) for what in ours if not what.startswith("trace_")]
        rows = {row[0]: row for row in rows}

        matrix = cotan(vertices, faces)[1:, 1:].tocsc()
        options = {"permc_spec": "MMD_AT_PLUS_A", "diag_pivot_thresh": 0.0, "options": {"SymmetricMode": True}}
        factor, ms = least(lambda: scipy.sparse.linalg.splu(matrix, **options))
        rows["cotan_factor"] = ("cotan_factor", ours["cotan_factor"], ms, "SciPy SuperLU", None)
        _, ms = least(lambda: factor.solve(vertices[1:, 2]))
        rows["cotan_solve"] = ("cotan_solve", ours["cotan_solve"], ms, "SciPy SuperLU", None)

        # With its ordering for symmetric matrices, AMD; analysis and numbers together, as ours.
        factor, ms = least(lambda: sksparse.cholmod.cholesky(matrix, ordering_method="amd"))
        rows["cholmod_factor"] = ("cotan_factor", ours["cotan_factor"], ms, "CHOLMOD", None)
        _, ms = least(lambda: factor(vertices[1:, 2]))
        rows["cholmod_solve"] = ("cotan_solve", ours["cotan_solve"], ms, "CHOLMOD", None)

        solver, ms = least(lambda: potpourri3d.MeshHeatMethodDistanceSolver(vertices, faces, use_robust=False))
        rows["heat_setup"] = ("heat_setup", ours["heat_setup"], ms, "potpourri3d", None)
        theirs, ms = least(lambda: solver.compute_distance(0))
        found = np.loadtxt(folder / "distances.txt")
        difference = np.abs(found - theirs).max() / theirs.max()
        rows["heat_distances"] = ("heat_distances", ours["heat_distances"], ms, "potpourri3d", difference)

        tracer = potpourri3d.GeodesicTracer(vertices, faces)
        for what in [what for what in ours if what.startswith("trace_")]:
            rays = np.loadtxt(folder / f"rays-{what.split('_')[1]}.txt")[:RAYS]
            ends, ms = least(
                lambda: [tracer.trace_geodesic_from_face(int(r[0]), r[1:4], r[4:7])[-1] for r in rays]
            )
            lengths = np.linalg.norm(rays[:, 4:7], axis=1)
            difference = (np.linalg.norm(np.array(ends) - rays[:, 7:10], axis=1) / lengths).max()
            rows[what] = (what, ours[what], ms * 1e3 / len(rays), "potpourri3d, from Python", difference)

        name = pathlib.Path(arguments.mesh).stem
        record = HERE.parent / "record" / f"{datetime.date.today()}-operators.csv"
        new = not record.exists()
        with open(record, "a", newline="") as out:
            writer = csv.writer(out)
            if new:
                heading = ["date", "commit", "cpu", "load", "mesh", "faces", "what", "pompeiu", "peer", "name", "difference"]
                writer.writerow(heading)
            where = [datetime.date.today().isoformat(), commit(), cpu(), f"{os.getloadavg()[0]:.1f}"]
            for what, mine, peer, peer_name, difference in rows.values():
                numbers = ["" if x is None else f"{x:.4g}" for x in (mine, peer)]
                last = "" if difference is None else f"{difference:.2g}"
                row = [name, len(faces), what, *numbers, peer_name, last]
                writer.writerow(where + row)
                print(*row, sep="\t")


if __name__ == "__main__":
    main()
