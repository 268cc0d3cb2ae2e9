"""Runs one tool on one pair, as often as it is asked: worker.py TOOL A.arrays B.arrays TOLERANCE SAMPLES

Loads both meshes, prints the tool's version, then answers each line on standard input with one JSON object: what the
tool found, wall and CPU time of the call, and the memory it took. Runs in the environment that environment.py makes.
"""

import importlib
import importlib.metadata
import json
import resource
import sys
import time

import numpy as np


def load(path):
    counts = np.fromfile(path, dtype="<i8", count=2)
    with open(path, "rb") as file:
        file.seek(16)
        vertices = np.fromfile(file, dtype="<f8", count=3 * counts[0]).reshape(-1, 3)
        faces = np.fromfile(file, dtype="<i4", count=3 * counts[1]).reshape(-1, 3)
    return vertices, faces


def status_mib(key):
    """A figure of the process by the kernel's account: VmRSS, or VmHWM for the peak."""
    with open("/proc/self/status") as lines:
        return next(int(line.split()[1]) / 1024 for line in lines if line.startswith(key))


def forget_peak():
    """Starts the peak anew, so that it is that of the call and not of reading; memory before the call, in MiB."""
    try:
        with open("/proc/self/clear_refs", "w") as file:
            file.write("5")
        return status_mib("VmRSS:")
    except OSError:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main():
    name, a, b, tolerance, samples = sys.argv[1:]
    tool = importlib.import_module(f"tools.{name}")
    prepared = tool.prepare(load(a), load(b), float(tolerance), int(samples))
    print(json.dumps({"version": importlib.metadata.version(tool.PACKAGE)}), flush=True)
    for _ in sys.stdin:
        reset = getattr(tool, "forget", None)
        if reset:
            reset(prepared)
        before, cpu, wall = forget_peak(), time.process_time(), time.perf_counter()
        found = tool.measure(prepared)
        wall, cpu, peak = time.perf_counter() - wall, time.process_time() - cpu, status_mib("VmHWM:")
        answer = dict(zip(("lower", "upper"), map(float, found))) if isinstance(found, tuple) else {"value": float(found)}
        print(json.dumps(answer | {
            "wall_ms": 1e3 * wall, "cpu_ms": 1e3 * cpu, "peak_mib": peak, "memory_over_start_mib": max(0.0, peak - before),
        }), flush=True)


if __name__ == "__main__":
    main()
