"""Distances and continuous collision detection beside ipctk: errors against 80-bit arithmetic, and times of impact."""

import argparse
import csv
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import ipctk
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
LONG = np.longdouble


def ours(pairs):
    """Squared distances, gradients and times of impact of pompeiu, and the seconds of distances and of times."""
    program = ROOT / "target/release/examples/pairs"
    with tempfile.TemporaryDirectory() as folder:
        source, target = Path(folder) / "in", Path(folder) / "out"
        pairs.astype("<f8").tofile(source)
        done = subprocess.run([program, source, target], check=True, capture_output=True, text=True)
        rows = np.fromfile(target, "<f8").reshape(-1, 14)
    return rows[:, 0], rows[:, 1:13].reshape(-1, 4, 3), rows[:, 13], [float(word) for word in done.stdout.split()]


def close_pairs(random, kind, count, distance):
    """Pairs of size 1 whose closest points are inside of both parts, at a distance."""
    pairs = []
    while len(pairs) < count:
        x = random.normal(size=(4, 3))
        normal = np.cross(x[2] - x[1], x[3] - x[1]) if kind == 0 else np.cross(x[1] - x[0], x[3] - x[2])
        normal /= np.linalg.norm(normal)
        if kind == 0:
            weights = random.dirichlet([2, 2, 2])
            x[0] = weights @ x[1:] + distance * normal
        else:
            s, t = random.uniform(0.1, 0.9, 2)
            shift = (1 - s) * x[0] + s * x[1] - (1 - t) * x[2] - t * x[3]
            x[2:] += shift - distance * normal
        pairs.append(np.concatenate([[kind], x.ravel(), np.zeros(12)]))
    return np.array(pairs)


def exact(kind, x):
    """The squared distance of a pair and its gradient in 80 bits, where the closest points are inside of both parts."""
    x = x.astype(LONG)
    if kind == 0:
        r0, ra, rb = x[0] - x[1], x[1] - x[2], x[1] - x[3]
    else:
        r0, ra, rb = x[0] - x[2], x[1] - x[0], x[2] - x[3]
    aa, ab, bb, ar, br = ra @ ra, ra @ rb, rb @ rb, ra @ r0, rb @ r0
    determinant = aa * bb - ab * ab
    s, t = (ab * br - bb * ar) / determinant, (ab * ar - aa * br) / determinant
    weights = np.array([1, s + t - 1, -s, -t] if kind == 0 else [1 - s, s, t - 1, -t], dtype=LONG)
    # The vector along the normal has all digits that the corners allow.
    normal = np.cross(ra, rb)
    normal = normal / np.sqrt(normal @ normal)
    r = normal * (normal @ r0)
    return r @ r, 2 * np.outer(weights, r)


def errors(kind, pairs, distances, gradients):
    worst = [0.0, 0.0]
    for pair, distance, gradient in zip(pairs, distances, gradients):
        true, by = exact(kind, pair[1:13].reshape(4, 3))
        worst[0] = max(worst[0], float(abs(distance - true) / true))
        worst[1] = max(worst[1], float(np.abs(gradient - by).max() / np.abs(by).max()))
    return worst


def ipctk_distances(kind, pairs):
    value = ipctk.edge_edge_distance if kind else ipctk.point_triangle_distance
    slope = ipctk.edge_edge_distance_gradient if kind else ipctk.point_triangle_distance_gradient
    corners = pairs[:, 1:13].reshape(-1, 4, 3)
    return [value(*x) for x in corners], [np.reshape(slope(*x), (4, 3)) for x in corners]


def moving_pairs(random, kind, count):
    return np.column_stack([np.full(count, kind), random.normal(size=(count, 12)), 2 * random.normal(size=(count, 12))])


def is_before_contact(pair, at):
    """Whether the four corners are nowhere coplanar until a time, so that nothing can have touched."""
    x, p = pair[1:13].reshape(4, 3), pair[13:].reshape(4, 3)
    places = np.linspace(0, at, 4)
    volumes = [np.linalg.det((x + t * p)[1:] - (x + t * p)[0]) for t in places]
    roots = np.roots(np.polyfit(places / at, volumes, 3))
    real = roots[np.abs(roots.imag) < 1e-9].real
    return not ((real >= 0) & (real <= 1)).any()


def times(method, pairs):
    """Times of impact by a method of ipctk, infinite where there is none, and the seconds."""
    found = np.full(len(pairs), np.inf)
    started = time.process_time()
    for i, pair in enumerate(pairs):
        x, p = pair[1:13].reshape(4, 3), pair[13:].reshape(4, 3)
        query = method.edge_edge_ccd if pair[0] else method.point_triangle_ccd
        hit, at = query(*x, *(x + p))
        if hit:
            found[i] = at
    return found, time.process_time() - started


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pairs", type=int, default=50_000, help="moving pairs of each kind")
    parser.add_argument("--record", type=Path)
    arguments = parser.parse_args()
    random = np.random.default_rng(1)
    rows = []
    for kind, name in enumerate(["point-triangle", "edge-edge"]):
        for distance in (1e-1, 1e-3, 1e-6):
            pairs = close_pairs(random, kind, 2_000, distance)
            values, gradients, *_ = ours(pairs)
            for program, worst in (
                ("pompeiu", errors(kind, pairs, values, gradients)),
                ("ipctk", errors(kind, pairs, *ipctk_distances(kind, pairs))),
            ):
                rows += [(name, f"d={distance:g}", program, what, f"{error:.2e}") for what, error in zip(("distance error", "gradient error"), worst)]
        pairs = moving_pairs(random, kind, arguments.pairs)
        *_, found, seconds = ours(pairs)
        tight, _ = times(ipctk.TightInclusionCCD(), pairs)
        additive, _ = times(ipctk.AdditiveCCD(), pairs)
        hits = np.isfinite(tight)
        later = np.flatnonzero(hits & (found > tight))
        rows += [
            (name, f"{len(pairs)} moving", "ipctk tight inclusion", "hits", int(hits.sum())),
            (name, f"{len(pairs)} moving", "pompeiu", "missed", int((hits & ~np.isfinite(found)).sum())),
            (name, f"{len(pairs)} moving", "pompeiu", "later than tight inclusion", len(later)),
            (name, f"{len(pairs)} moving", "pompeiu", "of these after contact is possible", sum(not is_before_contact(pairs[i], found[i]) for i in later)),
            (name, f"{len(pairs)} moving", "pompeiu", "median part of tight inclusion", f"{np.median(found[hits] / tight[hits]):.4f}"),
            (name, f"{len(pairs)} moving", "ipctk additive", "median part of tight inclusion", f"{np.median(additive[hits] / tight[hits]):.4f}"),
            (name, f"{len(pairs)} moving", "pompeiu", "microseconds a pair", f"{1e6 * seconds[1] / len(pairs):.3f}"),
        ]
    header = ("pair", "case", "program", "quantity", "value")
    for row in [header, *rows]:
        print(*row, sep="\t")
    if arguments.record:
        with arguments.record.open("w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([header, *rows])
    return 0


if __name__ == "__main__":
    sys.exit(main())
