# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses a page in headless Chromium, for tests of pages.

A script (the probe) that is added to a copy of the page clicks, types and leaves what it sees in
`seen`, which is written into the page; --dump-dom prints that.
"""
import html
import json
import re
import shutil
import subprocess

SKIPPED = 77  # the exit code of tests where there is no Chromium

BROWSERS = ("chromium", "chromium-browser", "google-chrome")

BEFORE = """
<script type="module">
const seen = {errors: []};
try {
"""
AFTER = """
  seen.overflow = document.documentElement.scrollWidth - document.documentElement.clientWidth;
} catch (error) {
  seen.errors.push(String(error));
}
seen.final_title = document.title;
const result = document.createElement("pre");
result.id = "probe";
result.textContent = JSON.stringify(seen);
document.body.append(result);
</script>
"""


def find_browser():
    return next(filter(None, map(shutil.which, BROWSERS)), None)


# Virtual time that a page gets, milliseconds. Pictures are decoded in real time: on a busy machine
# virtual time may be over before that, and the page gets more.
BUDGETS_MS = (4_000, 40_000, 400_000)


def browse(browser, page, probe, folder, width):
    """What the probe saw on the page at a window width."""
    copy = page.with_name("probed.html")
    text = page.read_text()
    copy.write_text(text.replace("</body>", BEFORE + probe + AFTER + "</body>"))
    for budget in BUDGETS_MS:
        command = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
                   "--disable-background-networking", "--disable-component-update",
                   "--disable-sync", "--disable-dev-shm-usage",
                   f"--user-data-dir={folder}/profile", f"--window-size={width},900",
                   f"--virtual-time-budget={budget}", "--dump-dom", copy.as_uri()]
        dom = subprocess.run(command, capture_output=True, text=True, timeout=300,
                             check=True).stdout
        probed = re.search(r'<pre id="probe">(.*?)</pre>', dom, re.S)
        if probed:
            return json.loads(html.unescape(probed.group(1)))
    raise AssertionError("the page did not run to its end")
