#!/usr/bin/env python3
"""How time and memory grow from a thousand to ten million faces, and with threads; writes a CSV record. See README.md.

Each pair is a shape and a deformed copy of it, made by `pompeiu generate` in a temporary folder and removed again.
"""

import argparse
import json
import math
import os
import pathlib
import shutil
import statistics
import tempfile
import time

import environment
import pairs
import record
import session

FIELDS = [
    "family", "faces_a", "faces_b", "direction", "threads", "runs", "obj_mib", "read_ms", "build_ms", "search_ms", "process_ms",
    "process_ms_min", "process_ms_max", "cpu_ms", "peak_mib", "memory_over_start_mib", "lower", "upper", "stop",
]
# OBJ files take some 55 bytes for a face, with its share of vertices; what a pair may need of the disk is this.
DISK_BYTES_PER_FACE = 2 * 70
# Of the diagonal of the box around both meshes; the pairs of compare.py have the same.
TOLERANCE = "1e-8"
# How far a vertex of the noisy torus moves, as a share of an edge around the axis.
NOISE = 0.05


def torus(half):
    """A torus of 4 half² faces and a noisy copy."""
    shape = f"torus --major-segments {2 * half} --minor-segments {half}"
    return 4 * half**2, shape, f"{shape} --noise {NOISE * 6.2832 / (2 * half):.6g} --seed 1"


def sphere(subdivisions):
    """A sphere of 20 · 4^n faces and a smoothly deformed copy."""
    shape = f"icosphere --subdivisions {subdivisions}"
    return 20 * 4**subdivisions, shape, f"{shape} --ripple 0.02,1"


FAMILIES = {
    "sphere, rippled": [sphere(n) for n in range(3, 10)],
    "torus, noisy": [torus(half) for half in (16, 50, 159, 500, 1582)],
}
# Up to these numbers of faces: how often the command runs, and whether with fewer threads and in both directions too.
EFFORTS = [(200_000, 5, True), (2_000_000, 3, True), (6_000_000, 2, False), (math.inf, 1, False)]


def run(files, direction, threads, count, limit):
    """Medians of some runs of the whole command."""
    command = [environment.pompeiu(), "distance", *files, "--direction", direction, "--json", "--quiet", "--tolerance", TOLERANCE,
               "--threads", str(threads), "--time-limit", f"{limit:g}s"]
    start_mib = session.measured([environment.pompeiu(), "--version"])[1]
    runs = []
    for _ in range(count):
        began = time.perf_counter()
        out, peak, cpu = session.measured(command)
        took = 1e3 * (time.perf_counter() - began)
        answer = json.loads(out)
        report = answer["report"]
        runs.append(answer["timing_ms"] | report["timing_ms"] | {"process": took, "cpu": cpu, "peak": peak})

    def median(key):
        return round(statistics.median(r[key] for r in runs), 3)

    directed = report["a_to_b"] if direction == "a-to-b" else report["hausdorff"]
    stops = [report[key]["stop"] for key in ("a_to_b", "b_to_a") if key in report]
    return {
        "direction": direction, "threads": threads, "runs": count, "read_ms": median("read"), "build_ms": median("build"),
        "search_ms": median("search"), "process_ms": median("process"),
        "process_ms_min": round(min(r["process"] for r in runs), 3),
        "process_ms_max": round(max(r["process"] for r in runs), 3), "cpu_ms": median("cpu"),
        "peak_mib": max(r["peak"] for r in runs), "memory_over_start_mib": max(r["peak"] for r in runs) - start_mib,
        "lower": directed["lower"], "upper": directed["upper"],
        "stop": next((stop for stop in stops if stop != "tolerance"), "tolerance"),
    }


def study(family, faces, recipes, options, folder):
    """The rows of one pair."""
    files = [folder / "a.obj", folder / "b.obj"]
    for path, recipe in zip(files, recipes):
        pairs.generate(recipe, path)
    cores = os.cpu_count()
    runs, thoroughly = next(effort for most, *effort in EFFORTS if faces <= most)
    threads = thread_counts(cores)
    asked = [*(("a-to-b", n) for n in threads), ("both", cores)] if thoroughly else [("a-to-b", cores)]
    for direction, threads in asked:
        row = {"family": family, "faces_a": faces, "faces_b": faces,
               "obj_mib": round(sum(path.stat().st_size for path in files) / 2**20, 1)}
        row |= run(files, direction, threads, min(runs, options.runs), options.limit)
        environment.say(
            f"{family:16} {faces:>11,} faces, {direction:6} {threads} threads: read {row['read_ms']:,.1f}, build "
            f"{row['build_ms']:,.1f}, search {row['search_ms']:,.1f}, process {row['process_ms']:,.1f} ms; "
            f"{row['memory_over_start_mib'] * 2**20 / (2 * faces):.0f} bytes per face"
            f"{', stopped by the limit on time' if row['stop'] == 'time' else ''}")
        yield row


def thread_counts(cores):
    """1, 2, 4 and so on, and all."""
    return sorted({cores, *(2**k for k in range(cores.bit_length()) if 2**k <= cores)}, reverse=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--most", type=float, default=2e7, metavar="FACES", help="leave out meshes of more faces")
    parser.add_argument("--family", help="only the family whose name holds this")
    parser.add_argument("--runs", type=int, default=5, help="of the command, at most; large meshes have fewer")
    parser.add_argument("--limit", type=float, default=60, metavar="SECONDS",
                        help="stop a search then; the record says so, and the study counts it as a no")
    parser.add_argument("--folder", type=pathlib.Path, help="where the files are made and removed; 1.2 GB of room")
    parser.add_argument("--record", type=pathlib.Path, help="the CSV file to write")
    options = parser.parse_args()
    rows = []
    for family, sizes in FAMILIES.items():
        for faces, *recipes in sizes:
            if faces > options.most or options.family and options.family not in family:
                continue
            with tempfile.TemporaryDirectory(prefix="scaling-", dir=options.folder) as folder:
                if shutil.disk_usage(folder).free < DISK_BYTES_PER_FACE * faces:
                    environment.say(f"{family}, {faces:,} faces: left out, there is no room for the files in {folder}")
                    continue
                rows += study(family, faces, recipes, options, pathlib.Path(folder))
    to = options.record or record.path("scaling")
    record.write(to, FIELDS, rows)
    print(to)


if __name__ == "__main__":
    main()
