"""The program in a page, used as people do: files are taken, tasks asked, work cancelled, results downloaded."""

import json
import random
import tempfile
import unittest
from pathlib import Path

from pages import FOLDER, ROOT, Browser, keep_picture

PAGE = FOLDER.parent / "page/pompeiu.html"
MESHES = ROOT / "examples/meshes"
ENDED = ", ".join(f"html[data-state={state}]" for state in ("done", "refused", "cancelled"))


def cloud(path, count):
    """An OBJ file of triangles in a cube, of which each pair of files differs: much work for a search."""
    draw = random.Random(count)
    with path.open("w") as file:
        for _ in range(count):
            corner = [draw.random() for _ in range(3)]
            for _ in range(3):
                file.write("v " + " ".join(f"{x + 0.05 * draw.random():.6f}" for x in corner) + "\n")
        for i in range(count):
            file.write(f"f {3 * i + 1} {3 * i + 2} {3 * i + 3}\n")


def hostile():
    """Files that are no meshes, or nearly: names and contents."""
    draw = random.Random(7)
    whole = (MESHES / "torus.obj").read_bytes()
    yield from [("empty.obj", b""), ("empty.stl", b""), ("text.txt", b"hello"), ("gzip.ply.gz", b"\x1f\x8b\x08\x00garbage"),
                ("many.ply", b"ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty double x\nend_header\n"),
                ("many.off", b"OFF\n2000000000 2000000000 0\n"), ("nan.obj", b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
                ("index.obj", b"v 0 0 0\nf 1 2 999999999\n"), ("<img src=x onerror=alert(1)>.obj", b"nothing"),
                ("bad.glb", b"glTF\x02\x00\x00\x00\xff\xff\xff\xff"), ("bad.vtp", b"<VTKFile><PolyData>"), ("points.obj", b"v 0 0 0\nv 1 1 1\n")]
    for i in range(38):
        size = draw.randrange(1, 3000)
        start = whole[:draw.randrange(len(whole) // 2)] if i % 2 else b""
        yield f"random-{i}.{draw.choice(['obj', 'ply', 'stl', 'off', 'glb', 'vtk'])}", b"f 0 \xff " + draw.randbytes(size) + start


class ProgramPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not PAGE.exists():
            raise unittest.SkipTest("the program in a page was not made: scripts/web makes it")
        cls.browser = cls.enterClassContext(Browser())

    def visit(self, **options):
        page = self.browser.open(PAGE, **options)
        self.addCleanup(self.close, page)
        return page

    def close(self, page):
        self.assertEqual(page.complaints, [])
        outside = [url for url in page.requests if not url.startswith(("data:", "blob:", "about:")) and url != PAGE.as_uri()]
        self.assertEqual(outside, [], "the page asks for nothing")
        page.context.close()

    def take(self, page, *files):
        page.set_input_files("#chooser", list(files))
        return self.end(page)

    def end(self, page):
        page.wait_for_selector(ENDED)
        return page.get_attribute("html", "data-state")

    def saved(self, page, button):
        with page.expect_download() as download:
            page.click(f"#download-{button}")
        return Path(download.value.path()).read_bytes()

    def test_two_files_are_compared_and_swapped(self):
        page = self.visit(width=1440, height=900)
        keep_picture(page, "program-empty")
        self.assertEqual(self.take(page, MESHES / "sphere.obj", MESHES / "rough-sphere.obj"), "done")
        self.assertIn("H(A, B) is proven to be in [0.0", page.text_content("#interval"))
        page.fill("#field-threshold", "0.01mm")
        page.select_option("#field-unit", "mm")
        page.click("#run")
        self.assertEqual(self.end(page), "done")
        self.assertTrue(page.text_content("#status").startswith("OUT OF TOLERANCE 0.01 mm"))
        self.assertIn("OUT OF TOLERANCE", page.frame_locator("iframe").locator("#banner").text_content())
        self.assertEqual(page.text_content("#command"), "pompeiu deviation sphere.obj rough-sphere.obj --within 0.01mm --unit mm"
                         " --report deviation.html --pdf deviation.pdf")
        keep_picture(page, "program-done")
        answer = json.loads(self.saved(page, "json"))
        self.assertEqual([one["path"] for one in answer["inputs"]], ["sphere.obj", "rough-sphere.obj"])
        self.assertEqual(answer["report"]["verdict"]["answer"], "out")
        self.assertTrue(self.saved(page, "pdf").startswith(b"%PDF"))
        self.assertIn(b"rough-sphere.obj", self.saved(page, "page"))
        page.click("#swap")
        self.assertEqual(self.end(page), "done")
        self.assertIn("deviation rough-sphere.obj sphere.obj --within 0.01mm", page.text_content("#command"))

    def test_files_are_dropped_on_a_phone_in_the_dark(self):
        page = self.visit(width=390, height=844, scheme="dark")
        page.evaluate("""([name, text]) => {
            const transfer = new DataTransfer();
            transfer.items.add(new File([text], name));
            dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
        }""", ["torus.obj", (MESHES / "torus.obj").read_text()])
        self.assertEqual(self.end(page), "done")
        self.assertIn("512 vertices, 1,024 faces", page.text_content("#status"))
        self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), 390)
        page.frame_locator("iframe").locator("html[data-ready=true]").wait_for()
        keep_picture(page, "program-phone-dark")

    def test_one_mesh_is_changed_and_written(self):
        page = self.visit()
        self.assertEqual(self.take(page, MESHES / "torus.obj"), "done")
        for task, expected in [("simplify", "at a distance of at most"), ("remesh", "at a distance of at most"), ("flatten", "1,024 faces"), ("repair", "1,024 faces")]:
            page.select_option("#which", task)
            page.click("#run")
            self.assertEqual(self.end(page), "done", page.text_content("#failure"))
            self.assertIn(expected, page.text_content("#status"))
            self.assertTrue(page.text_content("#command").startswith(f"pompeiu {task} torus.obj"))
            self.assertTrue(self.saved(page, "glb").startswith(b"glTF"))
            self.assertIn(b"f ", self.saved(page, "obj"))

    def test_work_is_cancelled_at_once_and_can_begin_again(self):
        page = self.visit(width=1440, height=900)
        with tempfile.TemporaryDirectory() as folder:
            files = [Path(folder) / "a.obj", Path(folder) / "b.obj"]
            for count, path in zip((20_000, 20_001), files):
                cloud(path, count)
            page.set_input_files("#chooser", files)
            page.wait_for_selector("html[data-state=working]")
            page.wait_for_selector("#interval:not([hidden])")
            keep_picture(page, "program-working")
            page.click("#cancel")
            self.assertEqual(self.end(page), "cancelled")
            self.assertIn("cancelled", page.text_content("#failure"))
            keep_picture(page, "program-cancelled")
        self.assertEqual(self.take(page, MESHES / "sphere.obj", MESHES / "torus.obj"), "done")

    def test_files_that_cannot_be_used_are_refused_in_a_sentence(self):
        page = self.visit(width=1440, height=900)
        ended = []
        for name, content in hostile():
            page.set_input_files("#chooser", {"name": name, "mimeType": "application/octet-stream", "buffer": content})
            ended.append((name, self.end(page), page.text_content("#failure")))
            page.evaluate("document.documentElement.dataset.state = 'empty'")
        self.assertEqual(len(ended), 50)
        for name, state, sentence in ended:
            self.assertEqual(state, "refused", name)
            self.assertGreater(len(sentence), len(name) + 10, name)
            self.assertTrue(sentence.startswith(f"{name}: "), sentence)
        self.take(page, *[MESHES / name for name in ("sphere.obj", "torus.obj", "cylinder.obj")])
        self.assertIn("3 files were dropped", page.text_content("#failure"))
        keep_picture(page, "program-refused")
        self.assertEqual(self.take(page, MESHES / "torus.obj"), "done", "the page still works")

    def test_the_page_is_small(self):
        self.assertLess(PAGE.stat().st_size, 4 * 2**20)


if __name__ == "__main__":
    unittest.main()
