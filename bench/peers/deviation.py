#!/usr/bin/env python3
"""How time and memory of `pompeiu deviation` grow from ten thousand to a million faces; writes a CSV record. See README.md.

Each pair is made by `pompeiu generate` in a temporary folder and removed again: a torus and a noisy copy of as many faces, and a scan,
which is noisy, dented and incomplete, beside a model of a tenth of the faces.
"""

import argparse
import json
import math
import pathlib
import statistics
import subprocess
import tempfile
import time

import deviation_chart
import environment
import growth
import record
import session

FIELDS = [
    "family", "faces_a", "faces_b", "accuracy", "runs", "process_ms", "process_ms_min", "process_ms_max", "cpu_ms", "peak_mib",
    "memory_over_start_mib", "build", "mean_lower", "mean_upper", "stop",
]
SIZES = [10_000, 30_000, 100_000, 300_000, 1_000_000]
ACCURACIES = ["0.01", "0.1"]
# How far a vertex moves, as a share of an edge around the axis.
NOISE = 0.1
# What is dented: around this point, so far around it, so deep. And what is missing: all faces with a centre near a point.
DENT = ((1.4, 0.0, 0.0), 0.25, 0.03)
MISSING = ((-1.2, 0.3, 0.2), 0.25)


def torus(faces, noise=0.0):
    """A torus of about so many faces."""
    minor = max(3, round(math.sqrt(faces / 5)))
    major = round(2.5 * minor)
    noisy = f" --noise {noise * 2 * math.pi / major:.6g} --seed 1" if noise else ""
    return f"torus --major-segments {major} --minor-segments {minor}{noisy}"


def damaged(source, path):
    """Writes a copy of an OBJ file with a dent and a hole."""
    (dent, radius, depth), (hole, reach) = DENT, MISSING
    positions = []
    with open(source) as lines, open(path, "w") as out:
        for line in lines:
            kind, *words = line.split() or [""]
            if kind == "v":
                x, y, z = map(float, words[:3])
                away = math.dist((x, y, z), dent) / radius
                x -= depth * (1 - away**2) ** 2 if away < 1 else 0.0
                positions.append((x, y, z))
                line = f"v {x!r} {y!r} {z!r}\n"
            elif kind == "f":
                corners = [positions[int(word.split("/")[0]) - 1] for word in words]
                if math.dist([sum(axis) / len(corners) for axis in zip(*corners)], hole) < reach:
                    continue
            out.write(line)


def make(program, family, faces, folder):
    """The files of a pair."""
    def generate(arguments, path):
        subprocess.run([program, "--quiet", "generate", *arguments.split(), "-o", path], check=True)

    files = [folder / "a.obj", folder / "b.obj"]
    if family == "scan":
        whole = folder / "whole.obj"
        generate(torus(faces, NOISE), whole)
        damaged(whole, files[0])
        generate(torus(faces / 10), files[1])
    else:
        generate(torus(faces), files[0])
        generate(torus(faces, NOISE), files[1])
    return files


def run(program, files, accuracy, count):
    """Medians of some runs of the whole command."""
    command = [program, "deviation", *files, "--accuracy", accuracy, "--json", "--quiet"]
    start_mib = session.measured([program, "--version"])[1]
    times, cpus, peaks = [], [], []
    for _ in range(count):
        began = time.perf_counter()
        out, peak, cpu = session.measured(command)
        times.append(1e3 * (time.perf_counter() - began))
        cpus.append(cpu)
        peaks.append(peak)
    answer = json.loads(out)
    faces, answer = [file["faces"] for file in answer["inputs"]], answer["report"]
    mean = answer["a_to_b"]["statistics"]["mean"]
    stops = [answer[key]["stop"] for key in ("a_to_b", "b_to_a")]
    return {
        "faces_a": faces[0], "faces_b": faces[1], "accuracy": accuracy, "runs": count,
        "process_ms": round(statistics.median(times), 3), "process_ms_min": round(min(times), 3),
        "process_ms_max": round(max(times), 3), "cpu_ms": round(statistics.median(cpus), 3), "peak_mib": max(peaks),
        "memory_over_start_mib": max(peaks) - start_mib, "build": pathlib.Path(program).parent.name, "mean_lower": mean["lower"], "mean_upper": mean["upper"],
        "stop": next((stop for stop in stops if stop != "tolerance"), "tolerance"),
    }


def verdicts(rows):
    """A sentence for each family and accuracy."""
    lines = []
    for family, accuracy in dict.fromkeys((row["family"], row["accuracy"]) for row in rows):
        sized = [row for row in rows if (row["family"], row["accuracy"]) == (family, accuracy)]
        largest = sized[-1]
        grows = ""
        if len(sized) > 1:
            p = growth.exponent([(growth.faces(row), float(row["cpu_ms"])) for row in sized])
            grows = f"processor time grows like (n log n) to the power {p:.2f}; "
        lines.append(
            f"* {family}, accuracy {accuracy}: {grows}{growth.faces(largest):,} faces of both take "
            f"{float(largest['process_ms']) / 1e3:.1f} s, {float(largest['cpu_ms']) / 1e3:.1f} s of processors, and "
            f"{growth.bytes_per_face(largest):,.0f} bytes per face.")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--most", type=float, default=2e6, metavar="FACES", help="leave out meshes of more faces")
    parser.add_argument("--runs", type=int, default=3, help="of the command")
    parser.add_argument("--folder", type=pathlib.Path, help="where the files are made and removed; 300 MB of room")
    parser.add_argument("--program", type=pathlib.Path, help="the program to measure instead of a release build of this repository")
    parser.add_argument("--draw", action="store_true", help="draw the figure of the guide from the record")
    parser.add_argument("--record", type=pathlib.Path, help="the CSV file to write")
    options = parser.parse_args()
    rows = []
    program = options.program or environment.pompeiu()
    for family in ("noisy", "scan"):
        for faces in SIZES:
            if faces > options.most:
                continue
            with tempfile.TemporaryDirectory(prefix="deviation-", dir=options.folder) as folder:
                files = make(program, family, faces, pathlib.Path(folder))
                for accuracy in ACCURACIES:
                    rows.append({"family": family} | run(program, files, accuracy, options.runs))
                    environment.say(f"{family:6} {faces:>9,} faces, accuracy {accuracy}: {rows[-1]['cpu_ms']:,.0f} ms of processors")
    print(*verdicts(rows), sep="\n")
    to = options.record or record.path("deviation")
    record.write(to, FIELDS, rows)
    print(to)
    if options.draw:
        deviation_chart.draw(record.read(to), environment.ROOT / "docs/guide/pages/pictures/deviation-growth.svg")


if __name__ == "__main__":
    main()
