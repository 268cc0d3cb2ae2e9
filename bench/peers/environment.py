"""What the comparison needs and how it gets it: Python packages from PyPI, CGAL's headers from Debian, our own program.

Whatever cannot be had on this machine is said, once, and done without.
"""

import functools
import pathlib
import re
import shutil
import subprocess
import sys
import venv

import arrays

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
VENV = HERE.parent / ".venv"
PYTHON = VENV / "bin" / "python"
BUILT = ROOT / "target" / "peers"


def say(text):
    print(text, file=sys.stderr, flush=True)


@functools.cache
def packages():
    """Makes the Python environment, or completes it; package -> why it cannot be used here, None when it can."""
    wanted = dict(line.split("==") for line in (HERE / "requirements.txt").read_text().split())
    if not PYTHON.exists():
        say(f"making a Python environment in {VENV.relative_to(ROOT)} and filling it from PyPI (some 2 GB, a few minutes)")
        try:
            venv.create(VENV, with_pip=True)
        except (subprocess.CalledProcessError, OSError) as error:
            # Such as Debian's Python without python3-venv; what was made has no pip and must not be taken for done.
            shutil.rmtree(VENV, ignore_errors=True)
            return dict.fromkeys(map(normal, wanted), f"no Python environment for it: {error}")
    listed = subprocess.run([PYTHON, "-m", "pip", "list", "--format=freeze"], capture_output=True, text=True, check=True)
    there = {normal(line.split("==")[0]): line.split("==")[-1] for line in listed.stdout.split()}
    reasons = {}
    for name, version in wanted.items():
        if there.get(normal(name)) != version:
            # The version of the record, or else whichever there is for this Python and this machine.
            reason = pip_install(f"{name}=={version}")
            if reason and normal(name) not in there and (newest := pip_install(name)):
                reasons[normal(name)] = f"cannot be installed: {newest}"
    return reasons


def pip_install(requirement):
    """Installs a package; None, or why not."""
    done = subprocess.run([PYTHON, "-m", "pip", "install", "-q", requirement], capture_output=True, text=True)
    return None if done.returncode == 0 else last_line(done.stderr)


@functools.cache
def cgal():
    """The path of our CGAL program, built when there are headers, and why there is none otherwise."""
    program, source = BUILT / "cgal", HERE / "cgal" / "hausdorff.cpp"
    if program.exists() and program.stat().st_mtime > source.stat().st_mtime:
        return program, None
    BUILT.mkdir(parents=True, exist_ok=True)
    probe = subprocess.run(["c++", "-E", "-x", "c++", "-", "-o", "/dev/null"], input="#include <CGAL/version.h>\n",
                           text=True, capture_output=True)
    if probe.returncode:
        return None, "no CGAL headers (Debian: libcgal-dev)"
    say("building the CGAL program")
    # -frounding-math: CGAL changes the rounding mode, and the compiler has to know.
    built = subprocess.run(["c++", "-std=c++17", "-O3", "-DNDEBUG", "-frounding-math", source, "-o", program, "-lgmp",
                            "-lmpfr"], text=True, capture_output=True)
    return (None, f"does not build: {last_line(built.stderr)}") if built.returncode else (program, None)


def unloadable(tool):
    """Why a tool that is installed does not run here, such as a system library that is not there; None if it does."""
    # On the smallest mesh, so that it has to load what it needs.
    BUILT.mkdir(parents=True, exist_ok=True)
    triangle = BUILT / "triangle.arrays"
    arrays.write(triangle, [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)], [(0, 1, 2)])
    tried = subprocess.run([PYTHON, "worker.py", tool, triangle, triangle, "1e-8", "10"], cwd=HERE, text=True,
                           stdin=subprocess.DEVNULL, capture_output=True)
    return None if tried.returncode == 0 else f"does not load: {last_line(tried.stderr)}"


@functools.cache
def pompeiu():
    """The release binary of this repository, built."""
    subprocess.run(["cargo", "build", "--release", "--quiet", "-p", "pompeiu-cli"], cwd=ROOT, check=True)
    return ROOT / "target" / "release" / "pompeiu"


@functools.cache
def peak():
    """The path of the small program that starts others and tells their peak memory."""
    program, source = BUILT / "peak", HERE / "peak.c"
    if not program.exists() or program.stat().st_mtime < source.stat().st_mtime:
        BUILT.mkdir(parents=True, exist_ok=True)
        subprocess.run(["cc", "-O2", "-o", program, source], check=True)
    return program


def normal(name):
    return re.sub(r"[-_.]+", "-", name).lower()


def last_line(text):
    return next((line.strip() for line in reversed(text.splitlines()) if line.strip()), "no reason given")
