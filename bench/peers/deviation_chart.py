"""docs/guide/pages/pictures/deviation-growth.svg: processor time and memory of `pompeiu deviation` against the number of faces."""

import math

import growth
import svg

COLOURS = {"noisy": svg.BLUE, "scan": svg.VERMILION}
SHAPES = {"noisy": "circle", "scan": "square"}
DASHES = ["", "8 4"]
WIDTH, HEIGHT, TOP, BOTTOM = 960, 400, 84, 52


def draw(rows, path):
    picture = svg.Picture(WIDTH, HEIGHT, "Processor time and memory of a deviation against the number of faces")
    series = list(dict.fromkeys((row["family"], row["accuracy"]) for row in rows))
    accuracies = list(dict.fromkeys(accuracy for _, accuracy in series))
    at = 24
    for family, accuracy in series:
        dashes = DASHES[accuracies.index(accuracy)]
        picture.line([(at - 10, 20), (at + 18, 20)], COLOURS[family], 2, dashes)
        picture.mark(at + 4, 20, SHAPES[family], COLOURS[family], r=4.5)
        picture.text(at + 26, 24.5, f"{family}, accuracy {float(accuracy) * 100:g} %")
        at += 200
    picture.line([(14, 44), (42, 44)], svg.GREY, 1, "1 4")
    picture.text(50, 48.5, "slope of n log n")
    panel(picture, rows, series, accuracies, (74, 400), "Processor time", lambda row: float(row["cpu_ms"]), svg.milliseconds, True)
    panel(picture, rows, series, accuracies, (560, 370), "Memory, bytes per face", growth.bytes_per_face, lambda v: f"{v:,.0f}", False)
    picture.write(path)


def panel(picture, rows, series, accuracies, place, title, value, label, with_slope):
    bottom = HEIGHT - BOTTOM
    x = svg.Log([growth.faces(row) for row in rows], *place)
    y = svg.Log([value(row) for row in rows], bottom, TOP - bottom)
    left, right = place[0], sum(place)
    picture.text(left - 40, TOP - 10, title, weight="bold")
    for power in x.ticks():
        picture.line([(x(power), TOP), (x(power), bottom)], svg.FAINT)
        picture.text(x(power), bottom + 18, svg.count(power), "middle", svg.GREY, 12)
    for power in y.ticks():
        picture.line([(left, y(power)), (right, y(power))], svg.FAINT)
        picture.text(left - 6, y(power) + 4, label(power), "end", svg.GREY, 12)
    picture.text((left + right) / 2, HEIGHT - 12, "faces of A and B together", "middle", svg.GREY, 12)
    for family, accuracy in series:
        sized = sorted((row for row in rows if (row["family"], row["accuracy"]) == (family, accuracy)), key=growth.faces)
        points = [(x(growth.faces(row)), y(value(row))) for row in sized]
        picture.line(points, COLOURS[family], 2, DASHES[accuracies.index(accuracy)])
        for u, v in points:
            picture.mark(u, v, SHAPES[family], COLOURS[family], r=4.5)
        if with_slope and (family, accuracy) == series[0] and len(sized) > 1:
            n, time = growth.faces(sized[0]), value(sized[0])
            ends = [n, growth.faces(sized[-1])]
            picture.line([(x(m), y(time * m * math.log(m) / (n * math.log(n)))) for m in ends], svg.GREY, 1, "1 4")
