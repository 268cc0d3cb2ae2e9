"""Fluids: what is conserved, forces as arrays and callables, saving and going on, errors."""

import numpy as np
import pompeiu
import pytest


def test_energy_mass_and_vorticity_are_conserved():
    torus = pompeiu.shapes.torus(1.0, 0.4, 24, 12)
    x, y, z = torus.vertices.T
    dye = np.exp(-4 * x)
    fluid = pompeiu.Simulation(torus, 0.05, integrator="implicit-midpoint", densities={"dye": dye})
    fluid.set_vorticity(x * y + z, [0.5, -0.2])
    before = fluid.measure()
    steps = fluid.step(6)
    assert len(steps) == 6 and fluid.steps == 6 and abs(fluid.time - 0.3) < 1e-12
    for step in steps:
        assert abs(step["energy"] / before["energy"] - 1) < 1e-12
        assert abs(step["mass"][0] / before["mass"][0] - 1) < 1e-12
        assert abs(step["total_vorticity"]) < 1e-12 and step["divergence"] < 1e-12
    assert fluid.velocity.shape == (torus.n_faces, 3)
    assert fluid.densities["dye"].min() >= dye.min() - 1e-14
    assert len(fluid.harmonic_fields) == 2 and not np.allclose(fluid.harmonic, [0.5, -0.2])


def test_forces_are_arrays_or_called():
    sphere = pompeiu.shapes.icosphere(1.0, 2)
    centres = sphere.vertices[sphere.faces].mean(axis=1)
    spin = np.cross([0.0, 0.0, 1.0], centres)
    given, called = (pompeiu.Simulation(sphere, 0.1) for _ in range(2))
    given.step(3, force=spin)
    times = []
    called.step(3, force=lambda fluid: (times.append(fluid.time), spin)[1])
    assert (given.velocity == called.velocity).all() and np.allclose(times, [0, 0.1, 0.2])
    assert given.measure()["energy"] > 0.1


@pytest.mark.parametrize("scheme, transport", [("vorticity", "flux-corrected"), ("crouzeix-raviart", "faces")])
def test_a_saved_state_goes_on_bit_for_bit(tmp_path, scheme, transport):
    sphere = pompeiu.shapes.icosphere(1.0, 2)

    def new():
        density = {"initial": sphere.vertices[:, 0] ** 2, "weight": 1.0, "diffusivity": 0.01}
        options = dict(viscosity=0.01, gravity=[0, 0, -1], densities={"dye": density})
        return pompeiu.Simulation(sphere, 0.1, scheme=scheme, transport=transport, **options)

    fluid = new()
    fluid.set_vorticity(sphere.vertices[:, 2])
    fluid.step(2)
    fluid.save(tmp_path / "state.json")
    expected = fluid.step(2)
    other = new()
    other.load(tmp_path / "state.json")
    assert other.step(2) == expected
    with pytest.raises(pompeiu.OptionError, match="was written with another `viscosity`"):
        pompeiu.Simulation(sphere, 0.1, scheme=scheme, transport=transport, densities={"dye": sphere.vertices[:, 0]}).load(tmp_path / "state.json")


def test_a_scene_flows_as_the_command_has_it(tmp_path):
    torus = pompeiu.shapes.torus(1.0, 0.4, 24, 12)
    (tmp_path / "scene.toml").write_text(
        "dt = 0.05\nvorticity = \"x*y+z\"\nharmonic = [0.5, -0.2]\n[[density]]\nname = \"dye\"\ninitial = \"exp(-4*x)\"\n"
    )
    scene = pompeiu.read_options(tmp_path / "scene.toml")
    found = pompeiu.fluid(torus, **scene, steps=4)
    x, y, z = torus.vertices.T
    stepped = pompeiu.Simulation(torus, 0.05, densities={"dye": np.exp(-4 * x)})
    stepped.set_vorticity(x * y + z, [0.5, -0.2])
    last = stepped.step(4)[-1]
    assert abs(found.steps[-1]["energy"] / last["energy"] - 1) < 1e-12
    assert np.allclose(found.velocity, stepped.velocity) and np.allclose(found.densities["dye"], stepped.densities["dye"])
    assert pompeiu.fluid(torus, **scene, steps=4, time_limit=0).stop == "time"
    assert pompeiu.fluid(torus, **scene, steps=100_000, progress=lambda share: False).stop == "cancelled"
    for wrong, message in [
        ({"steps": 1}, "give the length of a step"),
        ({}, "give the number of steps .* and the length of a step"),
        ({"steps": 1, "dt": 0.1, "lid": 1.0}, "`lid` is for the square"),
        ({"steps": 1, "dt": 0.1, "vortex": [{"at": [0, 0, 0], "radious": 1}]}, "unknown field `radious`"),
    ]:
        with pytest.raises(pompeiu.OptionError, match=message):
            pompeiu.fluid(torus, **wrong)


def test_what_makes_no_sense_is_refused():
    sphere = pompeiu.shapes.icosphere(1.0, 1)
    for options in [{"scheme": "eulerian"}, {"viscosity": -1.0}, {"cfl": 0.0}, {"wall": "sticky"}]:
        with pytest.raises(pompeiu.OptionError):
            pompeiu.Simulation(sphere, 0.1, **options)
    for dt, message in [(0.0, "time step is 0"), (float("nan"), "dt is nan")]:
        with pytest.raises(pompeiu.OptionError, match=message):
            pompeiu.Simulation(sphere, dt)
    fluid = pompeiu.Simulation(sphere, 0.1)
    force = np.zeros((sphere.n_faces, 3))
    force[4] = np.nan
    with pytest.raises(pompeiu.FieldError, match="face 4"):
        fluid.step(force=force)
    with pytest.raises(pompeiu.FieldError):
        fluid.set_vorticity(np.zeros(3))
    with pytest.raises(pompeiu.OptionError, match="no density"):
        fluid.set_density("dye", np.zeros(3))
    with pytest.raises(pompeiu.OptionError, match="unknown 'sorce'"):
        pompeiu.Simulation(sphere, 0.1, densities={"dye": {"initial": np.zeros(42), "sorce": 1}})


def test_the_square_has_the_same_methods(tmp_path):
    n = 16
    x, y = np.meshgrid((np.arange(n) + 0.5) / n, (np.arange(n) + 0.5) / n)
    options = dict(edges="periodic", viscosity=0.01, densities={"dye": x * y})

    # u = sin(2 pi y) decays by the same factor in each step, and what is right and what is up are told apart.
    square = pompeiu.SquareSimulation(n, 0.1, **options)
    square.set_velocity(np.stack([np.sin(2 * np.pi * y), 0 * x], axis=-1))
    assert np.allclose(square.velocity[:, 3, 0], np.sin(2 * np.pi * y[:, 3]), atol=0.03)
    first, second = square.step(2)
    rate = 0.01 * (2 * n * np.sin(np.pi / n)) ** 2
    assert abs(second["energy"] / first["energy"] - (1 + 0.1 * rate) ** -2) < 1e-9
    assert second["divergence"] < 1e-12 and abs(second["mass"][0] - 0.25) < 1e-12
    square.save(tmp_path / "square.json")
    other = pompeiu.SquareSimulation(n, 0.1, **options)
    other.load(tmp_path / "square.json")
    pull = np.zeros((n, n, 2))
    pull[..., 1] = np.sin(2 * np.pi * x)
    assert other.step(force=pull) == square.step(force=lambda fluid: pull)
    assert other.vorticity.shape == (n, n) and other.scheme["name"] == "mac" and other.steps == 3
    for wrong in [{"grid": "yee"}, {"edges": "channel"}, {"obstacles": [True]}]:
        with pytest.raises((pompeiu.OptionError, pompeiu.FieldError)):
            pompeiu.SquareSimulation(n, 0.1, **wrong)
    with pytest.raises(pompeiu.OptionError):
        pompeiu.SquareSimulation(100_000, 0.1)


def test_what_flows_in_flows_out():
    channel = pompeiu.shapes.grid((3.0, 1.0), (12, 4))
    x, y, _ = channel.vertices.T
    edges = {}
    for a, b in channel.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2):
        key = (min(a, b), max(a, b))
        edges[key] = edges.get(key, 0) + 1
    ends = [(v, w) for (v, w), count in edges.items() if count == 1 and x[v] == x[w]]
    inflow = [(v, w, 0.5 if x[v] < x.mean() else -0.5) for v, w in ends]
    fluid = pompeiu.Simulation(channel, 0.1, wall="free-slip", inflow=inflow)
    step = fluid.step(2)[-1]
    assert abs(step["energy"] - 0.375) < 1e-9 and step["divergence"] < 1e-12
    for wrong in [inflow[1:], [(0, 10_000, 1.0)]]:
        with pytest.raises(pompeiu.OptionError):
            pompeiu.Simulation(channel, 0.1, inflow=wrong)
