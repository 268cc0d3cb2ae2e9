"""point-cloud-utils' one_sided_hausdorff_distance between random points of A and of B: both surfaces are sampled."""

from tools.pcu_samples import points, prepare  # noqa: F401: the same meshes, the same points

TITLE = "point-cloud-utils, points"
PACKAGE = "point-cloud-utils"
KIND = "samples"


def measure(prepared):
    pcu, a, b, samples = prepared
    return pcu.one_sided_hausdorff_distance(points(pcu, a, samples), points(pcu, b, samples))[0]
