"""The programs that are compared, one file each.

A file says what its tool is and how it is asked:

    TITLE     as people read it
    PACKAGE   on PyPI; for a program of this repository, what its RUN names instead
    KIND      what the answer claims, see judge.py: enclosure, bounded, vertices or samples
    PRECISION digits it computes with, if they are not those of a double
    prepare(a, b, tolerance, samples)   the meshes (vertices, faces) as the tool holds them, before the clock starts
    measure(prepared)                   builds its trees and answers: a number, or a tuple (lower, upper)
    forget(prepared)                    drops what the tool keeps between calls, when it keeps anything

Nothing is imported before `prepare`, so that the program that starts the workers can read what is above without
having the packages. To add a tool, add a file and its package to requirements.txt.
"""

import importlib
import pkgutil


def adapters():
    """Every tool of this folder, name to module: ours, then the most that is claimed first."""
    kinds = ["enclosure", "bounded", "vertices", "samples"]
    modules = {m.name: importlib.import_module(f"{__name__}.{m.name}") for m in pkgutil.iter_modules(__path__)}

    def rank(name):
        return name != "pompeiu", kinds.index(modules[name].KIND), name

    return {name: modules[name] for name in sorted(modules, key=rank)}
