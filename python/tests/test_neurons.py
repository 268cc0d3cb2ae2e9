"""Skeletons of neurons: dialects, problems, repairs, errors."""

import pickle

import numpy as np
import pompeiu
import pytest

Y = b"# a furcation\r\n1 2 0 0 0 1 -1\r\n2 2 9 0 0 1 1\r\n4 2 18 6 0 0 2\r\n3 2 18 -6 0 1 2\r\n"


def test_a_skeleton_is_read_from_a_file_and_from_bytes(tmp_path):
    path = tmp_path / "y.swc"
    path.write_bytes(Y)
    skeleton = pompeiu.read_skeleton(path)
    assert (skeleton.ids == [1, 2, 4, 3]).all() and (skeleton.parents == [-1, 0, 1, 1]).all()
    assert skeleton.report["branches"] == 3 and skeleton.report["tips"] == 2
    assert [(p["kind"], p["sample"], p["line"]) for p in skeleton.problems] == [("zero_radius", 4, 4)]
    again = pompeiu.read_skeleton(skeleton.swc.encode())
    assert np.array_equal(again.positions, skeleton.positions)


def test_repairs_and_smoothing_are_told():
    skeleton = pompeiu.read_skeleton(Y, repair=True, smooth=2, spacing=0.5)
    assert skeleton.report["repairs"] == ["sample 4 (line 4) has the radius 1.000000 instead of 0"]
    assert skeleton.report["deviation"]["position"] < 1e-6
    assert skeleton.problems == [] and (skeleton.radii == 1).all() and len(skeleton.ids) > 50


def test_what_is_no_skeleton_is_located(tmp_path):
    with pytest.raises(pompeiu.ReadError, match="line 2: sample 2 continues sample 9, which does not exist"):
        pompeiu.read_skeleton(b"1 1 0 0 0 1 -1\n2 1 0 0 0 1 9\n")
    with pytest.raises(pompeiu.MissingFileError):
        pompeiu.read_skeleton(tmp_path / "none.swc")
    for options in [{"smooth": -1}, {"spacing": 0.0}, {"spacing": float("nan")}]:
        with pytest.raises(pompeiu.OptionError):
            pompeiu.read_skeleton(Y, **options)


def test_a_mesh_conforms_and_encloses_its_cells(tmp_path):
    mesh = pompeiu.read_skeleton(Y, repair=True).mesh(parts=1)
    assert mesh.certified and mesh.report["hexahedra"] == len(mesh.cells) and mesh.cells.max() == len(mesh.vertices) - 1
    assert sorted(mesh.cap_samples) == [1, 3, 4] and set(mesh.caps) == {-1, 0, 1, 2}
    # By the divergence theorem over bilinear faces, the boundary encloses some three cylinders of radius 1.
    a, b, c, d = np.moveaxis(mesh.vertices[mesh.boundary], 1, 0)
    mean = (a + b + c + d) / 4
    enclosed = (mean * np.cross(c - a, d - b)).sum() / 6
    assert 0.85 < enclosed / (np.pi * (9 + 2 * np.hypot(9, 6))) < 1.05
    mesh.write(tmp_path / "y.vtu")
    assert (tmp_path / "y.vtu").read_bytes() == mesh.vtu
    with pytest.raises(pompeiu.WriteError):
        mesh.write(tmp_path / "y.stl")


def test_the_wall_is_compared_with_the_skeleton():
    skeleton = pompeiu.read_skeleton(TUBE)
    mesh = skeleton.mesh()
    upper = max(mesh.report["wall"][way]["upper_radii"] for way in ("wall_to_cones", "cones_to_wall"))
    assert mesh.within is True and mesh.report["wall"]["within"] == 0.2 and upper <= 0.2
    # The corners of a square with the area of a circle are .253 radii outside of it.
    squares = [skeleton.mesh(parts=1, within=within) for within in (0.2, 0.26)]
    assert [square.within for square in squares] == [False, True]
    with pytest.raises(pompeiu.OptionError, match="distance in radii is 0"):
        skeleton.mesh(within=0)


def test_cells_that_are_not_proven_are_named():
    # A branch that turns at every sample, shorter between them than it is wide.
    text = (
        b"1 2 0.00 0.00 0.00 1.29 -1\n2 2 1.67 -0.11 0.65 0.70 1\n3 2 2.61 -1.37 0.61 1.48 2\n4 2 2.36 -2.71 -0.81 1.32 3\n"
        b"5 2 2.02 -2.79 -1.78 0.92 4\n6 2 0.89 -2.83 -2.81 1.28 5\n7 2 0.04 -2.52 -3.81 1.39 6\n8 2 -0.62 -2.02 -4.37 1.07 7\n"
        b"9 2 -1.99 -3.33 -4.97 2.39 8\n10 2 -2.47 -3.77 -5.55 2.48 9\n11 2 -3.07 -3.83 -5.96 1.00 10\n12 2 -3.32 -3.75 -7.20 1.82 11\n"
    )
    mesh = pompeiu.read_skeleton(text).mesh()
    assert not mesh.certified
    worst = mesh.report["unproven"][0]
    assert set(worst) == {"cell", "scaled_jacobian", "folded", "centre", "sample", "line"}
    assert any(place["folded"] for place in mesh.report["unproven"])
    assert worst["scaled_jacobian"] == min(place["scaled_jacobian"] for place in mesh.report["unproven"])


def test_what_cannot_be_meshed_is_said():
    with pytest.raises(pompeiu.OptionError, match="line 4: sample 4 has the radius 0"):
        pompeiu.read_skeleton(Y).mesh()
    skeleton = pompeiu.read_skeleton(Y, repair=True)
    with pytest.raises(pompeiu.OptionError, match="MiB"):
        skeleton.mesh(memory_limit=1000)
    for options in [{"parts": 0}, {"parts": 9}, {"layer": float("nan")}]:
        with pytest.raises(pompeiu.OptionError):
            skeleton.mesh(**options)


def test_transport_is_bounded_and_ends_in_equilibrium(tmp_path):
    mesh = pompeiu.read_skeleton(Y, repair=True).mesh(parts=1)
    config = """[transport]
    speed_plus = "0 um/s"
    attach_plus = "3 /s"
    detach_plus = "1 /s"
    step = "1 s"
    steps = 30
    [inlet]
    free = "closed"
    plus = 0
    [initial]
    free = 2
    """
    path = tmp_path / "run.toml"
    path.write_text(config, encoding="utf-8")
    found = mesh.transport(path, frames=4)
    assert found.times[-1] == 30 and list(found.frame_times) == [0, 10, 20, 30]
    assert found.ends.shape == (31, 3, 3) and found.frames.shape == (4, len(mesh.cells), 3)
    # Three quarters are on motors.
    assert np.allclose(found.frames[-1], [0.5, 1.5, 0.0], atol=1e-9) and np.allclose(found.ends[-1], [0.5, 1.5, 0.0], atol=1e-9)
    assert found.report["mass_balance"] < 1e-10 and found.report["minimum"] >= 0
    with pytest.raises(pompeiu.OptionError, match="line 2: there is no key"):
        mesh.transport("[transport]\nspeed = 1\n")
    with pytest.raises(pompeiu.MissingFileError):
        mesh.transport(tmp_path / "none.toml")
    with pytest.raises(pompeiu.OptionError):
        mesh.transport(frames=1)


TUBE = b"1 2 0 0 0 1 -1\n2 2 8 0 0 1 1\n"


def test_flow_through_a_tube_is_that_of_poiseuille(tmp_path):
    skeleton = pompeiu.read_skeleton(TUBE)
    splines = skeleton.splines()
    assert splines.certified and splines.cells.shape == (25, 64) and splines.cells.max() == len(splines.control_points) - 1
    flow = skeleton.flow('[flow]\nspeed = "2 um/s"\n')
    # 8 mu L U / R^2.
    assert flow.report["flow"]["pressure_drop"] == pytest.approx(8 * 1e-3 * 8 * 2, rel=2e-3)
    assert list(flow.end_samples) == [1, 2] and np.allclose(flow.end_fluxes, np.pi * 2 * np.array([-1, 1]), rtol=1e-9)
    assert flow.velocity.shape == flow.control_points.shape and len(flow.pressure) == len(flow.cells) == len(flow.branches)
    found = flow.transport("[transport]\nsteps = 4\norder = 2\n", parts=1, frames=3)
    assert found.frames.shape == (3, 25, 3) and found.report["mass_balance"] < 1e-12 and found.report["minimum"] >= 0
    flow.write(tmp_path / "flow.vtu")
    splines.write(tmp_path / "splines.vtu")
    assert (tmp_path / "flow.vtu").read_bytes() == flow.vtu
    with pytest.raises(pompeiu.OptionError, match="either a speed or a pressure"):
        skeleton.flow('[flow]\nspeed = "1 um/s"\npressure = "1 Pa"\n')
    with pytest.raises(pompeiu.OptionError):
        skeleton.splines(elements=5)


def test_splines_are_refined_where_they_are_asked_to_be(tmp_path):
    skeleton = pompeiu.read_skeleton(TUBE)
    splines = skeleton.splines(elements=2, refine=["ends", "sample=1"], levels=2)
    levels, report = splines.elements[:, 0], splines.report["spline"]
    assert [level["elements"] for level in report["levels"]] == list(np.bincount(levels))
    assert report["partition_of_unity_error"] <= 1e-14 and (0.125**levels).sum() == 25 * 8
    # Polygons of twelve sides in circles.
    # The section is a polygon of twelve sides.
    assert all(abs(splines.report["mesh"]["linear"][of] - 0.955) < 1e-3 for of in ("volume", "area"))
    starts, functions, coefficients = splines.extraction()
    assert len(starts) == len(splines.elements) + 1 and functions.max() == report["functions"] - 1
    sums = np.add.reduceat(coefficients, starts[:-1])
    assert np.abs(sums - 1).max() <= 1e-14 and coefficients.min() >= 0
    # The control points of elements, by the splines; the box of all of them is that of the tube.
    points = np.add.reduceat(coefficients[:, :, None] * splines.positions()[functions][:, None, :], starts[:-1])
    assert points[..., 0].min() == pytest.approx(0, abs=1e-13) and points[..., 0].max() == pytest.approx(8, abs=1e-13)
    assert 3 * len(splines.vtu) > points.nbytes
    assert skeleton.splines(elements=2).report["spline"].keys() == {"functions", "partition_of_unity_error"}
    for refine, problem in [("nodes", "no element is in this place"), ("sample=9", "no sample has this number"), ("tips", "is no place to refine")]:
        with pytest.raises(pompeiu.OptionError, match=problem):
            skeleton.splines(refine=[refine])
    with pytest.raises(pompeiu.OptionError):
        skeleton.splines(refine=["ends"], levels=6)


def test_heat_in_a_rod_that_was_meshed_elsewhere(tmp_path):
    pompeiu.read_skeleton(TUBE).mesh(parts=1).write(tmp_path / "rod.vtu")
    rod = pompeiu.read_neuron_mesh(tmp_path / "rod.vtu", sides=["+x", "-x"])
    assert rod.certified and list(rod.cap_samples) == [2, 1]
    heat = '[transport]\nspeed_plus = "0 um/s"\nattach_plus = "0 /s"\nstep = "1000 s"\nsteps = 3\n[inlet]\nplus = 0\n[tips]\nfree = 3\n'
    found = rod.transport(heat)
    middle = rod.vertices[rod.cells].mean(axis=1)[:, 0]
    assert np.allclose(found.frames[-1][:, 0], 3 - middle / 4, atol=1e-2)
    with pytest.raises(pompeiu.OptionError, match="no side of a box"):
        pompeiu.read_neuron_mesh(tmp_path / "rod.vtu", sides=["x"])
    with pytest.raises(pompeiu.OptionError, match="it is named twice"):
        pompeiu.read_neuron_mesh(tmp_path / "rod.vtu", sides=["+x", "+x"])
    with pytest.raises(pompeiu.MissingFileError):
        pompeiu.read_neuron_mesh(tmp_path / "none.vtu")


def test_a_duct_that_was_meshed_elsewhere_has_splines_and_flow(tmp_path):
    pompeiu.read_skeleton(TUBE).mesh(parts=1).write(tmp_path / "rod.vtu")
    rod = pompeiu.read_neuron_mesh(tmp_path / "rod.vtu", sides=["-x", "+x"])
    splines = rod.splines(refine=["ends"])
    assert splines.certified and splines.elements[:, 0].max() == 1
    with pytest.raises(pompeiu.OptionError, match="this mesh has none"):
        rod.splines(refine=["nodes"])
    flow = rod.flow('[flow]\nspeed = "1 um/s"\n')
    assert flow.end_fluxes[0] == pytest.approx(-flow.end_fluxes[1], rel=1e-9)
    # A prism over a square of the disc's area: about 28.46 mu L U / a^2.
    assert flow.report["flow"]["pressure_drop"] == pytest.approx(28.46e-3 * 8 / np.pi, rel=0.05)
    assert flow.transport("[transport]\nsteps = 2\n", parts=1).report["mass_balance"] < 1e-12


def test_a_run_goes_on_from_a_checkpoint_and_has_a_page(tmp_path):
    skeleton = pompeiu.read_skeleton(TUBE)
    config = '[transport]\nstep = "0.3 s"\nsteps = 8\n'
    flow = skeleton.flow(config)
    for moved in (skeleton.mesh(parts=1).transport, lambda *a, **k: flow.transport(*a, parts=1, **k)):
        whole = moved(config, frames=3)
        calls = []
        part = moved(config, frames=3, progress=lambda share: calls.append(share) or False)
        assert 1 <= part.report["steps"] <= 8
        moved(config.replace("steps = 8", "steps = 5"), frames=3).save_checkpoint(tmp_path / "state.json")
        found = moved(config, frames=3, resume=tmp_path / "state.json")
        assert (found.ends == whole.ends).all() and (found.frames[-1] == whole.frames[-1]).all()
        assert found.report == whole.report
        with pytest.raises(pompeiu.OptionError, match="another configuration"):
            moved(config.replace("0.3", "0.2"), resume=tmp_path / "state.json")
        found.save_html(tmp_path / "run.html", name="tube")
        page = (tmp_path / "run.html").read_text(encoding="utf-8")
        assert page.startswith("<!") and "tube" in page and "http://" not in page.replace("http://www.w3.org", "")
    with pytest.raises(pompeiu.OptionError, match="other cells"):
        skeleton.mesh(parts=2).transport(config, resume=tmp_path / "state.json")
    (tmp_path / "wrong.json").write_text("[]")
    with pytest.raises(pompeiu.ReadError, match="no checkpoint"):
        skeleton.mesh(parts=1).transport(config, resume=tmp_path / "wrong.json")
    with pytest.raises(pompeiu.MissingFileError):
        skeleton.mesh(parts=1).transport(config, resume=tmp_path / "none.json")
    with pytest.raises(ValueError, match="pickled"):
        pickle.loads(pickle.dumps(whole)).save_html(tmp_path / "run.html")


def test_a_check_says_what_a_mesh_cannot_do():
    back = pompeiu.read_skeleton(b"1 2 0 0 0 1 -1\n2 2 6 0 0 1 1\n3 2 0.5 0.6 0 1 2\n")
    found = back.check()
    assert found.meshable is False and not back.mesh().within
    assert [(p["kind"], p["line"]) for p in found.problems] == [("too_short", 3)]
    rod = pompeiu.read_skeleton(TUBE)
    assert rod.check(within=0.3) == pompeiu.SkeletonCheck(True, []) and rod.mesh(within=0.3).within
    once = pompeiu.neuron(b"1 2 0 0 0 1 -1\n2 2 8 0 0 1 1\n", stage="check")
    assert once.report["meshable"] is True and once.skeleton.problems == []


def test_stages_end_when_they_are_told_to():
    skeleton = pompeiu.read_skeleton(Y, repair=True)
    for stage in (skeleton.mesh, skeleton.splines, skeleton.flow):
        with pytest.raises(pompeiu.OptionError, match="ended by the time limit before the"):
            stage(time_limit=0)
        with pytest.raises(pompeiu.OptionError, match="ended by request before the"):
            stage(progress=lambda share: False)


def test_a_sweep_is_what_its_runs_are(tmp_path):
    configs = [f'[transport]\nspeed_plus = "{speed} um/s"\nsteps = 3\n' for speed in (0.5, 1)]
    [[slow, fast]] = pompeiu.sweep_neurons([TUBE], configs, parts=1)
    assert (fast.ends == pompeiu.read_skeleton(TUBE).mesh(parts=1).transport(configs[1]).ends).all()
    assert fast.ends[-1, 1].sum() > slow.ends[-1, 1].sum()
    [[along]] = pompeiu.sweep_neurons([TUBE], configs[:1], parts=1, viscous=True)
    assert along.report["mass_balance"] < 1e-12
    with pytest.raises(pompeiu.MissingFileError):
        pompeiu.sweep_neurons([tmp_path / "none.swc"], configs)


def test_all_stages_in_one_call(tmp_path):
    rod = b"1 2 0 0 0 1 -1\n2 2 12 0 0 1 1\n"
    stepped = read = pompeiu.read_skeleton(rod).mesh(parts=1).transport("[transport]\nsteps = 4")
    once = pompeiu.neuron(rod, stage="transport", parts=1, within=0.3, transport={"steps": 4})
    assert once.stop == "tolerance" and np.array_equal(once.transport.ends, stepped.ends)
    once.transport.save_checkpoint(tmp_path / "state.json")
    longer = pompeiu.neuron(rod, stage="transport", parts=1, within=0.3, transport={"steps": 6}, resume=tmp_path / "state.json")
    assert longer.report["transport"]["steps"] == 6
    # The checkpoint is that of the stages one after another, too.
    again = pompeiu.read_skeleton(rod).mesh(parts=1).transport("[transport]\nsteps = 6", resume=tmp_path / "state.json")
    assert np.array_equal(again.ends, longer.transport.ends) and read is stepped
    (tmp_path / "rod.swc").write_bytes(rod)
    assert len(pompeiu.neuron(tmp_path / "rod.swc", stage="mesh", parts=1, within=0.3).mesh.cells) == 25
    assert pompeiu.neuron(rod, stage="spline").splines.certified
    limited = pompeiu.neuron(rod, stage="transport", time_limit=0)
    assert limited.stop == "time" and limited.transport is None and limited.skeleton is not None
    for options, words in [
        ({"stage": "check", "frames": 3}, "frames is not for the stage check"),
        ({"transport": {"diffusoin": "1 um^2/s"}}, "there is no key \"diffusoin\""),
        ({"parameters": "run.toml", "flow": {}}, "from a file or from tables"),
        ({"elements": 9}, "elements is 9; expected 1 to 4"),
    ]:
        with pytest.raises(pompeiu.OptionError, match=words):
            pompeiu.neuron(rod, **options)
