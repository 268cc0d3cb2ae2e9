"""Contours and registration beside scikit-image and pycpd, and how long puzzles take, in one run.

Writes ../record/DATE-planar.csv: date, commit, processor, load of the machine, task, size, program, threads, milliseconds of processor time,
milliseconds by the clock, and what the program found.
"""

import argparse
import datetime
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

for name in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"]:
    os.environ[name] = "1"

import numpy as np
from pycpd import RigidRegistration
from skimage.measure import find_contours

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "peers"))

import record  # noqa: E402

FIELDS = ["date", "commit", "cpu", "load", "task", "size", "program", "threads", "cpu_ms", "wall_ms", "found"]


class Session:
    def __init__(self, target, path):
        self.target, self.path = target, path
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="planar-"))

    def add(self, task, size, program, threads, cpu, wall, found):
        row = {
            "date": datetime.date.today().isoformat(),
            "commit": record.git("rev-parse", "--short=10", "HEAD"),
            "cpu": record.cpu(),
            "load": f"{os.getloadavg()[0]:.1f}",
            "task": task,
            "size": size,
            "program": program,
            "threads": threads,
            "cpu_ms": f"{cpu:.2f}",
            "wall_ms": f"{wall:.2f}",
            "found": found,
        }
        print(", ".join(f"{key} {row[key]}" for key in FIELDS[4:]), flush=True)
        record.append(self.path, FIELDS, row)

    def run(self, *words, threads=1):
        """What a program prints, with its processor and wall-clock milliseconds."""
        before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        environment = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
        done = subprocess.run(list(map(str, words)), capture_output=True, text=True, env=environment, check=True)
        wall = time.perf_counter() - started
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        return done.stdout, 1000 * cpu, 1000 * wall


def timed(work):
    cpu, wall = time.process_time(), time.perf_counter()
    found = work()
    return found, 1000 * (time.process_time() - cpu), 1000 * (time.perf_counter() - wall)


def pictures(count, side, seed=7):
    """Smooth random levels, some waves in each."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[0:side, 0:side] / side
    for _ in range(count):
        levels = np.zeros((side, side))
        for _ in range(6):
            wave, phase = rng.normal(scale=12.0, size=2), rng.uniform(0, 2 * np.pi)
            levels += rng.normal() * np.sin(wave[0] * x + wave[1] * y + phase)
        yield (0.5 + 0.25 * levels).astype(np.float32)


def contours(session, count, side):
    file = session.folder / "pictures.f32"
    with open(file, "wb") as out:
        for levels in pictures(count, side):
            out.write(levels.tobytes())
    total, cpu, wall = 0, 0.0, 0.0
    for levels in pictures(count, side):
        found, more_cpu, more_wall = timed(lambda: find_contours(levels, 0.5))
        total, cpu, wall = total + sum(map(len, found)), cpu + more_cpu, wall + more_wall
    session.add("contours", f"{count} of {side}²", "scikit-image", 1, cpu, wall, f"{total} points")
    answer = json.loads(session.run(session.target / "examples" / "contours", file, side)[0])
    session.add("contours", f"{count} of {side}²", "pompeiu", 1, answer["cpu_ms"], answer["wall_ms"], f"{answer['points']} points")


def registration(session, points):
    rng = np.random.default_rng(3)
    at = 2 * np.pi * np.arange(points) / points
    radius = 1 + 0.3 * np.cos(at) + 0.2 * np.sin(3 * at) + 0.1 * np.cos(5 * at)
    shape = np.column_stack([radius * np.cos(at), radius * np.sin(at)])
    turn = 0.6
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    other = 1.7 * shape @ rotation.T + [4.0, -3.0] + rng.normal(scale=0.01, size=shape.shape)

    def rms(moved):
        distances = np.linalg.norm(moved[:, None] - other, axis=2).min(axis=1)
        return np.sqrt((distances**2).mean())

    (moved, _), cpu, wall = timed(lambda: RigidRegistration(X=other, Y=shape).register())
    session.add("registration", points, "pycpd", 1, cpu, wall, f"rms {rms(moved):.5f}")
    file = session.folder / "points.txt"
    np.savetxt(file, np.vstack([shape, other]))
    answer = json.loads(session.run(session.target / "examples" / "speed", "register", file)[0])
    session.add("registration", points, "pompeiu", 1, answer["cpu_ms"], answer["wall_ms"], f"rms {answer['rms']:.5f}")


def puzzles(session):
    for threads in [1, 2]:
        answer = json.loads(session.run(session.target / "examples" / "speed", "map", threads=threads)[0])
        session.add("map of 256 sides", "200²", "pompeiu", threads, answer["cpu_ms"], answer["wall_ms"], "")
        answer = json.loads(session.run(session.target / "examples" / "speed", "lloyd", threads=threads)[0])
        session.add("a round of 1,736 sites", "1000²", "pompeiu", threads, answer["cpu_ms"], answer["wall_ms"], "")
    program = session.target / "pompeiu"
    for words in [["--layout", "voronoi", "-n", 1000], ["--piece", "bird", "-n", 24], ["--piece", "fish", "-n", 24]]:
        text, cpu, wall = session.run(program, "puzzle", *words, "--json", threads=2)
        answer = json.loads(text)["report"]
        fits = [piece["similarity"]["iou"] for piece in answer["pieces"] if piece["similarity"]]
        found = f"{len(answer['clusters'])} clusters" + (f", mean overlap {np.mean(fits):.3f}" if fits else "")
        session.add("puzzle " + " ".join(map(str, words)), len(answer["pieces"]), "pompeiu", 2, cpu, wall, found)


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--target", type=pathlib.Path, default=pathlib.Path("target/release"))
    options.add_argument("--pictures", type=int, default=1400)
    options.add_argument("--record", type=pathlib.Path, default=record.path("planar"))
    chosen = options.parse_args()
    session = Session(chosen.target.resolve(), chosen.record)
    contours(session, chosen.pictures, 256)
    registration(session, 150)
    puzzles(session)


if __name__ == "__main__":
    main()
