"""`pompeiu align` beside Open3D's global registration with closest points, on random motions of parts of meshes.

Usage: compare.py MESH... [--motions 50] [--overlaps 0.8,0.5,0.3] [--command target/release/pompeiu] [--record FILE]

Each trial takes a mesh, orders its faces along a random direction, and cuts two parts from the two ends so that a given share of the
area of each lies in the other. The vertices of the moving part are jittered by a thousandth of the diagonal, and it is moved at random. A
trial succeeds when the motion found differs from the true one by at most 2 degrees, and moves the middle of the part to within 1 % of the
diagonal of its true place. Times are seconds of processors, of all threads: of the whole process for `pompeiu align`, reading and the proven
distance included, and of the registration alone for Open3D. Shapes that are symmetric have more than one right answer: leave them out.
"""

import argparse
import csv
import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import open3d as o3d
import trimesh
from scipy.spatial.transform import Rotation

#: Width of a voxel as a share of the diagonal, for Open3D; radii are those of its tutorial.
VOXEL = 0.02


def parts(mesh, overlap, direction):
    """Two parts of a mesh, each with this share of its area in the other."""
    if overlap == 1.0:
        return mesh.copy(), mesh.copy()
    order = np.argsort(mesh.triangles_center @ direction)
    passed = np.cumsum(mesh.area_faces[order]) / mesh.area
    share = 1.0 / (2.0 - overlap)
    first, second = order[passed <= share], order[passed >= 1.0 - share]
    return [mesh.submesh([faces], append=True, repair=False) for faces in (first, second)]


def spent():
    """Seconds of processors that ended children used."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def ours(command, moving, fixed, folder):
    moving.export(folder / "moving.ply")
    fixed.export(folder / "fixed.ply")
    started = spent()
    done = subprocess.run(
        [command, "align", folder / "moving.ply", folder / "fixed.ply", "--json", "--quiet"], capture_output=True, check=False
    )
    seconds = spent() - started
    if done.returncode not in (0, 3):
        sys.exit(done.stderr.decode())
    answer = json.loads(done.stdout)["report"]
    return np.array(answer["matrix"]), seconds, answer["unique"]


def open3d(moving, fixed, size):
    """Features, RANSAC and point-to-plane closest points with the parameters of Open3D's tutorial."""

    def cloud(mesh):
        shape = o3d.geometry.TriangleMesh(o3d.utility.Vector3dVector(mesh.vertices), o3d.utility.Vector3iVector(mesh.faces))
        shape.compute_vertex_normals()
        o3d.utility.random.seed(1)
        return shape.sample_points_uniformly(60_000)

    clouds = [cloud(moving), cloud(fixed)]
    voxel = VOXEL * size
    started = time.process_time()
    few = [c.voxel_down_sample(voxel) for c in clouds]
    search = o3d.geometry.KDTreeSearchParamHybrid(radius=5 * voxel, max_nn=100)
    features = [o3d.pipelines.registration.compute_fpfh_feature(c, search) for c in few]
    start = o3d.pipelines.registration.registration_ransac_based_on_feature_matching(
        few[0], few[1], features[0], features[1], True, 1.5 * voxel,
        o3d.pipelines.registration.TransformationEstimationPointToPoint(False), 3,
        [
            o3d.pipelines.registration.CorrespondenceCheckerBasedOnEdgeLength(0.9),
            o3d.pipelines.registration.CorrespondenceCheckerBasedOnDistance(1.5 * voxel),
        ],
        o3d.pipelines.registration.RANSACConvergenceCriteria(100_000, 0.999),
    )
    end = o3d.pipelines.registration.registration_icp(
        clouds[0], clouds[1], 0.4 * voxel, start.transformation,
        o3d.pipelines.registration.TransformationEstimationPointToPlane(),
    )
    return np.array(end.transformation), time.process_time() - started


def succeeds(found, true, middle, size):
    turn = Rotation.from_matrix((found[:3, :3] @ true[:3, :3].T)).magnitude()
    off = np.linalg.norm((found @ middle - true @ middle)[:3])
    return bool(np.degrees(turn) <= 2.0 and off <= 0.01 * size)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", type=Path)
    parser.add_argument("--motions", type=int, default=50)
    parser.add_argument("--overlaps", default="0.8,0.5,0.3", type=lambda text: [float(share) for share in text.split(",")])
    parser.add_argument("--command", default="target/release/pompeiu")
    parser.add_argument("--record", type=Path)
    args = parser.parse_args()
    random = np.random.default_rng(7)
    meshes = [(path.stem, trimesh.load(path, process=False, force="mesh")) for path in args.meshes]
    rows = []
    with tempfile.TemporaryDirectory() as name:
        for overlap in args.overlaps:
            for trial in range(args.motions):
                mesh_name, mesh = meshes[trial % len(meshes)]
                direction = random.normal(size=3)
                moving, fixed = parts(mesh, overlap, direction / np.linalg.norm(direction))
                size = np.linalg.norm(mesh.extents)
                moving.vertices = moving.vertices + random.normal(size=moving.vertices.shape) * 1e-3 * size
                motion = np.eye(4)
                motion[:3, :3] = Rotation.random(random_state=random).as_matrix()
                motion[:3, 3] = random.normal(size=3) * size
                moving.apply_transform(motion)
                true = np.linalg.inv(motion)
                middle = np.append(moving.bounds.mean(axis=0), 1.0)
                found, seconds, unique = ours(args.command, moving, fixed, Path(name))
                row = {"mesh": mesh_name, "overlap": overlap, "trial": trial, "pompeiu": succeeds(found, true, middle, size)}
                row |= {"pompeiu_s": round(seconds, 3), "pompeiu_unique": unique}
                found, seconds = open3d(moving, fixed, size)
                row |= {"open3d": succeeds(found, true, middle, size), "open3d_s": round(seconds, 3)}
                rows.append(row)
                print(row, file=sys.stderr, flush=True)
            some = [row for row in rows if row["overlap"] == overlap]
            rate = {who: sum(row[who] for row in some) for who in ("pompeiu", "open3d")}
            mean = {who: np.median([row[who + "_s"] for row in some]) for who in ("pompeiu", "open3d")}
            print(
                f"overlap {overlap:4.0%}: pompeiu {rate['pompeiu']} of {len(some)}, {mean['pompeiu']:.2f} s; "
                f"Open3D {rate['open3d']} of {len(some)}, {mean['open3d']:.2f} s",
                flush=True,
            )
    if args.record:
        with args.record.open("w", newline="") as file:
            writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
