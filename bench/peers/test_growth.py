"""Tests of what is said about growth; run by scripts/test."""

import math
import unittest

import growth

SIZES = [1e4, 1e5, 1e6, 1e7]


def row(faces, build, search, read, mib, threads="2"):
    return {"family": "sphere", "direction": "a-to-b", "cores": "2", "threads": threads, "faces_a": str(faces),
            "faces_b": str(faces), "build_ms": str(build), "search_ms": str(search), "read_ms": str(read),
            "peak_mib": str(mib), "memory_over_start_mib": str(mib), "stop": "tolerance"}


class Growth(unittest.TestCase):
    def test_n_log_n_has_the_exponent_one_and_its_square_two(self):
        self.assertAlmostEqual(growth.exponent([(n, 3e-5 * n * math.log(n)) for n in SIZES]), 1)
        self.assertAlmostEqual(growth.exponent([(n, (n * math.log(n)) ** 2) for n in SIZES]), 2)

    def test_each_question_has_its_yes(self):
        said = growth.verdicts([row(10**k, 10**k, 10**k, 3 * 10**k, 1) for k in range(3, 7)])
        self.assertEqual(["**yes**" in line for line in said], [True] * 3, said)

    def test_each_question_has_its_no(self):
        said = growth.verdicts([row(10**k, 10 ** (2 * k), 10**k, 10**k, 5000) for k in range(3, 7)])
        self.assertEqual(["**no**" in line for line in said], [True] * 3, said)

    def test_one_size_that_takes_longer_than_reading_is_a_no(self):
        said = growth.verdicts([row(10**4, 9, 9, 3, 1), row(10**6, 1, 1, 3, 1), row(10**7, 16, 16, 30, 1)])
        self.assertIn("**no**, at 1 of 2 sizes; at most 1.07 times", said[0])

    def test_what_was_stopped_is_a_no(self):
        rows = [row(10**k, 10**k, 10**k, 3 * 10**k, 1) for k in range(4, 7)]
        rows[-1]["stop"] = "time"
        said = growth.verdicts(rows)
        self.assertEqual(["**no**" in line for line in said], [True, True, False], said)
        self.assertIn("1,000,000 faces were stopped", said[1])

    def test_other_thread_counts_do_not_answer(self):
        rows = [row(10**k, 10**k, 10**k, 3 * 10**k, 1) for k in range(4, 7)]
        slow = [row(10**k, 10**(2 * k), 10**k, 1, 1, threads="1") for k in range(4, 7)]
        self.assertEqual(growth.verdicts(rows), growth.verdicts(rows + slow))


if __name__ == "__main__":
    unittest.main()
