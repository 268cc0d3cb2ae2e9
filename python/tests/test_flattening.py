"""Cutting and flattening: copies, exact verdicts, developable surfaces, errors."""

import numpy as np
import pompeiu
import pytest


def areas(flat):
    a, b, c = np.moveaxis(flat.uv, 1, 0)
    (x, y), (z, w) = (b - a).T, (c - a).T
    return 0.5 * (x * w - y * z)


def test_a_cut_glues_back():
    torus = pompeiu.shapes.torus(2.0, 0.7, 24, 16)
    opened = pompeiu.cut(torus)
    assert (opened.vertex_map[opened.mesh.faces] == torus.faces).all()
    assert (opened.mesh.vertices == torus.vertices[opened.vertex_map]).all()
    assert (opened.vertex_map[: torus.n_vertices] == np.arange(torus.n_vertices)).all()
    # A disk: one vertex more than the edges of a tree, for two loops that meet.
    assert opened.mesh.n_vertices == torus.n_vertices + len(opened.edges) + 1


def test_a_sphere_lies_flat_in_the_unit_square():
    sphere = pompeiu.shapes.icosphere(1.0, 3)
    told = []
    flat = pompeiu.flatten(sphere, progress=lambda share: told.append(share))
    assert flat.is_one_to_one and flat.charts == 1
    assert (areas(flat) > 0).all() and (flat.uv >= 0).all() and (flat.uv <= 1).all()
    assert flat.distortion["symmetric_dirichlet"]["mean"] < 4.4
    weights = pompeiu.shapes.icosphere(1.0, 3)
    corners = weights.vertices[weights.faces]
    in_space = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    mean = (flat.face_distortion * in_space).sum() / in_space.sum()
    assert mean == pytest.approx(flat.distortion["symmetric_dirichlet"]["mean"], rel=1e-9)
    assert (flat.vertex_map[flat.corners] == sphere.faces).all()


def test_a_cylinder_keeps_its_lengths():
    flat = pompeiu.flatten(pompeiu.shapes.cylinder(1.0, 2.0, 24, 6), pack=False)
    assert flat.distortion["isometric"]["max"] == pytest.approx(1.0, abs=1e-9)


def test_a_planar_grid_stays_as_it_is():
    grid = pompeiu.shapes.grid((3.0, 2.0), (6, 4))
    flat = pompeiu.flatten(grid, boundary="own", pack=False)
    shift = flat.coordinates[0] - grid.vertices[0, :2]
    assert np.abs(flat.coordinates - grid.vertices[:, :2] - shift).max() < 1e-12


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"strategy": "zigzag"}, "expected one of `auto`"),
        ({"boundary": "star"}, "expected free"),
        ({"weights": "heavy"}, "expected one of `uniform`"),
        ({"boundary": [(0, 0), (0, 1), (1, 0)]}, "no convex polygon"),
        ({"target": 4.0}, "greater than 4"),
        ({"through": [0], "along": [[0, 1]]}, "choose one"),
        ({"through": [-1]}, "`through` of flatten: .*-1"),
        ({"forbid_faces": [-1]}, "`forbid_faces` of flatten: .*-1"),
        ({"energy": "none"}, "expected one of `symmetric-dirichlet`"),
        ({"boundary": "circle", "virtual_layers": 1, "virtual_scale": 1.0}, "above 1"),
        ({"avoid_curvature": -1.0}, "weight of curvature is -1"),
        ({"strategy": "medial", "balls": 0}, "`balls` of flatten: .*nonzero"),
        ({"symmetry": (1, 0, 0)}, "four numbers"),
    ],
)
def test_options_that_make_no_sense(options, words):
    with pytest.raises(pompeiu.OptionError, match=words):
        pompeiu.flatten(pompeiu.shapes.icosphere(1.0, 1), **options)


def test_a_plane_of_symmetry_is_kept():
    tube = pompeiu.shapes.cylinder(1.0, 2.0, 24, 6)
    flat = pompeiu.flatten(tube, symmetry=(1, 0, 0, 0), pack=False)
    at = {tuple(np.round(p, 9) + 0.0): i for i, p in enumerate(tube.vertices)}
    image = np.array([at[tuple(np.round(p * [-1, 1, 1], 9) + 0.0)] for p in tube.vertices])
    for v in np.flatnonzero(np.bincount(flat.vertex_map) == 1):
        (here,), (there,) = (flat.coordinates[flat.vertex_map == w] for w in (v, image[v]))
        assert (here * [-1, 1] == there).all()
    with pytest.raises(pompeiu.SurfaceError, match="not symmetric"):
        pompeiu.cut(tube, symmetry=(1, 0, 0, 0.25))


def test_charts_are_reported_one_by_one():
    sphere, tube = pompeiu.shapes.icosphere(1.0, 2), pompeiu.shapes.cylinder(1.0, 2.0, 24, 6)
    both = (np.vstack([sphere.vertices, tube.vertices + 5]), np.vstack([sphere.faces, tube.faces + sphere.n_vertices]))
    parts = pompeiu.flatten(both, strategy="geodesic", spread=0.1).parts
    assert [part["faces"] for part in parts] == [len(sphere.faces), len(tube.faces)]
    assert parts[1]["distortion"]["symmetric_dirichlet"]["max"] == pytest.approx(4.0, abs=1e-9)
    assert parts[0]["cut_length"] > parts[1]["cut_length"] > 0


def test_a_straightened_path_is_a_geodesic():
    grid = pompeiu.shapes.grid((3.0, 2.0), (6, 4))
    rows = {tuple(np.round(p[:2] * 2)): i for i, p in enumerate(grid.vertices)}
    low = np.round(grid.vertices[:, :2].min(axis=0) * 2)
    at = lambda x, y: rows[(low[0] + x, low[1] + y)]
    path = [at(1, 1)] + [at(x, 1) for x in range(2, 6)] + [at(5, 2)]
    straight = pompeiu.straighten(grid, list(zip(path, path[1:])))
    ends = straight.mesh.vertices[straight.edges]
    assert np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).sum() == pytest.approx(np.hypot(2.0, 0.5), rel=1e-12)
    assert len(straight.faces) == straight.mesh.n_faces and (np.bincount(straight.faces) >= 1).all()
    with pytest.raises(pompeiu.SurfaceError, match="no edge joins"):
        pompeiu.straighten(grid, [(0, 0)])
    with pytest.raises(pompeiu.OptionError, match="no edge"):
        pompeiu.straighten(grid, [(0, -1)])


def test_what_cannot_be_cut():
    sphere = pompeiu.shapes.icosphere(1.0, 1)
    with pytest.raises(pompeiu.SurfaceError, match="no disk"):
        pompeiu.cut(sphere, strategy="genus")
    folded = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, -1, 0]], [[0, 1, 2], [0, 1, 3], [0, 1, 4]])
    with pytest.raises(pompeiu.SurfaceError, match="faces"):
        pompeiu.flatten(folded)


def test_free_boundaries_and_virtual_ones():
    grid = pompeiu.shapes.grid((1.0, 1.0), (8, 8))
    for energy in ("lscm", "spectral"):
        flat = pompeiu.flatten(grid, energy=energy)
        assert flat.is_one_to_one and flat.distortion["angle"]["max"] == pytest.approx(1.0, abs=1e-6)
    assert pompeiu.flatten(grid, energy="arap").report["method"] == "arap"
    stretch = [
        pompeiu.flatten(grid, boundary="circle", virtual_layers=layers).distortion["stretch_l2"] for layers in (0, 2)
    ]
    assert stretch[1] < stretch[0]


def test_balls_fill_a_sphere_and_guide_cuts():
    sphere = pompeiu.shapes.icosphere(2.0, 3)
    one = pompeiu.medial(sphere, balls=1)
    assert one.radii == pytest.approx([2.0], rel=0.02) and np.abs(one.centres).max() < 0.02
    assert one.surface_to_balls[0] <= one.surface_to_balls[1] < 0.05 and one.stop == "tolerance"
    torus = pompeiu.shapes.torus(2.0, 0.7, 24, 16)
    ring = pompeiu.medial(torus, balls=12)
    assert np.linalg.norm(ring.centres, axis=1) == pytest.approx(2.0, rel=0.1)
    assert len(ring.edges) >= 11 and ring.overlaps.shape[1] == 2
    for strategy in ("medial", "medial-tree", "bones"):
        opened = pompeiu.cut(torus, strategy=strategy, balls=12)
        # Vertices minus edges plus faces of a disk.
        summary = pompeiu.mesh_summary(opened.mesh)
        assert summary.euler_characteristic == 1
    with pytest.raises(pompeiu.SurfaceError, match="boundary loops"):
        pompeiu.medial(opened.mesh)
    with pytest.raises(pompeiu.OptionError, match="tolerance"):
        pompeiu.medial(sphere, tolerance=0.0)


def test_forbidden_edges_are_not_cut():
    sphere = pompeiu.shapes.icosphere(1.0, 3)
    free = pompeiu.cut(sphere, through=[0, 100])
    edge = sorted(free.edges[0].tolist())
    around = pompeiu.cut(sphere, through=[0, 100], forbid_edges=[edge])
    assert edge not in np.sort(around.edges, axis=1).tolist()
