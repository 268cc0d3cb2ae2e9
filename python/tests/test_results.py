"""Results: frozen, comparable, picklable, shown well."""

import copy
import dataclasses
import json
import pickle

import numpy as np
import pompeiu
import pytest

CUBES = (pompeiu.shapes.cube(1.0), pompeiu.shapes.cube(2.0))
REPORT = pompeiu.hausdorff(*CUBES)
HODGE = pompeiu.HodgeDecomposition(pompeiu.shapes.torus(2.0, 0.7, 12, 8))
PARTS = HODGE.decompose(np.tile([1.0, 2.0, 3.0], (192, 1)))
RESULTS = [
    REPORT,
    REPORT.a_to_b,
    REPORT.witness,
    REPORT.witness.from_,
    pompeiu.mesh_summary(CUBES[0]),
    HODGE.degrees_of_freedom,
    PARTS,
    PARTS.quality,
]


@pytest.mark.parametrize("result", RESULTS, ids=lambda result: type(result).__name__)
def test_results_are_frozen_comparable_and_can_be_pickled(result):
    for other in (pickle.loads(pickle.dumps(result)), copy.deepcopy(result)):
        assert other == result and other is not result
    with pytest.raises(dataclasses.FrozenInstanceError):
        setattr(result, dataclasses.fields(result)[0].name, None)
    assert json.loads(json.dumps(result.to_dict())), "plain values only"
    assert result != REPORT.b_to_a.witness.to


def test_the_time_it_took_does_not_count():
    other = dataclasses.replace(REPORT.a_to_b, timing=pompeiu.Timing(9.0, 9.0))
    assert other == REPORT.a_to_b and hash(other) == hash(REPORT.a_to_b)
    assert dataclasses.replace(REPORT.a_to_b, lower=0.25) != REPORT.a_to_b


def test_fields_are_compared_by_value():
    assert PARTS == HODGE.decompose(np.tile([1.0, 2.0, 3.0], (192, 1)))
    assert PARTS != HODGE.decompose(np.tile([1.0, 2.0, 3.5], (192, 1)))


def test_results_are_shown_in_one_line_and_as_a_table():
    assert repr(REPORT) == (
        f"SymmetricReport({REPORT.lower!r} <= H <= {REPORT.upper!r}, b_to_a, "
        f"from face {REPORT.witness.from_.face} to face {REPORT.witness.to.face})"
    )
    assert repr(REPORT.b_to_a).startswith(f"DirectedReport({REPORT.lower!r} <= h <= ")
    assert repr(PARTS).startswith("FieldParts(gradient=<float64 (192, 3)>, ")
    for shown in (REPORT, REPORT.a_to_b, pompeiu.mesh_summary(CUBES[0]), PARTS, PARTS.quality):
        table = shown._repr_html_()
        assert table.startswith("<table>") and table.count("<tr>") == table.count("</tr>") > 4


def test_a_dictionary_names_both_ends_of_a_witness():
    data = REPORT.to_dict()
    assert data["direction"] == "b_to_a" and data["lower"] == data["b_to_a"]["lower"]
    assert set(data["a_to_b"]["witness"]) == {"from", "to"}
    assert REPORT.witness == REPORT.b_to_a.witness


def test_meshes_can_be_pickled_without_a_copy():
    mesh = pompeiu.shapes.icosphere()
    assert pickle.loads(pickle.dumps(mesh)) == mesh
    buffers = []
    small = pickle.dumps(mesh, protocol=5, buffer_callback=buffers.append)
    assert len(buffers) == 2 and len(small) < 1000
    assert pickle.loads(small, buffers=[memoryview(bytes(b.raw())) for b in buffers]) == mesh, "read-only, as Ray's are"
    assert mesh != pompeiu.shapes.icosphere(2.0) and mesh != "a mesh"


def test_summaries_count():
    summary = pompeiu.mesh_summary(CUBES[1])
    assert (summary.vertices, summary.faces, summary.edges, summary.genus, summary.components) == (8, 12, 18, 0, 1)
    assert summary.area == 24.0 and summary.volume == pytest.approx(8.0)
    assert (summary.lower_corner, summary.upper_corner) == ((-1.0,) * 3, (1.0,) * 3)


def test_enclosures_compare_and_format_like_numbers_where_that_is_certain():
    found = pompeiu.deviations.Enclosure(0.12342, 0.12348)
    assert found < 0.2 and found <= 0.12348 and found > 0.1 and found >= 0.12342 and 0.2 > found
    assert not found < 0.1 and not found > 0.2
    assert found < pompeiu.deviations.Enclosure(0.2, 0.3) and not found > pompeiu.deviations.Enclosure(0.2, 0.3)
    for compare in (lambda: found < 0.12345, lambda: found >= 0.12345, lambda: found > found):
        with pytest.raises(pompeiu.UndecidedError, match="is not decided by these bounds"):
            compare()
    with pytest.raises(TypeError):
        found < "0.1"
    assert f"{found:.3f}" == "0.123" and f"{found:.9f}" == "0.123"
    assert f"{found:8.2f}" == "    0.12" and f"{found:.1%}" == "12.3%" and f"{found:g}" == "0.123"
    assert f"{pompeiu.deviations.Enclosure(0.4, 1.6):.3f}" == "[0.400000, 1.60001]" and f"{found}" == str(found)
    report = pompeiu.distance(pompeiu.shapes.cube(2.0), pompeiu.shapes.cube(2.2))
    assert report.distance < 0.2 and report > 0.1 and f"{report.distance:.3f}" == "0.173"
    assert pompeiu.deviation(pompeiu.shapes.cube(2.0), pompeiu.shapes.cube(2.2)).distance < 0.2
