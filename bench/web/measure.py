"""Times the program in a page beside the native one on one thread, in one run: how long the page takes to open, and both maps of a pair.

usage: measure.py PROGRAM A B RECORD.csv
The page is target/page/pompeiu.html, see scripts/web. Times are those of the answers, without reading.
"""

import csv
import datetime
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "crates/show/figures/tests/browser"))
from pages import Browser  # noqa: E402

PAGE = ROOT / "target/page/pompeiu.html"
ROUNDS = 3


def native(program, files):
    """Milliseconds, and the distance, of the program on one thread."""
    output = subprocess.run([program, "deviation", *files, "--threads", "1", "--json"], check=True, capture_output=True, text=True).stdout
    answer = json.loads(output)
    return answer["timing_ms"]["total"] - answer["timing_ms"]["read"], answer["report"]["distance"]


def in_page(browser, files):
    """Milliseconds until the page is ready, until the first interval from the drop, of the answer, and the distance."""
    page = browser.open(PAGE)
    opened = page.evaluate("performance.getEntriesByType('navigation')[0].domComplete")
    page.evaluate("""() => {
        const seen = new MutationObserver(() => {
            const { state } = document.documentElement.dataset;
            if (state === "reading") globalThis.began ??= performance.now();
            if (!document.getElementById("interval").hidden) globalThis.first ??= performance.now();
        });
        seen.observe(document.documentElement, { attributes: true, subtree: true });
    }""")
    page.set_input_files("#chooser", [str(file) for file in files])
    page.wait_for_selector("html[data-state=done]")
    first = page.evaluate("first - began")
    with page.expect_download() as download:
        page.click("#download-json")
    answer = json.loads(Path(download.value.path()).read_text())
    memory = page.evaluate("engine.memory")
    page.context.close()
    return opened, first, answer["timing_ms"]["total"], answer["report"]["distance"], memory


def main(program, a, b, record):
    rows = []
    with Browser() as browser:
        for _ in range(ROUNDS):
            program_ms, expected = native(program, [a, b])
            opened, first, page_ms, found, memory = in_page(browser, [a, b])
            assert found == expected, (found, expected)
            rows.append([datetime.date.today(), Path(a).parent.name, PAGE.stat().st_size, round(opened), round(first), round(page_ms), round(program_ms),
                         round(page_ms / program_ms, 2), memory // 2**20])
            print(*rows[-1])
    with Path(record).open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["date", "pair", "page_bytes", "opened_ms", "first_interval_ms", "maps_in_page_ms", "maps_native_ms", "ratio", "memory_mib"])
        writer.writerows(rows)


if __name__ == "__main__":
    main(*sys.argv[1:])
