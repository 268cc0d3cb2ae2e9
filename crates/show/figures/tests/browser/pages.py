"""Pages made by the crate, opened in a browser that must not talk to anyone."""

import base64
import json
import os
import subprocess
import unittest
from collections import Counter
from pathlib import Path

from playwright.sync_api import sync_playwright

ROOT = Path(__file__).resolve().parents[5]
FOLDER = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")).resolve() / "pages"
# A machine without a graphics card draws with the processor; the rest keeps the browser from calling home.
FLAGS = [
    "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--no-first-run", "--disable-extensions",
]
# Loading a large page is slow on a machine that draws with the processor; nothing is asserted about time.
PATIENCE_MS = 300_000


def make(name, example, *options):
    """Writes a page with one of the examples; gives its path and what it was made from."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    path = FOLDER / name
    # Built with the whole workspace, so that what its tests have compiled serves here.
    subprocess.run(["cargo", "build", "--quiet", "--locked", "--workspace", "--example", example], cwd=ROOT, check=True)
    program = FOLDER.parent / "debug/examples" / example
    subprocess.run([program, str(path), *options], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    return path, json.loads(Path(f"{path}.json").read_text())


class Browser:
    """One browser for all tests of a file."""

    def __enter__(self):
        executable = subprocess.run([ROOT / "scripts/chromium"], check=True, capture_output=True, text=True).stdout.strip()
        self.playwright = sync_playwright().start()
        self.browser = self.playwright.chromium.launch(executable_path=executable, args=FLAGS)
        return self

    def __exit__(self, *_):
        self.browser.close()
        self.playwright.stop()

    def open(self, path, width=1280, height=860, scheme="light", motion="reduce"):
        """Opens a file, or the address of a page that is served on this machine."""
        is_served = isinstance(path, str)
        context = self.browser.new_context(
            viewport={"width": width, "height": height}, color_scheme=scheme, reduced_motion=motion, offline=not is_served)
        context.set_default_timeout(PATIENCE_MS)
        page = context.new_page()
        page.complaints = []
        page.requests = []
        page.on("console", lambda message: page.complaints.append(message.text))
        page.on("pageerror", lambda error: page.complaints.append(str(error)))
        page.on("request", lambda request: page.requests.append(request.url))
        page.goto(path if is_served else path.as_uri())
        page.wait_for_selector("html[data-ready=true]")
        return page


def settle(page):
    """Waits until the last frame that was asked for is drawn."""
    page.wait_for_selector(".view[data-state=still]")


def keep_picture(page, name, **options):
    """A picture for somebody to look at, where PICTURES is set: nothing is asserted of it, and drawing it can take long."""
    if os.environ.get("PICTURES"):
        FOLDER.mkdir(parents=True, exist_ok=True)
        page.screenshot(path=FOLDER / f"{name}.png", **options)


def shown(page, selector):
    return page.text_content(selector)


def data(page, selector, name):
    return page.get_attribute(selector, f"data-{name}")


def pixels(page):
    """What the canvas shows: width, height, and colours from the lower left corner, row by row."""
    settle(page)
    width, height, text = page.evaluate("""() => {
        const gl = pompeiu.app.view.renderer.getContext();
        const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
        const bytes = new Uint8Array(4 * width * height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
        let text = "";
        for (let i = 0; i < bytes.length; i += 32768) text += String.fromCharCode(...bytes.subarray(i, i + 32768));
        return [width, height, btoa(text)];
    }""")
    raw = base64.b64decode(text)
    return width, height, raw


def count_of(raw, wanted):
    """How many pixels have a colour that the condition holds for; colours are looked at once each."""
    words = memoryview(raw).cast("I")
    return sum(n for word, n in Counter(words).items() if wanted(word & 255, word >> 8 & 255, word >> 16 & 255))


def is_contrast(red, green, blue):
    """The colour of what is out of tolerance on the sequential map, in any light."""
    return red > 100 and green < 0.35 * red and blue < 0.35 * red


class PageTest(unittest.TestCase):
    """Opens pages, and sees at the end that they did not complain and asked for nothing."""

    def visit(self, browser, path, **options):
        self.page = browser.open(path, **options)
        self.addCleanup(self.close, self.page, path)
        return self.page

    def close(self, page, path):
        settle(page)
        self.assertEqual(page.complaints, [])
        outside = [url for url in page.requests if not url.startswith(("data:", "blob:")) and url != path.as_uri()]
        self.assertEqual(outside, [], "the page asks for nothing")
        page.context.close()

    def camera(self):
        settle(self.page)
        return self.page.evaluate("""() => {
            const { camera, controls } = pompeiu.app.cameras[0];
            return { position: camera.position.toArray(), target: controls.target.toArray() };
        }""")

    def screen(self, point, pane=0):
        """Where a point of the meshes is on the canvas."""
        return self.page.evaluate("""([point, pane]) => {
            const { view } = pompeiu.app;
            return view.project(view.panes[pane].scene.point(point), pane);
        }""", [point, pane])
