"""The deviation page, used as people use it, against what it was made from."""

import math
import random
import re
import sys
import time
import unittest
from pathlib import Path

from pages import FOLDER, Browser, PageTest, count_of, data, is_contrast, keep_picture, make, pixels, settle, shown

HOSTILE = ["</script><img src=x onerror=alert(1)>\"'&.ply", "<!--<script>'\"&amp;\u2028.stl"]


def setUpModule():
    global browser, pages
    browser = Browser().__enter__()
    unittest.addModuleCleanup(browser.__exit__)
    pages = {
        "plain": make("plain.html", "deviation_page", "--faces", "4000"),
        "signed": make("signed.html", "deviation_page", "--faces", "4000", "--signed"),
        "bands": make("bands.html", "deviation_page", "--faces", "4000", "--signed", "--bands", "-0.1,0.2"),
        "dented": make("dented.html", "dented_page"),
        "hostile": make("hostile.html", "deviation_page", "--faces", "600", "--offset", "1e7", "--names", *HOSTILE),
    }


def subtract(p, q):
    return [p[k] - q[k] for k in range(3)]


def dot(p, q):
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


def cross(p, q):
    return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]


def hits(origin, direction, triangles):
    """All crossings of a ray with triangles, the nearest first: distance, triangle, weights of its corners."""
    found = []
    for i, (a, b, c) in enumerate(triangles):
        u, v = subtract(b, a), subtract(c, a)
        across = cross(direction, v)
        determinant = dot(u, across)
        if determinant == 0:
            continue
        s = subtract(origin, a)
        second = dot(s, across) / determinant
        turned = cross(s, u)
        third = dot(direction, turned) / determinant
        distance = dot(v, turned) / determinant
        weights = [1 - second - third, second, third]
        if min(weights) > -1e-6 and distance > 0:
            found.append((distance, i, weights))
    return sorted(found)


def area_below(triangle, values, level):
    """Area of the part of a triangle where a linear function is below a level, by clipping."""
    polygon = []
    for i in range(3):
        j = (i + 1) % 3
        if values[i] < level:
            polygon.append(triangle[i])
        if (values[i] < level) != (values[j] < level):
            t = (level - values[i]) / (values[j] - values[i])
            polygon.append([p + t * (q - p) for p, q in zip(triangle[i], triangle[j])])
    fan = [cross(subtract(q, polygon[0]), subtract(r, polygon[0])) for q, r in zip(polygon[1:], polygon[2:])]
    return sum(math.hypot(*normal) for normal in fan) / 2


class DeviationPage(PageTest):
    def open(self, name="plain", **options):
        path, self.truth = pages[name]
        return self.visit(browser, path, **options)

    # ---- what is drawn

    def test_both_surfaces_are_drawn(self):
        page = self.open()
        width, height, raw = pixels(page)
        background = raw[:3]
        covered = count_of(raw, lambda *color: bytes(color) != background) / (width * height)
        self.assertGreater(covered, 0.2)
        page.uncheck("[data-control=toggle-0]")
        alone = count_of(pixels(page)[2], lambda *color: bytes(color) != background) / (width * height)
        self.assertLess(alone, covered, "without the other surface there is less to see")
        self.assertGreater(alone, 0.1)

    def test_colours_are_those_of_the_map(self):
        page = self.open()
        page.uncheck("[data-control=toggle-0]")
        width, height, raw = pixels(page)
        table = page.evaluate("pompeiu.app.data.scales[0].colors.table")
        end = page.evaluate("pompeiu.app.scales[0].end")
        ratio = page.evaluate("pompeiu.app.view.renderer.getPixelRatio()")
        places = [[x, y] for x in range(20, int(width / ratio), 37) for y in range(20, int(height / ratio), 31)]
        picked = page.evaluate("places => places.map(([x, y]) => pompeiu.app.pick(x + 0.5, y + 0.5))", places)
        compared = 0
        for (x, y), hit in zip(places, picked):
            if not hit or min(hit["weights"]) < 0.1:
                continue
            entry = round(min(1, hit["value"] / end) * 255)
            at = 4 * (int((height / ratio - y - 0.5) * ratio) * width + int((x + 0.5) * ratio))
            seen, wanted = raw[at:at + 3], table[3 * entry:3 * entry + 3]
            # Light scales all channels alike.
            light = sum(seen) / max(1, sum(wanted))
            self.assertTrue(0.6 < light < 1.1, (x, y, tuple(seen), wanted))
            for channel in range(3):
                self.assertLess(abs(seen[channel] - light * wanted[channel]), 9, (x, y, tuple(seen), wanted, light))
            compared += 1
        self.assertGreater(compared, 60)

    def test_screenshots(self):
        for name, options in {
            "light": {}, "dark": {"scheme": "dark"}, "narrow": {"width": 400, "height": 860}, "wide": {"width": 1800, "height": 1000},
        }.items():
            with self.subTest(name):
                page = self.open("plain" if name != "wide" else "signed", **options)
                keep_picture(page, name, full_page=name == "narrow")
                overflow = page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")
                self.assertLessEqual(overflow, 0, "nothing is cut off at the side")

    # ---- values

    def test_values_under_the_cursor_are_those_given(self):
        for name in ["plain", "signed", "hostile"]:
            page = self.open(name)
            page.click("label:has([data-control=arrangement-both])")
            page.uncheck("[data-control=toggle-0]")
            settle(page)
            corners = [[[[(x - o) / s for x, o in zip(p, origin)] for p in t] for t in surface["corners"]]
                       for origin, s in [page.evaluate("[pompeiu.app.data.spaces[0].origin, pompeiu.app.data.spaces[0].scale]")]
                       for surface in self.truth["surfaces"]]
            boxes = page.evaluate("pompeiu.app.view.panes.map((_, i) => pompeiu.app.view.middle(i)).map(({ x, y }) => [x, y])")
            chance = random.Random(7)
            compared = 0
            for i, (x, y) in enumerate(boxes):
                for _ in range(40):
                    at = [x + chance.uniform(-200, 200), y + chance.uniform(-150, 150)]
                    hit = page.evaluate("([x, y]) => pompeiu.app.pick(x, y)", at)
                    origin, direction = page.evaluate(
                        "([x, y]) => { const { ray } = pompeiu.app.view.rayAt(x, y); return [ray.origin.toArray(), ray.direction.toArray()] }", at)
                    expected = hits(origin, direction, corners[i])
                    clear = not expected or (min(expected[0][2]) > 1e-3 and (len(expected) == 1 or expected[1][0] - expected[0][0] > 1e-4))
                    if not clear:
                        continue
                    self.assertEqual(hit is None, not expected, at)
                    if hit is None:
                        continue
                    surface = self.truth["surfaces"][i]
                    self.assertEqual(hit["scene"], i)
                    self.assertEqual(hit["face"], expected[0][1])
                    self.assertEqual(hit["values"], surface["values"][hit["face"]], "to the last bit")
                    self.assertEqual(hit["bounds"], surface["bounds"][hit["face"]], "to the last bit")
                    for weight, wanted in zip(hit["weights"], expected[0][2]):
                        self.assertAlmostEqual(weight, wanted, delta=1e-3)
                    (u, v, w), (a, b, c) = hit["weights"], hit["values"]
                    self.assertEqual(hit["value"], u * a + v * b + w * c)
                    compared += 1
            self.assertGreater(compared, 25, name)

    def test_hovering_shows_the_value(self):
        page = self.open()
        x, y = (lambda at: (at["x"], at["y"]))(self.screen(self.truth["surfaces"][0]["witness"][0]))
        box = page.locator("#view").bounding_box()
        page.mouse.move(box["x"] + x + 60, box["y"] + y + 10)
        page.wait_for_selector("#reading:not([hidden])")
        face = int(data(page, "#reading", "face"))
        bounds = [float(data(page, "#reading", end)) for end in ("lower", "upper")]
        self.assertEqual(bounds, self.truth["surfaces"][0]["bounds"][face])
        self.assertIn(f"face {face} of A", shown(page, "#reading"))
        page.mouse.move(2, 2)
        page.wait_for_selector("#reading", state="hidden")

    def test_numbers_shown_enclose_those_given(self):
        page = self.open()
        rows = page.eval_on_selector_all("[data-key=statistics] tbody tr", "rows => rows.map((row) => [row.cells[0].textContent, "
                                         "Number(row.cells[1].dataset.exact), Number(row.cells[2].dataset.exact)])")
        self.assertEqual(rows, [[name, *value] for name, value in self.truth["surfaces"][0]["statistics"]])
        chance = random.Random(3)
        cases = [(0.0, 0.0), (0.0, 1.0), (0.1, 0.1), (1 / 3, 2 / 3), (5e-324, 1e308), (-2.5, -1e-9), (9.9999999, 10.0000001)]
        for _ in range(3000):
            low = chance.uniform(0.1, 1) * 10.0 ** chance.randint(-300, 300) * chance.choice([1, 1, -1])
            cases.append((low, low + abs(low) * 10.0 ** chance.uniform(-17, 2)))
        ends = page.evaluate("(cases) => cases.map((ends) => [pompeiu.format.ends(ends), pompeiu.format.enclosure(ends)])", cases)
        digits = str.maketrans("\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079\u207b\u2212", "0123456789--")
        for (low, high), ((low_end, high_end), text) in zip(cases, ends):
            read = [float(part.replace("\u202f", "").replace("\u00b710", "e").translate(digits)) for part in text[1:-1].split(", ")]
            self.assertEqual(read, [float(low_end), float(high_end)], text)
            self.assertLessEqual(read[0], low, text)
            self.assertGreaterEqual(read[1], high, text)
            widest = max(abs(low), abs(high)) * 2e-3 + (high - low) * 0.2
            self.assertLessEqual(read[1] - read[0], (high - low) + widest, text)

    # ---- controls

    def test_views_are_switched(self):
        page = self.open()
        for mode, panes, label in [("excess", 1, "B, distance from A"), ("both", 2, None), ("missing", 1, "A, distance from B")]:
            page.click(f"label:has([data-control=arrangement-{mode}])")
            settle(page)
            labels = page.locator(".pane-label").all_text_contents()
            self.assertEqual(len(labels), panes)
            if label:
                self.assertEqual(labels, [label])
        page.click("label:has([data-control=scene-1])")
        settle(page)
        self.assertEqual(data(page, ".view", "arrangement"), "excess")
        self.assertTrue(page.is_checked("[data-control=arrangement-excess]"))

    def test_cameras_are_linked(self):
        page = self.open()
        page.click("label:has([data-control=arrangement-both])")
        point = self.truth["surfaces"][0]["witness"][0]
        box = page.locator("#view").bounding_box()
        width = page.evaluate("pompeiu.app.view.canvas.clientWidth")
        for _ in range(2):
            settle(page)
            left, right = self.screen(point, 0), self.screen(point, 1)
            self.assertAlmostEqual(right["x"] - left["x"], width / 2, places=6)
            self.assertAlmostEqual(right["y"], left["y"], places=6)
            page.mouse.move(box["x"] + 100, box["y"] + 200)
            page.mouse.down()
            page.mouse.move(box["x"] + 190, box["y"] + 240, steps=3)
            page.mouse.up()

    def test_the_camera_flies_to_the_farthest_pair(self):
        for motion in ["reduce", "no-preference"]:
            page = self.open(motion=motion)
            before = self.camera()
            page.click("[data-control=look-at-pair]")
            after = self.camera()
            self.assertNotEqual(before, after)
            a, b = self.truth["surfaces"][0]["witness"]
            placed = page.evaluate("(p) => p.map((x, k) => (x - pompeiu.app.data.spaces[0].origin[k]) / pompeiu.app.data.spaces[0].scale)",
                                   [(x + y) / 2 for x, y in zip(a, b)])
            self.assertLess(math.dist(after["target"], placed), 1e-9)
            ends = [self.screen(p) for p in (a, b)]
            box = page.locator("#view").bounding_box()
            for end in ends:
                self.assertTrue(0 < end["x"] < box["width"] and 0 < end["y"] < box["height"], end)
            self.assertGreater(math.dist(*[(end["x"], end["y"]) for end in ends]), 150, "seen from the side")
            page.click("[data-control=show-all]")
            back = self.camera()
            self.assertLess(math.dist(back["target"], before["target"]), 1e-9)

    def assert_outside(self, at):
        """The camera is outside of the part, and nothing is between it and the dent."""
        camera = self.camera()
        space = self.page.evaluate("pompeiu.app.data.spaces[0]")
        eye = [x * space["scale"] + origin for x, origin in zip(camera["position"], space["origin"])]
        self.assertGreater(math.hypot(*eye), self.truth["wall"][1], "the camera is outside of the ball")
        way = subtract(at, eye)
        # One can see through the other surface.
        painted = self.truth["triangles"][self.page.evaluate("pompeiu.app.scene")]
        before = [distance for distance, _, _ in hits(eye, way, painted) if distance < 1 - 0.01 / math.hypot(*way)]
        self.assertEqual(before, [], "nothing is in the way")

    def test_the_first_view_and_places_are_seen_from_outside(self):
        page = self.open("dented")
        pair = page.evaluate("pompeiu.app.scenes[pompeiu.app.scene].pair")
        self.assertLess(math.dist(pair["from"], self.truth["dent"]), 0.1)
        # The first view: all of it, with the dent in front.
        self.assert_outside(pair["from"])
        self.assertLess(math.dist(self.camera()["target"], [0, 0, 0]), 0.1)
        keep_picture(page, "deviation-dented")
        # A place that is chosen from behind the part, and the way to the pair.
        for control in ["[data-place='0']", "[data-control=look-at-pair]"]:
            page.evaluate("""() => {
                const [camera] = pompeiu.app.cameras;
                camera.flyFrom(camera.direction.negate().toArray());
            }""")
            page.click(control)
            self.assert_outside(pair["from"])
            self.assertGreater(page.locator(".flag:visible").count(), 0, "labels stay")
            screen = self.screen(pair["from"])
            box = page.locator("#view").bounding_box()
            self.assertTrue(0 < screen["x"] < box["width"] and 0 < screen["y"] < box["height"], screen)
            keep_picture(page, f"deviation-dented-{'place' if 'place' in control else 'pair'}")
        # The hollow of a ball is seen from nowhere outside: the camera stays there all the same.
        page.evaluate("""() => {
            const { app } = pompeiu;
            const { pair } = app.scenes[app.scene].places[0];
            const scale = 0.9 / Math.hypot(...pair.from);
            app.scenes[app.scene].places[0] = { ...app.scenes[app.scene].places[0], center: pair.from.map((x) => x * scale), pair: { from: pair.from.map((x) => x * scale), to: pair.to }, faces: new Uint32Array() };
            app.showAll();
            app.choosePlace({ scene: app.scene, place: 0 }, "the hollow");
        }""")
        camera = self.camera()
        self.assertGreater(math.hypot(*camera["position"]) * page.evaluate("pompeiu.app.data.spaces[0].scale"), self.truth["wall"][1])

    def test_stages_shrink(self):
        page = self.open()
        stages = self.truth["surfaces"][0]["stages"]
        painted = []
        for i, stage in enumerate(stages):
            page.fill("[data-control=step]", str(i + 1))
            settle(page)
            told = re.search(r": ([\d\u202f]+) parts? of A left", shown(page, "[data-key=step-text]")).group(1)
            self.assertEqual(int(told.replace("\u202f", "")), stage["count"])
            drawn = page.evaluate("""() => {
                const pieces = pompeiu.app.data.scenes[0].layers.findIndex(({ frames }) => frames[0].kind === "pieces");
                const { shown } = pompeiu.app.scenes[0].layers[pieces];
                return pompeiu.app.scenes[0].scene.children.filter((child) => child === shown.object).map(({ geometry }) => geometry.index.count / 3);
            }""")
            self.assertEqual(drawn, [stage["count"]])
            painted.append(count_of(pixels(page)[2], is_contrast))
        self.assertTrue(all(later <= earlier for earlier, later in zip(painted, painted[1:])), painted)
        self.assertGreater(painted[0], 1000)
        self.assertLess(painted[-1], painted[0] / 20)
        page.fill("[data-control=step]", "0")
        self.assertEqual(count_of(pixels(page)[2], is_contrast), 0)

    def test_stages_play(self):
        page = self.open()
        page.click("[data-control=play]")
        last = str(len(self.truth["surfaces"][0]["stages"]))
        page.wait_for_function("(last) => document.querySelector('[data-control=step]').value === last", arg=last)

    def test_regions_are_flown_to_and_highlighted(self):
        page = self.open()
        self.assertEqual(page.locator("[data-place]").count(), len(self.truth["surfaces"][0]["regions"]))
        for i in [2, 0]:
            region = self.truth["surfaces"][0]["regions"][i]
            page.click(f"[data-place='{i}']")
            camera = self.camera()
            self.assertEqual(page.locator("[aria-pressed=true]").count(), 1)
            self.assertEqual(page.get_attribute(f"[data-place='{i}']", "aria-pressed"), "true")
            placed = page.evaluate("(p) => p.map((x, k) => (x - pompeiu.app.data.spaces[0].origin[k]) / pompeiu.app.data.spaces[0].scale)", region["center"])
            self.assertLess(math.dist(camera["target"], placed), 1e-9)
            self.assertEqual(page.evaluate("pompeiu.app.scenes[0].layers[0].shown.part.geometry.index.count / 3"), len(region["faces"]))
        page.click("[data-control=show-all]")
        self.assertEqual(page.locator("[aria-pressed=true]").count(), 0)

    def test_the_threshold_paints_and_counts(self):
        page = self.open()
        surface = self.truth["surfaces"][0]
        self.assertEqual(count_of(pixels(page)[2], is_contrast), 0)
        top = surface["distance"][1]
        painted = []
        for at in [0.0, 0.1, surface["exceedance"]["at"][77], 0.3, 2 * top]:
            page.fill("[data-control=threshold-value]", repr(at))
            page.press("[data-control=threshold-value]", "Enter")
            settle(page)
            self.assertTrue(page.is_checked("[data-control=paint-threshold]"))
            counts = [int(data(page, "[data-key=faces-above]", name)) for name in ("above", "open", "within")]
            above = sum(low > at for low, _ in surface["bounds"])
            within = sum(high <= at for _, high in surface["bounds"])
            self.assertEqual(counts, [above, surface["faces"] - above - within, within])
            places, fractions = surface["exceedance"]["at"], surface["exceedance"]["fractions"]
            before = [fraction[1] for place, fraction in zip(places, fractions) if place <= at]
            after = [fraction[0] for place, fraction in zip(places, fractions) if place >= at]
            enclosure = [float(data(page, "[data-key=area-above]", end)) for end in ("lower", "upper")]
            self.assertEqual(enclosure, [after[0] if after else 0, before[-1] if before else 1])
            painted.append(count_of(pixels(page)[2], is_contrast))
        self.assertTrue(all(later < earlier for earlier, later in zip(painted, painted[1:])), painted)
        self.assertEqual(painted[-1], 0)
        page.fill("[data-control=threshold]", "500")
        largest = max(max(surface["distance"][1], *(abs(value) for values in surface["values"] for value in values)) for surface in self.truth["surfaces"])
        self.assertLess(abs(float(data(page, "[data-control=threshold-value]", "exact")) * 2 / largest - 1), 1e-12)
        page.uncheck("[data-control=paint-threshold]")
        self.assertEqual(count_of(pixels(page)[2], is_contrast), 0)

    def test_the_first_scale_ends_below_the_largest_value(self):
        page = self.open()
        self.assertLess(page.evaluate("pompeiu.app.scales[0].end"), page.evaluate("pompeiu.app.scales[0].largest"))
        self.assertIn("and more", shown(page, ".legend-title"))

    def test_scales_change_colours_and_legend(self):
        page = self.open()
        # A few far points do not leave all others in one colour.
        self.assertEqual(page.input_value("[data-control=range]"), "2")
        seen, legends = set(), set()
        for kind, end in [*(("linear", end) for end in "0123"), ("root", "0"), ("logarithmic", "0")]:
            page.select_option("[data-control=scale]", kind)
            page.select_option("[data-control=range]", end)
            seen.add(pixels(page)[2])
            legends.add(shown(page, ".legend .ticks"))
        self.assertEqual(len(seen), 6)
        self.assertGreaterEqual(len(legends), 4)

    def test_signed_values_diverge(self):
        page = self.open("signed")
        self.assertEqual(page.evaluate("pompeiu.app.data.scales[0].colors.name"), "vik")
        self.assertIn("\u2212", shown(page, ".legend .ticks"))
        values = [value for corner in self.truth["surfaces"][0]["values"] for value in corner]
        self.assertTrue(min(values) < 0 < max(values))
        self.assertIn("signed", shown(page, ".pane-label"))

    def test_classes_and_steps_are_colours_of_their_own(self):
        page = self.open("signed")
        end = page.evaluate("pompeiu.app.scales[0].whole")
        page.select_option("[data-control=scale]", "steps")
        seen = page.evaluate("""(end) => new Set(Array.from({ length: 1001 }, (_, i) =>
            pompeiu.app.scales[0].colorOf(end * (i / 500 - 1)))).size""", end)
        # Ten on each side, and zero.
        self.assertTrue(10 <= seen <= 21, seen)
        page.evaluate("(end) => { const scale = pompeiu.app.scales[0]; scale.edges = [-end / 4, end / 4]; scale.kind = 'bands'; pompeiu.app.update(); }", end)
        colours = page.evaluate("(end) => [-end, -end / 4, 0, end / 4, end].map((x) => pompeiu.app.scales[0].colorOf(x))", end)
        self.assertEqual(len(set(colours)), 3)
        self.assertEqual(colours[1], colours[2])
        self.assertEqual(page.locator(".classes .swatch").count(), 3)

    def test_the_end_of_the_legend_is_dragged(self):
        page = self.open()
        before = page.evaluate("pompeiu.app.scales[0].end")
        handle = page.locator("[data-control=scale-end]").bounding_box()
        bar = page.locator(".legend .bar").bounding_box()
        page.mouse.move(handle["x"] + 7, handle["y"] + 8)
        page.mouse.down()
        page.mouse.move(handle["x"] + 7 - bar["width"] / 2, handle["y"] + 8, steps=4)
        page.mouse.up()
        after = page.evaluate("pompeiu.app.scales[0].end")
        self.assertTrue(0.1 * before < after < 0.7 * before, (before, after))
        page.select_option("[data-control=range]", "1")
        self.assertEqual(page.evaluate("pompeiu.app.scales[0].custom"), None)
        heights = page.evaluate("Array.from(document.querySelectorAll('.spread rect'), (bar) => Number(bar.getAttribute('height')))")
        self.assertGreater(max(heights), 25, "how values are spread stands over the bar")

    def test_ends_of_tolerance_bands_are_dragged(self):
        page = self.open("bands")
        surface = self.truth["surfaces"][0]

        def rows():
            return page.eval_on_selector_all("[data-key=bands] tbody tr", """rows => rows.map((row) =>
                [row.cells[0].textContent, ...[...row.cells].slice(1).map((cell) => Number(cell.dataset.exact))])""")

        def edges():
            return page.evaluate("pompeiu.app.scales[0].edges")

        proven, painted = rows(), pixels(page)[2]
        self.assertEqual([name for name, *_ in proven], ["too low, below \u22120.1", "\u22120.1 to 0.2", "too high, above 0.2"])
        for (_, low, high), (lower, upper) in zip(proven, surface["bands"]):
            self.assertTrue(low <= 100 * lower <= 100 * upper <= high and high - low <= 100 * (upper - lower) * (1 + 1e-12) + 1e-12)

        handle = page.locator("[data-control=band-end-1]").bounding_box()
        x, y = handle["x"] + handle["width"] / 2, handle["y"] + handle["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 30, y, steps=3)
        page.mouse.up()
        low, high = edges()
        self.assertEqual(low, -0.1)
        self.assertTrue(0.22 < high < 0.6, high)
        self.assertNotEqual(pixels(page)[2], painted)
        self.assertIn("not proven", shown(page, "[data-key=bands-moved]"))
        area = sum(area_below(t, [0, 0, 0], 1) for t in surface["corners"])
        below = [sum(area_below(t, v, level) for t, v in zip(surface["corners"], surface["values"])) / area for level in (low, high)]
        for (_, estimate), share in zip(rows(), [below[0], below[1] - below[0], 1 - below[1]]):
            self.assertAlmostEqual(estimate, 100 * share, delta=1e-3)
        # No farther than the other end.
        page.mouse.move(x + 30, y)
        page.mouse.down()
        page.mouse.move(x - 900, y, steps=3)
        page.mouse.up()
        self.assertTrue(-0.1 < edges()[1] < -0.09, edges())
        page.keyboard.press("Escape")
        self.assertEqual(edges(), [-0.1, 0.2])
        self.assertEqual(rows(), proven)
        self.assertEqual(pixels(page)[2], painted)
        page.focus("[data-control=band-end-0]")
        page.keyboard.press("ArrowLeft")
        self.assertLess(edges()[0], -0.1)
        page.select_option("[data-control=range]", "0")
        self.assertEqual(edges(), [-0.1, 0.2])

    def test_points_are_pinned_measured_and_taken_back(self):
        page = self.open()
        page.evaluate("pompeiu.app.cameras[0].home()")
        settle(page)
        canvas = page.locator("#view").bounding_box()
        hits = []
        for x, y in [(0.5, 0.5), (0.45, 0.4)]:
            at = [canvas["width"] * x, canvas["height"] * y]
            hits.append(page.evaluate("([x, y]) => { const hit = pompeiu.app.pick(x, y); return { ...hit, mesh: null, scale: null }; }", at))
            page.mouse.click(canvas["x"] + at[0], canvas["y"] + at[1])
        pins = page.evaluate("pompeiu.app.pins.all.map(({ value, face, position, nearest }) => ({ value, face, position, nearest }))")
        self.assertEqual([pin["face"] for pin in pins], [hit["face"] for hit in hits])
        for pin in pins:
            # The nearest point that is drawn of the other surface is as far away as the value says, but for how both are drawn.
            self.assertLess(abs(math.dist(pin["position"], pin["nearest"]) - pin["value"]), 0.05)
        measured = float(data(page, "[data-key=measured] output", "exact"))
        self.assertAlmostEqual(measured, math.dist(pins[0]["position"], pins[1]["position"]), places=9)
        with page.expect_download() as download:
            page.click("[data-control=pins-csv]")
        rows = Path(download.value.path()).read_text().splitlines()
        self.assertEqual(len(rows), 3)
        self.assertEqual(float(rows[1].split(",")[3]), pins[0]["value"])
        page.keyboard.press("Escape")
        self.assertEqual(page.evaluate("pompeiu.app.pins.all.length"), 1)
        page.keyboard.press("Escape")
        self.assertEqual(page.locator("[data-key=pins]").count(), 0)

    def test_places_are_numbered_on_the_surface(self):
        page = self.open()
        regions = self.truth["surfaces"][0]["regions"]
        self.assertEqual(page.locator(".flag").count(), len(regions))
        page.locator(".flag").first.dispatch_event("click")
        settle(page)
        self.assertNotEqual(page.evaluate("pompeiu.app.place"), None)
        page.keyboard.press("Escape")
        self.assertEqual(page.evaluate("pompeiu.app.place"), None)
        page.uncheck("[data-control=flags]")
        self.assertEqual(page.locator(".flag").count(), 0)
        with page.expect_download() as download:
            page.click("[data-control=regions-csv]")
        rows = Path(download.value.path()).read_text().splitlines()
        point = page.evaluate("pompeiu.app.data.scenes[0].places[0].pair.from")
        self.assertEqual([float(x) for x in rows[1].split(",")[3:6]], point)

    def test_a_section_cuts_surfaces_and_shows_their_curves(self):
        page = self.open()
        whole = count_of(pixels(page)[2], lambda *color: True)
        before = pixels(page)[2]
        page.check("[data-control=section]")
        settle(page)
        cut = pixels(page)[2]
        self.assertNotEqual(before, cut)
        self.assertEqual(count_of(cut, lambda *color: True), whole)
        curves = page.evaluate("""() => {
            const { section, meshes } = pompeiu.app;
            const [group] = section.curves.values();
            const at = section.low[section.axis] + section.part * (section.high[section.axis] - section.low[section.axis]);
            return group.userData.lines.map(({ object }) => {
                const points = Array.from(object.geometry.getAttribute("start").array);
                return { count: points.length / 3, off: Math.max(...points.map((x, i) => i % 3 === section.axis ? Math.abs(x - at) : 0)) };
            });
        }""")
        self.assertEqual(len(curves), 2)
        for curve in curves:
            self.assertGreater(curve["count"], 8)
            self.assertLess(curve["off"], 1e-6)
        page.fill("[data-control=section-at]", "900")
        self.assertNotEqual(pixels(page)[2], cut)
        page.uncheck("[data-control=section]")
        self.assertEqual(pixels(page)[2], before)

    def test_usual_views(self):
        page = self.open()
        seen = set()
        for name in ["front", "back", "left", "right", "top", "bottom"]:
            page.select_option("[data-control=direction]", name)
            settle(page)
            seen.add(tuple(round(x, 2) for x in page.evaluate("pompeiu.app.cameras[0].direction.toArray()")))
        self.assertEqual(len(seen), 6)

    def test_the_upward_axis_and_the_picture(self):
        page = self.open()
        cameras = []
        for axis in "xyz":
            page.select_option("[data-control=upward]", axis)
            settle(page)
            cameras.append(tuple(self.camera()["position"]))
            top = max((self.screen(p) for t in self.truth["surfaces"][0]["corners"][::50] for p in t), key=lambda at: -at["y"])
            self.assertLess(top["y"], page.locator("#view").bounding_box()["height"] / 2)
        self.assertEqual(len(set(cameras)), 3)
        with page.expect_download() as download:
            page.click("[data-control=save]")
        saved = FOLDER / "saved.png"
        download.value.save_as(saved)
        self.assertEqual(saved.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertGreater(saved.stat().st_size, 10_000)

    # ---- access

    def test_everything_works_by_keyboard(self):
        page = self.open()
        reached = []
        for _ in range(60):
            page.keyboard.press("Tab")
            name = page.evaluate("document.activeElement.dataset.control || document.activeElement.dataset.place || document.activeElement.id")
            if name in reached:
                break
            reached.append(name)
        for control in ["theme", "arrangement-missing", "scale", "range", "toggle-0", "toggle-1", "upward", "save", "view", "look-at-pair",
                        "show-all", "threshold", "threshold-value", "paint-threshold", "0", "step", "play"]:
            self.assertIn(control, reached)
        for axis in "xyz":
            page.select_option("[data-control=upward]", axis)
            page.focus("#view")
            for key in ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"]:
                before = self.camera()
                page.keyboard.press(key)
                after = self.camera()
                turned = math.dist(before["position"], after["position"]) / math.dist(before["position"], before["target"])
                self.assertTrue(0.01 < turned < 0.1, (axis, key, turned))
                self.assertEqual(before["target"], after["target"])
            closer = self.camera()
            page.keyboard.press("+")
            self.assertLess(math.dist(*self.camera().values()), math.dist(*closer.values()))
            page.keyboard.press("-")
            self.assertAlmostEqual(math.dist(*self.camera().values()), math.dist(*closer.values()))
            page.keyboard.press("Shift+ArrowRight")
            self.assertNotEqual(self.camera()["target"], closer["target"])
            page.keyboard.press("Home")
            self.assertLess(math.dist(self.camera()["target"], page.evaluate("pompeiu.app.cameras[0].sphere.center.toArray()")), 1e-9)
        page.focus("[data-control=look-at-pair]")
        page.keyboard.press("Enter")
        page.focus("#view")
        page.keyboard.press("Enter")
        self.assertRegex(shown(page, "#spoken"), r"About .* mm here; face \d+ of A|No surface in the middle")
        outline = page.evaluate("getComputedStyle(document.activeElement).outlineStyle")
        self.assertEqual(outline, "solid", "focus is visible")

    def test_every_control_has_a_name(self):
        page = self.open()
        nameless = page.evaluate("""() => [...document.querySelectorAll("button, input, select, [tabindex='0'], svg[role=img], table")]
            .filter((e) => !(e.getAttribute("aria-label") || e.textContent.trim() || e.labels?.[0]?.textContent.trim() || e.caption))
            .map((e) => e.outerHTML)""")
        self.assertEqual(nameless, [])

    def test_light_and_dark(self):
        def brightness(page):
            return sum(pixels(page)[2][:3])
        page = self.open(scheme="dark")
        self.assertLess(brightness(page), 150)
        page.click("#theme")
        self.assertGreater(brightness(page), 600, "light by choice")
        page.click("#theme")
        self.assertLess(brightness(page), 150, "dark by choice")
        page.click("#theme")
        page.emulate_media(color_scheme="light")
        page.wait_for_function("() => getComputedStyle(document.body).color === getComputedStyle(document.documentElement).color")
        page.wait_for_function("() => pompeiu.app.scenes[0].scene.background.r > 0.8")
        self.assertGreater(brightness(page), 600, "as the system")

    def test_text_has_contrast(self):
        for scheme in ["light", "dark"]:
            page = self.open(scheme=scheme)
            ratios = page.evaluate("""() => {
                const light = (color) => {
                    const canvas = new OffscreenCanvas(1, 1).getContext("2d");
                    canvas.fillStyle = color;
                    canvas.fillRect(0, 0, 1, 1);
                    const [r, g, b] = [...canvas.getImageData(0, 0, 1, 1).data].slice(0, 3).map((v) => v / 255)
                        .map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
                    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
                };
                const opaque = (e) => { while (e && /, 0\\)$|^transparent/.test(getComputedStyle(e).backgroundColor)) e = e.parentElement; return e; };
                return [...document.querySelectorAll("h1, h2, p, small, dt, dd, th, td, button, label")].filter((e) => e.offsetParent && e.textContent.trim())
                    .map((e) => {
                        const [a, b] = [light(getComputedStyle(e).color), light(getComputedStyle(opaque(e) ?? document.body).backgroundColor)];
                        return [(Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05), e.outerHTML.slice(0, 80)];
                    });
            }""")
            self.assertEqual([r for r in ratios if r[0] < 4.5], [], scheme)

    # ---- hostile and large input

    def test_names_stay_text(self):
        page = self.open("hostile")
        self.assertIn(HOSTILE[0], shown(page, "header"))
        self.assertIn(HOSTILE[1], shown(page, "#panel"))
        self.assertEqual(page.locator("img").count(), 0)
        self.assertIn(HOSTILE[0], page.title())

    def test_as_many_faces_as_a_page_holds(self):
        # Larger surfaces are drawn by groups of faces, 90,000 triangles each.
        path, truth = make("large.html", "deviation_page", "--faces", "180000")
        pages["large"] = path, truth
        began = time.monotonic()
        page = self.open("large")
        ready = time.monotonic() - began
        frame = page.evaluate("""async () => {
            const times = [];
            for (let i = 0; i < 5; i++) {
                const began = performance.now();
                pompeiu.app.cameras[0].orbit(0.05, 0);
                pompeiu.app.view.drawNow();
                const gl = pompeiu.app.view.renderer.getContext();
                gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
                times.push(performance.now() - began);
            }
            return times.sort((a, b) => a - b)[2];
        }""")
        pick = page.evaluate("""() => {
            pompeiu.app.pick(300, 300);
            const began = performance.now();
            for (let i = 0; i < 100; i++) pompeiu.app.pick(200 + 3 * i, 350);
            return (performance.now() - began) / 100;
        }""")
        width, height, raw = pixels(page)
        self.assertGreater(count_of(raw, lambda *color: bytes(color) != raw[:3]) / (width * height), 0.2)
        faces = sum(surface["faces"] for surface in truth["surfaces"])
        self.assertGreater(faces, 170_000)
        size = path.stat().st_size
        print(f"\n{faces} faces: {size / 1e6:.1f} MB ({size / faces:.0f} bytes per face), ready in {ready * 1e3:.0f} ms, "
              f"a frame {frame:.0f} ms, a value under the cursor {pick:.2f} ms", file=sys.stderr)


if __name__ == "__main__":
    unittest.main()
