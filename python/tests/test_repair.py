"""Repairing meshes."""

import numpy as np
import pompeiu
import pytest


def soup(mesh):
    """Three vertices of its own for every face."""
    return mesh.vertices[mesh.faces].reshape(-1, 3), np.arange(3 * mesh.n_faces).reshape(-1, 3)


def test_what_is_broken_is_mended_and_told():
    sphere = pompeiu.shapes.icosphere(2.0, 1)
    vertices, faces = soup(sphere)
    turned = faces.copy()
    turned[7] = turned[7][::-1]
    broken = np.vstack([vertices, [[9.0, 9.0, 9.0]]]), np.vstack([turned, turned[3], [0, 0, 1]])
    found = pompeiu.repair(broken, within=1e-9)
    done = {name: change.count for name, change in found.changes.items()}
    assert done == {
        "unreferenced_vertices": 1,
        "welded_vertices": 198,
        "degenerate_faces": 1,
        "duplicate_faces": 1,
        "turned_faces": 1,
    }
    assert found.changes["unreferenced_vertices"].places.tolist() == [[9.0, 9.0, 9.0]]
    assert found.distance.upper <= 1e-9
    summary = pompeiu.mesh_summary(found.mesh)
    assert (summary.boundary_edges, summary.seam_edges, summary.genus) == (0, 0, 0)
    assert "turned_faces 1" in repr(found)
    again = pompeiu.repair(found.mesh)
    assert not again.changes and again.distance is None and again.mesh == found.mesh


def test_seams_are_counted_and_left_when_asked():
    vertices, faces = soup(pompeiu.shapes.cube(1.0, 1))
    summary = pompeiu.mesh_summary((vertices, faces))
    assert summary.seam_edges == summary.boundary_edges == 36
    assert "welded_vertices" not in pompeiu.repair((vertices, faces), no_weld=True).changes
    apart = vertices + 1e-3 * (np.arange(36)[:, None] % 2)
    assert pompeiu.repair((apart, faces), weld=0.01, within=0.01).mesh.n_vertices == 8
    with pytest.raises(pompeiu.PompeiuError, match="not proven to be within 1e-05"):
        pompeiu.repair((apart, faces), weld=0.01, within=1e-5)


def test_holes_are_filled():
    torus = pompeiu.shapes.torus(2.0, 0.7, 12, 9)
    open_torus = torus.vertices, torus.faces[1:]
    found = pompeiu.repair(open_torus, fill_holes=3)
    assert found.faces_added == 1 and found.changes["filled_holes"].count == 1
    assert pompeiu.mesh_summary(found.mesh).genus == 1


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"weld": -1.0}, "option `weld` of repair: expected a finite length that is not negative"),
        ({"weld": float("nan")}, "weld is nan"),
        ({"fill_holes": 1000}, "holes of up to 1000 edges"),
        ({"fill_holes": -1}, "`fill_holes` of repair: .*-1"),
        ({"within": -1.0}, "option `within` of repair: expected a finite length"),
    ],
)
def test_options_that_make_no_sense_are_named(options, said):
    with pytest.raises(pompeiu.errors.OptionError, match=said):
        pompeiu.repair(pompeiu.shapes.cube(1.0, 1), **options)


def test_nothing_left():
    with pytest.raises(pompeiu.errors.SurfaceError, match="nothing is left"):
        pompeiu.repair((np.zeros((3, 3)), [[0, 1, 2]]))
