#!/usr/bin/env python3
"""Small meshes that programs fail on, each with the true distance in closed form; writes a CSV record. See README.md.

Every tool that can run here is asked for the distance from A to B of every case, once.
"""

import argparse
import math
import pathlib
import tempfile

import arrays
import environment
import judge
import lineup
import pairs
import record
from session import NoAnswer

# Relative to the true distance, or to the size of the mesh where that is zero; all cases are exact far below it.
TOLERANCE = 1e-6
NAN, INF = math.nan, math.inf

FIELDS = ["case", "about", "truth", "tolerance", "tool", "title", "kind", "version", "status", "detail", "lower", "upper"]

FACE = [(0, 1, 2)]
TRIANGLE = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]
SQUARE = [(-1.0, -1.0, 0.0), (1.0, -1.0, 0.0), (1.0, 1.0, 0.0), (-1.0, 1.0, 0.0)]
HALVES = [(0, 1, 2), (0, 2, 3)]


def square():
    return SQUARE, HALVES


def tent(height=1.0):
    """Four faces over the square, with the apex above its middle."""
    return [*SQUARE, (0.0, 0.0, height)], [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]


def grid(n, turned=False):
    """The unit square in n x n cells, each cut along one diagonal or along the other."""
    vertices = [(i / n, j / n, 0.0) for j in range(n + 1) for i in range(n + 1)]
    faces = []
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            b, c, d = a + 1, a + n + 2, a + n + 1
            faces += [(a, b, d), (b, c, d)] if turned else [(a, b, c), (a, c, d)]
    return vertices, faces


def mapped(mesh, function):
    """A mesh with its vertices moved."""
    return [tuple(map(function, p)) for p in mesh[0]], mesh[1]


def raised(mesh, height):
    """A mesh moved along z."""
    return [(x, y, z + height) for x, y, z in mesh[0]], mesh[1]


def with_vertex(mesh, vertex):
    """A mesh with a vertex more that no face uses."""
    return [*mesh[0], vertex], mesh[1]


def with_broken_vertex(mesh, x):
    """A mesh whose first vertex, which faces use, has no position."""
    return [(x, *mesh[0][0][1:]), *mesh[0][1:]], mesh[1]


# The farthest point is (0, 0.250984, 1), inside the face.
RIDGE = [(-1.0, 1.0, 1.0), (0.0, -1.0, 1.0), (1.0, 1.0, 1.0)], FACE
VALLEY = (
    [(-1.0, 1.0, 0.0), (0.0, -1.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, -1.0), (-0.5, 0.0, -1.0), (0.5, 0.0, -1.0)],
    [(3, 4, 5), (0, 4, 3), (1, 5, 4), (2, 3, 5)],
)

# Name: what it is, A, B, the true distance from A to B; None where no distance exists and the input has to be refused.
CASES = {
    "tent_flat": ("a square below a tent: the maximum is in the middle of A", square(), tent(), 1 / math.sqrt(2)),
    "skew_quad": (
        "a quad with either diagonal: all vertices agree, the surfaces do not",
        ([(0.0, 0.0, 0.0), (1.0, 0.0, 1.0), (1.0, 1.0, 0.0), (0.0, 1.0, 1.0)], [(0, 1, 2), (0, 2, 3)]),
        ([(0.0, 0.0, 0.0), (1.0, 0.0, 1.0), (1.0, 1.0, 0.0), (0.0, 1.0, 1.0)], [(0, 1, 3), (1, 2, 3)]), 1 / math.sqrt(3)),
    "interior_maximum": ("a face over a valley: the maximum is inside the face", RIDGE, VALLEY, 1.591686239),
    "three_points": (
        "a triangle against its corners, as faces shrunk to points",
        ([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.5, math.sqrt(0.75), 0.0)], FACE),
        ([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.5, math.sqrt(0.75), 0.0)], [(0, 0, 0), (1, 1, 1), (2, 2, 2)]),
        1 / math.sqrt(3)),
    "one_triangle": ("one triangle against the same, raised by 1", (TRIANGLE, FACE), raised((TRIANGLE, FACE), 1.0), 1.0),
    "segment": (
        "a face without area, which is a segment, above a square",
        ([(-1.0, 0.0, 1.0), (1.0, 0.0, 1.0), (0.0, 0.0, 1.0)], FACE), square(), 1.0),
    "coplanar": (
        "a square in 2 x 2 cells against 3 x 3 cells: the same surface", grid(2), grid(3, True), 0.0),
    "parallel": ("the same, raised by 1", grid(2), raised(grid(3, True), 1.0), 1.0),
    "itself": ("a tent against itself", tent(), tent(), 0.0),
    "unused_far_a": (
        "A has a vertex at 100 that no face uses", with_vertex(grid(2), (0.0, 0.0, 100.0)), raised(grid(3), 1.0), 1.0),
    "unused_far_b": (
        "B has a vertex next to A that no face uses", grid(2), with_vertex(raised(grid(3), 1.0), (0.0, 0.0, 0.0)), 1.0),
    "unused_nan_a": (
        "A has a vertex without position that no face uses; refusing it is as good", with_vertex(grid(2), (NAN, NAN, NAN)),
        raised(grid(3), 1.0), 1.0),
    "nan_a": ("a coordinate of a face of A is not a number", with_broken_vertex(grid(2), NAN), raised(grid(3), 1.0), None),
    "nan_b": ("a coordinate of a face of B is not a number", grid(2), with_broken_vertex(raised(grid(3), 1.0), NAN), None),
    "infinite_a": ("a coordinate of A is infinite", with_broken_vertex(grid(2), INF), raised(grid(3), 1.0), None),
    "infinite_b": ("a coordinate of B is infinite", grid(2), with_broken_vertex(raised(grid(3), 1.0), INF), None),
    "empty_a": ("A has no face", (TRIANGLE, []), grid(2), None),
    "empty_b": ("B has no face", grid(2), (TRIANGLE, []), None),
    "moved_1e9": (
        "the square and a tent of height 1/256, with 1e9 added to each coordinate, which is exact",
        mapped(square(), lambda x: x + 1e9), mapped(tent(1 / 256), lambda x: x + 1e9), 1 / math.sqrt(1 + 256**2)),
    "tent_apex": ("a tent above a square: the maximum is at the apex", tent(), square(), 1.0),
    "parallel_1e8": (
        "squares 1 apart, with 1e8 added to each coordinate, which is exact",
        mapped(grid(2), lambda x: x + 1e8), mapped(raised(grid(2, True), 1.0), lambda x: x + 1e8), 1.0),
    "scaled_1e-160": (
        "the tent and the square times 1e-160: the maximum is at the apex",
        mapped(tent(), lambda x: x * 1e-160), mapped(square(), lambda x: x * 1e-160), 1e-160),
    "scaled_1e150": (
        "the tent and the square times 1e150: the maximum is at the apex",
        mapped(tent(), lambda x: x * 1e150), mapped(square(), lambda x: x * 1e150), 1e150),
}

# What a program may refuse, and be right.
REFUSABLE = {case for case, (*_, truth) in CASES.items() if truth is None} | {"unused_nan_a"}


def verdict(kind, answer, truth, tolerance):
    """As judge.judge; where there is no distance, every number is wrong."""
    if truth is None:
        found = answer.get("value", answer.get("upper"))
        return "wrong", f"answers {found:.6g} where there is no distance"
    return judge.judge(kind, answer, (truth, truth), tolerance)


def ask(case, entrants, folder, options):
    """The rows of a case: what each tool says."""
    about, a, b, truth = CASES[case]
    size = max(abs(x) for p in a[0] for x in p if math.isfinite(x))
    tolerance = TOLERANCE * (truth or size)
    files, written = [], []
    for name, mesh in zip("ab", (a, b)):
        files.append(folder / f"{name}.obj")
        arrays.write_obj(files[-1], *mesh)
        written.append(folder / f"{name}.arrays")
        arrays.write(written[-1], *mesh)
    pair = pairs.Prepared(case, about, tuple(files), tuple(written), (len(a[1]), len(b[1])), math.nan)
    limits = lineup.Limits(options.timeout, int(options.memory * 2**30))
    # All load at once; nothing is timed here.
    sessions = [entrant.start(pair, tolerance, options.samples, limits) for entrant in entrants]
    try:
        for entrant, session in zip(entrants, sessions):
            yield {"case": case, "about": about, "truth": "" if truth is None else truth, "tolerance": tolerance,
                   "tool": entrant.name, "title": entrant.adapter.TITLE, "kind": entrant.adapter.KIND,
                   **said(session, case, entrant.adapter.KIND, truth, tolerance, folder), "version": session.version}
    finally:
        for session in sessions:
            session.close()


def said(session, case, kind, truth, tolerance, folder):
    """One answer and its verdict."""
    try:
        answer = session.ask()
    except NoAnswer as end:
        is_right = end.status == "refused" and case in REFUSABLE
        return {"status": "right" if is_right else end.status, "detail": str(end).replace(f"{folder}/", "")}
    status, detail = verdict(kind, answer, truth, tolerance)
    return {"status": status, "detail": detail, "lower": answer.get("lower", answer.get("value")),
            "upper": answer.get("upper", answer.get("value"))}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", help="cases whose name holds this")
    parser.add_argument("--tools", help="tools whose name holds one of these, separated by commas")
    parser.add_argument("--samples", type=int, default=10_000, help="points that sampling tools take")
    parser.add_argument("--timeout", type=float, default=3, help="seconds for an answer")
    parser.add_argument("--memory", type=float, default=6, help="GiB of address space for a tool")
    parser.add_argument("--record", type=pathlib.Path, help="the CSV file to write")
    options = parser.parse_args()
    present = [e for e in lineup.entrants() if not e.absent and not (e.name == "pompeiu" and e.threads == "1")]
    if options.tools:
        present = [e for e in present if any(word in e.name for word in options.tools.split(","))]
    rows = []
    with tempfile.TemporaryDirectory(prefix="cases-") as folder:
        for case in CASES:
            if options.only and options.only not in case:
                continue
            for row in ask(case, present, pathlib.Path(folder), options):
                rows.append(row)
                environment.say(f"{case:18} {row['tool']:22} {row['status']:8} {row['detail'][:80]}")
    to = options.record or record.path("wrong")
    record.write(to, FIELDS, rows)
    print(to)


if __name__ == "__main__":
    main()
