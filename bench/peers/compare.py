#!/usr/bin/env python3
"""Measures programs against each other on the same pairs of meshes and writes a CSV record. See README.md."""

import argparse
import csv
import datetime
import json
import os
import pathlib
import platform
import resource
import statistics
import subprocess
import sys
import venv

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
VENV = HERE.parent / ".venv"
PEER = "cascading_upper_bounds"

GENERATED = {
    "lantern_vs_cylinder": (
        "schwarz-lantern --segments 48 --bands 192",
        "cylinder --segments 256 --rows 64",
    ),
    "noisy_sphere": ("icosphere --subdivisions 6", "icosphere --subdivisions 6 --noise 1e-4 --seed 1"),
    "coarse_torus": (
        "torus --major-segments 256 --minor-segments 128",
        "torus --major-segments 64 --minor-segments 32",
    ),
}

FIELDS = [
    "date", "cpu", "cores", "pair", "faces_a", "faces_b", "tolerance", "program", "version", "threads", "runs",
    "status", "lower", "upper", "wall_ms_median", "wall_ms_min", "wall_ms_max", "cpu_ms_median", "peak_mib",
    "memory_over_start_mib",
]


def environment():
    """The Python environment with the peers, made when absent."""
    python = VENV / "bin" / "python"
    stamp = VENV / "requirements.txt"
    wanted = (HERE / "requirements.txt").read_text()
    if not stamp.exists() or stamp.read_text() != wanted:
        venv.create(VENV, with_pip=True)
        subprocess.run([python, "-m", "pip", "install", "-q", "-r", HERE / "requirements.txt"], check=True)
        stamp.write_text(wanted)
    return python


def run(command, timeout, memory_limit=None):
    """Standard output of a command; its CPU time in ms and peak memory in MiB; or why it did not end well."""
    def limit():
        if memory_limit:
            resource.setrlimit(resource.RLIMIT_AS, (memory_limit, memory_limit))
    with open(os.devnull, "w") as null:
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=null, preexec_fn=limit)
        try:
            out, _ = process.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            return None, "timeout"
    return (out, "ok") if process.returncode == 0 else (None, f"failed ({process.returncode})")


def measured(command):
    """Runs a command; its output, peak memory in MiB and CPU time in ms by the operating system's account."""
    peak = ROOT / "target" / "peak"
    if not peak.exists():
        subprocess.run(["cc", "-O2", "-o", peak, HERE / "peak.c"], check=True)
    done = subprocess.run([peak, *command], check=True, capture_output=True, text=True)
    kib, cpu_ms = done.stderr.split()[-2:]
    return done.stdout, int(kib) / 1024, float(cpu_ms)


def run_pompeiu(binary, pair, tolerance, threads, start_mib):
    out, peak, cpu = measured([
        binary, "distance", pair / "a.obj", pair / "b.obj", "--direction", "a-to-b", "--json", "--quiet",
        "--tolerance", repr(tolerance), "--tolerance-kind", "absolute", "--threads", str(threads),
    ])
    answer = json.loads(out)
    timing = answer["timing_ms"]
    return {
        "lower": answer["a_to_b"]["lower"], "upper": answer["a_to_b"]["upper"],
        "wall_ms": timing["build"] + timing["search"], "cpu_ms": cpu,
        "peak_mib": peak, "memory_over_start_mib": peak - start_mib,
    }


def diagonal(binary, mesh):
    info = json.loads(subprocess.run([binary, "info", mesh, "--json"], check=True, capture_output=True).stdout)
    box = info["bounding_box"]
    return sum((u - l) ** 2 for l, u in zip(box["lower"], box["upper"])) ** 0.5, info["faces"]


def generated_pairs(binary, folder):
    for name, recipes in GENERATED.items():
        pair = folder / name
        pair.mkdir(parents=True, exist_ok=True)
        for mesh, recipe in zip("ab", recipes):
            path = pair / f"{mesh}.obj"
            if not path.exists():
                subprocess.run([binary, "--quiet", "generate", *recipe.split(), "-o", path], check=True)
        yield pair


def cpu_name():
    for line in open("/proc/cpuinfo"):
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return platform.processor()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pairs", type=pathlib.Path, default=ROOT.parent / "shared" / "data" / "pairs")
    parser.add_argument("--only", help="pairs whose name holds this")
    parser.add_argument("--tolerance", type=float, default=1e-8, help="fraction of the diagonal of A")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--timeout", type=float, default=30, help="seconds for one run of a peer")
    parser.add_argument("--memory", type=float, default=6, help="GiB of address space for one run of a peer")
    parser.add_argument("--record", type=pathlib.Path)
    options = parser.parse_args()

    python = environment()
    subprocess.run(["cargo", "build", "--release", "--quiet", "-p", "pompeiu-cli"], cwd=ROOT, check=True)
    binary = ROOT / "target" / "release" / "pompeiu"
    version = subprocess.run([binary, "--version"], capture_output=True, text=True).stdout.split()[-1]
    start_mib = measured([binary, "--version"])[1]
    pairs = list(generated_pairs(binary, ROOT / "target" / "pairs"))
    if options.pairs.is_dir():
        pairs += sorted(p for p in options.pairs.iterdir() if (p / "a.obj").exists() and (p / "b.obj").exists())
    pairs = [p for p in pairs if not options.only or options.only in p.name]
    date = datetime.date.today().isoformat()
    record = options.record or HERE.parent / "record" / f"{date}-peers.csv"
    record.parent.mkdir(parents=True, exist_ok=True)
    cores = os.cpu_count()

    rows = []
    for pair in pairs:
        extent, faces_a = diagonal(binary, pair / "a.obj")
        faces_b = diagonal(binary, pair / "b.obj")[1]
        tolerance = options.tolerance * extent
        results = {("pompeiu", cores): [], ("pompeiu", 1): [], (PEER, ""): []}
        peer_status = "ok"
        for _ in range(options.runs):
            for threads in (cores, 1):
                results[("pompeiu", threads)].append(run_pompeiu(binary, pair, tolerance, threads, start_mib))
            if peer_status == "ok":
                command = [python, HERE / "cub.py", pair / "a.obj", pair / "b.obj", repr(tolerance)]
                out, peer_status = run(command, options.timeout, int(options.memory * 2**30))
                if out:
                    results[(PEER, "")].append(json.loads(out))
        ours = results[("pompeiu", cores)][0]
        for (program, threads), runs in results.items():
            row = {
                "date": date, "cpu": cpu_name(), "cores": cores, "pair": pair.name, "faces_a": faces_a,
                "faces_b": faces_b, "tolerance": tolerance, "program": program,
                "version": version if program == "pompeiu" else "1.0.0", "threads": threads, "runs": len(runs),
                "status": "ok" if program == "pompeiu" else peer_status,
            }
            if runs and row["status"] == "ok":
                wall = [r["wall_ms"] for r in runs]
                last = runs[-1]
                if last["lower"] > ours["upper"] + tolerance or last["upper"] < ours["lower"] - tolerance:
                    row["status"] = "wrong"
                row |= {
                    "lower": last["lower"], "upper": last["upper"],
                    "wall_ms_median": round(statistics.median(wall), 3), "wall_ms_min": round(min(wall), 3),
                    "wall_ms_max": round(max(wall), 3),
                    "cpu_ms_median": round(statistics.median(r["cpu_ms"] for r in runs), 3),
                    "peak_mib": round(max(r["peak_mib"] for r in runs), 1),
                    "memory_over_start_mib": round(max(r["memory_over_start_mib"] for r in runs), 1),
                }
            rows.append(row)
            print(f"{pair.name:28} {program:24} {threads!s:2} {row['status']:10} "
                  f"{row.get('wall_ms_median', ''):>10} ms {row.get('memory_over_start_mib', ''):>8} MiB",
                  file=sys.stderr)
    with open(record, "w", newline="") as file:
        writer = csv.DictWriter(file, FIELDS)
        writer.writeheader()
        writer.writerows(rows)
    print(record)


if __name__ == "__main__":
    main()
