"""Ctrl-C while a call is under way."""

import os
import subprocess
import sys

import pytest

LATE = """
import os, pompeiu, signal, sys, threading
signal.signal(signal.SIGINT, signal.default_int_handler)  # Background jobs of some shells ignore it.
before, call = sys.argv[1].split("|")
exec(before)
def interrupt():
    os.kill(os.getpid(), signal.SIGINT)
timer = threading.Timer(0.1, interrupt)
try:
    timer.start()
    eval(call)
    timer.cancel()
    print("finished", flush=True)
except KeyboardInterrupt:
    print("interrupted", flush=True)
    # What goes on by itself ends with the process.
    os._exit(0)
"""


def ends_by_interrupt(call, folder=None):
    """Runs "before|call" in another process, and sends it a signal a moment after the call began."""
    if os.name == "nt":
        pytest.skip("signals are sent otherwise there")
    child = subprocess.run([sys.executable, "-c", LATE, call], capture_output=True, text=True, cwd=folder)
    assert child.stdout == "interrupted\n", child.stdout + child.stderr
