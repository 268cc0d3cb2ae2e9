"""Neurons at growing lengths, beside VTK, METIS and NeuronTransportIGA, in one run.

Writes ../record/DATE-neuron.csv: date, commit, processor, load of the machine, task, input, what was measured, value.
"""

import argparse
import datetime
import gzip
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "peers"))

import record  # noqa: E402
import svg  # noqa: E402

FIELDS = ["date", "commit", "cpu", "load", "task", "input", "quantity", "value"]
CONFIG = '[transport]\nstep = "0.1 s"\nsteps = {steps}\n[inlet]\nfree = 1.0\nplus = 2.0\n'


class Session:
    def __init__(self, program, place):
        self.program, self.record = program, place
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="neuron-"))

    def pompeiu(self, *words):
        """The answer, the seconds of processor time and the peak of memory in MiB."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        command = ["/usr/bin/env", "python3", HERE.parent / "neuron" / "peak.py", self.program, *words, "--json"]
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(map(str, words))}: {done.stderr.strip()}")
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        answer, peak = done.stdout.strip().splitlines()
        return json.loads(answer)["report"], seconds, float(peak)

    def config(self, steps):
        place = self.folder / f"run-{steps}.toml"
        place.write_text(CONFIG.format(steps=steps))
        return place

    def add(self, task, what, quantity, value):
        row = {
            "date": datetime.date.today().isoformat(),
            "commit": record.git("rev-parse", "--short=10", "HEAD"),
            "cpu": record.cpu(),
            "load": f"{os.getloadavg()[0]:.1f}",
            "task": task,
            "input": what,
            "quantity": quantity,
            "value": f"{value:.6g}",
        }
        print(", ".join(f"{key} {row[key]}" for key in FIELDS[4:]), flush=True)
        record.append(self.record, FIELDS, row)


def caterpillar(nodes):
    """A spine of radius 1 with a node every 24 radii, and a branch of 12 at each, in turns to all sides."""
    lines, spine, number = ["1 2 0 0 0 1 -1"], 1, 1
    for k in range(nodes):
        x = 24 * (k + 1)
        number += 1
        lines.append(f"{number} 2 {x} 0 0 1 {spine}")
        spine = number
        number += 1
        angle = 2.4 * k
        lines.append(f"{number} 2 {x + 6} {10.4 * np.cos(angle):.4f} {10.4 * np.sin(angle):.4f} 0.8 {spine}")
    lines.append(f"{number + 1} 2 {24 * (nodes + 1)} 0 0 1 {spine}")
    return "\n".join(lines) + "\n", 24 * (nodes + 1) + 12 * nodes


def growth(session):
    points = []
    for nodes in [1, 2, 4, 8]:
        text, length = caterpillar(nodes)
        place = session.folder / f"caterpillar-{nodes}.swc"
        place.write_text(text)
        answer, seconds, peak = session.pompeiu("neuron", place, "--config", session.config(15))
        session.add("growth", f"length {length}", "processor seconds", seconds)
        session.add("growth", f"length {length}", "peak MiB", peak)
        session.add("growth", f"length {length}", "cells", answer["mesh"]["hexahedra"])
        points.append((length, seconds))
    draw(points)


def draw(points):
    """Seconds over length on logarithmic axes, beside a straight line through the last point."""
    width, height, left, right, top, bottom = 640, 400, 70, 30, 50, 60
    picture = svg.Picture(width, height, "Processor time of all stages over the length of the tree")
    picture.text(left, 28, "Processor time of all stages over the length of the tree", size=15, weight="bold")
    xs, ys = zip(*points)
    low, high = np.log10(min(xs) / 1.3), np.log10(max(xs) * 1.3)
    least, most = np.log10(min(ys) / 1.6), np.log10(max(ys) * 1.6)

    def place(x, y):
        across = (np.log10(x) - low) / (high - low)
        up = (np.log10(y) - least) / (most - least)
        return left + across * (width - left - right), height - bottom - up * (height - top - bottom)

    for x in xs:
        at = place(x, ys[0])[0]
        picture.line([(at, top), (at, height - bottom)], svg.FAINT)
        picture.text(at, height - bottom + 20, f"{x}", "middle")
    for y in [1, 2, 5, 10, 20, 50, 100, 200, 500]:
        if least <= np.log10(y) <= most:
            at = place(xs[0], y)[1]
            picture.line([(left, at), (width - right, at)], svg.FAINT)
            picture.text(left - 8, at + 4, f"{y} s", "end")
    ends = [(x, ys[-1] * x / xs[-1]) for x in (xs[0], xs[-1])]
    picture.line([place(*end) for end in ends if np.log10(end[1]) >= least], svg.GREY, 1.5, "6 4")
    picture.line([place(*point) for point in points], svg.BLUE, 2)
    for point in points:
        picture.mark(*place(*point), "circle", svg.BLUE)
    picture.text(width / 2, height - 14, "length of all branches in radii; dashed: proportional to the length", "middle")
    (HERE / "growth.svg").write_text("\n".join([*picture.parts, "</svg>"]) + "\n")


def stages(session, data, names):
    for name in names:
        place = data / name / "skeleton_smooth.swc"
        answer, seconds, peak = session.pompeiu("neuron", place, "--repair", "--config", session.config(15))
        session.add("stages", name, "processor seconds", seconds)
        session.add("stages", name, "seconds", answer["timing_ms"]["total"] / 1e3)
        session.add("stages", name, "peak MiB", peak)
        session.add("stages", name, "cells", answer["mesh"]["hexahedra"])
        session.add("stages", name, "least scaled Jacobian", answer["mesh"]["min_scaled_jacobian"])
        session.add("stages", name, "section flux drift", answer["flow"]["section_flux_drift"])
        session.add("stages", name, "mass balance", answer["transport"]["mass_balance"])


def bezier_volume(points):
    """The volumes of cells by their values at thirds, as an array of shape (cells, 4, 4, 4, 3), the last axis of places fastest."""
    gauss, weights = np.polynomial.legendre.leggauss(5)
    gauss, weights = (gauss + 1) / 2, weights / 2
    nodes = np.arange(4) / 3
    vandermonde = np.linalg.inv(np.vander(nodes, increasing=True))
    values = np.vander(gauss, 4, increasing=True) @ vandermonde
    slopes = (np.vander(gauss, 4, increasing=True)[:, :3] * np.arange(1, 4)) @ vandermonde[1:]
    along = [np.einsum("ai,bj,ck,nijkd->nabcd", *[slopes if axis == k else values for k in range(3)], points) for axis in range(3)]
    jacobian = np.einsum("nabcd,nabcd->nabc", along[0], np.cross(along[1], along[2]))
    return np.abs(np.einsum("nabc,a,b,c->n", jacobian, weights, weights, weights))


def beside_vtk(session, data):
    tube = session.folder / "tube.swc"
    tube.write_text("1 2 0 0 0 0.5 -1\n2 2 10 0 0 0.5 1\n")
    volume = volume_in_vtk(session, "tube", tube)
    session.add("vtk", "tube", "volume over that of the cylinder, less one", volume / (np.pi * 0.25 * 10) - 1)
    volume_in_vtk(session, "bifurcation", data / "bifurcation" / "skeleton_smooth.swc")


def volume_in_vtk(session, name, skeleton):
    """The volume of the last frame of a run, by the places that VTK finds in its cells."""
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    output = session.folder / f"{name}.pvd"
    answer, _, _ = session.pompeiu("neuron", skeleton, "--config", session.config(15), "--parts", 1, "--frames", 2, "-o", output)
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(sorted(output.with_suffix("").glob("*.vtu"))[-1]))
    reader.Update()
    grid = reader.GetOutput()
    count = grid.GetNumberOfCells()
    assert count == answer["mesh"]["hexahedra"]
    assert all(grid.GetCellType(cell) == vtk.VTK_BEZIER_HEXAHEDRON for cell in range(count))
    places, weights = np.zeros((count, 4, 4, 4, 3)), [0.0] * 64
    for cell in range(count):
        shape, where = grid.GetCell(cell), [0.0, 0.0, 0.0]
        for i, j, k in np.ndindex(4, 4, 4):
            shape.EvaluateLocation(vtk.reference(0), [i / 3, j / 3, k / 3], where, weights)
            places[cell, i, j, k] = where
    volumes = bezier_volume(places)
    total = vtk_to_numpy(grid.GetCellData().GetArray("total"))
    session.add("vtk", name, "cells", count)
    session.add("vtk", name, "volume", volumes.sum())
    session.add("vtk", name, "mass", (volumes * total).sum())
    return volumes.sum()


def shipped_mesh(session, data):
    place = session.folder / "controlmesh.vtk"
    place.write_bytes(gzip.decompress((data / "bifurcation" / "controlmesh.vtk.gz").read_bytes()))
    return place


def partitions(session, data):
    import pymetis

    mesh, parts = shipped_mesh(session, data), 28
    lines = mesh.read_text().split("CELLS", 1)[1].splitlines()
    count = int(lines[0].split()[0])
    cells = np.array([line.split()[1:] for line in lines[1 : 1 + count]], dtype=int)
    faces = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    owner, links = {}, []
    for cell, corners in enumerate(cells):
        for face in faces:
            key = tuple(sorted(corners[face]))
            if key in owner:
                links.append((owner[key], cell))
            owner[key] = cell
    links = np.array(links)
    neighbours = [[] for _ in range(count)]
    for a, b in links:
        neighbours[a].append(b)
        neighbours[b].append(a)
    output = session.folder / "mesh.vtu"
    session.pompeiu("neuron", "mesh", mesh, "-o", output, "--partition", parts)
    ours = np.array((session.folder / f"mesh.vtu.epart.{parts}").read_text().split(), dtype=int)
    shipped = gzip.decompress((data / "bifurcation" / "bzmeshinfo.txt.epart.28.gz").read_bytes())
    found = {
        "pompeiu": ours,
        "METIS": np.array(pymetis.part_graph(parts, adjacency=neighbours)[1]),
        "shipped": np.array(shipped.split(), dtype=int),
    }
    for name, part in found.items():
        session.add("partition", name, "faces cut", (part[links[:, 0]] != part[links[:, 1]]).sum())
        session.add("partition", name, "imbalance", np.bincount(part).max() * parts / count)


def beside_iga(session, data):
    mesh = shipped_mesh(session, data)
    _, seconds, _ = session.pompeiu("neuron", "mesh", mesh, "--extraction", session.folder / "splines")
    session.add("iga", "extraction", "processor seconds", seconds)
    times = [session.pompeiu("neuron", "transport", mesh, "--config", session.config(steps))[1] for steps in (5, 55)]
    session.add("iga", "transport", "processor seconds a step", (times[1] - times[0]) / 50)
    session.add("iga", "transport", "processor seconds before the first step", times[0] - (times[1] - times[0]) / 10)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pompeiu", required=True)
    parser.add_argument("--data", type=pathlib.Path, required=True)
    parser.add_argument("--skeletons", nargs="*", default=["cylinder", "bifurcation"])
    parser.add_argument("--tasks", nargs="*", default=["growth", "stages", "vtk", "partition", "iga"])
    options = parser.parse_args()
    place = HERE.parent / "record" / f"{datetime.date.today().isoformat()}-neuron.csv"
    session = Session(pathlib.Path(options.pompeiu).resolve(), place)
    tasks = {
        "growth": lambda: growth(session),
        "stages": lambda: stages(session, options.data, options.skeletons),
        "vtk": lambda: beside_vtk(session, options.data),
        "partition": lambda: partitions(session, options.data),
        "iga": lambda: beside_iga(session, options.data),
    }
    for name in options.tasks:
        tasks[name]()


if __name__ == "__main__":
    main()
