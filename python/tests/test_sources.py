"""Meshes from arrays, files and objects of other libraries."""

import math
import tracemalloc
from pathlib import Path
from types import SimpleNamespace

import meshio
import numpy as np
import pompeiu
import pytest
import trimesh
from shapes_with_answers import cube

VERTICES, FACES = cube(2.0)
EXPECTED = pompeiu.Mesh(VERTICES, FACES)


@pytest.mark.parametrize("dtype", ["u4", "i4", "i8", "u8", "i2", "u1", ">i4"])
def test_faces_of_any_integers(dtype):
    assert pompeiu.Mesh(VERTICES, FACES.astype(dtype)) == EXPECTED


@pytest.mark.parametrize("dtype", ["f8", "f4", "f2", "i8", "i1", ">f8", "g"])
def test_vertices_of_any_numbers(dtype):
    assert pompeiu.Mesh(VERTICES.astype(dtype), FACES) == EXPECTED


def unaligned(array):
    """The same array at an odd address."""
    room = np.zeros(array.nbytes + 1, dtype=np.uint8)
    view = room[1:].view(array.dtype).reshape(array.shape)
    view[:] = array
    assert not view.flags.aligned
    return view


def read_only(array):
    array = array.copy()
    array.flags.writeable = False
    return array


LAYOUTS = {
    "lists": lambda array: array.tolist(),
    "columns first": np.asfortranarray,
    "every other row": lambda array: np.repeat(array, 2, axis=0)[::2],
    "turned over and back": lambda array: np.ascontiguousarray(array[::-1])[::-1],
    "columns of a wider array": lambda array: np.hstack([array, array])[:, 3:],
    "read-only": read_only,
    "unaligned": unaligned,
}


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS.keys())
def test_arrays_of_any_layout(layout):
    assert pompeiu.Mesh(layout(VERTICES), layout(FACES)) == EXPECTED


def test_arrays_are_given_back_as_they_were():
    mesh = pompeiu.Mesh(VERTICES, FACES)
    assert mesh.vertices.dtype == np.float64 and mesh.faces.dtype == np.uint32
    assert np.array_equal(mesh.vertices, VERTICES) and np.array_equal(mesh.faces, FACES)
    assert (mesh.n_vertices, mesh.n_faces) == (8, 12)
    with pytest.raises(ValueError, match="read-only"):
        mesh.vertices[:] = 0
    assert repr(mesh) == "Mesh(8 vertices, 12 faces)"


def test_no_more_copies_than_one_each_way():
    vertices, faces = (read_only(array) for array in cube(2.0))
    vertices = read_only(np.tile(vertices, (50_000, 1)))
    for indices in (faces.astype(np.uint32), faces.astype(np.int32), faces):
        tracemalloc.start()
        try:
            mesh = pompeiu.Mesh(vertices, read_only(np.tile(indices, (50_000, 1)))[::2])
            _, peak = tracemalloc.get_traced_memory()
        finally:
            tracemalloc.stop()
        # numpy tells what it takes; the mesh's own memory is not Python's.
        tiled = 50_000 * indices.nbytes
        assert peak < 2 * tiled + vertices.nbytes // 10
    tracemalloc.start()
    try:
        handed_out = mesh.vertices
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < vertices.nbytes // 10 and not handed_out.flags.owndata and handed_out.flags.c_contiguous


@pytest.mark.parametrize(
    ("vertices", "faces", "sentence"),
    [
        ([[0, 0]], [[0, 0, 0]], "vertices have shape (1, 2), expected (n, 3)"),
        ([0, 0, 0], [[0, 0, 0]], "vertices have shape (3,), expected (n, 3)"),
        ([[0, 0, 0]], [[0, 0, 0, 0]], "faces have shape (1, 4), expected (m, 3)"),
        ([[0, 0, 0]], [[0.0, 0, 0]], "faces are of type float64, expected integers"),
        ([[0, 0, 0]], [[False, False, False]], "faces are of type bool, expected integers"),
        ([[0, 0, 1j]], [[0, 0, 0]], "vertices are of type complex128, expected real numbers"),
        ([["a", "b", "c"]], [[0, 0, 0]], "vertices are of type <U1, expected real numbers"),
        ([[0, 0, 0]], [[0, 0, 0], [0, -1, 0]], "face 1 names vertex -1, but there are 1 vertices (the first is 0)"),
        ([[0, 0, 0]], [[0, 0, 1]], "face 0 names vertex 1, but there are 1 vertices (the first is 0)"),
        ([[0, 0, 0]], [[0, 0, 2**40]], "face 0 names vertex 1099511627776, but there are 1 vertices (the first is 0)"),
        ([[0, math.nan, 0]], [[0, 0, 0]], "coordinate y of vertex 0 is NaN"),
        ([[0, 0, math.inf]], [[0, 0, 0]], "coordinate z of vertex 0 is inf"),
        ([[0, 0, 0]], np.empty((0, 3), int), "the mesh has no faces (1 vertices)"),
    ],
)
def test_arrays_that_are_no_mesh_are_named(vertices, faces, sentence):
    with pytest.raises(pompeiu.MeshError) as raised:
        pompeiu.as_mesh((vertices, faces))
    assert str(raised.value) == sentence
    assert isinstance(raised.value, ValueError) and isinstance(raised.value, pompeiu.PompeiuError)


def test_meshes_of_trimesh():
    theirs = trimesh.Trimesh(VERTICES, FACES, process=False)
    assert pompeiu.as_mesh(theirs) == EXPECTED
    assert 0.0 in pompeiu.hausdorff(theirs, EXPECTED)


def test_meshes_of_meshio():
    cells = [("line", [[0, 1]]), ("triangle", FACES[:5]), ("vertex", [[0]]), ("triangle", FACES[5:])]
    assert pompeiu.as_mesh(meshio.Mesh(VERTICES, cells)) == EXPECTED
    with pytest.raises(pompeiu.MeshError, match="cells of type quad, expected triangles"):
        pompeiu.as_mesh(meshio.Mesh(VERTICES, [("quad", [[0, 1, 3, 2]])]))
    with pytest.raises(pompeiu.MeshError, match=r"no triangles \(8 vertices\)"):
        pompeiu.as_mesh(meshio.Mesh(VERTICES, [("line", [[0, 1]])]))


class Vector:
    """Stands for Open3D's vectors: not an array, but something numpy makes one of."""

    def __init__(self, array):
        self.array = array

    def __array__(self, dtype=None, copy=None):
        return np.asarray(self.array, dtype=dtype)

    def __len__(self):
        return len(self.array)


class Tensor:
    """Stands for Open3D's tensors."""

    def __init__(self, array):
        self.array = array

    def cpu(self):
        return self

    def numpy(self):
        return self.array


def test_objects_like_those_of_open3d():
    legacy = SimpleNamespace(vertices=Vector(VERTICES), triangles=Vector(FACES.astype(np.int32)))
    assert pompeiu.as_mesh(legacy) == EXPECTED
    tensors = SimpleNamespace(
        vertex=SimpleNamespace(positions=Tensor(VERTICES.astype(np.float32))),
        triangle=SimpleNamespace(indices=Tensor(FACES)),
    )
    assert pompeiu.as_mesh(tensors) == EXPECTED


def test_a_scene_of_trimesh_is_taken_as_it_is_placed():
    scene = trimesh.Scene()
    box = trimesh.Trimesh(VERTICES, FACES, process=False)
    scene.add_geometry(box)
    scene.add_geometry(box, transform=trimesh.transformations.translation_matrix([5, 0, 0]))
    mesh = pompeiu.as_mesh(scene)
    assert (mesh.n_vertices, mesh.n_faces) == (16, 24)
    assert mesh.vertices[:, 0].max() == VERTICES[:, 0].max() + 5
    with pytest.raises(pompeiu.MeshError, match="no mesh"):
        pompeiu.as_mesh(trimesh.Scene())


def test_grids_and_quadrangles_like_those_of_pyvista():
    counted = np.hstack([np.full((len(FACES), 1), 3), FACES]).ravel()
    surface = SimpleNamespace(points=VERTICES, faces=counted)
    grid = SimpleNamespace(points=VERTICES, cells=np.array([8, *range(8)]), extract_surface=lambda: surface)
    assert pompeiu.as_mesh(grid) == EXPECTED
    quadrangles = SimpleNamespace(points=VERTICES, faces=np.array([4, 0, 1, 3, 2]), triangulate=lambda: surface)
    assert pompeiu.as_mesh(quadrangles) == EXPECTED
    with pytest.raises(pompeiu.MeshError, match="no triangles"):
        stubborn = SimpleNamespace(points=VERTICES, faces=np.array([4, 0, 1, 3, 2]))
        stubborn.triangulate = lambda: stubborn
        pompeiu.as_mesh(stubborn)


def test_objects_like_those_of_pyvista():
    counted = np.column_stack([np.full(len(FACES), 3), FACES]).ravel()
    assert pompeiu.as_mesh(SimpleNamespace(points=VERTICES, faces=counted, strips=np.array([], int))) == EXPECTED
    for faces in ([4, 0, 1, 3, 2], [4, 0, 1, 3, 2, 2, 0, 1], [3, 0, 1, 2, 4, 0, 1, 2, 3]):
        with pytest.raises(pompeiu.MeshError, match=r"no triangles; call its triangulate\(\) first"):
            pompeiu.as_mesh(SimpleNamespace(points=VERTICES, faces=np.array(faces)))
    with pytest.raises(pompeiu.MeshError, match="strips"):
        pompeiu.as_mesh(SimpleNamespace(points=VERTICES, faces=counted, strips=np.array([3, 0, 1, 2])))
    with pytest.raises(pompeiu.MeshError, match="the mesh has no faces"):
        pompeiu.as_mesh(SimpleNamespace(points=VERTICES, faces=np.array([], int)))


def test_objects_of_no_kind_known():
    with pytest.raises(TypeError, match="found an object of type dict, expected a path"):
        pompeiu.as_mesh({})
    with pytest.raises(TypeError, match="type int"):
        pompeiu.hausdorff(1, 2)


def test_files_by_name(repository):
    lantern = repository / "examples" / "meshes" / "lantern.obj"
    read = pompeiu.as_mesh(lantern)
    assert read == pompeiu.read_mesh(str(lantern)) == pompeiu.as_mesh(read)
    assert pompeiu.hausdorff(lantern, str(lantern)).lower == 0.0


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(FileNotFoundError) as raised:
        pompeiu.read_mesh(tmp_path / "missing.obj")
    assert isinstance(raised.value, pompeiu.ReadError)
    assert str(raised.value).startswith(f"{tmp_path / 'missing.obj'}: No such file")
    broken = tmp_path / "broken.off"
    broken.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 zero\n3 0 1 2\n")
    with pytest.raises(pompeiu.ReadError, match="broken.off: line 5") as raised:
        pompeiu.read_mesh(broken)
    assert isinstance(raised.value, OSError) and not isinstance(raised.value, FileNotFoundError)


def test_faces_left_out_are_told(tmp_path: Path):
    thin = tmp_path / "thin.off"
    thin.write_text("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n2 0 1\n")
    with pytest.warns(pompeiu.MeshWarning, match="1 faces with fewer than three corners"):
        assert pompeiu.read_mesh(thin).n_faces == 1


def test_meshes_of_other_units_are_told():
    metres, millimetres = pompeiu.shapes.cube(1.0, 1), pompeiu.shapes.cube(1000.0, 1)
    for ask in (pompeiu.distance, pompeiu.deviation):
        with pytest.warns(pompeiu.MeshWarning, match="B is about 1000 times the size of A"):
            ask(metres, millimetres)
