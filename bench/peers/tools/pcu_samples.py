"""point-cloud-utils' closest_points_on_mesh at random points of A."""

TITLE = "point-cloud-utils, mesh"
PACKAGE = "point-cloud-utils"
KIND = "samples"


def prepare(a, b, tolerance, samples):
    import point_cloud_utils
    return point_cloud_utils, a, b, samples


def measure(prepared):
    pcu, a, b, samples = prepared
    return pcu.closest_points_on_mesh(points(pcu, a, samples), *b)[0].max()


def points(pcu, mesh, count):
    """Random points of a mesh, the same every time."""
    faces, weights = pcu.sample_mesh_random(*mesh, count, random_seed=1)
    return pcu.interpolate_barycentric_coords(mesh[1], faces, weights, mesh[0])
