"""`pompeiu app`: the program in a page with the native engine behind it."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import axe_playwright_python

from pages import FOLDER, ROOT, Browser, keep_picture

PROGRAM = Path(os.environ.get("POMPEIU", FOLDER.parent / "debug/pompeiu")).resolve()
MESHES = ROOT / "examples/meshes"
AXE = (Path(axe_playwright_python.__file__).parent / "axe.min.js").read_text()
RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "best-practice"]
ENDED = ", ".join(f"html[data-state={state}]" for state in ("done", "refused", "cancelled"))


class App(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not PROGRAM.exists():
            raise unittest.SkipTest("there is no program: cargo build -p pompeiu-cli makes it")
        cls.browser = cls.enterClassContext(Browser())

    def serve(self, *files, **environment):
        program = subprocess.Popen([PROGRAM, "app", "--no-browser", *files], env={**os.environ, **environment}, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.addCleanup(program.wait)
        self.addCleanup(program.stdout.close)
        self.addCleanup(program.kill)
        return program, program.stdout.readline().strip()

    def test_files_of_the_command_are_compared_until_the_page_is_closed(self):
        program, address = self.serve(MESHES / "sphere.obj", MESHES / "rough-sphere.obj")
        page = self.browser.open(address, width=1440, height=900)
        page.wait_for_selector(ENDED)
        self.assertEqual(page.get_attribute("html", "data-state"), "done", page.text_content("#failure"))
        self.assertIn("H(A, B) is proven to be in [0.0", page.text_content("#interval"))
        page.fill("#field-threshold", "0.01mm")
        page.select_option("#field-unit", "mm")
        page.click("#run")
        page.wait_for_selector("html[data-state=working]")
        page.wait_for_selector(ENDED)
        self.assertTrue(page.text_content("#status").startswith("OUT OF TOLERANCE 0.01 mm"))
        self.assertIn("OUT OF TOLERANCE", page.frame_locator("iframe").locator("#banner").text_content())
        page.frame_locator("iframe").locator("html[data-ready=true]").wait_for()
        keep_picture(page, "app-done")
        with page.expect_download() as download:
            page.click("#download-json")
        served = json.loads(Path(download.value.path()).read_bytes())
        words = ["deviation", "sphere.obj", "rough-sphere.obj", "--within", "0.01mm", "--unit", "mm", "--json"]
        command = json.loads(subprocess.run([PROGRAM, *words], cwd=MESHES, capture_output=True, check=False).stdout)
        self.assertEqual(served["report"]["distance"], command["report"]["distance"])
        self.assertEqual(served["inputs"][1]["sha256"], command["inputs"][1]["sha256"])
        outside = [url for url in page.requests if not url.startswith((address, "data:", "blob:", "about:"))]
        self.assertEqual(outside, [], "the page asks its program alone")
        self.assertEqual(page.complaints, [])
        page.goto(address)
        page.wait_for_selector(ENDED)
        self.assertIsNone(program.poll(), "the page was only loaded again")
        page.close()
        self.assertEqual(program.wait(timeout=120), 0)

    def test_a_first_answer_is_looked_at_while_the_whole_one_is_computed(self):
        with tempfile.TemporaryDirectory() as folder:
            files = [Path(folder) / "a.obj", Path(folder) / "b.obj"]
            for path, size in zip(files, ("0.4", "0.42")):
                subprocess.run([PROGRAM, "generate", "torus", "--minor-radius", size, "--major-segments", "360", "--minor-segments", "180", "-o", path], check=True, capture_output=True)
            # Many processors would have the whole answer at once.
            _, address = self.serve(*files, RAYON_NUM_THREADS="1")
            page = self.browser.open(address, width=1440, height=900)
            page.frame_locator("iframe").locator("html[data-ready=true]").wait_for()
            self.assertEqual(page.get_attribute("html", "data-state"), "working")
            self.assertIn("H(A, B) is proven to be in [0.0", page.text_content("#interval"))
            first = page.frames[-1]
            self.assertIn("the time limit ran out", first.locator("body").text_content())
            keep_picture(page, "app-first-answer")
            first.locator("canvas").first.press("ArrowLeft")
            first.locator("canvas").first.press("ArrowUp")
            looking = "JSON.stringify(globalThis.pompeiu.app.cameras.map(({ looking }) => looking))"
            turned = json.loads(first.evaluate(looking))
            page.wait_for_selector(ENDED)
            self.assertEqual(page.get_attribute("html", "data-state"), "done", page.text_content("#failure"))
            page.frame_locator("iframe").locator("html[data-ready=true]").wait_for()
            self.assertNotIn("the time limit ran out", page.frames[-1].locator("body").text_content())
            kept = json.loads(page.frames[-1].evaluate(looking))
            for x, y in zip(turned[0]["position"] + turned[0]["target"], kept[0]["position"] + kept[0]["target"]):
                self.assertAlmostEqual(x, y, delta=0.01)
            keep_picture(page, "app-whole-answer")
            # A verdict that is known at once does not make the first answer a whole one.
            page.fill("#field-threshold", "0.5")
            page.click("#run")
            page.wait_for_selector("html[data-state=working]")
            page.wait_for_selector(ENDED)
            self.assertTrue(page.text_content("#status").startswith("WITHIN TOLERANCE"), page.text_content("#status"))
            page.frame_locator("iframe").locator("html[data-ready=true]").wait_for()
            self.assertNotIn("the time limit ran out", page.frames[-1].locator("body").text_content())
            self.assertEqual(page.complaints, [])

    def test_a_page_whose_program_has_ended_says_so(self):
        program, address = self.serve()
        page = self.browser.open(address, width=390, height=844, scheme="dark")
        self.assertEqual(page.locator("#examples button").count(), 0)
        program.kill()
        program.wait()
        page.set_input_files("#chooser", [MESHES / "torus.obj"])
        page.wait_for_selector("html[data-state=refused]")
        self.assertIn("start pompeiu app again", page.text_content("#failure"))

    def complain(self, frame):
        """What axe finds in a frame: rules, and the elements that break them."""
        frame.evaluate(AXE)
        found = frame.evaluate("(rules) => axe.run(document, { runOnly: rules, iframes: false })", RULES)
        return [(one["id"], node["target"], node.get("failureSummary")) for one in found["violations"] for node in one["nodes"]]

    def test_axe_finds_nothing_in_any_state(self):
        for width, height in [(1440, 900), (390, 844)]:
            for scheme in ["light", "dark"]:
                # A program of its own: one whose only page was closed ends after seconds, and a busy machine opens the next page later.
                _, address = self.serve()
                page = self.browser.open(address, width=width, height=height, scheme=scheme)
                look = f"{'phone' if width < 400 else 'desk'}-{scheme}"

                def state(name):
                    keep_picture(page, f"app-{name}-{look}")
                    self.assertEqual(self.complain(page.main_frame), [], f"{name}, {look}")

                state("empty")
                page.set_input_files("#chooser", [MESHES / "sphere.obj", MESHES / "rough-sphere.obj"])
                page.wait_for_selector(ENDED)
                page.frame_locator("iframe").locator("html[data-ready=true]").wait_for()
                state("compared")
                self.assertEqual(self.complain(page.frames[-1]), [], f"page of the deviation, {look}")
                page.fill("#field-threshold", "much")
                page.click("#run")
                page.wait_for_selector("html[data-state=refused]")
                state("refused")
                page.context.close()

    def test_axe_finds_nothing_in_pages_of_one_mesh(self):
        """Their panel of numbers is scrolled, with nothing in it to focus."""
        _, address = self.serve()
        page = self.browser.open(address, width=1440, height=900)
        page.set_input_files("#chooser", [MESHES / "torus.obj"])
        for task in ["remesh", "flatten"]:
            page.select_option("#which", task)
            page.click("#run")
            page.wait_for_selector(ENDED)
            page.frame_locator("iframe").locator("html[data-ready=true]").wait_for()
            self.assertEqual(self.complain(page.frames[-1]), [], f"page of {task}")
        page.context.close()


if __name__ == "__main__":
    unittest.main()
