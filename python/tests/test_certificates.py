"""Certificates are written and checked; what is false is named."""

import gzip

import numpy as np
import pytest

import pompeiu


@pytest.fixture
def pair():
    return pompeiu.shapes.icosphere(1.0, 2), pompeiu.shapes.cube(2.0, 2)


def test_what_is_written_is_valid_and_holds_the_distance(pair, tmp_path):
    found = pompeiu.distance(*pair, certificate_slack=1e-9)
    path = tmp_path / "proof.phc"
    written = found.certificate(path)
    assert written.bytes == path.stat().st_size
    checked = pompeiu.verify(path, *pair, threads=1)
    assert checked and checked.failure is None
    for claim, report in ((checked.a_to_b, found.a_to_b), (checked.b_to_a, found.b_to_a)):
        assert claim.lower <= report.lower <= report.upper < claim.upper < report.upper + 1e-8
        assert report.lower - claim.lower < 1e-14
    assert (checked.a_to_b, checked.b_to_a) == (written.a_to_b, written.b_to_a)


def test_a_threshold_is_the_upper_end(pair, tmp_path):
    found = pompeiu.distance(*pair, assert_below=5.0, direction="a-to-b")
    written = found.certificate(tmp_path / "proof.phc")
    assert found.answer == "below" and written.a_to_b.upper == 5.0 and written.b_to_a is None


def test_meshes_made_within_a_distance_come_with_proofs(tmp_path):
    ball, path = pompeiu.shapes.icosphere(1.0, 3), tmp_path / "proof.phc"
    few = pompeiu.simplify(ball, within=0.05, levels=2)
    made = [
        (few, 0.05),
        (few.finer[0], 0.025),
        (pompeiu.remesh(ball, edge_length=0.2, within=0.06), 0.06),
        (pompeiu.repair(ball, weld=1e-3, within=0.01), 0.01),
    ]
    for result, within in made:
        written = result.certificate(path)
        checked = pompeiu.verify(path, ball, result.mesh)
        assert checked and checked.a_to_b == written.a_to_b
        assert [claim.upper for claim in (checked.a_to_b, checked.b_to_a)] == [within, within]
        assert not pompeiu.verify(path, ball, pompeiu.shapes.cube(2.0, 2))
    with pytest.raises(pompeiu.OptionError, match="within"):
        pompeiu.simplify(ball, faces=200).certificate(path)
    with pytest.raises(pompeiu.OptionError, match="center"):
        pompeiu.remesh(ball, edge_length=0.2, within=0.06, center=True).certificate(path)


def test_the_largest_distances_of_a_deviation_are_proven(pair, tmp_path):
    path = tmp_path / "proof.phc"
    found = pompeiu.deviation(*pair)
    found.certificate(path)
    checked = pompeiu.verify(path, *pair)
    for claim, one in ((checked.a_to_b, found.a_to_b), (checked.b_to_a, found.b_to_a)):
        assert claim.lower <= one.lower <= one.upper < claim.upper < one.upper + 1e-10
    pompeiu.deviation(*pair, threshold=5.0).certificate(path)
    assert pompeiu.verify(path, *pair).b_to_a.upper == 5.0
    with pytest.raises(pompeiu.OptionError, match="left out"):
        pompeiu.deviation(*pair, box=(0, 0, 0, 2, 2, 2)).certificate(path)


def test_the_first_statement_that_fails_is_named(pair, tmp_path):
    path = tmp_path / "proof.phc"
    pompeiu.distance(*pair).certificate(path)
    other = pompeiu.verify(path, pair[0], pompeiu.shapes.cube(2.5, 2))
    assert not other and other.failure.statement == "hash-of-b" and other.a_to_b is None
    content = bytearray(gzip.decompress(path.read_bytes()))
    content[81:89] = np.float64(0.1).tobytes()
    path.write_bytes(content)
    failure = pompeiu.verify(path, *pair).failure
    assert failure.statement == "cell" and failure.direction == "a_to_b" and failure.cell is not None
    assert str(failure.face) in failure.message


def test_what_cannot_be_used_is_refused(pair, tmp_path):
    path = tmp_path / "proof.phc"
    with pytest.raises(pompeiu.MissingFileError):
        pompeiu.verify(path, *pair)
    path.write_bytes(b"PHCERT9\n" + bytes(100))
    with pytest.raises(pompeiu.ReadError, match="version 1"):
        pompeiu.verify(path, *pair)
    with pytest.raises(pompeiu.OptionError, match="slack"):
        pompeiu.distance(*pair, certificate_slack=-1.0)
    with pytest.raises(pompeiu.WriteError, match="limit on time"):
        pompeiu.distance(*pair).certificate(path, time_limit=0.0)
    moved = pompeiu.distance(*pair, align="rigid")
    with pytest.raises(pompeiu.OptionError, match="align"):
        moved.certificate(path)
    assert path.read_bytes().startswith(b"PHCERT9\n")
