#!/usr/bin/env python3
"""Draws docs/speed.svg and the table of the README from a record of compare.py: chart.py RECORD.csv"""

import csv
import math
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
OURS, PEER = "pompeiu", "cascading_upper_bounds"


def results(record):
    """The rows of a record: pair -> (program, threads) -> row."""
    pairs = {}
    with open(record, newline="") as file:
        for row in csv.DictReader(file):
            pairs.setdefault(row["pair"], {})[row["program"], row["threads"]] = row
    return pairs


def milliseconds(row):
    if row["status"] != "ok":
        return row["status"]
    value = float(row["wall_ms_median"])
    return f"{value:.1f}" if value < 100 else f"{value:,.0f}"


def chart(pairs, cores):
    left, width, line, top = 250, 620, 34, 46
    height = top + line * len(pairs) + 40
    times = [float(r["wall_ms_median"]) for rows in pairs.values() for r in rows.values() if r["wall_ms_median"]]
    low, high = math.floor(math.log10(min(times))), math.ceil(math.log10(max(times)))

    def x(ms):
        return left + (math.log10(ms) - low) / (high - low) * width

    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {left + width + 90} {height}" '
        'font-family="system-ui, sans-serif" font-size="13">',
        f'<rect width="{left + width + 90}" height="{height}" rx="10" fill="#fbfbfa"/>',
    ]
    for power in range(low, high + 1):
        at = x(10.0 ** power)
        label = f"{10 ** power:g} ms" if power < 3 else f"{10 ** (power - 3):g} s"
        out.append(f'<path d="M{at:.1f} {top - 12}V{height - 34}" stroke="#ddd"/>')
        out.append(f'<text x="{at:.1f}" y="{height - 16}" text-anchor="middle" fill="#555">{label}</text>')
    out.append(f'<circle cx="{left}" cy="20" r="6" fill="#0072b2"/><text x="{left + 12}" y="24">pompeiu, '
               f'{cores} threads</text>')
    out.append(f'<circle cx="{left + 190}" cy="20" r="6" fill="#d55e00"/>'
               f'<text x="{left + 202}" y="24">{PEER}</text>')
    for i, (pair, rows) in enumerate(pairs.items()):
        y = top + line * i + line / 2
        ours, peer = rows[OURS, cores], rows[PEER, ""]
        out.append(f'<text x="{left - 14}" y="{y + 4:.1f}" text-anchor="end">{pair}</text>')
        a = x(float(ours["wall_ms_median"]))
        if peer["status"] == "ok":
            b = x(float(peer["wall_ms_median"]))
            out.append(f'<path d="M{a:.1f} {y:.1f}H{b:.1f}" stroke="#bbb" stroke-width="3"/>')
            out.append(f'<circle cx="{b:.1f}" cy="{y:.1f}" r="6" fill="#d55e00"/>')
        else:
            b = left + width
            out.append(f'<path d="M{a:.1f} {y:.1f}H{b:.1f}" stroke="#bbb" stroke-width="3" stroke-dasharray="6 5"/>')
            out.append(f'<text x="{b + 6:.1f}" y="{y + 4:.1f}" fill="#b04a00">{peer["status"]}</text>')
        out.append(f'<circle cx="{a:.1f}" cy="{y:.1f}" r="6" fill="#0072b2"/>')
    out.append("</svg>")
    return "\n".join(out) + "\n"


def table(pairs, cores, record):
    first = next(iter(pairs.values()))[OURS, cores]
    lines = [
        "![Time for each pair on a logarithmic scale](docs/speed.svg)",
        "",
        f"Directed distance, milliseconds (medians) to build the tree and search, meshes in memory, {cores} cores; the same "
        "absolute tolerance for both, 1e-8 of the diagonal of A.",
        f"Record: `{record.resolve().relative_to(ROOT)}` ({first['date']}, {first['cpu']}), made by "
        "`python3 bench/peers/compare.py`.",
        "",
        f"| pair (faces A → B) | pompeiu, {cores} threads | 1 thread | bytes per face "
        f"| {PEER} {next(iter(pairs.values()))[PEER, '']['version']} |",
        "|---|---:|---:|---:|---:|",
    ]
    for pair, rows in pairs.items():
        ours, single, peer = rows[OURS, cores], rows[OURS, "1"], rows[PEER, ""]
        faces = int(ours["faces_a"]), int(ours["faces_b"])
        bytes_per_face = float(ours["memory_over_start_mib"]) * 2**20 / sum(faces)
        lines.append(f"| {pair} ({faces[0]:,} → {faces[1]:,}) | {milliseconds(ours)} | {milliseconds(single)} "
                     f"| {bytes_per_face:.0f} | {milliseconds(peer)} |")
    lines += [
        "",
        "Bytes per face of A and B together: peak memory of the whole process, files mapped, beyond what it takes before it has "
        "a mesh.",
        "A *timeout* took longer than the limit of the run. The cubes are the same surface meshed twice: their distance is zero.",
    ]
    return "\n".join(lines)


def main():
    record = pathlib.Path(sys.argv[1])
    pairs = results(record)
    cores = next(row["cores"] for rows in pairs.values() for row in rows.values())
    (ROOT / "docs").mkdir(exist_ok=True)
    (ROOT / "docs" / "speed.svg").write_text(chart(pairs, cores))
    readme = ROOT / "README.md"
    before, rest = readme.read_text().split("<!-- speed: made by bench/peers/chart.py -->\n")
    after = rest.split("<!-- /speed -->")[1]
    readme.write_text(f"{before}<!-- speed: made by bench/peers/chart.py -->\n{table(pairs, cores, record)}\n"
                      f"<!-- /speed -->{after}")


if __name__ == "__main__":
    main()
