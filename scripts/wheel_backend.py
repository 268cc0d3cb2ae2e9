"""Builds wheels as maturin does, and puts the command `pompeiu` into them: what pip calls, by PEP 517.

`POMPEIU_COMMAND_ARGS` are the arguments with which cargo builds the command, `--release --locked` unless set; where it is empty, the wheel goes
without. A source distribution holds the sources of the module only, and so do wheels made from it.
"""

import json
import os
import shlex
import subprocess
from pathlib import Path

import maturin
from add_command import add_command
from maturin import (  # noqa: F401
    build_editable,
    build_sdist,
    get_requires_for_build_editable,
    get_requires_for_build_sdist,
    get_requires_for_build_wheel,
    prepare_metadata_for_build_editable,
    prepare_metadata_for_build_wheel,
)

MANIFEST = Path(__file__).resolve().parent.parent / "crates/doors/cli/Cargo.toml"


def program(arguments):
    """Builds the command; gives where it is."""
    call = ["cargo", "build", "--manifest-path", MANIFEST, "--message-format", "json-render-diagnostics", *arguments]
    messages = subprocess.run(call, check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()
    built = [message["executable"] for message in map(json.loads, messages) if message.get("executable")]
    return Path(built[-1])


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """The file name of the wheel."""
    name = maturin.build_wheel(wheel_directory, config_settings, metadata_directory)
    arguments = shlex.split(os.environ.get("POMPEIU_COMMAND_ARGS", "--release --locked"))
    if arguments and MANIFEST.exists():
        add_command(Path(wheel_directory) / name, program(arguments))
    return name
