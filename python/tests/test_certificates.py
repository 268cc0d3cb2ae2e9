"""Certificates are written and checked; what is false is named."""

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


def test_the_first_statement_that_fails_is_named(pair, tmp_path):
    path = tmp_path / "proof.phc"
    pompeiu.distance(*pair).certificate(path)
    other = pompeiu.verify(path, pair[0], pompeiu.shapes.cube(2.5, 2))
    assert not other and other.failure.statement == "hash-of-b" and other.a_to_b is None
    content = bytearray(path.read_bytes())
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
