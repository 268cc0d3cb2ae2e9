"""docs/speed.svg: how long every program takes on every pair, and whether its answer is right."""

import svg

# Tool, or kind of tool: colour, shape, size, words.
LOOKS = {
    "pompeiu": (svg.BLUE, "circle", 6.5, "pompeiu, {cores} threads"),
    "cascading_upper_bounds": (svg.VERMILION, "square", 5.5, "cascading_upper_bounds"),
    "cgal_bounded": (svg.GREEN, "diamond", 5.5, "CGAL, bounded error"),
    "vertices": (svg.PURPLE, "triangle", 4.5, "vertices only"),
    "samples": (svg.GREY, "circle", 3.6, "random samples"),
}
LEFT, WIDTH, LINE, TOP, BOTTOM, RIGHT = 190, 600, 26, 76, 40, 120


def look(row):
    return LOOKS.get(row["tool"]) or LOOKS[row["kind"]]


def shown(rows):
    """Rows that the chart shows: of pompeiu, the one with all threads."""
    return [row for row in rows if row["tool"] != "pompeiu" or row["threads"] == row["cores"]]


def draw(rows, path):
    rows = [row for row in rows if row["pair"]]
    by_pair = {}
    for row in shown(rows):
        by_pair.setdefault(row["pair"], []).append(row)
    times = [float(row["wall_ms_median"]) for row in rows if row["wall_ms_median"]]
    x = svg.Log(times, LEFT, WIDTH)
    height = TOP + LINE * len(by_pair) + BOTTOM
    picture = svg.Picture(LEFT + WIDTH + RIGHT, height, "Time of the distance from A to B for each pair, by program")
    legend(picture, rows[0]["cores"])
    for power in x.ticks():
        picture.line([(x(power), TOP - 8), (x(power), height - BOTTOM + 4)], svg.FAINT)
        picture.text(x(power), height - BOTTOM + 22, svg.milliseconds(power), "middle", svg.GREY, 12)
    outside = LEFT + WIDTH + 18
    picture.text(outside - 6, TOP - 12, "no answer", fill=svg.GREY, size=12)
    for place, (pair, of_pair) in enumerate(by_pair.items()):
        y = TOP + LINE * (place + 0.5)
        picture.line([(LEFT - 6, y), (LEFT + WIDTH, y)], svg.FAINT, 0.8)
        picture.text(LEFT - 14, y + 4.5, pair, "end")
        silent = 0
        # Ours last, on top.
        for row in sorted(of_pair, key=lambda row: -list(LOOKS.values()).index(look(row))):
            colour, shape, size, _ = look(row)
            if row["wall_ms_median"] and row["status"] in ("right", "wrong", "misses", "wide"):
                picture.mark(x(float(row["wall_ms_median"])), y, shape, colour, row["status"] == "right", size)
            else:
                picture.mark(outside + 16 * silent, y, shape, colour, False, size)
                silent += 1
    picture.write(path)


def legend(picture, cores):
    at = 24
    for colour, shape, size, words in LOOKS.values():
        words = words.format(cores=cores)
        picture.mark(at, 20, shape, colour, True, size)
        picture.text(at + 12, 24.5, words)
        at += 34 + 7.4 * len(words)
    picture.mark(24, 44, "square", svg.INK, True, 5.5)
    picture.text(36, 48.5, "right")
    picture.mark(98, 44, "square", svg.INK, False, 5.5)
    picture.text(110, 48.5, "not right: misses the maximum, or wrong; or no answer within the limit")
