"""Pairs of meshes whose distances are known in closed form: those of the tests in Rust, written down anew."""

from __future__ import annotations

import math
from typing import NamedTuple, Optional

import numpy as np

#: Relative error of a closed form evaluated in doubles, and of coordinates that are rounded: some units in the last place.
ROUNDING = 16 * np.finfo(float).eps


class Case(NamedTuple):
    """Two meshes, and both directed distances where they are known."""

    name: str
    a: "tuple[np.ndarray, np.ndarray]"
    b: "tuple[np.ndarray, np.ndarray]"
    a_to_b: float
    b_to_a: Optional[float]


def mesh(vertices, faces):
    return np.array(vertices, dtype=np.float64), np.array(faces, dtype=np.int64)


def grid(side, n, height=0.0, falling=False):
    """A square of n by n cells around the origin."""
    at = np.linspace(-side / 2, side / 2, n + 1)
    x, y = np.meshgrid(at, at, indexing="ij")
    vertices = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, height)])
    faces = []
    for i in range(n):
        for j in range(n):
            a, b, c, d = i * (n + 1) + j, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1, i * (n + 1) + j + 1
            faces += [[a, b, d], [b, c, d]] if falling else [[a, b, c], [a, c, d]]
    return mesh(vertices, faces)


def cube(side):
    """A cube around the origin."""
    vertices = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return mesh(np.array(vertices) * side / 2, [t for a, b, c, d in quads for t in ([a, b, c], [a, c, d])])


def cases():
    first = [[0, 0, 0], [2, 0, 0], [1, 1, 0]]
    for other, to, back in (
        ([[0, 0, 0], [2, 0, 0], [1, 0, 1]], 1.0, 1.0),
        ([[0, 0, 1], [2, 0, 1], [1, 0, 2]], math.sqrt(2), 2.0),
        ([[0, 1, 1], [2, 1, 1], [1, 1, 0]], math.sqrt(1.5), math.sqrt(1.5)),
        ([[0, 1, 2], [2, 1, 2], [1, 1, 1]], math.sqrt(3), math.sqrt(4.5)),
    ):
        yield Case(f"triangle against {other}", mesh(first, [[0, 1, 2]]), mesh(other, [[0, 1, 2]]), to, back)

    for size in (1.0, 0.25, 3.0):
        corners = [[0, 0, 0], [size, 0, size], [size, size, 0], [0, size, size]]
        a, b = mesh(corners, [[0, 1, 2], [0, 2, 3]]), mesh(corners, [[0, 1, 3], [1, 2, 3]])
        yield Case(f"skew quadrilateral of size {size} with its two diagonals", a, b, size / math.sqrt(3), size / math.sqrt(3))

    for inner, outer in ((1.0, 2.0), (1.0, 1.25), (0.5, 0.5), (1.0, 9.0)):
        half = (outer - inner) / 2
        yield Case(f"cube of side {inner} in one of side {outer}", cube(inner), cube(outer), half, math.sqrt(3) * half)

    for n in (1, 2, 5):
        points = grid(1.0, n)[0]
        lattice = mesh(points, [[i, i, i] for i in range(len(points))])
        yield Case(f"square over {len(points)} points", grid(1.0, 1), lattice, math.sqrt(2) / (2 * n), 0.0)

    for height in (0.0, 0.5, 1e-9):
        yield Case(f"squares {height} apart", grid(2.0, 2), grid(2.0, 3, height, falling=True), height, height)

    for w, depth in ((1.0, 1.0), (0.5, 2.0), (2.0, 0.125)):
        corners = [[-w, 0, 0], [w, 0, 0], [w, 4, 0], [-w, 4, 0]]
        lid = mesh(corners, [[0, 1, 2], [0, 2, 3]])
        walls = mesh([*corners, [0, 0, -depth], [0, 4, -depth]], [[0, 4, 5], [0, 5, 3], [1, 2, 5], [1, 5, 4]])
        yield Case(f"lid over a notch of depth {depth}", lid, walls, w * depth / math.hypot(w, depth), depth)

    point = mesh([[0, 0, 0]], [[0, 0, 0]])
    segment = mesh([[0, 0, 0], [0, 4, 0], [0, 2, 0]], [[0, 1, 2], [0, 2, 0]])
    points = mesh([[0, 0, 0], [3, 4, 0]], [[0, 0, 0], [1, 1, 1]])
    yield Case("a segment and a point", segment, point, 4.0, 0.0)
    yield Case("a segment and two points", segment, points, 3.125, 3.0)
    yield Case("one point", point, point, 0.0, 0.0)
    far = mesh([*grid(1.0, 1, 1.0)[0], [100, 0, 0]], grid(1.0, 1)[1])
    yield Case("an unreferenced vertex far away", grid(1.0, 1), far, 1.0, 1.0)
