# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Links between the Markdown pages lead to files and headings that exist."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).parents[2]
LINK = re.compile(r"\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ (.+)$", re.M)


def pages(root):
    return [path for path in sorted(root.rglob("*.md"))
            if not any(part == "build" or part.startswith(".")
                       for part in path.relative_to(root).parts)]


def anchors(text):
    """The names that GitHub gives to headings."""
    return {re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
            for heading in HEADING.findall(text)}


def broken_links(page, text):
    for link in LINK.findall(text):
        if "://" in link:
            continue
        path, _, anchor = link.partition("#")
        target = page.parent / path if path else page
        if not target.exists():
            yield link
        elif anchor and anchor not in anchors(target.read_text(encoding="utf-8")):
            yield link


class Links(unittest.TestCase):
    def test_lead_somewhere(self):
        found = pages(ROOT)
        self.assertIn(ROOT / "README.md", found)
        broken = [f"{page.relative_to(ROOT)}: {link}" for page in found
                  for link in broken_links(page, page.read_text(encoding="utf-8"))]
        self.assertEqual(broken, [])

    def test_broken_ones_are_found(self):
        text = "[a](README.md) [b](missing.md) [c](CONTRIBUTING.md#tests) [d](CONTRIBUTING.md#x)"
        self.assertEqual(list(broken_links(ROOT / "README.md", text)),
                         ["missing.md", "CONTRIBUTING.md#x"])


if __name__ == "__main__":
    unittest.main()
