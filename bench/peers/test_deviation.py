"""Tests of how a scan is made and of what is said about deviation; run by scripts/test."""

import math
import pathlib
import tempfile
import unittest

import deviation


def row(faces, cpu):
    return {"family": "noisy", "accuracy": "0.01", "faces_a": str(faces), "faces_b": str(faces), "process_ms": str(cpu),
            "cpu_ms": str(cpu), "memory_over_start_mib": str(2 * faces * 400 / 2**20)}


class Deviation(unittest.TestCase):
    def test_a_scan_has_a_dent_and_a_hole_and_else_what_the_whole_has(self):
        (dent, _, depth), (hole, _) = deviation.DENT, deviation.MISSING
        beside = [tuple(x + 1e-3 * (k == j) for k, x in enumerate(hole)) for j in range(3)]
        points = [dent, (9.0, 0.0, 0.0), (9.0, 1.0, 0.0), *beside]
        with tempfile.TemporaryDirectory() as folder:
            whole, scan = (pathlib.Path(folder) / name for name in ("whole.obj", "scan.obj"))
            whole.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in points) + "f 1 2 3\nf 4 5 6\n")
            deviation.damaged(whole, scan)
            lines = scan.read_text().splitlines()
        placed = [tuple(map(float, line.split()[1:])) for line in lines if line.startswith("v")]
        self.assertAlmostEqual(placed[0][0], dent[0] - depth)
        self.assertEqual(placed[1:], points[1:])
        self.assertEqual(lines[len(points):], ["f 1 2 3"])

    def test_growth_and_memory_are_told(self):
        said = deviation.verdicts([row(n, 1e-3 * n * math.log(n)) for n in (10**4, 10**5, 10**6)])
        self.assertEqual(len(said), 1)
        self.assertIn("power 1.0", said[0])
        self.assertIn("400 bytes per face", said[0])


if __name__ == "__main__":
    unittest.main()
