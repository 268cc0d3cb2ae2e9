"""The page of tangent fields, used as people use it, against what it was made from."""

import math
import random
import unittest

from pages import Browser, PageTest, keep_picture, make, pixels, settle, shown

LABELS = ["field", "gradient", "rotated gradient", "harmonic"]


def setUpModule():
    global browser, path, truth
    browser = Browser().__enter__()
    unittest.addModuleCleanup(browser.__exit__)
    path, truth = make("fields.html", "fields_page", "--faces", "3000")


class FieldsPage(PageTest):
    def open(self, **options):
        return self.visit(browser, path, **options)

    def test_all_fields_are_shown_and_each_by_itself(self):
        page = self.open()
        self.assertEqual(page.locator(".pane-label").all_text_contents(), LABELS)
        seen = set()
        for i, label in enumerate(LABELS):
            page.click(f"label:has([data-control=arrangement-{i}])")
            settle(page)
            self.assertEqual(page.locator(".pane-label").all_text_contents(), [label])
            seen.add(pixels(page)[2])
        self.assertEqual(len(seen), 4, "they look different")
        page.click("label:has([data-control=arrangement-all])")
        self.assertEqual(page.locator(".pane-label").count(), 4)

    def test_cameras_are_linked(self):
        page = self.open()
        point = truth["corners"][100][0]
        width, height = page.evaluate("[pompeiu.app.view.canvas.clientWidth, pompeiu.app.view.canvas.clientHeight]")
        for _ in range(2):
            settle(page)
            first, *others = [self.screen(point, pane) for pane in range(4)]
            for pane, other in enumerate(others, 1):
                self.assertAlmostEqual(other["x"] - first["x"], width / 2 * (pane % 2), places=6)
                self.assertAlmostEqual(other["y"] - first["y"], height / 2 * (pane // 2), places=6)
            page.focus("#view")
            page.keyboard.press("ArrowLeft")

    def test_vectors_under_the_cursor_are_those_given(self):
        page = self.open()
        settle(page)
        width, height = page.evaluate("[pompeiu.app.view.canvas.clientWidth, pompeiu.app.view.canvas.clientHeight]")
        chance = random.Random(5)
        fields = set()
        for _ in range(120):
            hit = page.evaluate("([x, y]) => pompeiu.app.pick(x, y)", [chance.uniform(0, width), chance.uniform(0, height)])
            if hit:
                vector = truth["fields"][hit["scene"]][hit["face"]]
                self.assertEqual(hit["vector"], vector, "to the last bit")
                self.assertAlmostEqual(hit["value"], math.hypot(*vector))
                fields.add(hit["scene"])
        self.assertEqual(fields, {0, 1, 2, 3})

    def test_arrows_follow_the_vectors_at_one_scale(self):
        page = self.open()
        longest = max(math.hypot(*vector) for field in truth["fields"] for vector in field)
        for i, field in enumerate(truth["fields"]):
            arrows = page.evaluate("""(i) => {
                const { meshes } = pompeiu.app.scenes[i].layers[1].shown;
                return Array.from({ length: meshes[1].count }, (_, k) => Array.from(meshes[1].instanceMatrix.array.subarray(16 * k, 16 * k + 16)));
            }""", i)
            self.assertGreater(len(arrows), 50)
            faces = {}
            origin, scale = page.evaluate("[pompeiu.app.data.spaces[0].origin, pompeiu.app.data.spaces[0].scale]")
            for face, corners in enumerate(truth["corners"]):
                middle = tuple(round((sum(p[k] for p in corners) / 3 - origin[k]) / scale, 4) for k in range(3))
                faces[middle] = face
            lengths = []
            for matrix in arrows:
                vector = field[faces[tuple(round(x, 4) for x in matrix[12:15])]]
                length, size = math.hypot(*matrix[0:3]), math.hypot(*vector)
                cosine = sum(a * b for a, b in zip(matrix[0:3], vector)) / (length * size)
                self.assertAlmostEqual(cosine, 1, places=5)
                lengths.append(length / size)
            self.assertLess(max(lengths) - min(lengths), 1e-5 * max(lengths))
            scale_of_first = lengths[0] if i == 0 else scale_of_first
            self.assertAlmostEqual(lengths[0], scale_of_first, places=6)
        self.assertGreater(longest, 0)

    def test_arrows_can_be_changed(self):
        page = self.open()
        seen = {pixels(page)[2]}
        page.check("[data-control=equal-arrows]")
        seen.add(pixels(page)[2])
        counts = []
        for density in [0, 50, 100]:
            page.fill("[data-control=arrow-density]", str(density))
            seen.add(pixels(page)[2])
            counts.append(page.evaluate("pompeiu.app.scenes[0].layers[1].shown.count"))
        self.assertTrue(counts[0] < counts[1] < counts[2], counts)
        page.uncheck("[data-control=toggle-0]")
        seen.add(pixels(page)[2])
        for kind in ["root", "logarithmic"]:
            page.select_option("[data-control=scale]", kind)
            seen.add(pixels(page)[2])
        self.assertEqual(len(seen), 8)

    def test_numbers_are_those_given(self):
        page = self.open()
        exact = "cells => cells.map((cell) => Number(cell.dataset.exact))"
        self.assertEqual(page.eval_on_selector_all("[data-key=norms] td[data-exact]", exact), truth["norms"])
        self.assertEqual(page.eval_on_selector_all("[data-key=inner-products] td[data-exact]", exact), sum(truth["products"], []))
        self.assertEqual(page.eval_on_selector_all("[data-key=residual]", exact), [truth["residual"]])

    def test_keyboard_reads_and_controls_have_names(self):
        page = self.open()
        page.click("label:has([data-control=arrangement-2])")
        page.focus("#view")
        for key in ["ArrowUp"] * 9 + ["+"] * 2 + ["Enter"]:
            page.keyboard.press(key)
        self.assertRegex(shown(page, "#spoken"), r"rotated gradient: length .* face \d+|No surface")
        nameless = page.evaluate("""() => [...document.querySelectorAll("button, input, select, [tabindex='0']")]
            .filter((e) => !(e.getAttribute("aria-label") || e.textContent.trim() || e.labels?.[0]?.textContent.trim())).map((e) => e.outerHTML)""")
        self.assertEqual(nameless, [])

    def test_screenshots(self):
        for name, options in {"light": {}, "dark": {"scheme": "dark"}, "narrow": {"width": 400, "height": 860}}.items():
            with self.subTest(name):
                page = self.open(**options)
                keep_picture(page, f"fields-{name}", full_page=name == "narrow")
                self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth"), 0)


if __name__ == "__main__":
    unittest.main()
