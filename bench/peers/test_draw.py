"""Tests of what is put into documents; run by scripts/test."""

import pathlib
import tempfile
import unittest
from unittest import mock

import draw
import tables

TEXT = f"before\n<!-- name: {draw.MAKER} -->\nold\n<!-- /name -->\nafter\n"


def row(pair, tool, kind, status, wall, threads="1", **more):
    return {"pair": pair, "tool": tool, "title": tool.upper(), "kind": kind, "status": status, "threads": threads, "cores": "2",
            "wall_ms_median": str(wall), "faces_a": "100", "faces_b": "100", "memory_over_start_mib": "1", "tolerance": "1e-8",
            "certified_lower": "2.0", "certified_upper": "2.0", "lower": "1.5", "upper": "1.5", "precision": "double",
            "version": "1", "detail": "more than 10 s"} | more


ROWS = [
    row("one", "pompeiu", "enclosure", "right", 2, "2"), row("one", "pompeiu", "enclosure", "right", 4),
    row("one", "cascading_upper_bounds", "enclosure", "right", 40),
    row("one", "fast", "vertices", "misses", 0.5), row("one", "slow", "vertices", "right", 1),
    row("two", "pompeiu", "enclosure", "right", 10, "2"), row("two", "pompeiu", "enclosure", "right", 10),
    row("two", "cascading_upper_bounds", "enclosure", "timeout", ""),
    row("two", "fast", "vertices", "misses", 5), row("two", "slow", "vertices", "wrong", 50),
    row("three", "pompeiu", "enclosure", "right", 10, "2"), row("three", "pompeiu", "enclosure", "right", 10),
    row("three", "cascading_upper_bounds", "enclosure", "wrong", 5000),
]


class Put(unittest.TestCase):
    def test_only_what_stands_between_the_markers_changes_however_often(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(draw, "ROOT", pathlib.Path(folder)):
            document = pathlib.Path(folder) / "document.md"
            document.write_text(TEXT)
            for _ in range(2):
                draw.put("document.md", "name", ["new", "lines"])
            self.assertEqual(document.read_text(), TEXT.replace("old", "new\nlines"))


class Tables(unittest.TestCase):
    def test_only_right_answers_are_compared_in_time(self):
        lines = tables.summary(ROWS)
        self.assertIn("on the 1 pairs", lines[0])
        self.assertIn("20.0 times as fast with 2 threads (geometric mean; least: 20.0, one), 10.0 times with one", lines[0])
        self.assertIn("no answer within the limits on 1 of all 3 pairs", lines[0])

    def test_a_right_answer_goes_before_a_faster_one_that_is_not(self):
        first, second, _ = tables.speed(ROWS)[2:]
        self.assertIn("| SLOW 1.0 |", first)
        self.assertIn("| FAST 5.0, misses |", second)
        self.assertIn("| timeout (more than 10 s) |", second)

    def test_who_is_right_and_faster_is_named(self):
        self.assertEqual(tables.faster(ROWS).count("pompeiu 2.0"), 1)
        self.assertIn("on 1 of 3 pairs: one (SLOW, 1.0 ms; pompeiu 2.0).", tables.faster(ROWS))

    def test_what_nobody_tried_is_a_dash(self):
        self.assertIn("| 5,000, wrong | – | – | – |", tables.speed(ROWS)[-1])

    def test_verdicts_are_counted_tool_by_tool(self):
        said = {line.split(" | ")[0]: line for line in tables.tools(ROWS)}
        self.assertIn("| 1 | 0 | 1 | 0 | 1 | – | 25 % |", said["| CASCADING_UPPER_BOUNDS"])
        self.assertIn("| 0 | 2 | 0 | 0 | 0 | 25 % |", said["| FAST"])


if __name__ == "__main__":
    unittest.main()
