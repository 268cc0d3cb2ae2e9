"""Adds the command to a wheel, so that installing it puts `pompeiu` beside `python`: `add_command.py WHEEL PROGRAM`."""

import base64
import hashlib
import os
import sys
import zipfile
from pathlib import Path


def add_command(wheel: Path, program: Path) -> None:
    """The wheel is written anew, whole or not at all; what it had stays as it is."""
    content = program.read_bytes()
    temporary = wheel.with_suffix(".part")
    with zipfile.ZipFile(wheel) as old, zipfile.ZipFile(temporary, "w", zipfile.ZIP_DEFLATED) as new:
        (record,) = [name for name in old.namelist() if name.endswith(".dist-info/RECORD")]
        script = record.replace(".dist-info/RECORD", f".data/scripts/{program.name}")
        for entry in old.infolist():
            if entry.filename not in (record, script):
                new.writestr(entry, old.read(entry))
        placed = zipfile.ZipInfo(script, date_time=(1980, 1, 1, 0, 0, 0))
        # A regular file that everybody may run.
        placed.external_attr = 0o100755 << 16
        placed.compress_type = zipfile.ZIP_DEFLATED
        new.writestr(placed, content)
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        rows = [row for row in old.read(record).decode().splitlines() if not row.startswith(f"{script},")]
        rows.append(f"{script},sha256={digest},{len(content)}")
        new.writestr(record, "\n".join(rows) + "\n")
    os.replace(temporary, wheel)


if __name__ == "__main__":
    add_command(Path(sys.argv[1]), Path(sys.argv[2]))
