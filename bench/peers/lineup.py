"""Who can take part on this machine, and how each is started."""

import dataclasses
import os

import environment
import session
import tools


@dataclasses.dataclass
class Limits:
    """What one program may spend on one pair."""

    seconds: float  # for one answer
    memory: int  # bytes of address space
    loading: float = 60  # seconds until the meshes are loaded


@dataclasses.dataclass
class Entrant:
    """A tool of the folder `tools`; `absent` says why it cannot take part."""

    name: str
    adapter: object
    threads: str
    absent: str = None

    def start(self, pair, tolerance, samples, limits):
        """Its session on a pair of pairs.Prepared."""
        program = getattr(self.adapter, "PROGRAM", "").split()
        if program[:1] == ["pompeiu"]:
            return session.Pompeiu(environment.pompeiu(), pair.files, tolerance, int(self.threads), limits)
        if program[:1] == ["cgal"]:
            command = [environment.cgal()[0], program[1]]
        else:
            command = [environment.PYTHON, "worker.py", self.name]
        return session.Worker([*command, *pair.arrays, repr(tolerance), str(samples)], limits)


def entrants():
    """Everybody, our own program with all threads first and then with one; what is missing is said."""
    missing_packages, cgal_missing = environment.packages(), environment.cgal()[1]
    found = []
    for name, adapter in tools.adapters().items():
        if name == "pompeiu":
            cores = os.cpu_count()
            found += [Entrant(name, adapter, str(threads)) for threads in sorted({cores, 1}, reverse=True)]
        elif hasattr(adapter, "PROGRAM"):
            found.append(Entrant(name, adapter, "1", cgal_missing))
        else:
            package = environment.normal(adapter.PACKAGE)
            found.append(Entrant(name, adapter, "own choice", missing_packages.get(package) or environment.unloadable(name)))
    for entrant in found:
        if entrant.absent:
            environment.say(f"{entrant.adapter.TITLE} takes no part: {entrant.absent}")
    return found
