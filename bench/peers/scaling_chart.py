"""docs/scaling.svg: time and memory against the number of faces; crossed out is what a limit on time stopped."""

import math

import growth
import svg

COLOURS = [svg.BLUE, svg.VERMILION, svg.GREEN, svg.PURPLE]
SHAPES = ["circle", "square", "diamond", "triangle"]
WIDTH, HEIGHT, TOP, BOTTOM = 960, 440, 84, 52


def draw(rows, path):
    picture = svg.Picture(WIDTH, HEIGHT, "Time and memory against the number of faces")
    families = growth.families(rows)
    legend(picture, families, rows[0]["cores"])
    times(picture, rows, families, 74, 470)
    memory(picture, rows, families, 640, 290)
    picture.write(path)


def legend(picture, families, cores):
    at = 24
    for family, colour, shape in zip(families, COLOURS, SHAPES):
        picture.mark(at, 20, shape, colour)
        picture.text(at + 12, 24.5, f"{family}: build + search, {cores} threads")
        at += 320
    at = 24
    for words, colour, width, dashes in (
            ("1 thread", svg.INK, 1.6, "2 3"), ("reading both files as OBJ", svg.ORANGE, 3, ""),
            ("whole process", svg.INK, 1.2, "8 4"), ("slope of n log n", svg.GREY, 1, "1 4")):
        picture.line([(at - 6, 44), (at + 22, 44)], colour, width, dashes)
        picture.text(at + 30, 48.5, words)
        at += 56 + 7.4 * len(words)
    picture.mark(at, 44, "square", svg.INK, False, 4.5)
    picture.text(at + 12, 48.5, "stopped by a limit on time")


def axes(picture, x, y, title, label):
    left, right, bottom = x.start, x.start + x.length, HEIGHT - BOTTOM
    picture.text(left - 40, TOP - 10, title, weight="bold")
    for power in x.ticks():
        picture.line([(x(power), TOP), (x(power), bottom)], svg.FAINT)
        picture.text(x(power), bottom + 18, svg.count(power), "middle", svg.GREY, 12)
    for power in y.ticks():
        picture.line([(left, y(power)), (right, y(power))], svg.FAINT)
        picture.text(left - 6, y(power) + 4, label(power), "end", svg.GREY, 12)
    picture.text((left + right) / 2, HEIGHT - 12, "faces of A and B together", "middle", svg.GREY, 12)


def vertical(values):
    """A logarithmic axis that goes up."""
    return svg.Log(values, HEIGHT - BOTTOM, TOP - (HEIGHT - BOTTOM))


def times(picture, rows, families, left, width):
    directed = [row for row in rows if row["direction"] == "a-to-b"]
    x = svg.Log([growth.faces(row) for row in rows], left, width)
    y = vertical([t for row in directed for t in (growth.build_and_search(row), float(row["read_ms"]), float(row["process_ms"]))])
    axes(picture, x, y, "Time", svg.milliseconds)
    for place, family in enumerate(families):
        colour, shape = COLOURS[place], SHAPES[place]
        of_family = growth.of_all_threads(rows, family)
        at = [x(growth.faces(row)) for row in of_family]
        picture.line([(u, y(float(row["read_ms"]))) for u, row in zip(at, of_family)], svg.ORANGE, 3)
        picture.line([(u, y(float(row["process_ms"]))) for u, row in zip(at, of_family)], colour, 1.2, "8 4")
        single = sorted((r for r in directed if r["family"] == family and r["threads"] == "1"), key=growth.faces)
        picture.line([(x(growth.faces(row)), y(growth.build_and_search(row))) for row in single], colour, 1.6, "2 3")
        points = [(u, y(growth.build_and_search(row))) for u, row in zip(at, of_family)]
        picture.line(points, colour, 2)
        for (u, v), row in zip(points, of_family):
            picture.mark(u, v, shape, colour, growth.finished(row), 4.5)
    slope(picture, x, y, rows, families)


def slope(picture, x, y, rows, families):
    """n log n through the point in the middle of the first family."""
    sized = growth.of_all_threads(rows, families[0])
    if len(sized) < 3:
        return
    middle = sized[len(sized) // 2]
    n, time = growth.faces(middle), growth.build_and_search(middle)
    ends = [growth.faces(sized[0]), growth.faces(sized[-1])]
    picture.line([(x(m), y(time * m * math.log(m) / (n * math.log(n)))) for m in ends], svg.GREY, 1, "1 4")


def memory(picture, rows, families, left, width):
    x = svg.Log([growth.faces(row) for row in rows], left, width)
    y = vertical([growth.bytes_per_face(row) for row in rows if row["direction"] == "a-to-b"])
    axes(picture, x, y, "Memory, bytes per face", lambda value: f"{value:,.0f}")
    for place, family in enumerate(families):
        of_family = growth.of_all_threads(rows, family)
        points = [(x(growth.faces(row)), y(growth.bytes_per_face(row))) for row in of_family]
        picture.line(points, COLOURS[place], 2)
        for u, v in points:
            picture.mark(u, v, SHAPES[place], COLOURS[place], r=4.5)
