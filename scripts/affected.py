"""What a change affects: the crates to test, and the checks beyond them.

    python3 scripts/affected.py FILE...

prints the packages on one line and the names of checks on the next. A crate is affected when a file of its folder changed, or
when it depends on a crate whose library is; tests and examples are part of no library.
"""

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# What the whole workspace is built with.
BUILD = {"Cargo.toml", "Cargo.lock", "clippy.toml", "rustfmt.toml"}
# Which checks beyond lints and tests of crates a file calls for, by the beginning of its path.
CHECKS = {
    "Cargo.lock": ["licences"],
    "deny.toml": ["licences"],
    "crates/doors/py/": ["python"],
    "python/": ["python"],
    "pyproject.toml": ["python"],
    "examples/python/": ["python"],
    "crates/doors/py/src/hausdorff/": ["cluster"],
    "python/pompeiu/ray": ["cluster"],
    "python/tests/test_ray": ["cluster"],
    "crates/show/figures/web/": ["browser"],
    "crates/show/figures/src/page/": ["browser"],
    "crates/show/figures/examples/": ["browser"],
    "docs/guide/": ["guide"],
    "scripts/requirements.txt": ["guide", "python", "browser"],
    "bench/peers/": ["peers"],
    "scripts/": ["scripts"],
}
# The same by a folder of any crate.
FOLDERS = {"/src/show/": ["browser"], "/src/show.rs": ["browser"], "/tests/browser/": ["browser"]}
# Crates whose tests read files outside of all crates, by the beginning of the path of those.
READERS = {
    "docs/guide/": "pompeiu-cli",
    "examples/bracket/": "pompeiu-cli",
    "examples/meshes/": "pompeiu-cli",
    "docs/": "pompeiu",
    "ARCHITECTURE.md": "pompeiu",
    "REFERENCES.bib": "pompeiu",
}


def workspace():
    """By the name of the package: its folder, what it depends on, and what only its tests and examples depend on."""
    command = ["cargo", "metadata", "--format-version", "1", "--no-deps", "--offline"]
    packages = json.loads(subprocess.run(command, cwd=ROOT, check=True, capture_output=True).stdout)["packages"]
    names = {package["name"] for package in packages}

    def uses(package, in_tests):
        found = package["dependencies"]
        return {dependency["name"] for dependency in found if (dependency["kind"] == "dev") == in_tests} & names

    return {
        package["name"]: (
            Path(package["manifest_path"]).parent.relative_to(ROOT).as_posix() + "/",
            uses(package, False),
            uses(package, True),
        )
        for package in packages
    }


def packages(files, crates):
    """The crates that a change of these files affects, in order of their names."""
    if BUILD.intersection(files):
        return sorted(crates)
    folders = {folder: name for name, (folder, _, _) in crates.items()}
    touched, changed = set(), set()
    for file in files:
        for folder, name in folders.items():
            if file.startswith(folder):
                touched.add(name)
                if not file[len(folder):].startswith(("tests/", "examples/", "benches/")):
                    changed.add(name)
        touched.update(name for start, name in READERS.items() if file.startswith(start) and name in crates)
    while True:
        more = {name for name, (_, uses, _) in crates.items() if uses & changed} - changed
        if not more:
            break
        changed |= more
    tested = {name for name, (_, _, uses) in crates.items() if uses & changed}
    return sorted(touched | changed | tested)


def checks(files):
    """The checks beyond crates that a change of these files calls for, in order of their names."""
    by_start = {check for file in files for start, names in CHECKS.items() if file.startswith(start) for check in names}
    by_folder = {check for file in files for folder, names in FOLDERS.items() if folder in file for check in names}
    return sorted(by_start | by_folder)


if __name__ == "__main__":
    print(*packages(sys.argv[1:], workspace()))
    print(*checks(sys.argv[1:]))
