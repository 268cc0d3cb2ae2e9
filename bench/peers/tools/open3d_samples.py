"""Open3D's RaycastingScene.compute_distance at the vertices of A and at random points of it, in single precision."""

TITLE = "Open3D"
PACKAGE = "open3d"
KIND = "samples"
PRECISION = "single"


def prepare(a, b, tolerance, samples):
    import open3d
    import vertices
    mesh = open3d.geometry.TriangleMesh(
        open3d.utility.Vector3dVector(a[0]), open3d.utility.Vector3iVector(a[1]))
    return open3d, mesh, vertices.of_faces(a), b[0].astype("float32"), b[1].astype("uint32"), samples


def measure(prepared):
    import numpy
    open3d, mesh, points, positions, faces, samples = prepared
    points = numpy.concatenate([points, numpy.asarray(mesh.sample_points_uniformly(samples).points)])
    scene = open3d.t.geometry.RaycastingScene()
    scene.add_triangles(open3d.core.Tensor(positions), open3d.core.Tensor(faces))
    return scene.compute_distance(open3d.core.Tensor(points.astype("float32"))).numpy().max()
