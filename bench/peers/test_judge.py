"""Tests of the judge; run by scripts/test: python3 -m unittest discover bench/peers"""

import math
import unittest

import judge

CERTIFIED = (1.0, 1.0 + 1e-12)
TOLERANCE = 1e-8


def verdict(kind, *ends):
    answer = {"value": ends[0]} if len(ends) == 1 else {"lower": ends[0], "upper": ends[1]}
    return judge.judge(kind, answer, CERTIFIED, TOLERANCE)[0]


class Enclosures(unittest.TestCase):
    def test_one_that_holds_the_distance_is_right(self):
        self.assertEqual(verdict(judge.ENCLOSURE, 1.0 - 4e-9, 1.0 + 4e-9), "right")

    def test_one_of_no_width_is_right_where_the_distance_is(self):
        self.assertEqual(verdict(judge.ENCLOSURE, 1.0, 1.0), "right")

    def test_one_beside_the_distance_is_wrong(self):
        self.assertEqual(verdict(judge.ENCLOSURE, 1.1, 1.1), "wrong")
        self.assertEqual(verdict(judge.ENCLOSURE, 0.9, 0.9), "wrong")

    def test_an_inverted_one_is_wrong_though_both_ends_are_near(self):
        self.assertEqual(verdict(judge.ENCLOSURE, 1.0 + 1e-9, 1.0 - 1e-9), "wrong")

    def test_infinite_and_undefined_ends_are_wrong(self):
        for ends in [(0.0, math.inf), (-math.inf, 1.0), (math.inf, math.inf), (math.nan, 1.0), (1.0, math.nan)]:
            self.assertEqual(verdict(judge.ENCLOSURE, *ends), "wrong", ends)

    def test_one_that_is_wider_than_asked_is_not_right(self):
        self.assertEqual(verdict(judge.ENCLOSURE, 0.9, 1.1), "wide")


class Numbers(unittest.TestCase):
    def test_a_bounded_number_may_be_off_by_the_tolerance_and_no_more(self):
        self.assertEqual(verdict(judge.BOUNDED, 1.0 + 0.9e-8), "right")
        self.assertEqual(verdict(judge.BOUNDED, 1.0 - 0.9e-8), "right")
        self.assertEqual(verdict(judge.BOUNDED, 1.0 + 2e-8), "wrong")
        self.assertEqual(verdict(judge.BOUNDED, 1.0 - 2e-8), "wrong")

    def test_samples_that_find_the_maximum_are_right(self):
        self.assertEqual(verdict(judge.VERTICES, 1.0), "right")

    def test_samples_that_find_less_miss_it_by_a_share(self):
        for kind in judge.SAMPLED:
            answer = judge.judge(kind, {"value": 0.75}, CERTIFIED, TOLERANCE)
            self.assertEqual(answer, ("misses", "misses the maximum by 25 %"))
        self.assertIn("1e-05 %", judge.judge(judge.VERTICES, {"value": 1 - 1e-7}, CERTIFIED, TOLERANCE)[1])

    def test_samples_that_find_more_than_there_is_are_wrong(self):
        self.assertEqual(verdict(judge.SAMPLES, 1.0 + 1e-7), "wrong")

    def test_what_is_no_number_is_wrong(self):
        for value in [math.nan, math.inf, -math.inf]:
            self.assertEqual(verdict(judge.SAMPLES, value), "wrong")

    def test_a_distance_of_zero_has_no_share(self):
        self.assertEqual(judge.judge(judge.SAMPLES, {"value": 0.5}, (0.0, 0.0), 0.0), ("wrong", "0.5, above the distance"))
        self.assertEqual(judge.judge(judge.SAMPLES, {"value": 0.0}, (0.0, 0.0), 0.0), ("right", ""))


class Offsets(unittest.TestCase):
    def test_what_meets_the_enclosure_is_off_by_nothing(self):
        self.assertEqual(judge.off_by({"lower": 0.5, "upper": 1.0}, CERTIFIED), 0.0)
        self.assertEqual(judge.off_by({"value": 1.0 + 5e-13}, CERTIFIED), 0.0)

    def test_what_does_not_is_off_by_the_way_to_its_nearer_end(self):
        self.assertEqual(judge.off_by({"value": 0.25}, CERTIFIED), 0.75)
        self.assertEqual(judge.off_by({"lower": 1.5, "upper": 3.0}, (0.5, 1.0)), 0.5)

    def test_what_is_no_number_is_infinitely_far(self):
        self.assertEqual(judge.off_by({"value": math.nan}, CERTIFIED), math.inf)

    def test_of_several_answers_the_worst_counts(self):
        for bad in [0.5, 0.9, 1.5, math.nan]:
            answers = [{"value": 1.0}, {"value": bad}, {"value": 1.0 - 1e-3}]
            self.assertEqual(judge.worst(judge.SAMPLES, answers, CERTIFIED, TOLERANCE)[0], answers[1])
        self.assertEqual(judge.worst(judge.VERTICES, [{"value": 1.0}] * 2, CERTIFIED, TOLERANCE)[1], "right")


if __name__ == "__main__":
    unittest.main()
