"""The page with every part, used as people use it, against what it was made from."""

import math
import unittest

from pages import Browser, PageTest, data, keep_picture, make, pixels, settle, shown

TABLE = "[data-key=pieces] tbody"


def setUpModule():
    global browser, path, truth
    browser = Browser().__enter__()
    unittest.addModuleCleanup(browser.__exit__)
    path, truth = make("showcase.html", "showcase")


def torus(u, v):
    """A point of the surface at the first step, by its angles."""
    ring = 1 + 0.35 * math.cos(v)
    return [ring * math.cos(u), ring * math.sin(u), 0.35 * math.sin(v)]


class Showcase(PageTest):
    def open(self, **options):
        return self.visit(browser, path, **options)

    def show(self, key):
        self.page.click(f"label:has([data-control=arrangement-{key}])")
        settle(self.page)

    def target(self, camera):
        settle(self.page)
        return self.page.evaluate("""(i) => {
            const { camera, controls, space } = pompeiu.app.cameras[i];
            const direction = camera.position.clone().sub(controls.target).normalize().toArray();
            return { target: controls.target.toArray().map((x, k) => x * space.scale + space.origin[k]), direction };
        }""", camera)

    # ---- steps over time

    def test_a_player_moves_surfaces_and_charts(self):
        page = self.open()
        self.show("surface")
        seen, marks = set(), []
        for step in [0, 5, 17]:
            page.fill("[data-control=step]", str(step))
            seen.add(pixels(page)[2])
            marks.append(float(page.get_attribute("[data-key=area] circle.present", "cx")))
            told = shown(page, "[data-key=step-text]")
            self.assertIn(f"area {truth['areas'][step]:.5g}", told)
        self.assertEqual(len(seen), 3, "each frame looks different")
        self.assertTrue(marks[0] < marks[1] < marks[2], marks)
        self.assertEqual(page.evaluate("pompeiu.app.players[0].position"), 17)
        # A click in the chart goes to the nearest step.
        box = page.locator("[data-key=area] svg").bounding_box()
        page.mouse.click(box["x"] + box["width"] * (38 + 274 / 2) / 320, box["y"] + 40)
        self.assertIn(page.evaluate("pompeiu.app.players[0].position"), [11, 12])

    def test_a_player_plays_and_stops(self):
        page = self.open()
        page.click("[data-control=play]")
        self.assertEqual(shown(page, "[data-control=play]"), "Pause")
        page.wait_for_function("() => pompeiu.app.players[0].position > 2")
        page.click("[data-control=play]")
        self.assertEqual(shown(page, "[data-control=play]"), "Play")
        self.show("pieces")
        self.assertFalse(page.is_visible("[data-control=step]"), "nothing here follows the player")

    def test_a_film_plays_by_itself_unless_people_want_no_motion(self):
        page = self.open(motion="no-preference")
        page.wait_for_function("() => pompeiu.app.players[0].position > 2")
        self.assertEqual(shown(page, "[data-control=play]"), "Pause")
        page.click("[data-control=play]")
        self.assertFalse(page.evaluate("pompeiu.app.players[0].playing"))
        still = self.open(motion="reduce")
        self.assertEqual(still.evaluate("[pompeiu.app.players[0].position, pompeiu.app.players[0].playing]"), [0, False])

    def test_values_under_the_cursor_follow_the_step(self):
        page = self.open()
        self.show("surface")
        for step in [0, 9]:
            page.fill("[data-control=step]", str(step))
            settle(page)
            middle = page.evaluate("(({ x, y }) => [x, y])(pompeiu.app.view.middle(0))")
            compared = 0
            for dx in range(-300, 301, 40):
                hit = page.evaluate("([x, y]) => pompeiu.app.pick(x, y)", [middle[0] + dx, middle[1] + 90])
                if not hit:
                    continue
                heights = [truth["heights"][step][v] for v in truth["faces"][hit["face"]]]
                self.assertEqual(hit["values"], heights, "to the last bit")
                self.assertAlmostEqual(hit["value"], hit["position"][2], delta=1e-5)
                compared += 1
            self.assertGreater(compared, 6)

    # ---- linked views

    def test_what_is_pointed_at_is_marked_on_the_other_mesh(self):
        page = self.open()
        settle(page)
        box = page.locator("#view").bounding_box()
        for x, y in [(0.4, 0.1), (1.3, 0.5), (1.9, 0.62)]:
            at = self.screen([x, y, 0], 1)
            page.mouse.move(box["x"] + at["x"], box["y"] + at["y"])
            page.wait_for_selector("#reading:not([hidden])")
            page.wait_for_selector(".dot circle", state="attached")
            settle(page)
            page.wait_for_function("""([x, y]) => {
                const text = document.querySelector("#reading").textContent.replaceAll("\\u2212", "-");
                const found = /at \\(([^,]+), ([^)]+)\\)/.exec(text);
                return found && Math.hypot(found[1] - x, found[2] - y) < 0.02;
            }""", arg=[x, y])
            settle(page)
            expected = self.screen(torus(math.pi * x, math.pi * y / 0.35), 0)
            dot = [float(page.get_attribute(".dot circle", name)) for name in ("cx", "cy")]
            self.assertLess(math.dist(dot, (expected["x"], expected["y"])), 6, (x, y))
        page.mouse.move(2, 2)
        page.wait_for_selector("#reading", state="hidden")
        self.assertEqual(page.locator(".dot").count(), 0)

    def test_spaces_have_cameras_of_their_own_and_the_plane_is_never_turned(self):
        page = self.open()
        box = page.locator("#view").bounding_box()
        before = [self.target(0), self.target(1)]
        for part, moved, kept in [(0.75, 1, 0), (0.25, 0, 1)]:
            x = box["x"] + box["width"] * part
            page.mouse.move(x, box["y"] + 300)
            page.mouse.down()
            page.mouse.move(x + 60, box["y"] + 340, steps=3)
            page.mouse.up()
            after = [self.target(0), self.target(1)]
            self.assertNotEqual(after[moved], before[moved])
            self.assertEqual(after[kept], before[kept])
            before = after
        for z in before[1]["direction"][:2]:
            self.assertAlmostEqual(z, 0, places=9)
        self.assertNotEqual(before[0]["direction"], [0, 0, 1])

    # ---- tables and charts

    def test_tables_are_sorted(self):
        page = self.open()
        areas = truth["pieces"]["areas"]
        read = lambda: [float(x) for x in page.eval_on_selector_all(f"{TABLE} td:nth-child(2)", "cells => cells.map((cell) => cell.dataset.exact)")]
        self.assertEqual(read(), areas)
        page.click("[data-key=pieces] th:nth-child(2) button")
        self.assertEqual(read(), sorted(areas))
        self.assertEqual(page.get_attribute("[data-key=pieces] th:nth-child(2)", "aria-sort"), "ascending")
        page.click("[data-key=pieces] th:nth-child(2) button")
        self.assertEqual(read(), sorted(areas, reverse=True))
        page.click("[data-key=pieces] th:nth-child(1) button")
        self.assertEqual(read(), areas, "piece 10 comes after piece 9")
        self.assertEqual(page.locator("[data-key=pieces] img").count(), 1)
        self.assertGreater(page.evaluate("document.querySelector('[data-key=pieces] img').naturalWidth"), 0)

    def test_rows_and_points_lead_to_places(self):
        page = self.open()
        for selector, piece in [(f"{TABLE} tr:nth-child(8) button", 7), ("[data-key=scatter] [data-point='20']", 20), ("[data-place='1']", 1)]:
            page.locator(selector).dispatch_event("click")
            settle(page)
            self.assertEqual(data(page, ".view", "arrangement"), "pieces")
            self.assertLess(math.dist(self.target(2)["target"], truth["pieces"]["middles"][piece]), 1e-6)
            self.assertEqual(page.evaluate("pompeiu.app.scenes[3].layers[0].shown.place.label"), str(piece))
            self.assertEqual(page.locator(f"{TABLE} tr.chosen").count(), 1)
        page.click("[data-control=show-all]")
        self.assertEqual(page.locator("[aria-pressed=true]").count(), 0)

    def test_pieces_are_read_by_name_and_holes_are_empty(self):
        page = self.open()
        self.show("pieces")
        middles = truth["pieces"]["middles"]
        for piece in [0, 13, 35]:
            at = self.screen(middles[piece])
            hit = page.evaluate("([x, y]) => (({ face, value, mesh }) => ({ face, value, element: mesh.element }))(pompeiu.app.pick(x, y))", [at["x"], at["y"]])
            self.assertEqual(hit, {"face": piece, "value": truth["pieces"]["areas"][piece], "element": "piece"})
        at = self.screen([3.5, 3.5, 0])
        self.assertIsNone(page.evaluate("([x, y]) => pompeiu.app.pick(x, y)", [at["x"], at["y"]]))

    def test_a_click_in_a_histogram_sets_the_threshold(self):
        page = self.open()
        self.show("pieces")
        plain = pixels(page)[2]
        page.locator("[data-key=areas] svg").scroll_into_view_if_needed()
        box = page.locator("[data-key=areas] svg").bounding_box()
        page.mouse.click(box["x"] + box["width"] * (38 + 274 * 0.3) / 320, box["y"] + 40)
        self.assertAlmostEqual(float(data(page, "[data-control=threshold-value]", "exact")), 0.6, delta=0.02)
        self.assertTrue(page.is_checked("[data-control=paint-threshold]"))
        self.assertNotEqual(pixels(page)[2], plain)

    # ---- the rest

    def test_streaks_move_unless_that_is_not_wanted(self):
        page = self.open(motion="no-preference")
        self.show("flow")
        page.wait_for_function("() => pompeiu.app.phase > 0.1")
        page.uncheck("[data-control=motion]")
        settle(page)
        self.assertEqual(pixels(page)[2], pixels(page)[2], "at rest")
        still = self.open(motion="reduce")
        self.show("flow")
        self.assertEqual(still.evaluate("pompeiu.app.phase"), 0)
        self.assertFalse(still.is_checked("[data-control=motion]"))

    def test_controls_are_those_of_what_is_shown_and_have_names(self):
        page = self.open()
        visible = lambda name: page.is_visible(f"[data-control={name}]")
        self.assertFalse(visible("arrow-density"))
        self.show("flow")
        self.assertTrue(visible("arrow-density") and visible("upward"))
        self.show("pieces")
        self.assertFalse(visible("arrow-density") or visible("upward"))
        nameless = page.evaluate("""() => [...document.querySelectorAll("button, input, select, [tabindex='0'], svg[role=img], table")]
            .filter((e) => !(e.getAttribute("aria-label") || e.textContent.trim() || e.labels?.[0]?.textContent.trim() || e.caption)).map((e) => e.outerHTML)""")
        self.assertEqual(nameless, [])

    def test_screenshots(self):
        for name, options in {"light": {}, "dark": {"scheme": "dark"}, "narrow": {"width": 400, "height": 860}}.items():
            with self.subTest(name):
                page = self.open(**options)
                keep_picture(page, f"showcase-{name}", full_page=name == "narrow")
                self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth"), 0)


if __name__ == "__main__":
    unittest.main()
