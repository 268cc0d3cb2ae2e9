"""One run of cascading_upper_bounds: python cub.py A.obj B.obj TOLERANCE; prints a JSON object."""

import json
import resource
import sys
import time

import numpy as np
from cascading_upper_bounds import pompeiu_hausdorff


def read_obj(path):
    vertices, faces = [], []
    with open(path) as lines:
        for line in lines:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(x) for x in words[1:4]])
            elif words[:1] == ["f"]:
                faces.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
    return np.array(vertices), np.array(faces, dtype=np.int32)


def peak_mib():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


a, b, tolerance = read_obj(sys.argv[1]), read_obj(sys.argv[2]), float(sys.argv[3])
start_mib, cpu, wall = peak_mib(), time.process_time(), time.perf_counter()
lower, upper, *_ = pompeiu_hausdorff(*a, *b, tol=tolerance)
wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
print(json.dumps({
    "lower": lower, "upper": upper, "wall_ms": 1e3 * wall, "cpu_ms": 1e3 * cpu,
    "peak_mib": peak_mib(), "memory_over_start_mib": peak_mib() - start_mib,
}))
