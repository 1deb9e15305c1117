#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the modules, their folders and who includes whom, from the includes in the sources.

Usage: draw_architecture.py [> docs/architecture.svg]      (a test compares both)
"""
import html
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests/architecture"))
import check_architecture as rules  # noqa: E402
import include_graph  # noqa: E402

COLUMN, GAP, MARGIN, ROW_GAP, LINE = 142, 12, 16, 44, 15
# Left to right; what has no column spans those of SPANS, or those that include it.
COLUMNS = ["evaluate", "plan", "calib", "proxy", "texture", "dense", "capture_ingest", "report",
           "exchange"]
ROWS = [["cli"], ["evaluate", "pipeline"],
        ["simulate", "plan", "calib", "proxy", "texture", "dense", "capture_ingest", "report",
         "exchange"],
        ["site"], ["survey"]]
SPANS = {"cli": (0, 9), "pipeline": (1, 9), "survey": (0, 9), "evaluate": (0, 1),
         "simulate": (0, 1)}


def module_includes():
    """{module: modules that it includes} and {module: {folder: folders of it that it includes}}."""
    modules = {module: set() for module in rules.MODULES}
    folders = {module: {} for module in modules}
    for path in rules.find_files(ROOT):
        if path.suffix not in rules.SOURCES or path.parts[0] not in modules:
            continue
        module, folder = path.parts[0], include_graph.folder_of(path)
        inside = folders[module].setdefault(folder, set())
        for _, target in rules.includes_of(path, (ROOT / path).read_text(encoding="utf-8")):
            other = target.split("/")[0]
            if other != module:
                modules[module].add(other)
            elif include_graph.folder_of(target) != folder:
                inside.add(include_graph.folder_of(target))
    return modules, folders


def reach(graph, node):
    found, front = set(), [node]
    while front:
        for other in graph[front.pop()]:
            if other not in found:
                found.add(other)
                front.append(other)
    return found


def without_detours(graph):
    """Only the arrows that no longer way stands for."""
    return {node: {other for other in others
                   if not any(other in reach(graph, third) for third in others - {other})}
            for node, others in graph.items()}


def from_top(folders, module):
    """Names of the subfolders, those that include others above those that they include."""
    def depth(folder):
        return 1 + max((depth(other) for other in folders[folder]), default=0)
    names = sorted((folder for folder in folders if folder != module),
                   key=lambda folder: (-depth(folder), folder))
    return [name.removeprefix(module + "/") for name in names]


def saying(module):
    heading = (ROOT / module / "README.md").read_text(encoding="utf-8").splitlines()[0]
    return heading.partition(": ")[2].replace("`", "")


def wrapped(words, width):
    lines = [""]
    for word in words:
        if lines[-1] and len(lines[-1]) + 1 + len(word) > width:
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
    return [line for line in lines if line]


def span(module, modules):
    if module in SPANS:
        return SPANS[module]
    if module in COLUMNS:
        return COLUMNS.index(module), COLUMNS.index(module) + 1
    above = [COLUMNS.index(other) for other in COLUMNS if module in modules[other]]
    return min(above), max(above) + 1


class Box:
    def __init__(self, module, modules, folders):
        first, end = span(module, modules)
        self.module = module
        self.x = MARGIN + first * (COLUMN + GAP)
        self.width = (end - first) * (COLUMN + GAP) - GAP
        characters = self.width // 7
        self.says = wrapped(saying(module).split(), characters)
        names = from_top(folders, module)
        self.folders = wrapped([name + "/" for name in names], characters)
        self.height = 26 + LINE * (len(self.says) + len(self.folders))
        self.y = 0

    def middle(self):
        return self.x + self.width / 2

    def nearest(self, x):
        return min(max(x, self.x + 20), self.x + self.width - 20)

    def svg(self):
        yield (f'<rect x="{self.x}" y="{self.y}" width="{self.width}" height="{self.height}" rx="4" '
               'fill="#eef2f5" stroke="#5d7387"/>')
        yield (f'<text x="{self.x + 8}" y="{self.y + 18}" font-weight="bold">{self.module}</text>')
        y = self.y + 18
        for kind, lines in (("#45525c", self.says), ("#9a5a21", self.folders)):
            for line in lines:
                y += LINE
                yield f'<text x="{self.x + 8}" y="{y}" fill="{kind}">{html.escape(line)}</text>'


def place(modules, folders):
    boxes, y = {}, MARGIN
    for row in ROWS:
        row = [Box(module, modules, folders[module]) for module in row]
        for box in row:
            box.y = y
            boxes[box.module] = box
        tallest = max(box.height for box in row)
        for box in row:
            box.height = tallest
        y += tallest + ROW_GAP
    return boxes, y - ROW_GAP + MARGIN


def arrow(source, target):
    """From the lower edge of a box to the upper one of a box below, straight down where it can."""
    x = source.middle()
    if target.width > source.width:
        start, end = x, target.nearest(x)
    else:
        start, end = source.nearest(target.middle()), target.middle()
    if source.y == target.y:
        y = source.y + source.height / 2
        start, end = source.x + source.width, target.x
        return f'<path d="M{start} {y}H{end - 2}" marker-end="url(#head)"/>'
    return (f'<path d="M{start} {source.y + source.height}L{end} {target.y - 3}" '
            'marker-end="url(#head)"/>')


def draw():
    modules, folders = module_includes()
    boxes, height = place(modules, folders)
    width = 2 * MARGIN + len(COLUMNS) * (COLUMN + GAP) - GAP
    yield '<?xml version="1.0" encoding="UTF-8"?>'
    yield "<!-- SPDX-FileCopyrightText: 2026 the Stucco authors -->"
    yield "<!-- SPDX-License-Identifier: GPL-3.0-or-later -->"
    yield "<!-- Made by scripts/draw_architecture.py. -->"
    yield (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
           'font-family="DejaVu Sans, Verdana, sans-serif" font-size="11.5" fill="#24303a">')
    yield "<title>The modules of Stucco; an arrow leads to what a module includes</title>"
    yield f'<rect width="{width}" height="{height}" fill="#ffffff"/>'
    yield ('<defs><marker id="head" markerWidth="8" markerHeight="8" refX="6" refY="3" '
           'orient="auto"><path d="M0 0L7 3L0 6z" fill="#5d7387"/></marker></defs>')
    yield '<g fill="none" stroke="#5d7387" stroke-width="1.3">'
    graph = without_detours(modules)
    for source in sorted(graph, key=list(boxes).index):
        for target in sorted(graph[source], key=list(boxes).index):
            yield arrow(boxes[source], boxes[target])
    yield "</g>"
    for box in boxes.values():
        yield from box.svg()
    yield "</svg>"


if __name__ == "__main__":
    print("\n".join(draw()))
