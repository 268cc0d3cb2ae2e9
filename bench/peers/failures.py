"""Where each tool goes wrong, tool by tool, in Markdown; from the records of wrong.py and compare.py."""

import math

import judge
import tables

# Pairs that are named for each tool; the others are counted.
NAMED = 3


def by_tool(cases, pairs):
    """A paragraph for each tool but ours, and one for ours."""
    lines = []
    for title in dict.fromkeys(row["title"] for row in cases):
        said = of_cases([row for row in cases if row["title"] == title])
        said += of_pairs([row for row in pairs if row["title"] == title and row["pair"]])
        lines.append(f"* **{title}**: {'; '.join(said) if said else 'nothing found'}.")
    return lines


def of_cases(rows):
    """What is not right on the small inputs."""
    groups = {
        "wrong on": [f"`{row['case']}` ({found(row)} for {truth(row)})" for row in rows if row["status"] == "wrong"],
        "wider than asked on": [f"`{row['case']}`" for row in rows if row["status"] == "wide"],
        "misses": [f"`{row['case']}` by {missed(row)}" for row in rows if row["status"] == "misses"],
        "dies on": [f"`{row['case']}`" for row in rows if row["status"] == "crashed"],
        "has no answer in time on": [f"`{row['case']}`" for row in rows if row["status"] in ("timeout", "memory")],
        "refuses": [f"`{row['case']}`" for row in rows if row["status"] == "refused"],
    }
    return [f"{words} {', '.join(names)}" for words, names in groups.items() if names]


def of_pairs(rows):
    """What is not right on the pairs, the worst ones by name. Zero distances have no share."""
    rows = [row for row in rows if not tables.is_zero(row) and (row["tool"] != "pompeiu" or row["threads"] == row["cores"])]
    shares = [
        (tables.share_missed(row), f"{row['pair']} by {judge.digits(tables.share_missed(row))} %")
        for row in rows if row["status"] == "misses"]
    over = [
        (tables.share_off(row), f"{row['pair']} ({judge.digits(tables.share_off(row))} % off)")
        for row in rows if row["status"] == "wrong"]
    silent = [(0, row["pair"]) for row in rows if row["status"] not in tables.JUDGED]
    return [f"of the pairs, {words} {listed(found)}" for words, found in (
        ("it misses", shares), ("it is wrong on", over), ("it has no answer on", silent)) if found]


def listed(found):
    """The largest, by name, and how many more."""
    names = [name for _, name in sorted(found, reverse=True)]
    more = len(names) - NAMED
    return ", ".join(names[:NAMED]) + (f" and {more} more" if more > 0 else "")


def found(row):
    low, high = float(row["lower"]), float(row["upper"])
    same = low == high or math.isnan(low) and math.isnan(high)
    return f"{low:.6g}" if same else f"[{low:.6g}, {high:.6g}]"


def truth(row):
    return f"{float(row['truth']):.6g}" if row["truth"] else "no distance"


def missed(row):
    truth = float(row["truth"])
    return f"{judge.digits(100 * (truth - float(row['upper'])) / truth)} %"
