"""libigl's point_mesh_squared_distance at the vertices of A: what igl.hausdorff does, in the one direction asked for."""

TITLE = "libigl"
PACKAGE = "libigl"
KIND = "vertices"


def prepare(a, b, tolerance, samples):
    import igl
    import vertices
    return igl, vertices.of_faces(a), b[0], b[1].astype("int64")


def measure(prepared):
    igl, points, positions, faces = prepared
    return igl.point_mesh_squared_distance(points, positions, faces)[0].max() ** 0.5
