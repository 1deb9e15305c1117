#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens evaluation.html in headless Chromium and uses it: page_test.py PAGE_MAKER.

Exits with 77 (skipped) where there is no Chromium.
"""
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
import browser as browsers  # noqa: E402

PROBE = """
  const table = document.querySelector(".picture-table");
  const rows = () => Array.from(table.tBodies[0].rows);
  const column = (name) => Array.from(table.querySelectorAll(".sort"))
    .find((button) => button.textContent === name);
  column("SSIM").click();
  seen.ssim = rows().map((row) => row.cells[4].dataset.sort);
  column("Facade").click();
  seen.names = rows().map((row) => row.cells[0].querySelector("bdi").textContent);
  const images = Array.from(document.querySelectorAll("td img"));
  seen.images = images.length;
  seen.lazy = images.every((image) => image.loading === "lazy");
  const viewer = document.getElementById("viewer");
  table.querySelector(".side-by-side img").click();
  seen.opened = viewer.open;
  seen.shown = viewer.querySelectorAll("img").length;
  viewer.querySelector("button").click();
  seen.closed = !viewer.open;
  seen.tallest = Math.max(...Array.from(document.querySelectorAll("table.surfaces tbody th"),
                                        (head) => head.getBoundingClientRect().height));
  const large = new Image();
  large.src = images[0].src;
  await large.decode();
  seen.loaded = large.naturalWidth;
"""


def check_use(seen):
    assert not seen["errors"], seen["errors"]
    numbers = [float(value) for value in seen["ssim"] if value]
    assert len(numbers) == 3 and numbers == sorted(numbers), seen["ssim"]
    assert seen["ssim"][-1] == "", seen["ssim"]  # what was not measured comes last
    # Numbers in names count as numbers.
    assert [name[:9] for name in seen["names"]] == [
        "B0001/F00", "B0001/F9\"", "B0001/F10", "B0002/F00"], seen["names"]
    assert seen["images"] == 12 and seen["lazy"], seen
    assert seen["opened"] and seen["shown"] == 3 and seen["closed"], seen
    assert seen["loaded"] == 420, seen["loaded"]  # the policy lets pictures through


def main():
    browser = browsers.find_browser()
    if not browser:
        print("no Chromium: skipped")
        return browsers.SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], f"{folder}/out"], check=True)
        page = pathlib.Path(folder, "out/evaluation.html")
        check_use(browsers.browse(browser, page, PROBE, folder, 1280))
        for width in (1280, 500):
            seen = browsers.browse(browser, page, PROBE, folder, width)
            assert seen["final_title"] == "Evaluation", (width, seen["final_title"])
            assert seen["overflow"] <= 0, (width, seen["overflow"])
            assert 0 < seen["tallest"] < 50, (width, seen["tallest"])  # one line, not letters
    print("the page works")
    return 0


if __name__ == "__main__":
    sys.exit(main())
