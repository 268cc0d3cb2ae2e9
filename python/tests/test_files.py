"""Writing, and reading back with this and other readers."""

import meshio
import numpy as np
import pompeiu
import pytest
import trimesh

RNG = np.random.default_rng(5)
MESH = pompeiu.Mesh(RNG.normal(size=(20, 3)), RNG.permuted(np.tile(np.arange(20), (30, 1)), axis=1)[:, :3])


@pytest.mark.parametrize("suffix", ["obj", "ply", "off", "vtp", "vtu", "obj.gz", "ply.gz"])
def test_every_bit_comes_back(tmp_path, suffix):
    path = tmp_path / f"mesh.{suffix}"
    pompeiu.write_mesh(path, MESH)
    assert pompeiu.read_mesh(path) == MESH


@pytest.mark.parametrize("suffix", ["stl", "glb"])
def test_single_precision_comes_back(tmp_path, suffix):
    path = tmp_path / f"mesh.{suffix}"
    pompeiu.write_mesh(str(path), MESH)
    read = pompeiu.read_mesh(path)
    assert np.allclose(read.vertices[read.faces], MESH.vertices[MESH.faces], atol=1e-6)


def test_other_readers_see_the_same(tmp_path):
    pompeiu.write_mesh(tmp_path / "mesh.ply", MESH, vertex_scalars={"height": MESH.vertices[:, 2]})
    theirs = trimesh.load_mesh(tmp_path / "mesh.ply", process=False)
    assert np.array_equal(theirs.vertices, MESH.vertices) and np.array_equal(theirs.faces, MESH.faces)
    data = meshio.read(tmp_path / "mesh.ply")
    assert np.array_equal(data.point_data["height"], MESH.vertices[:, 2])


def test_attributes_of_all_kinds_are_written(tmp_path):
    path = tmp_path / "mesh.vtp"
    pompeiu.write_mesh(
        path,
        MESH,
        vertex_scalars={"one": np.arange(20), "two": np.ones(20, np.float32)},
        face_scalars={"three": np.arange(30.0)},
        face_vectors={"four": np.zeros((30, 3))},
        vertex_colors=np.zeros((20, 3), np.uint8),
        face_colors=np.zeros((30, 3), np.uint8),
    )
    content = path.read_bytes()
    assert all(b'Name="%s"' % name in content for name in (b"one", b"two", b"three", b"four"))
    assert pompeiu.read_mesh(path) == MESH


@pytest.mark.parametrize(
    ("name", "attributes", "sentence"),
    [
        ("mesh.xyz", {}, "the suffix names no format that can be written (obj, ply, stl, off, vtp, vtu, 3mf, glb)"),
        ("mesh.obj", {"vertex_scalars": {"s": np.zeros(20)}}, "OBJ has no place for vertex scalars"),
        ("mesh.ply", {"vertex_scalars": {"s": np.zeros(19)}}, "s: 19 values for 20 vertices"),
        ("mesh.ply", {"vertex_scalars": {"a b": np.zeros(20)}}, "attribute name"),
        ("missing/mesh.ply", {}, "No such file or directory"),
    ],
)
def test_what_cannot_be_written_is_named(tmp_path, name, attributes, sentence):
    with pytest.raises(pompeiu.WriteError) as raised:
        pompeiu.write_mesh(tmp_path / name, MESH, **attributes)
    assert sentence in str(raised.value)
    assert not (tmp_path / name).exists()


def test_attributes_of_the_wrong_shape_are_named(tmp_path):
    for attributes, sentence in (
        ({"vertex_scalars": {"s": np.zeros((20, 1))}}, r"vertex scalars have shape \(20, 1\), expected \(n,\)"),
        ({"face_vectors": {"v": np.zeros(30)}}, r"face vectors have shape \(30,\), expected \(m, 3\)"),
        ({"vertex_colors": np.zeros((20, 3))}, "vertex colours are of type float64, expected uint8"),
        ({"vertex_colors": np.zeros((20, 3), np.uint16)}, "vertex colours are of type uint16, expected uint8"),
    ):
        with pytest.raises(pompeiu.MeshError, match=sentence):
            pompeiu.write_mesh(tmp_path / "mesh.ply", MESH, **attributes)


def test_what_cannot_be_finished_leaves_what_was_there(tmp_path):
    """States of simulations and drawings of puzzles, where files may not grow."""
    resource = pytest.importorskip("resource")
    simulation = pompeiu.SquareSimulation(8, 0.1)
    puzzle = pompeiu.puzzle(4)
    simulation.save(tmp_path / "state.json")
    puzzle.write(tmp_path / "puzzle.svg")
    before = {path: path.read_bytes() for path in tmp_path.iterdir()}
    simulation.step()
    most, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (10, hard))
    try:
        with pytest.raises(pompeiu.WriteError, match="state.json: File too large"):
            simulation.save(tmp_path / "state.json")
        with pytest.raises(pompeiu.WriteError, match="puzzle.svg: File too large"):
            puzzle.write(tmp_path / "puzzle.svg", cuts=True)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, hard))
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == before
