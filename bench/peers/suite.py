#!/usr/bin/env python3
"""All of it: compares on all pairs, looks for wrong answers, measures growth, and draws what the records show."""

import pathlib
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent

for script in ("compare.py", "wrong.py", "scaling.py", "draw.py"):
    began = time.monotonic()
    subprocess.run([sys.executable, HERE / script], check=True)
    print(f"{script}: {time.monotonic() - began:.0f} s", file=sys.stderr, flush=True)
