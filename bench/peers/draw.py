#!/usr/bin/env python3
"""Draws the pictures in docs/ and the tables of README.md and COMPARE.md from the newest records, or from those named:
draw.py [RECORD.csv ...]"""

import pathlib
import sys

import environment
import failures
import growth
import record
import scaling_chart
import speed_chart
import tables

ROOT = environment.ROOT
MAKER = "made by bench/peers/draw.py"


def put(document, name, lines):
    """Replaces what stands between the markers of a name in a document."""
    path = ROOT / document
    before, rest = path.read_text().split(f"<!-- {name}: {MAKER} -->\n")
    after = rest.split(f"<!-- /{name} -->")[1]
    path.write_text("\n".join([f"{before}<!-- {name}: {MAKER} -->", *lines, f"<!-- /{name} -->{after}"]))


def source(path, rows):
    """Where figures come from."""
    first = rows[0]
    load = f", load {first['load_before']} before the start" if "load_before" in first else ""
    return (f"Record: `{path.relative_to(ROOT)}` ({first['date']}, commit {first['commit']}, {first['cpu']}, {first['cores']} "
            f"cores{load}).")


def draw_peers(path):
    rows = record.read(path)
    speed_chart.draw(rows, ROOT / "docs" / "speed.svg")
    answered = [row for row in rows if row["status"] != "absent"]
    absent = [f"{row['title']} ({row['detail']})" for row in rows if row["status"] == "absent"]
    put("README.md", "speed", [
        "![Time for each pair on a logarithmic scale, by program, with wrong answers crossed out](docs/speed.svg)",
        "",
        *tables.summary(answered),
        "",
        source(path, rows) + " [COMPARE.md](COMPARE.md) has the table, and where others are better.",
    ])
    put("COMPARE.md", "pairs", [
        *tables.speed(answered), "", source(path, rows),
        *([f"Not on this machine: {'; '.join(absent)}."] if absent else []),
    ])
    put("COMPARE.md", "faster", [tables.faster(answered), source(path, rows)])
    put("COMPARE.md", "tools", [*tables.tools(answered), "", source(path, rows)])


def draw_wrong(path):
    rows = record.read(path)
    peers = record.latest("peers")
    pairs = record.read(peers) if peers else []
    put("COMPARE.md", "failures", [
        *failures.by_tool(rows, pairs), "", source(path, rows), *([source(peers, pairs)] if peers else []),
    ])
    put("COMPARE.md", "wrong", [*tables.cases(rows), "", source(path, rows)])


def draw_scaling(path):
    rows = record.read(path)
    scaling_chart.draw(rows, ROOT / "docs" / "scaling.svg")
    put("bench/peers/SCALING.md", "scaling", [
        "![Time and memory against the number of faces, on logarithmic scales](../../docs/scaling.svg)",
        "",
        *growth.verdicts(rows),
        "",
        "Milliseconds, medians:",
        "",
        *growth.table(rows),
        "",
        source(path, rows),
    ])


DRAW = {"peers": draw_peers, "wrong": draw_wrong, "scaling": draw_scaling}


def main():
    named = [pathlib.Path(argument).resolve() for argument in sys.argv[1:]]
    for kind, draw in DRAW.items():
        path = next((path for path in named if path.stem.endswith(f"-{kind}")), None) or record.latest(kind)
        if path:
            draw(path)
            environment.say(f"drawn from {path.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
