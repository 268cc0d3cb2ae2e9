#!/usr/bin/env python3
"""Measures programs against each other on the same pairs of meshes and writes a CSV record. See README.md."""

import argparse
import json
import pathlib
import statistics
import subprocess
import tempfile

import environment
import judge
import lineup
import pairs
import record
from session import NoAnswer

# A distance below this share of the diagonal of A counts as zero, and is asked for to ZERO_TOLERANCE.
ZERO = 1e-10
ZERO_TOLERANCE = 1e-12
# Seconds after which the tree and the search of the reference answer stop, with a wider enclosure.
CERTIFYING = "120s"

FIELDS = [
    "pair", "about", "faces_a", "faces_b", "tolerance", "certified_lower", "certified_upper", "tool", "title", "kind",
    "precision", "version", "threads", "runs", "status", "detail", "off_by", "lower", "upper", "wall_ms_median", "wall_ms_min",
    "wall_ms_max", "cpu_ms_median", "peak_mib", "memory_over_start_mib",
]


def certified(pair):
    """The enclosure of the distance as narrow as pompeiu can have it: what answers are judged by."""
    done = subprocess.run(
        [environment.pompeiu(), "distance", *pair.files, "--direction", "a-to-b", "--json", "--quiet", "--time-limit",
         CERTIFYING], capture_output=True, text=True)
    answer = json.loads(done.stdout)["report"]["a_to_b"]
    return answer["lower"], answer["upper"]


def measure(pair, tolerance, entrants, options):
    """Asks everybody in turn, several times; entrant -> (answers, why there are no more)."""
    limits = lineup.Limits(options.timeout, int(options.memory * 2**30))
    sessions, answers, ends = {}, {}, {}
    try:
        for place, entrant in enumerate(entrants):
            answers[place], ends[place] = [], None
            sessions[place] = entrant.start(pair, tolerance, options.samples, limits)
        # Nobody is timed while others still load.
        for place, session in sessions.items():
            try:
                session.ready()
            except NoAnswer as end:
                ends[place] = end
        spent = dict.fromkeys(sessions, 0.0)
        for turn in range(options.runs):
            for place, session in sessions.items():
                # Whoever is slow is asked less often, but a slow answer also varies less.
                if ends[place] or (turn and spent[place] > options.timeout):
                    continue
                try:
                    answers[place].append(session.ask())
                    spent[place] += answers[place][-1]["wall_ms"] / 1e3
                except NoAnswer as end:
                    ends[place] = end
        versions = {place: session.version for place, session in sessions.items()}
    finally:
        for session in sessions.values():
            session.close()
    return [(answers[place], ends[place], versions[place]) for place in range(len(entrants))]


def row(pair, tolerance, enclosure, entrant, answers, end, version):
    """A line of the record."""
    cells = {
        "pair": pair.name, "about": pair.about, "faces_a": pair.faces[0], "faces_b": pair.faces[1], "tolerance": tolerance,
        "certified_lower": enclosure[0], "certified_upper": enclosure[1], "tool": entrant.name,
        "title": entrant.adapter.TITLE, "kind": entrant.adapter.KIND,
        "precision": getattr(entrant.adapter, "PRECISION", "double"), "version": version, "threads": entrant.threads,
        "runs": len(answers),
    }
    if end:
        cells |= {"status": end.status, "detail": str(end)}
    if answers:
        worst, status, detail = judge.worst(entrant.adapter.KIND, answers, enclosure, tolerance)
        if not end:
            cells |= {"status": status, "detail": detail}
        wall = [answer["wall_ms"] for answer in answers]
        cells |= {
            "off_by": judge.off_by(worst, enclosure), "lower": worst.get("lower", worst.get("value")),
            "upper": worst.get("upper", worst.get("value")), "wall_ms_median": round(statistics.median(wall), 3),
            "wall_ms_min": round(min(wall), 3), "wall_ms_max": round(max(wall), 3),
            "cpu_ms_median": round(statistics.median(answer["cpu_ms"] for answer in answers), 3),
            "peak_mib": round(max(answer["peak_mib"] for answer in answers), 1),
            "memory_over_start_mib": round(max(answer["memory_over_start_mib"] for answer in answers), 1),
        }
    return cells


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pairs", type=pathlib.Path, metavar="FOLDER",
                        help="measure the pairs of this folder, which holds NAME/a.obj and NAME/b.obj, in any format")
    parser.add_argument("--only", help="pairs whose name holds this")
    parser.add_argument("--tools", help="tools whose name holds one of these, separated by commas")
    parser.add_argument("--tolerance", type=float, default=1e-8,
                        help=f"fraction of the diagonal of A; where the distance is zero, {ZERO_TOLERANCE:g}")
    parser.add_argument("--samples", type=int, default=100_000, help="points that sampling tools take")
    parser.add_argument("--runs", type=int, default=5, help="answers of each tool, unless it is slow")
    parser.add_argument("--timeout", type=float, default=10, help="seconds for one answer, and for all but the first")
    parser.add_argument("--memory", type=float, default=6, help="GiB of address space for a tool")
    parser.add_argument("--record", type=pathlib.Path, help="the CSV file to write")
    return parser.parse_args()


def chosen(options):
    """The pairs to measure."""
    if options.pairs:
        found = list(pairs.found(options.pairs))
    else:
        made, shared = environment.ROOT / "target" / "pairs", environment.ROOT.parent / "shared" / "data"
        found = list(pairs.generated(made, pairs.GENERATED))
        if shared.is_dir():
            found += pairs.generated(made, pairs.FROM_MESHES, shared / "meshes")
            found += pairs.found(shared / "pairs")
    return [pair for pair in found if not options.only or options.only in pair.name]


def main():
    options = arguments()
    entrants = lineup.entrants()
    if options.tools:
        entrants = [e for e in entrants if any(word in e.name for word in options.tools.split(","))]
    present = [entrant for entrant in entrants if not entrant.absent]
    rows = []
    for found in chosen(options):
        with tempfile.TemporaryDirectory(prefix="pairs-") as folder:
            pair = pairs.prepare(found, pathlib.Path(folder))
            enclosure = certified(pair)
            is_zero = enclosure[1] <= ZERO * pair.diagonal
            tolerance = (ZERO_TOLERANCE if is_zero else options.tolerance) * pair.diagonal
            results = measure(pair, tolerance, present, options)
        for entrant, result in zip(present, results):
            rows.append(row(pair, tolerance, enclosure, entrant, *result))
            cells = rows[-1]
            environment.say(f"{pair.name:20} {entrant.name:22} {entrant.threads[:3]:3} {cells.get('wall_ms_median', ''):>10} ms "
                            f"{cells.get('memory_over_start_mib', ''):>7} MiB  {cells['status']:8} {cells['detail'][:60]}")
    rows += [{"tool": e.name, "title": e.adapter.TITLE, "kind": e.adapter.KIND, "status": "absent", "detail": e.absent}
             for e in entrants if e.absent]
    to = options.record or record.path("peers")
    record.write(to, FIELDS, rows)
    print(to)


if __name__ == "__main__":
    main()
