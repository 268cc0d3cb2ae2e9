"""Makes the model of a bracket and a scan of one with defects: model.obj and scan.obj, which the commands in README.md simplify.

Both are level sets of signed distance functions, in millimetres. Needs NumPy and scikit-image.
"""

import numpy as np
from skimage import measure

LOWER, UPPER = np.array([-3.0, -3.0, -3.0]), np.array([83.0, 58.0, 63.0])


def box(p, centre, half, rounding):
    q = np.abs(p - np.array(centre)) - np.array(half) + rounding
    return np.linalg.norm(np.maximum(q, 0), axis=-1) + np.minimum(q.max(-1), 0) - rounding


def cylinder(p, axis, centre, radius, half):
    u, v = (p[..., i] - centre[i] for i in range(3) if i != axis)
    across, along = np.hypot(u, v) - radius, np.abs(p[..., axis] - centre[axis]) - half
    return np.minimum(np.maximum(across, along), 0) + np.hypot(np.maximum(across, 0), np.maximum(along, 0))


def union(a, b, fillet):
    share = np.clip(0.5 + 0.5 * (b - a) / fillet, 0, 1)
    return b * (1 - share) + a * share - fillet * share * (1 - share)


def intersection(a, b, fillet):
    return -union(-a, -b, fillet)


def rib(p, x):
    y, z = p[..., 1], p[..., 2]
    slope = ((y - 8) / 34 + (z - 8) / 40 - 1) * (34 * 40) / np.hypot(34, 40)
    flat = intersection(np.abs(p[..., 0] - x) - 2.5, slope, 0.8)
    return intersection(flat, np.maximum(4 - y, 4 - z), 0.5)


def bracket(p, is_scan):
    """A plate and a wall with two ribs, two holes for screws and a bearing seat; the scan has one rib, and a dent in its front edge."""
    d = union(box(p, [40, 25, 4], [40, 25, 4], 1.2), box(p, [40, 4, 30], [40, 4, 30], 1.2), 5.0)
    d = intersection(intersection(d, -p[..., 1], 1.2), -p[..., 2], 1.2)
    for x in [20] if is_scan else [20, 60]:
        d = union(d, rib(p, x), 2.0)
    for x in [10, 70]:
        d = intersection(d, -cylinder(p, 2, [x, 40, 4], 3.3, 20), 0.6)
    d = intersection(d, -cylinder(p, 1, [40, 4, 38], 11, 20), 0.8)
    seat = np.maximum(cylinder(p, 1, [40, 8, 38], 15.5, 5) - 0.6, -cylinder(p, 1, [40, 4, 38], 11, 40))
    d = union(d, seat, 0.8)
    if is_scan:
        d = intersection(d, 7.5 - np.linalg.norm(p - np.array([41, 51.5, 10]), axis=-1), 1.2)
    return d


def write(name, spacing, is_scan):
    counts = np.ceil((UPPER - LOWER) / spacing).astype(int)
    axes = [LOWER[i] + spacing * np.arange(counts[i]) for i in range(3)]
    distances = bracket(np.stack(np.meshgrid(*axes, indexing="ij"), -1), is_scan)
    vertices, faces, _, _ = measure.marching_cubes(distances, 0.0)
    vertices = LOWER + vertices * spacing
    if is_scan:
        # The plate is bent upwards by a quarter of a millimetre, and the scanner has noise.
        vertices[:, 2] += 0.25 * (vertices[:, 0] - 40) ** 2 / 1600 * np.clip(vertices[:, 1] / 50, 0, 1)
        vertices += np.random.default_rng(3).normal(size=vertices.shape) * 0.008
    # The front is towards negative y.
    vertices = np.array([80, 50, 0]) + vertices * [-1, -1, 1]
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    if (a * np.cross(b, c)).sum() < 0:
        faces = faces[:, ::-1]
    with open(name, "w") as file:
        file.writelines("v %.3f %.3f %.3f\n" % tuple(vertex) for vertex in vertices)
        file.writelines("f %d %d %d\n" % tuple(face + 1) for face in faces)


write("model.obj", 0.8, is_scan=False)
write("scan.obj", 1.1, is_scan=True)
