"""Tables in Markdown, made from records."""

import math

import judge

JUDGED = ("right", "wrong", "misses", "wide")


def by_pair(rows):
    """Pair -> (tool, threads) -> row; rows of absent tools left out."""
    pairs = {}
    for row in rows:
        if row["pair"]:
            pairs.setdefault(row["pair"], {})[row["tool"], row["threads"]] = row
    return pairs


def ours(cells, threads=None):
    """The row of pompeiu with all threads, or as many as said."""
    return next(row for (tool, n), row in cells.items() if tool == "pompeiu" and n == (threads or row["cores"]))


def of(cells, tool):
    """The row of a peer, or None."""
    return next((row for (name, _), row in cells.items() if name == tool), None)


def fastest(cells, kind):
    """The fastest that answered, of a kind of tool: right ones before others."""
    rows = [row for row in cells.values() if row["kind"] == kind and row["status"] in JUDGED]
    return min(rows, key=lambda row: (row["status"] != "right", time(row)), default=None)


def milliseconds(row):
    """Time, and what is wrong with the answer."""
    if row is None:
        return "–"
    if row["status"] not in JUDGED:
        return f"{row['status']} ({row['detail']})" if row["status"] in ("timeout", "memory") else row["status"]
    taken = number(time(row))
    return taken if row["status"] == "right" else f"{taken}, {row['status']}"


def number(value):
    return f"{value:.1f}" if value < 100 else f"{value:,.0f}"


def bytes_per_face(row):
    faces = int(row["faces_a"]) + int(row["faces_b"])
    return float(row["memory_over_start_mib"]) * 2**20 / faces


def is_zero(row):
    """Whether the distance is zero, up to rounding: such pairs were asked for to a finer tolerance."""
    return float(row["certified_upper"]) < float(row["tolerance"])


def speed(rows):
    """A row for each pair: ours, and those whose answer claims a bound."""
    pairs = by_pair(rows)
    cores = rows[0]["cores"]
    lines = [
        f"| pair (faces A → B) | pompeiu, {cores} threads | 1 thread | bytes per face | cascading_upper_bounds "
        "| CGAL, bounded error | best of vertices | best of samples |",
        "|---|---:|---:|---:|---:|---:|---:|---:|",
    ]
    for pair, cells in pairs.items():
        row = ours(cells)
        lines.append(
            f"| {pair} ({int(row['faces_a']):,} → {int(row['faces_b']):,}) | {milliseconds(row)} "
            f"| {milliseconds(ours(cells, '1'))} | {bytes_per_face(row):.0f} "
            f"| {milliseconds(of(cells, 'cascading_upper_bounds'))} | {milliseconds(of(cells, 'cgal_bounded'))} "
            f"| {best(cells, 'vertices')} | {best(cells, 'samples')} |")
    return lines


def best(cells, kind):
    row = fastest(cells, kind)
    return "–" if row is None else f"{row['title']} {milliseconds(row)}"


def without_answer(pairs, tool):
    """How often a peer had none within the limits."""
    silent = sum(row["status"] not in JUDGED for cells in pairs.values() if (row := of(cells, tool)))
    return f"It has no answer within the limits on {silent} of all {len(pairs)} pairs, which do not count here."


def faster(rows):
    """Pairs on which somebody else was right and faster, in a sentence."""
    names = []
    for pair, cells in by_pair(rows).items():
        mine = ours(cells)
        best = min((row for row in cells.values() if row["status"] == "right"), key=time, default=mine)
        if best["tool"] != "pompeiu":
            names.append(f"{pair} ({best['title']}, {number(time(best))} ms; pompeiu {number(time(mine))})")
    return (f"Right, and faster than pompeiu with all threads, on {len(names)} of {len(by_pair(rows))} pairs: {'; '.join(names)}."
            if names else "On no pair was anybody right and faster than pompeiu with all threads.")


def time(row):
    return float(row["wall_ms_median"])


def ratios(pairs, tool, threads=None):
    """Pair -> how many times as long a peer takes as we do, where both are right and the distance is not zero."""
    found = {}
    for pair, cells in pairs.items():
        mine, peer = ours(cells, threads), of(cells, tool)
        if peer and peer["status"] == mine["status"] == "right" and not is_zero(mine):
            found[pair] = time(peer) / time(mine)
    return found


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def summary(rows):
    """What the table comes to, in sentences."""
    pairs = by_pair(rows)
    cores = rows[0]["cores"]
    lines = []
    for tool in ("cascading_upper_bounds", "cgal_bounded"):
        all_threads, single = ratios(pairs, tool), ratios(pairs, tool, "1")
        if all_threads:
            least, least_single = (min(r, key=r.get) for r in (all_threads, single))
            title = of(next(iter(pairs.values())), tool)["title"]
            lines.append(
                f"* Beside {title}, on the {len(all_threads)} pairs of a distance that is not zero and where both are "
                f"right: {geometric_mean(all_threads.values()):.1f} times as fast with {cores} threads (geometric mean; least: "
                f"{all_threads[least]:.1f}, {least}), {geometric_mean(single.values()):.1f} times with one (least: "
                f"{single[least_single]:.1f}, {least_single}). {without_answer(pairs, tool)}")
    zero = {pair: ours(cells) for pair, cells in pairs.items() if is_zero(ours(cells))}
    if zero:
        slowest = max(zero, key=lambda pair: time(zero[pair]))
        lines.append(
            f"* The {len(zero)} pairs of distance zero, at 1e-12: at most {milliseconds(zero[slowest])} ms ({slowest}).")
    memory = {pair: bytes_per_face(ours(cells)) for pair, cells in pairs.items()}
    most = max(memory, key=memory.get)
    lines.append(f"* Memory of the whole process beyond its start: at most {memory[most]:.0f} bytes per face of A and B "
                 f"together ({most}).")
    return lines


def tools(rows):
    """A row for each tool: what it claims, and how its answers were judged."""
    pairs = by_pair(rows)
    lines = [
        "| tool | version | answers with | right | misses | wrong | wide | no answer | most missed | most wrong "
        "| time beside pompeiu |",
        "|---|---|---|---:|---:|---:|---:|---:|---:|---:|---:|",
    ]
    seen = dict.fromkeys((row["tool"], row["title"], row["kind"], row["precision"]) for row in rows if row["pair"])
    for tool, title, kind, precision in seen:
        theirs = {pair: (ours(cells) if tool == "pompeiu" else of(cells, tool)) for pair, cells in pairs.items()}
        theirs = {pair: row for pair, row in theirs.items() if row}
        counts = {status: sum(row["status"] == status for row in theirs.values()) for status in JUDGED}
        missed = [share_missed(row) for row in theirs.values() if row["status"] == "misses"]
        off = [share_off(row) for row in theirs.values() if row["status"] == "wrong" and not is_zero(row)]
        beside = [time(row) / time(ours(pairs[pair]))
                  for pair, row in theirs.items() if row["status"] in JUDGED]
        version = next((row["version"] for row in theirs.values() if row["version"]), "")
        claims = kind + (", single precision" if precision == "single" else "")
        lines.append(
            f"| {title} | {version} | {claims} | {counts['right']} | {counts['misses']} | {counts['wrong']} | {counts['wide']} "
            f"| {len(theirs) - sum(counts.values())} | {share(missed)} | {share(off)} "
            f"| {f'{geometric_mean(beside):.2g} ×' if beside else '–'} |")
    return lines


def share_missed(row):
    lower = float(row["certified_lower"])
    return 100 * (lower - float(row["upper"])) / lower


def share_off(row):
    """How far an answer is from the distance, in percent of it; what is inverted or not a number is off by everything."""
    low, high = float(row["lower"]), float(row["upper"])
    if not low <= high < math.inf:
        return math.inf
    lower, upper = float(row["certified_lower"]), float(row["certified_upper"])
    return 100 * max(low - upper, lower - high) / upper


def share(percents):
    return judge.digits(max(percents)) + " %" if percents else "–"


def cases(rows):
    """A row for each case, a column for each tool."""
    titles = dict.fromkeys(row["title"] for row in rows)
    by_case = {}
    for row in rows:
        by_case.setdefault((row["case"], row["about"], row["truth"]), {})[row["title"]] = row
    lines = ["| case | distance | " + " | ".join(titles) + " |", "|---|---|" + "---|" * len(titles)]
    for (case, about, truth), cells in by_case.items():
        said = [judged(cells[title]) if title in cells else "–" for title in titles]
        distance = f"{float(truth):.6g}" if truth else "none"
        lines.append(f"| `{case}`: {about} | {distance} | " + " | ".join(said) + " |")
    return lines


def judged(row):
    """A verdict in a few words."""
    if row["status"] == "right":
        return "refused" if row["upper"] == "" else "right"
    if row["status"] == "misses":
        truth, found = float(row["truth"]), float(row["upper"])
        return f"−{judge.digits(100 * (truth - found) / truth)} %"
    if row["status"] == "wrong":
        low, high = float(row["lower"]), float(row["upper"])
        return f"**{low:.6g}**" if low == high or low != low and high != high else f"**{low:.6g} … {high:.6g}**"
    if row["status"] == "crashed":
        return "**crash**"
    return row["status"]
