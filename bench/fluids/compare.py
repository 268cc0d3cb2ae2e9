"""Fluids in the square beside a plain C program and PhiFlow, and on a surface, in one run.

Writes ../record/DATE-fluids.csv: date, commit, processor, load of the machine, what, size, program, milliseconds of processor time a
step on one thread, and the kinetic energy at the end.
"""

import argparse
import datetime
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

for name in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "RAYON_NUM_THREADS", "MKL_NUM_THREADS"]:
    os.environ[name] = "1"

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "peers"))

import record  # noqa: E402

FIELDS = ["date", "commit", "cpu", "load", "task", "size", "program", "ms_per_step", "energy"]
VISCOSITY, DIFFUSIVITY, DT = 1e-4, 1e-4, 0.02
VELOCITY = "16*x^2*(1-x)^2*y*(1-y)*(1-2*y); -16*x*(1-x)*y^2*(1-y)^2*(1-2*x)"


class Session:
    def __init__(self, program, record):
        self.program, self.record = program, record
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="fluids-"))

    def pompeiu(self, *words):
        done = subprocess.run([self.program, *map(str, words), "--json"], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(map(str, words))}: {done.stderr.strip()}")
        return json.loads(done.stdout)["report"]

    def add(self, task, size, program, milliseconds, energy):
        row = {
            "date": datetime.date.today().isoformat(),
            "commit": record.git("rev-parse", "--short=10", "HEAD"),
            "cpu": record.cpu(),
            "load": f"{os.getloadavg()[0]:.1f}",
            "task": task,
            "size": size,
            "program": program,
            "ms_per_step": f"{milliseconds:.2f}",
            "energy": f"{energy:.6g}",
        }
        print(", ".join(f"{key} {row[key]}" for key in FIELDS[4:]), flush=True)
        record.append(self.record, FIELDS, row)


def per_step(answer):
    return sum(answer["timing_ms"]["per_step"].values())


def square(session, cells, steps):
    compiled = session.folder / "stam"
    subprocess.run(["cc", "-O3", "-march=native", "-o", compiled, HERE / "stam.c"], check=True)
    words = [compiled, cells, steps, 20, VISCOSITY, DIFFUSIVITY, DT]
    answer = json.loads(subprocess.run(list(map(str, words)), check=True, capture_output=True, text=True).stdout)
    session.add("square", cells, "stam.c, 20 sweeps", 1000 * answer["seconds_per_step"], answer["energy"])
    scene = session.folder / "square.toml"
    scene.write_text(
        f'dt = {DT}\nsteps = {steps}\nviscosity = {VISCOSITY}\nvelocity = "{VELOCITY}"\n'
        f'[[density]]\nname = "dye"\ndiffusivity = {DIFFUSIVITY}\ninitial = "x*y"\n'
    )
    for grid in ["stam:20", "stam", "mac"]:
        answer = session.pompeiu("fluid", "--square", cells, scene, "--grid", grid, "--wall", "free-slip" if grid == "mac" else "no-slip")
        session.add("square", cells, f"pompeiu, {grid}", per_step(answer), answer["steps"][-1]["energy"])
    try:
        phiflow(session, cells, max(1, steps // 5))
    except ValueError as error:
        # Indices of its sparse matrices overflow on larger squares.
        print(f"square, size {cells}, PhiFlow 3.4.0: no answer, {error}", flush=True)


def phiflow(session, cells, steps):
    from phi import math
    from phi.flow import Box, CenteredGrid, Solve, StaggeredGrid, advect, diffuse, extrapolation, fluid

    math.set_global_precision(64)

    def start(place):
        x, y = place.vector["x"], place.vector["y"]
        u = 16 * x**2 * (1 - x) ** 2 * y * (1 - y) * (1 - 2 * y)
        v = -16 * x * (1 - x) * y**2 * (1 - y) ** 2 * (1 - 2 * x)
        return math.stack([u, v], math.channel(vector="x,y"))

    box = Box(x=1, y=1)
    u = StaggeredGrid(CenteredGrid(start, 0, box, x=cells, y=cells), 0, box, x=cells, y=cells)
    product = lambda place: place.vector["x"] * place.vector["y"]
    dye = CenteredGrid(product, extrapolation.BOUNDARY, box, x=cells, y=cells)
    spent = 0.0
    for step in range(steps + 1):
        before = time.process_time()
        u = diffuse.explicit(u, VISCOSITY, DT, substeps=max(1, int(8 * VISCOSITY * DT * cells**2)))
        u = advect.semi_lagrangian(u, u, DT)
        u, _ = fluid.make_incompressible(u, solve=Solve("CG", 1e-5, 1e-5))
        dye = diffuse.explicit(dye, DIFFUSIVITY, DT, substeps=max(1, int(8 * DIFFUSIVITY * DT * cells**2)))
        dye = advect.semi_lagrangian(dye, u, DT)
        if step > 0:
            spent += time.process_time() - before
    centred = u.at_centers().values.numpy("x,y,vector")
    energy = 0.5 * (centred**2).sum() / cells**2
    session.add("square", cells, "PhiFlow 3.4.0", 1000 * spent / steps, energy)


def surface(session, mesh, steps):
    """A viscous flow that carries a density, at dual Courant numbers of about 1 and 4."""
    answer = session.pompeiu("info", mesh)
    faces = answer["faces"]
    start = ["fluid", mesh, "--velocity", "random:1", "--viscosity", 1e-4, "--density", "exp(-x^2)", "--steps", steps]
    probe = session.pompeiu(*start[:-1], 1, "--dt", 1e-3)
    unit = 1e-3 / probe["steps"][-1]["cfl"]
    for number in [1, 4]:
        for scheme in ["vorticity", "any-step", "faces", "crouzeix-raviart"]:
            words = [*start, "--dt", 0.95 * number * unit, "--scheme", scheme]
            if scheme in ["any-step", "faces"]:
                words += ["--transport", "semi-lagrangian"]
            answer = session.pompeiu(*words)
            name = f"pompeiu, {scheme}, Courant number {number}"
            session.add(f"surface {mesh.stem}", faces, name, per_step(answer), answer["steps"][-1]["energy"])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mesh", type=pathlib.Path, nargs="?", help="a closed surface, or an oriented one with boundary")
    parser.add_argument("--pompeiu", default=shutil.which("pompeiu") or "target/release/pompeiu")
    parser.add_argument("--cells", type=int, nargs="+", default=[128, 512])
    parser.add_argument("--steps", type=int, default=10)
    today = datetime.date.today().isoformat()
    parser.add_argument("--record", type=pathlib.Path, default=HERE.parent / "record" / f"{today}-fluids.csv")
    arguments = parser.parse_args()
    session = Session(arguments.pompeiu, arguments.record)
    try:
        for cells in arguments.cells:
            square(session, cells, arguments.steps)
        if arguments.mesh:
            surface(session, arguments.mesh, arguments.steps)
    finally:
        shutil.rmtree(session.folder)


if __name__ == "__main__":
    main()
