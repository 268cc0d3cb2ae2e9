"""What the charts share: colours, marks, logarithmic axes, text."""

import html
import math

# Okabe and Ito's colours, which people with any colour vision tell apart; shapes differ as well.
BLUE, VERMILION, GREEN, PURPLE, ORANGE, GREY = "#0072b2", "#d55e00", "#009e73", "#a0568a", "#e69f00", "#666666"
INK, FAINT, PAPER = "#222222", "#d8d8d6", "#fbfbfa"


class Picture:
    """An SVG picture under construction."""

    def __init__(self, width, height, title):
        self.parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
            f'font-family="system-ui, \'DejaVu Sans\', sans-serif" font-size="13" fill="{INK}">',
            f"<title>{html.escape(title)}</title>",
            f'<rect width="{width}" height="{height}" rx="10" fill="{PAPER}"/>',
        ]

    def text(self, x, y, words, anchor="start", fill=INK, size=13, weight="normal"):
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{fill}" font-size="{size}" '
                          f'font-weight="{weight}">{html.escape(words)}</text>')

    def line(self, points, stroke, width=1.0, dashes=""):
        path = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        dashed = f' stroke-dasharray="{dashes}"' if dashes else ""
        self.parts.append(f'<path d="{path}" fill="none" stroke="{stroke}" stroke-width="{width}"{dashed} '
                          'stroke-linejoin="round"/>')

    def mark(self, x, y, shape, colour, right=True, r=6.0):
        """A mark of a shape: filled when the answer is right, hollow and crossed out when it is not."""
        d = {
            "circle": f"M{x - r:.1f} {y:.1f}a{r} {r} 0 1 0 {2 * r} 0a{r} {r} 0 1 0 {-2 * r} 0Z",
            "square": f"M{x - r * .9:.1f} {y - r * .9:.1f}h{1.8 * r:.1f}v{1.8 * r:.1f}h{-1.8 * r:.1f}Z",
            "diamond": f"M{x:.1f} {y - 1.2 * r:.1f}l{1.2 * r:.1f} {1.2 * r:.1f}l{-1.2 * r:.1f} {1.2 * r:.1f}"
                       f"l{-1.2 * r:.1f} {-1.2 * r:.1f}Z",
            "triangle": f"M{x:.1f} {y - 1.1 * r:.1f}l{1.1 * r:.1f} {2 * r:.1f}h{-2.2 * r:.1f}Z",
        }[shape]
        if right:
            self.parts.append(f'<path d="{d}" fill="{colour}" stroke="{PAPER}" stroke-width="0.8"/>')
        else:
            c = 0.9 * r
            self.parts.append(f'<path d="{d}" fill="{PAPER}" fill-opacity="0.8" stroke="{colour}" stroke-width="1.1"/>')
            self.parts.append(f'<path d="M{x - c:.1f} {y - c:.1f}l{2 * c:.1f} {2 * c:.1f}m0 {-2 * c:.1f}l{-2 * c:.1f} '
                              f'{2 * c:.1f}" stroke="{colour}" stroke-width="1.4"/>')

    def write(self, path):
        path.write_text("\n".join([*self.parts, "</svg>"]) + "\n")


class Log:
    """A logarithmic axis onto a stretch of the picture, from one round number to another."""

    def __init__(self, values, start, length):
        tens = range(math.floor(math.log10(min(values))), math.ceil(math.log10(max(values))) + 1)
        rounds = [float(f"{step}e{power}") for power in tens for step in (1, 2, 5)]
        self.low = max(x for x in rounds if x <= min(values))
        self.high = min(x for x in rounds if x >= max(values))
        self.start, self.length = start, length

    def __call__(self, value):
        return self.start + math.log(value / self.low) / math.log(self.high / self.low) * self.length

    def ticks(self):
        """Powers of ten where there are some, else all round numbers."""
        tens = range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)) + 1)
        steps = (1,) if self.high > 150 * self.low else (1, 2, 5)
        rounds = [float(f"{step}e{power}") for power in tens for step in steps]
        return [x for x in rounds if self.low <= x <= self.high]


def milliseconds(value):
    """A time for an axis."""
    return f"{value:g} ms" if value < 1000 else f"{value / 1000:g} s"


def count(value):
    """A number of faces for an axis."""
    for size, unit in ((1e6, "M"), (1e3, "k")):
        if value >= size:
            return f"{value / size:g}{unit}"
    return f"{value:g}"
