"""Distances and continuous collision detection beside ipctk: errors against 80-bit arithmetic, and times of impact."""

import argparse
import csv
import itertools
import os
import subprocess
import sys
import tempfile
import time
from fractions import Fraction
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
    """The errors of squared distances and of gradients of all pairs."""
    found = []
    for pair, distance, gradient in zip(pairs, distances, gradients):
        true, by = exact(kind, pair[1:13].reshape(4, 3))
        found.append((float(abs(distance - true) / true), float(np.abs(gradient - by).max() / np.abs(by).max())))
    return np.array(found).T


def ipctk_distances(kind, pairs):
    value = ipctk.edge_edge_distance if kind else ipctk.point_triangle_distance
    slope = ipctk.edge_edge_distance_gradient if kind else ipctk.point_triangle_distance_gradient
    corners = pairs[:, 1:13].reshape(-1, 4, 3)
    return [value(*x) for x in corners], [np.reshape(slope(*x), (4, 3)) for x in corners]


def moving_pairs(random, kind, count):
    return np.column_stack([np.full(count, kind), random.normal(size=(count, 12)), 2 * random.normal(size=(count, 12))])


def can_touch_until(pair, at):
    """Whether the four corners are coplanar at some time in (0, at], as they are at any contact: decided in rational numbers."""
    x, p = ([[Fraction(float(c)) for c in row] for row in rows.reshape(4, 3)] for rows in (pair[1:13], pair[13:]))
    edges = [[[rows[i][k] - rows[0][k] for k in range(3)] for i in (1, 2, 3)] for rows in (x, p)]
    volume = [Fraction(0)] * 4
    for choice in itertools.product((0, 1), repeat=3):
        u, v, w = (edges[part][i] for i, part in enumerate(choice))
        cross = (v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0])
        volume[sum(choice)] += sum(a * b for a, b in zip(u, cross))
    return roots_between(volume, Fraction(0), Fraction(float(at))) > 0


def roots_between(polynomial, low, high):
    """The number of different roots in (low, high], by Sturm's theorem; coefficients from the constant on."""
    trimmed = lambda p: p if not p or p[-1] else trimmed(p[:-1])  # noqa: E731
    at = lambda p, t: sum(c * t**k for k, c in enumerate(p))  # noqa: E731
    first = trimmed(polynomial)
    chain = [first, trimmed([k * c for k, c in enumerate(first)][1:])]
    while chain[-1]:
        rest, divisor = list(chain[-2]), chain[-1]
        while len(rest) >= len(divisor):
            factor, shift = rest[-1] / divisor[-1], len(rest) - len(divisor)
            rest = [c - factor * divisor[i - shift] if i >= shift else c for i, c in enumerate(rest)][:-1]
        chain.append(trimmed([-c for c in rest]))

    def changes(t):
        signs = [value > 0 for value in (at(p, t) for p in chain if p) if value]
        return sum(a != b for a, b in zip(signs, signs[1:]))

    return changes(low) - changes(high)


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


def sheets(random, cells):
    """Three noisy square sheets one above the other, turned against each other so that no edges are parallel: vertices and faces."""
    n = cells + 1
    i, j = np.meshgrid(np.arange(cells), np.arange(cells), indexing="ij")
    corner = (i * n + j).ravel()
    faces = np.concatenate([np.column_stack([corner, corner + n, corner + n + 1]), np.column_stack([corner, corner + n + 1, corner + 1])])
    u, v = np.meshgrid(np.linspace(-0.5, 0.5, n), np.linspace(-0.5, 0.5, n), indexing="ij")
    flat = np.column_stack([u.ravel(), v.ravel(), np.zeros(n * n)])
    vertices = []
    for k in range(3):
        angle = np.radians(20 * k)
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        noise = random.uniform(-1, 1, flat.shape) * [0.1 / cells, 0.1 / cells, 0.2 / cells]
        vertices.append((flat + noise) @ turn.T + [0, 0, 0.5 * k / cells])
    return np.concatenate(vertices), np.concatenate([faces + k * n * n for k in range(3)])


def best(of):
    """The result, and the best milliseconds of five runs."""
    seconds = []
    for _ in range(5):
        started = time.perf_counter()
        result = of()
        seconds.append(time.perf_counter() - started)
    return result, 1e3 * min(seconds)


def barriers(random, cells):
    """Potential, gradient and second derivatives of a whole scene, and the times of both on one thread."""
    vertices, faces = sheets(random, cells)
    d_hat = 0.25 / cells
    moves, vector = random.normal(size=(2, *vertices.shape)) * [[[0.5 / cells]], [[1]]]
    with tempfile.TemporaryDirectory() as folder:
        source, target = Path(folder) / "in", Path(folder) / "out"
        np.concatenate([[len(vertices), len(faces), d_hat], vertices.ravel(), moves.ravel(), vector.ravel(), faces.ravel()]).astype("<f8").tofile(source)
        program = ROOT / "target/release/examples/potential"
        done = subprocess.run([program, source, target], check=True, capture_output=True, text=True, env={**os.environ, "RAYON_NUM_THREADS": "1"})
        found = np.fromfile(target, "<f8")
    (pairs, mollified, free), ours = ([float(word) for word in line.split()] for line in done.stdout.splitlines())

    ipctk.set_num_threads(1)
    edges = ipctk.edges(faces)
    mesh = ipctk.CollisionMesh(vertices, edges, faces)
    potential = ipctk.BarrierPotential(d_hat, 1.0)

    def collisions():
        built = ipctk.NormalCollisions()
        built.build(mesh, vertices, d_hat)
        return built

    built, of_pairs = best(collisions)
    value, of_potential = best(lambda: potential(built, mesh, vertices))
    gradient, of_gradient = best(lambda: potential.gradient(built, mesh, vertices))
    _, of_projected = best(lambda: potential.hessian(built, mesh, vertices, ipctk.PSDProjectionMethod.CLAMP))
    detection = ipctk.AdditiveCCD()
    step, of_step = best(lambda: ipctk.compute_collision_free_stepsize(mesh, vertices, vertices + moves, narrow_phase_ccd=detection))
    product = potential.hessian(built, mesh, vertices) @ vector.ravel()
    relative = lambda ours, theirs: f"{np.abs(ours - theirs).max() / np.abs(theirs).max():.2e}"  # noqa: E731
    size = vertices.size
    case = f"{len(faces)} faces"
    rows = [
        ("sheets", case, "pompeiu", "pairs", int(pairs)),
        ("sheets", case, "pompeiu", "mollified pairs", int(mollified)),
        ("sheets", case, "both", "difference of the potential", relative(found[0], value)),
        ("sheets", case, "both", "difference of its gradient", relative(found[1 : 1 + size], gradient)),
        ("sheets", case, "both", "difference of its Hessian times a vector", relative(found[1 + size :], product)),
        ("sheets", case, "pompeiu", "free part of a displacement", f"{free:.6f}"),
        ("sheets", case, "ipctk additive", "free part of a displacement", f"{step:.6f}"),
    ]
    names = ("pairs", "potential", "gradient", "Hessian, normal part", "Hessian, exact projection", "free part")
    theirs = (of_pairs, of_potential, of_gradient, None, of_projected, of_step)
    for name, here, there in zip(names, ours, theirs):
        rows.append(("sheets", case, "pompeiu", f"milliseconds: {name}", f"{here:.2f}"))
        if there is not None:
            rows.append(("sheets", case, "ipctk", f"milliseconds: {name}", f"{there:.2f}"))
    return rows


def scenes():
    """Seconds of scenes with a name, on one thread."""
    rows = []
    for name in ("drape", "cloth-twist", "rod-twist"):
        program = ROOT / "target/release/examples/scene"
        before = os.times().children_user
        done = subprocess.run([program, name], check=True, capture_output=True, text=True, env={**os.environ, "RAYON_NUM_THREADS": "1"})
        used = os.times().children_user - before
        seconds, detection, steps, iterations = done.stdout.split()
        rows += [
            ("scene", name, "pompeiu", "processor seconds", f"{used:.2f}"),
            ("scene", name, "pompeiu", "part of collision detection", f"{float(detection) / float(seconds):.3f}"),
            ("scene", name, "pompeiu", "steps", steps),
            ("scene", name, "pompeiu", "Newton steps", iterations),
        ]
    return rows


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
            both = {"pompeiu": errors(kind, pairs, values, gradients), "ipctk": errors(kind, pairs, *ipctk_distances(kind, pairs))}
            for program, found in both.items():
                for what, of_pairs in zip(("distance error", "gradient error"), found):
                    rows.append((name, f"d={distance:g}", program, what, f"{of_pairs.max():.2e}"))
                    rows.append((name, f"d={distance:g}", program, f"median {what}", f"{np.median(of_pairs):.2e}"))
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
            (name, f"{len(pairs)} moving", "pompeiu", "of these after contact is possible", sum(can_touch_until(pairs[i], found[i]) for i in later)),
            (name, f"{len(pairs)} moving", "pompeiu", "median part of tight inclusion", f"{np.median(found[hits] / tight[hits]):.4f}"),
            (name, f"{len(pairs)} moving", "ipctk additive", "median part of tight inclusion", f"{np.median(additive[hits] / tight[hits]):.4f}"),
            (name, f"{len(pairs)} moving", "pompeiu", "microseconds a pair", f"{1e6 * seconds[1] / len(pairs):.3f}"),
        ]
    for cells in (48, 98):
        rows += barriers(random, cells)
    rows += scenes()
    header = ("pair", "case", "program", "quantity", "value")
    for row in [header, *rows]:
        print(*row, sep="\t")
    if arguments.record:
        with arguments.record.open("w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([header, *rows])
    return 0


if __name__ == "__main__":
    sys.exit(main())
