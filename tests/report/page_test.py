# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens the report in headless Chromium and uses it: page_test.py PAGE_MAKER.

Exits with 77 (skipped) where there is no Chromium.
"""
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))
import browser as browsers  # noqa: E402

PROBE = """
const rows = () => Array.from(document.querySelectorAll("#facade-table tbody tr"));
const shown = () => rows().filter((row) => !row.hidden).map((row) => row.cells[1]
  .querySelector("button").textContent);
const opened = () => document.querySelector("dialog[open]");
  seen.title = document.title;
  seen.at_first = shown();
  const column = (name) => Array.from(document.querySelectorAll(".sort"))
    .find((button) => button.textContent === name);
  if (column("Area")) {
    column("Area").click();
    seen.areas = rows().map((row) => Number(row.cells[3].dataset.sort));
    column("Area").click();
    seen.areas_down = rows().map((row) => Number(row.cells[3].dataset.sort));
    seen.sorted = column("Area").closest("th").getAttribute("aria-sort");
    column("Facade").click();
    seen.by_name = shown();
    const red = document.querySelector(".tile.red");
    red.click();
    seen.red = rows().filter((row) => !row.hidden).map((row) => row.dataset.verdict);
    seen.red_count = Number(red.querySelector(".tile-count").textContent);
    red.click();
    const search = document.getElementById("search");
    search.value = "b0002";
    search.dispatchEvent(new Event("input"));
    seen.found = shown();
    search.value = "nothing like this";
    search.dispatchEvent(new Event("input"));
    seen.none = shown();
    seen.none_message = !document.getElementById("none-shown").hidden;
    document.getElementById("show-all").click();
    seen.all = shown().length;
    rows()[0].querySelector(".link").click();
    seen.opened = opened().id === "facade-" + rows()[0].dataset.index;
    seen.loaded = Array.from(opened().querySelectorAll("img")).length;
    opened().querySelector("[data-step='1']").click();
    seen.stepped = opened().id === "facade-" + rows()[1].dataset.index;
    const blend = opened().querySelector(".blend");
    if (blend) {
      blend.value = 100;
      blend.dispatchEvent(new Event("input"));
      seen.blend = getComputedStyle(opened().querySelector(".labels")).opacity;
    }
    opened().querySelector("[data-close]").click();
    seen.closed = opened() === null;
    const wall = document.querySelector(".map .wall");
    wall.dispatchEvent(new MouseEvent("click", {bubbles: true}));
    seen.map_opens = opened().id === "facade-" + wall.dataset.open;
    opened().close();
  }
"""


def check_use(seen):
    assert not seen["errors"], seen["errors"]
    assert seen["areas"] == sorted(seen["areas"]), seen["areas"]
    assert seen["areas_down"] == sorted(seen["areas"], reverse=True), seen["areas_down"]
    assert seen["sorted"] == "descending"
    assert seen["by_name"] == sorted(seen["by_name"]), seen["by_name"]
    assert len(seen["at_first"]) == 12, seen["at_first"]  # walls; roofs are behind the filter
    assert seen["red"] and set(seen["red"]) == {"red"}, seen["red"]
    assert len(seen["red"]) == seen["red_count"], seen
    assert seen["found"] and all("B0002" in name for name in seen["found"]), seen["found"]
    assert seen["none"] == [] and seen["none_message"]
    assert seen["all"] == 15, seen["all"]
    for step in ("opened", "stepped", "closed", "map_opens"):
        assert seen[step], step
    assert seen.get("blend", "1") == "1", seen["blend"]


def main():
    browser = browsers.find_browser()
    if not browser:
        print("no Chromium: skipped")
        return browsers.SKIPPED
    maker = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        def page_of(kind):
            survey = pathlib.Path(folder, kind)
            subprocess.run([maker, survey, kind], check=True, stdout=subprocess.DEVNULL)
            return survey / "report/report.html"

        full = page_of("full")
        check_use(browsers.browse(browser, full, PROBE, folder, 1280))
        for width in (1280, 500):
            for page in (full, page_of("hostile"), page_of("empty"), page_of("failed")):
                seen = browsers.browse(browser, page, PROBE, folder, width)
                name = f"{page.parent.parent.name} at {width} px"
                assert not seen["errors"], (name, seen["errors"])
                assert seen["final_title"] == "Facade report", (name, seen["final_title"])
                assert seen["overflow"] <= 0, (name, seen["overflow"])
    print("the page works")
    return 0


if __name__ == "__main__":
    sys.exit(main())
