"""What a scaling record says about the questions that are asked of it: three yes or no, each with its figure."""

import math

# Sizes below this are left out of the fit: starting threads takes longer than the work.
LEAST_FACES = 10_000
# From this size on, build and search are held against the time to read.
LARGE_FACES = 300_000
# n log n shows as 1; the fit of a few points on a shared machine is not better than this.
FIT_ALLOWANCE = 0.05
MEMORY_GIB = 4


def of_all_threads(rows, family, direction="a-to-b"):
    """The rows of a family, measured with all threads, by size."""
    return sorted((row for row in rows if row["family"] == family and row["direction"] == direction
                   and row["threads"] == row["cores"]), key=faces)


def families(rows):
    return list(dict.fromkeys(row["family"] for row in rows))


def faces(row):
    """Of A and B together."""
    return int(row["faces_a"]) + int(row["faces_b"])


def build_and_search(row):
    return float(row["build_ms"]) + float(row["search_ms"])


def finished(row):
    """Whether the search was not stopped by the limit on time."""
    return row["stop"] != "time"


def bytes_per_face(row):
    return float(row["memory_over_start_mib"]) * 2**20 / faces(row)


def exponent(points):
    """p of the least-squares fit of time = c (n log n)^p to pairs (n, time)."""
    x = [math.log(n * math.log(n)) for n, _ in points]
    y = [math.log(time) for _, time in points]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x)


def verdicts(rows):
    """Sentences."""
    lines = []
    for family in families(rows):
        sized = [row for row in of_all_threads(rows, family) if int(row["faces_a"]) >= LEAST_FACES]
        if len(sized) < 2:
            continue
        large = [row for row in sized if int(row["faces_a"]) >= LARGE_FACES]
        if large:
            shares = [build_and_search(row) / float(row["read_ms"]) for row in large]
            below = sum(share < 1 and finished(row) for share, row in zip(shares, large))
            worst = shares.index(max(shares))
            lines.append(
                f"* {family}: build and search stay below the time to read both files as OBJ, from {LARGE_FACES:,} faces each: "
                f"{'**yes**' if below == len(large) else '**no**'}, at {below} of {len(large)} sizes; at most "
                f"{shares[worst]:.2f} times that time ({int(large[worst]['faces_a']):,} faces each).")
        p = exponent([(faces(row), build_and_search(row)) for row in sized])
        stopped = [row for row in sized if not finished(row)]
        lines.append(
            f"* {family}: time grows like (n log n) to the power {p:.2f}, so no faster than n log n: "
            f"{'**yes**' if p <= 1 + FIT_ALLOWANCE and not stopped else '**no**'} (fit over {len(sized)} sizes from "
            f"{int(sized[0]['faces_a']):,} to {int(sized[-1]['faces_a']):,} faces each; up to {1 + FIT_ALLOWANCE} counts"
            + "".join(f"; {int(row['faces_a']):,} faces were stopped by the limit on time" for row in stopped) + ").")
    largest = max(rows, key=lambda row: (faces(row), float(row["peak_mib"])))
    gib = float(largest["peak_mib"]) / 1024
    lines.append(
        f"* {int(largest['faces_a']):,} faces of A and as many of B take {gib:.2f} GiB ({bytes_per_face(largest):.0f} bytes per "
        f"face), so they fit in {MEMORY_GIB} GiB: {'**yes**' if gib <= MEMORY_GIB else '**no**'}.")
    return lines


def table(rows):
    """A row for each pair with all threads, with the time of one thread beside it."""
    lines = [
        "| pair | faces of each | read both | build | search | with 1 thread: build + search | whole process | both directions "
        "| bytes per face |",
        "|---|---:|---:|---:|---:|---:|---:|---:|---:|",
    ]
    for family in families(rows):
        for row in of_all_threads(rows, family):
            same = [r for r in rows if r["family"] == family and r["faces_a"] == row["faces_a"]]
            single = next((r for r in same if r["threads"] == "1" and r["direction"] == "a-to-b"), None)
            both = next((r for r in same if r["direction"] == "both"), None)
            cells = [
                family, f"{int(row['faces_a']):,}", ms(row["read_ms"]), ms(row["build_ms"]),
                ms(row["search_ms"]) if finished(row) else f"> {ms(row['search_ms'])}",
                ms(build_and_search(single)) if single else "–", ms(row["process_ms"]),
                ms(both["process_ms"]) if both else "–", f"{bytes_per_face(row):.0f}",
            ]
            lines.append(f"| {' | '.join(cells)} |")
    return lines


def ms(value):
    value = float(value)
    return f"{value:.1f}" if value < 100 else f"{value:,.0f}"
