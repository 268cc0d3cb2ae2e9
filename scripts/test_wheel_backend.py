"""A wheel carries the command after maturin has made it."""

import base64
import hashlib
import json
import os
import subprocess
import sys
import tempfile
import types
import unittest
import zipfile
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).parent))

NAME = "pompeiu-0.1.0-cp310-abi3-linux_x86_64.whl"
HOOKS = ["build_editable", "build_sdist", "get_requires_for_build_editable", "get_requires_for_build_sdist",
         "get_requires_for_build_wheel", "prepare_metadata_for_build_editable", "prepare_metadata_for_build_wheel"]


def fake_maturin():
    module = types.ModuleType("maturin")
    for hook in HOOKS:
        setattr(module, hook, lambda *_: None)

    def build_wheel(folder, *_):
        with zipfile.ZipFile(Path(folder) / NAME, "w") as wheel:
            wheel.writestr("pompeiu/__init__.py", "")
            wheel.writestr("pompeiu-0.1.0.dist-info/RECORD", "pompeiu/__init__.py,,\npompeiu-0.1.0.dist-info/RECORD,,\n")
        return NAME

    module.build_wheel = build_wheel
    return module


class WheelBackend(unittest.TestCase):
    def built(self, folder, arguments):
        with mock.patch.dict(sys.modules, {"maturin": fake_maturin()}):
            sys.modules.pop("wheel_backend", None)
            import wheel_backend
        executable = Path(folder) / "pompeiu"
        executable.write_bytes(b"a program")
        messages = [{"reason": "compiler-artifact", "executable": None}, {"executable": str(executable)}, {"reason": "build-finished"}]
        done = subprocess.CompletedProcess([], 0, stdout="\n".join(map(json.dumps, messages)))
        with mock.patch.dict(os.environ, arguments), mock.patch("subprocess.run", return_value=done) as run:
            self.assertEqual(wheel_backend.build_wheel(folder), NAME)
        return run, zipfile.ZipFile(Path(folder) / NAME)

    def test_the_command_is_in_the_wheel_and_its_record(self):
        with tempfile.TemporaryDirectory() as folder:
            run, wheel = self.built(folder, {"POMPEIU_COMMAND_ARGS": "--profile dev"})
            self.assertEqual(run.call_args.args[0][-2:], ["--profile", "dev"])
            with wheel:
                script = "pompeiu-0.1.0.data/scripts/pompeiu"
                self.assertEqual(wheel.read(script), b"a program")
                self.assertEqual(wheel.getinfo(script).external_attr >> 16, 0o100755)
                record = wheel.read("pompeiu-0.1.0.dist-info/RECORD").decode()
            digest = base64.urlsafe_b64encode(hashlib.sha256(b"a program").digest()).rstrip(b"=").decode()
            self.assertIn(f"{script},sha256={digest},9\n", record)

    def test_it_is_left_out_where_nobody_wants_it(self):
        with tempfile.TemporaryDirectory() as folder:
            run, wheel = self.built(folder, {"POMPEIU_COMMAND_ARGS": ""})
            with wheel:
                self.assertFalse(any("scripts" in name for name in wheel.namelist()))
            run.assert_not_called()


if __name__ == "__main__":
    unittest.main()
