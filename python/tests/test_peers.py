"""Beside trimesh and libigl, where what they compute is exact.

Both look at vertices only. The distance from a convex set is a convex function, so on every face it is greatest at a corner: where
B is a convex set (a flat square, in however many faces), the greatest distance of a vertex of A is that of all its points.
"""

import igl
import numpy as np
import pompeiu
import pytest
import trimesh
from shapes_with_answers import grid

#: Relative difference of two correct evaluations in doubles.
ROUNDING = 1e-14


def bumpy(seed):
    """A grid of 2 * 12² faces, its vertices moved about."""
    rng = np.random.default_rng(seed)
    vertices, faces = grid(2.0, 12)
    return vertices + rng.normal(scale=0.1, size=vertices.shape), faces


def turned(mesh, seed):
    vertices, faces = mesh
    rotation, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return vertices @ rotation.T + [0.5, 0.25, 2.0], faces


@pytest.mark.parametrize("seed", range(8))
def test_distances_from_a_convex_set_are_those_of_libigl(seed):
    a, b = bumpy(seed), grid(1.0, 5)
    squared, _, _ = igl.point_mesh_squared_distance(a[0], b[0], b[1])
    report = pompeiu.directed_hausdorff(a, b)
    assert report.upper == pytest.approx(np.sqrt(squared.max()), rel=1e-11)
    assert report.lower <= np.sqrt(squared.max()) * (1 + ROUNDING)
    assert np.sqrt(squared.max()) * (1 - ROUNDING) <= report.upper


@pytest.mark.parametrize("seed", range(8))
def test_the_distance_of_two_convex_sets_is_that_of_libigl(seed):
    a, b = turned(grid(2.0, 6), seed), grid(3.0, 4)
    theirs = igl.hausdorff(a[0], a[1], b[0], b[1])
    report = pompeiu.hausdorff(a, b)
    assert report.lower * (1 - ROUNDING) <= theirs <= report.upper * (1 + ROUNDING)


@pytest.mark.parametrize("seed", range(4))
def test_distances_from_a_convex_set_are_those_of_trimesh(seed):
    a, b = bumpy(seed), grid(1.0, 3)
    _, distances, _ = trimesh.proximity.closest_point_naive(trimesh.Trimesh(*b, process=False), a[0])
    report = pompeiu.directed_hausdorff(a, b)
    assert report.lower * (1 - ROUNDING) <= distances.max() <= report.upper * (1 + ROUNDING)


@pytest.mark.parametrize("seed", range(4))
def test_vertices_alone_never_say_more(seed):
    a, b = bumpy(seed), turned(bumpy(seed + 100), seed)
    squared, _, _ = igl.point_mesh_squared_distance(a[0], b[0], b[1])
    assert np.sqrt(squared.max()) <= pompeiu.directed_hausdorff(a, b).upper * (1 + ROUNDING)


def test_vertices_alone_can_miss_the_distance():
    corners = np.array([[0, 0, 0], [1, 0, 1], [1, 1, 0], [0, 1, 1]], float)
    a, b = (corners, np.array([[0, 1, 2], [0, 2, 3]])), (corners, np.array([[0, 1, 3], [1, 2, 3]]))
    assert igl.hausdorff(*a, *b) == 0.0
    assert 1 / np.sqrt(3) in pompeiu.hausdorff(a, b)
