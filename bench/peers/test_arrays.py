"""Tests of the files that every program reads; run by scripts/test."""

import pathlib
import struct
import tempfile
import unittest

import arrays

VERTICES = [(0.1, -1e-300, 1e300), (1 / 3, 2 / 7, 5e-324), (0.0, 1.0, 2.0)]
FACES = [(0, 1, 2), (2, 2, 0)]


class Arrays(unittest.TestCase):
    def test_what_goes_through_an_obj_file_comes_out_bit_for_bit(self):
        with tempfile.TemporaryDirectory() as folder:
            obj, straight, round_trip = (pathlib.Path(folder) / name for name in ("m.obj", "a.arrays", "b.arrays"))
            arrays.write_obj(obj, VERTICES, FACES)
            self.assertEqual(arrays.from_obj(obj, round_trip), (3, 2))
            arrays.write(straight, VERTICES, FACES)
            self.assertEqual(straight.read_bytes(), round_trip.read_bytes())
            self.assertEqual(straight.read_bytes(), struct.pack("<qq9d6i", 3, 2, *sum(VERTICES, ()), *sum(FACES, ())))

    def test_polygons_are_refused_with_their_file(self):
        with tempfile.TemporaryDirectory() as folder:
            obj = pathlib.Path(folder) / "quad.obj"
            obj.write_text("v 0 0 0\nf 1 1 1 1\n")
            with self.assertRaisesRegex(ValueError, "quad.obj.*4 corners"):
                arrays.from_obj(obj, pathlib.Path(folder) / "a.arrays")


if __name__ == "__main__":
    unittest.main()
