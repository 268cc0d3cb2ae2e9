"""Joins the page, its scripts, the module and the examples into one file that needs no network.

usage: assemble.py MODULE.wasm FOLDER
"""

import base64
import gzip
import json
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
MESHES = HERE.parents[3] / "examples/meshes"
EXAMPLES = ["sphere.obj", "rough-sphere.obj", "torus.obj", "lantern.obj", "cylinder.obj"]


def packed(content):
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode()


def script(*names):
    text = "\n".join((HERE / name).read_text() for name in names)
    # A classic script has no exports.
    text = re.sub(r"^export (?=class|function|const)", "", text, flags=re.MULTILINE)
    assert "</script" not in text.lower(), "a script would end the element that it stands in"
    return text


def page(module):
    html = (HERE / "index.html").read_text()
    parts = {
        "STYLE": (HERE / "style.css").read_text(),
        "MODULE": packed(module),
        "EXAMPLES": json.dumps({name: packed((MESHES / name).read_bytes()) for name in EXAMPLES}),
        "SERVED": "null",
        "WORKER": script("engine.js", "worker.js"),
        "SCRIPT": script("engines.js", "tasks.js", "page.js"),
    }
    for name, content in parts.items():
        mark = f"/*{name}*/"
        assert html.count(mark) == 1, mark
        html = html.replace(mark, content)
    return html


def main(wasm, folder):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    html = page(Path(wasm).read_bytes())
    (folder / "pompeiu.html").write_text(html)
    print(f"{folder}/pompeiu.html: {len(html.encode())} bytes")


if __name__ == "__main__":
    main(*sys.argv[1:])
