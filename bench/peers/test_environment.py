"""What is said when a machine lacks something; run by scripts/test."""

import pathlib
import subprocess
import tempfile
import unittest
from unittest import mock

import environment


class Lacking(unittest.TestCase):
    def setUp(self):
        for cached in (environment.packages, environment.cgal):
            cached.cache_clear()
            self.addCleanup(cached.cache_clear)

    def test_without_venv_every_package_has_the_reason(self):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(folder.rmdir)
        failure = subprocess.CalledProcessError(1, "ensurepip")
        with mock.patch.multiple(environment, ROOT=folder, VENV=folder / "venv", PYTHON=folder / "venv" / "python"), \
                mock.patch("venv.create", side_effect=failure), mock.patch.object(environment, "say"):
            reasons = environment.packages()
        self.assertIn("ensurepip", reasons["cascading-upper-bounds"])
        self.assertIn("ensurepip", reasons["open3d"])

    def test_without_cgal_its_package_is_named(self):
        missing = subprocess.CompletedProcess([], 1, "", "fatal error")
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(environment, "BUILT", pathlib.Path(folder)), \
                mock.patch("subprocess.run", return_value=missing):
            program, reason = environment.cgal()
        self.assertIsNone(program)
        self.assertIn("libcgal-dev", reason)


if __name__ == "__main__":
    unittest.main()
