"""Deviation: closed forms, sampling beside libigl, regions, options."""

import json
import math
import pickle

import igl
import numpy as np
import pompeiu
import pytest
from shapes_with_answers import grid, mesh

#: A triangle, and one that leans away from it by up to 0.3: the distance is 0.3 times a linear function from 0 to 1.
FLAT = mesh([[0, 0, 0], [2, 0, 0], [0, 2, 0]], [[0, 1, 2]])
LEANING = mesh([[0, 0, 0], [1, 0, 0.3], [0, 1, 0]], [[0, 1, 2]])


def test_statistics_of_a_linear_distance():
    report = pompeiu.directed_deviation(LEANING, FLAT, threshold=0.15, percentiles=(50, 75))
    statistics = report.statistics
    # The share of a triangle where a linear function from 0 to 1 is at most t is 1 - (1 - t)².
    assert 0.1 in statistics.mean and 0.3 / math.sqrt(6) in statistics.rms
    assert 0.25 in statistics.above.share and statistics.above.threshold == 0.15
    assert 0.3 * (1 - math.sqrt(0.5)) in statistics.percentiles[0].distance
    assert [p.share for p in statistics.percentiles] == [0.5, 0.75] and 0.15 in statistics.percentiles[1].distance
    assert statistics.area == pytest.approx(0.5 * math.hypot(1, 0.3))
    assert report.lower <= 0.3 <= report.upper + 1e-15 and report.stop == "tolerance"
    assert report.witness.from_.position == pytest.approx((1, 0, 0.3))
    edges, cumulative = statistics.histogram.edges, statistics.histogram.cumulative
    assert edges.shape == (65,) and statistics.histogram.bins.shape == (64, 2)
    exact = 1 - (1 - np.minimum(edges / 0.3, 1)) ** 2
    assert np.all(cumulative[:, 0] <= exact + 1e-12) and np.all(exact - 1e-12 <= cumulative[:, 1])


def test_fields_by_face_and_by_vertex():
    report = pompeiu.directed_deviation(LEANING, FLAT)
    assert np.allclose(report.vertex_distances, [0, 0.3, 0], atol=report.vertex_error)
    assert report.face_max.shape == report.face_min.shape == report.face_mean.shape == (1, 2)
    for bounds, exact in ((report.face_max, 0.3), (report.face_min, 0.0), (report.face_mean, 0.1)):
        assert bounds[0, 0] - 1e-15 <= exact <= bounds[0, 1] + 1e-15
    spare = (np.vstack([LEANING[0], [[9, 9, 9]]]), LEANING[1])
    assert np.array_equal(np.isnan(pompeiu.directed_deviation(spare, FLAT).vertex_distances), [False, False, False, True])


def test_both_directions_stay_apart():
    part, whole = grid(1.0, 2), grid(3.0, 2)
    report = pompeiu.deviation(part, whole)
    assert report.a_to_b.upper < 1e-12 and report.b_to_a.lower <= math.sqrt(2) <= report.b_to_a.upper
    assert (report.lower, report.upper) == (report.b_to_a.lower, report.b_to_a.upper)
    assert report.greater_percentiles == report.b_to_a.statistics.percentiles
    assert report.pooled.area == pytest.approx(10.0)
    mean = report.b_to_a.statistics.mean
    assert report.pooled.mean.lower <= 0.9 * mean.upper and 0.9 * mean.lower <= report.pooled.mean.upper


def test_samples_agree():
    rng = np.random.default_rng(11)
    vertices, faces = grid(2.0, 8)
    a, b = (vertices + rng.normal(scale=0.05, size=vertices.shape), faces), (vertices, faces)
    report = pompeiu.directed_deviation(a, b, threshold=0.05)
    corners = a[0][faces]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    chosen = rng.choice(len(faces), size=200_000, p=areas / areas.sum())
    weights = rng.dirichlet((1, 1, 1), size=len(chosen))
    squared, _, _ = igl.point_mesh_squared_distance(np.einsum("ij,ijk->ik", weights, corners[chosen]), b[0], b[1])
    samples = np.sqrt(np.maximum(squared, 0))
    statistics = report.statistics
    # Four standard errors either way.
    slack = 4 / math.sqrt(len(samples))
    assert statistics.mean.lower - slack * samples.std() <= samples.mean() <= statistics.mean.upper + slack * samples.std()
    share = (samples > 0.05).mean()
    assert statistics.above.share.lower - slack / 2 <= share <= statistics.above.share.upper + slack / 2
    assert samples.max() <= report.upper
    largest = np.zeros(len(faces))
    np.maximum.at(largest, chosen, samples)
    assert np.all(largest <= report.face_max[:, 1])


def test_regions_are_told_apart():
    vertices, faces = grid(10.0, 20)
    for x, y, height in ((-3.0, -3.0, 0.5), (3.0, 3.0, 0.25)):
        vertices[:, 2] += height * np.exp(-((vertices[:, 0] - x) ** 2 + (vertices[:, 1] - y) ** 2))
    report = pompeiu.directed_deviation((vertices, faces), grid(10.0, 1), threshold=0.1, regions=2)
    first, second = report.regions
    assert 0.5 in first.peak and np.allclose(first.witness.from_.position, (-3, -3, 0.5))
    assert 0.25 in second.peak and np.allclose(second.centre[:2], (3, 3), atol=0.2)
    assert np.all(np.diff(first.faces.astype(int)) > 0) and not set(first.faces) & set(second.faces)
    assert first.lower_corner <= (-3, -3, 0) and first.area > 0 and len(report.beyond_threshold) == 2
    assert all(region.level == 0.1 for region in report.beyond_threshold)


def test_the_same_bits_for_any_number_of_threads_and_through_a_pickle():
    a, b = pompeiu.shapes.torus(2.0, 0.7, 30, 20), pompeiu.shapes.torus(2.0, 0.72, 24, 16)
    one = pompeiu.deviation(a, b, threads=1, threshold=0.02)
    assert one == pompeiu.deviation(a, b, threads=2, threshold=0.02) == pickle.loads(pickle.dumps(one))
    assert one != pompeiu.deviation(a, b, threshold=0.03)
    data = json.loads(json.dumps(one.to_dict()))
    assert len(data["a_to_b"]["face_max"]) == 1200 and data["a_to_b"]["regions"][0]["witness"]["from"]["face"] >= 0
    assert repr(one).startswith("Deviation(") and "1200 faces" in repr(one.a_to_b)
    for shown in (one, one.a_to_b, one.pooled):
        assert shown._repr_html_().count("<tr>") > 4


def test_sides_are_told_apart():
    inner, outer = pompeiu.shapes.icosphere(1.0, 2), pompeiu.shapes.icosphere(1.5, 3)
    report = pompeiu.deviation(inner, outer, signed=True)
    # Winding numbers are evaluated only as well as the side needs.
    assert np.all(np.abs(report.a_to_b.vertex_winding - 1) < 0.5) and np.all(np.abs(report.a_to_b.face_winding - 1) < 0.5)
    assert np.all(np.abs(report.b_to_a.vertex_winding) < 0.5) and report.b_to_a.face_winding.shape == (1280,)
    assert np.array_equal(report.a_to_b.signed_vertex_distances, -report.a_to_b.vertex_distances)
    assert np.array_equal(report.b_to_a.signed_vertex_distances, report.b_to_a.vertex_distances)
    # Both are closed and oriented.
    inside = pompeiu.directed_deviation(inner, outer)
    assert inside.signed == report.a_to_b.signed and inside.signed.mean.upper == pytest.approx(-inside.statistics.mean.lower)
    assert inside.signed.highest < 0 < report.b_to_a.signed.lowest and inside.signed.standard_deviation.upper < 0.1
    unsigned = pompeiu.directed_deviation(inner, outer, unsigned=True)
    assert unsigned.signed_vertex_distances is None and unsigned.signed is None


def test_a_mesh_without_area_has_no_statistics():
    points = mesh([[0, 0, 1], [1, 0, 2]], [[0, 0, 0], [1, 1, 1]])
    report = pompeiu.deviation(points, grid(4.0, 1))
    assert report.a_to_b.statistics is None and report.greater_percentiles is None and 2.0 in report.a_to_b.distance
    assert np.allclose(report.a_to_b.vertex_distances, [1, 2])


def test_limits_and_callbacks_end_it_with_wider_enclosures():
    a, b = pompeiu.shapes.torus(2.0, 0.7, 30, 20), pompeiu.shapes.torus(2.0, 0.72, 24, 16)
    exact = pompeiu.directed_deviation(a, b).statistics.mean
    stopped = pompeiu.directed_deviation(a, b, accuracy=1e-6, progress=lambda progress: False)
    few = pompeiu.directed_deviation(a, b, accuracy=1e-6, most_pieces=1300)
    for report in (stopped, few):
        mean = report.statistics.mean
        assert mean.lower <= exact.upper and exact.lower <= mean.upper
        assert mean.gap > 1e-6 * mean.lower
    assert stopped.stop == "cancelled" and few.stop == "pieces"


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"accuracy": 0.0}, "the accuracy is 0; it must be"),
        ({"percentiles": [0.5]}, "the percentile is 0.5; percentiles are in percent of the area, at least 1 and below 100"),
        ({"threshold": -1.0}, "option `threshold` of deviation: expected a finite length that is not negative"),
        ({"threads": 0}, "the number of threads is 0; at least 1 is needed"),
        ({"time_limit": math.inf}, "the time limit is inf seconds; it must be a finite number that is not negative"),
    ],
)
def test_options_that_mean_nothing_are_named(options, sentence):
    with pytest.raises(pompeiu.OptionError) as raised:
        pompeiu.deviation(FLAT, LEANING, **options)
    assert str(raised.value).startswith(sentence)


def test_what_is_shown_encloses_too():
    rng = np.random.default_rng(13)
    for x in [0.0, 1.0, 1e-300, 5e-324, 1e300, 0.9999999, *10.0 ** rng.uniform(-20, 20, 200)]:
        shown = str(pompeiu.Enclosure(x, x))
        lower, upper = map(float, shown.strip("[]").split(", "))
        assert lower <= x <= upper and len(shown) <= 34


def test_pages_and_pictures(tmp_path):
    report = pompeiu.deviation(LEANING, FLAT, threshold=0.15)
    page = tmp_path / "page.html"
    report.save_html(page, names=("model.obj", "scan.obj"), unit="mm", up="z")
    text = page.read_text(encoding="utf-8")
    assert "model.obj" in text and "mm" in text and "<script src" not in text
    picture = tmp_path / "picture.png"
    report.save_image(picture, size=(320, 200), theme="dark", direction_to_eye=(0, 0, 1))
    assert picture.read_bytes() == report.image(size=(320, 200), theme="dark", direction_to_eye=(0, 0, 1))
    assert report.image(size=(64, 48))[:8] == b"\x89PNG\r\n\x1a\n"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["page.html", "picture.png"]
    for wrong in ({"size": (0, 5)}, {"theme": "blue"}, {"up": "w"}):
        with pytest.raises(pompeiu.OptionError):
            report.image(**wrong)
    with pytest.raises(pompeiu.WriteError):
        report.save_html(tmp_path / "nowhere" / "page.html")
    again = pickle.loads(pickle.dumps(report))
    assert again == report and "_page" not in report.to_dict()
    with pytest.raises(ValueError, match="pickled"):
        again.save_html(page)


def test_tolerance_bands():
    cube = pompeiu.shapes.cube(2.0)
    raised = (np.asarray(cube.vertices) + [0, 0, 0.1], cube.faces)
    found = pompeiu.deviation(cube, raised, bands=[(-0.05, 0.05)]).bands
    # The lid stands out and so do the walls along it; the floor is inside, and nearer beside the walls.
    low, high = 1.9**2 / 24, (4 + 8 * 0.05) / 24
    shares = found.b_to_a.shares
    assert found.edges == (-0.05, 0.05) and low in shares[0] and high in shares[2]
    assert found.b_to_a.closed and found.b_to_a.lowest.lower <= -0.1 <= found.b_to_a.lowest.upper + 1e-12
    assert high in found.a_to_b.shares[0] and low in found.a_to_b.shares[2]
    assert pompeiu.deviation(cube, raised).bands is None
    with pytest.raises(pompeiu.OptionError, match="bands leave out"):
        pompeiu.deviation(cube, raised, bands=[(-1, 0), (0.5, 1)])


def test_documents_for_printing(tmp_path):
    report = pompeiu.deviation(LEANING, FLAT)
    report.save_pdf(tmp_path / "found.pdf", verdict="WITHIN", paper="letter", unit="mm")
    content = (tmp_path / "found.pdf").read_bytes()
    assert content.startswith(b"%PDF-") and content.rstrip().endswith(b"%%EOF")
    with pytest.raises(pompeiu.OptionError, match="paper"):
        report.save_pdf(tmp_path / "no.pdf", paper="a3")
    assert not (tmp_path / "no.pdf").exists()


def test_verdicts_and_units():
    report = pompeiu.deviation(LEANING, FLAT, threshold="0.2mm", unit="cm")
    # The leaning triangle reaches 0.3 cm, so 0.02 cm is exceeded.
    assert report.verdict.answer == "out" and report.a_to_b.statistics.above.threshold == pytest.approx(0.02)
    assert str(report.verdict).startswith("OUT OF TOLERANCE 0.02 cm: beyond it")
    cube = pompeiu.shapes.cube(2.0)
    within = pompeiu.deviation(cube, pompeiu.shapes.cube(2.2), bands=["0um..0.2mm"], unit="mm")
    assert within.verdict.answer == "within" and within.bands.edges == (0.0, 0.2)
    assert pompeiu.deviation(LEANING, FLAT).verdict is None
    with pytest.raises(pompeiu.OptionError, match="give one of them"):
        pompeiu.deviation(LEANING, FLAT, threshold=1, bands=[(-1, 1)])
    with pytest.raises(pompeiu.OptionError, match="mesh files have none"):
        pompeiu.deviation(LEANING, FLAT, threshold="1mm")


def test_parts_and_groups(tmp_path):
    whole, part = grid(3.0, 6), grid(1.0, 2)
    near = (part[0] + [0, 0, 0.1], part[1])
    report = pompeiu.deviation(whole, near, only_overlap=True, threshold=0.15)
    assert report.verdict.answer == "within" and 0.1 in report.a_to_b.distance
    left_out = report.report["left_out"]["a"]
    assert left_out["faces"] == len(whole[1]) - len(part[1]) and left_out["cut"] == len(part[1])
    # A strip three quarters as wide as the distance goes along the rim.
    assert left_out["share"]["lower"] == pytest.approx(1 - 0.85**2 / 9, abs=1e-3)
    report.save_html(tmp_path / "part.html")
    path = tmp_path / "two.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 5\nv 1 0 5\nv 0 1 5\no low\nf 1 2 3\no high\nf 4 5 6\n")
    above = mesh([[0, 0, 5.5], [1, 0, 5.5], [0, 1, 5.5]], [[0, 1, 2]])
    report = pompeiu.deviation(path, above, group=["high"])
    assert 0.5 in report and report.a_to_b.regions[0].faces.tolist() == [1]
    with pytest.raises(pompeiu.OptionError, match="there are low, high"):
        pompeiu.deviation(path, above, group=["lid"])


def test_a_moved_copy_is_aligned_first():
    vertices = np.array([[0, 0, 0], [4, 0, 0], [0, 2, 0], [1, 0.5, 1.0]])
    faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
    turned = (vertices[:, [2, 0, 1]] + [10, -3, 7], faces)
    report = pompeiu.deviation((vertices, faces), turned, align="rigid")
    assert report.upper < 1e-6 and report.report["alignment"]["matched"] > 0.99


def test_a_part_that_lies_elsewhere_is_noticed():
    ring = pompeiu.shapes.torus(1.0, 0.4, 24, 12)
    moved = (ring.vertices + [151, 0, 0], ring.faces)
    with pytest.warns(UserWarning, match='the poses do not fit, and align="rigid"'):
        report = pompeiu.deviation(ring, moved)
    assert report.report["misplaced"]["aligned"] < 1e-3 * report.report["misplaced"]["as_it_lies"]


def test_clouds_are_led_to_what_measures_them():
    points = np.random.default_rng(1).normal(size=(10, 3))
    with pytest.raises(TypeError, match="pompeiu.distance measures how far its points"):
        pompeiu.deviation(pompeiu.shapes.cube(), points)


def test_arrays_are_read_only():
    ring = pompeiu.shapes.torus()
    one = pompeiu.deviation(ring, ring).a_to_b
    histogram = one.statistics.histogram
    for array in (ring.vertices, ring.faces, one.face_max, one.vertex_distances, histogram.edges, histogram.bins):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
