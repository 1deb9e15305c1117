#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the sources and says where they break the rules of the architecture.

Usage: check_architecture.py ROOT     (exit code 1 when a rule is broken)

CMake's link lists cannot stop an include, because all modules share one include root; so the
includes themselves are read here.
"""

import os
import pathlib
import re
import sys

import include_graph
import link_lists

STAGES = {"plan", "capture_ingest", "calib", "dense", "proxy", "texture", "report"}

# What the sources of a module may include besides their own module.
ARROWS = {stage: {"survey"} for stage in STAGES}
ARROWS["survey"] = set()
ARROWS["exchange"] = {"survey"}
ARROWS["site"] = {"survey"}
for stage in ("plan", "calib", "proxy", "texture"):
    ARROWS[stage] = {"survey", "site"}
ARROWS["pipeline"] = STAGES | {"survey", "site", "exchange"}
ARROWS["simulate"] = {"survey", "site", "plan"}
ARROWS["evaluate"] = {"survey", "site", "simulate"}
ARROWS["cli"] = {"pipeline", "survey", "simulate", "evaluate"}
MODULES = set(ARROWS)

# Narrower arrows, for the sources below a folder: beginnings of all that they may include of any
# module. What decides and runs knows neither the verbs nor any stage; the program knows the engine
# by its front door.
FOLDER_ARROWS = {
    "pipeline/engine/": ("pipeline/engine/", "survey/"),
    "pipeline/verbs/": ("pipeline/engine/", "pipeline/verbs/", "calib/localise/localise.h",
                        "calib/options/calib_options.h", "calib/records/placement.h",
                        "capture_ingest/ingest.h", "exchange/", "plan/",
                        "proxy/imported/proxy_of_surfaces.h", "proxy/output/cityjson.h",
                        "proxy/output/proxy_files.h", "report/epoch_report.h", "survey/",
                        "texture/options/texture_options.h", "texture/output/tiles_3d.h",
                        "texture/output/write_glb.h", "texture/repaint.h"),
    "cli/": ("cli/", "evaluate/", "pipeline/default_stages.h", "pipeline/engine/engine.h",
             "pipeline/verbs/", "simulate/", "survey/"),
}

# Folders of a module from the bottom up; each includes those before it. "." are the files beside the
# folders.
FLOORS = {
    "calib": ("options", "expect", "features", "scene", "two_view", "adjust", "records", "mapping",
              "matching", "control", "parts", "localise", "results", "."),
    "evaluate": ("figures", "geometry", "picture", "page", "."),
    "plan": ("options", "camera", "safety", "map", "space", "quality", "evaluate", "dipping",
             "planar", "match", "baseline", "path", "output", "mission", "field", "."),
    "proxy": ("options", "cloud", "planes", "scene", "facets", "solids", "map", "terrain", "output",
              "imported", "."),
    "simulate": (".", "scene", "paint", "city", "render", "flight"),
    "texture": ("options", "grid", "photos", "light", "views", "relief", "selection", "painting",
                "output", "epoch", "."),
}

# The virtual drone and the measuring of results may serve any test.
FOR_TESTS = {"survey", "simulate", "evaluate"}

# Headers that cost seconds in every file that sees them. Public headers do without.
HEAVY = re.compile(
    r"CGAL/|opencv2/(?!core[./])|ceres/|pcl/|assimp/|embree3/|nlohmann/"
    r"|gdal|ogr_|ogrsf_|cpl_")

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"\n]+)[>"]', re.M)

# Types of a header. All modules share the namespace stucco: two types of one name in it are two
# destructors of which the linker keeps one, for both.
NAMESPACE = re.compile(r"^namespace (\S+) \{", re.M)
TYPE = re.compile(r"^(?:struct|class|enum class|enum) (\w+)\b[^;({]*\{", re.M)

MAX_LINES = 500
SOURCES = {".h", ".cpp"}
SPDX_SUFFIXES = {".h", ".cpp", ".cmake", ".py", ".sh"}
SPDX_MARKS = ("SPDX-FileCopyrightText:", "SPDX-License-Identifier:")
SPDX_WITHIN_LINES = 3  # the first may be #!


def find_files(root):
    """Files of the repository by path, without hidden folders and build trees."""
    found = []
    for folder, folders, names in os.walk(root):
        if "CMakeCache.txt" in names:
            folders.clear()
            continue
        folders[:] = sorted(
            name for name in folders
            if not name.startswith(".") and name not in {"build", "node_modules", "__pycache__"})
        found += [pathlib.Path(folder, name).relative_to(root) for name in sorted(names)]
    return found


def may_include(path):
    """The modules that a source file may include, or None where every module is allowed."""
    top = path.parts[0]
    if top in MODULES:
        return ARROWS[top] | {top}
    if top == "tests" and path.parts[1] in MODULES:
        return ARROWS[path.parts[1]] | {path.parts[1]} | FOR_TESTS
    return None


def folder_may_not(path, include):
    """True when the folder of a source file has arrows of its own and none leads to `include`."""
    for folder, allowed in FOLDER_ARROWS.items():
        if str(path).startswith(folder):
            return not include.startswith(allowed)
    return False


def floor(parts):
    """The folder of a module that a file with these parts of a path is in, without internal/."""
    return parts[1] if len(parts) > 2 and parts[1] != "internal" else "."


def climbs(path, include):
    """True when a source file includes one of a folder of its module that stands above its own."""
    floors = FLOORS.get(path.parts[0])
    parts = include.split("/")
    own, other = floor(path.parts), floor(parts)
    if parts[0] != path.parts[0] or floors is None or not {own, other} <= set(floors):
        return False
    return floors.index(other) > floors.index(own)


def floor_problems(path):
    floors = FLOORS.get(path.parts[0])
    if floors is not None and floor(path.parts) not in floors:
        yield f"{path}: FLOORS of check_architecture.py do not know this folder"


def owner(path):
    """The module that a source file belongs to; a module's tests count as its own."""
    top = path.parts[0]
    return path.parts[1] if top == "tests" and len(path.parts) > 2 else top


def include_problems(path, text):
    allowed = may_include(path)
    is_public = path.suffix == ".h" and path.parts[0] in MODULES and "internal" not in path.parts
    for quote, include in INCLUDE.findall(text):
        target = include.split("/")[0]
        if quote == '"' and target not in MODULES | {"tests"}:
            yield f'{path}: write #include "module/file.h" instead of "{include}"'
            continue
        if target in MODULES and allowed is not None and target not in allowed:
            yield f"{path}: {owner(path)} may not include {include}"
        elif target in MODULES and folder_may_not(path, include):
            yield f"{path}: {path.parent} may not include {include}"
        elif climbs(path, include):
            yield f"{path}: {path.parent} stands below {include}"
        if target == "tests" and path.parts[0] != "tests":
            yield f"{path}: only tests may include {include}"
        if target in MODULES and "/internal/" in include and target != owner(path):
            yield f"{path}: {include} is internal to {target}"
        if is_public and target in MODULES and "/internal/" in include:
            yield f"{path}: public header includes {include}"
        if is_public and HEAVY.match(include):
            yield f"{path}: public header includes heavy {include}"


def includes_of(path, text):
    """Pairs (path, included header of a module); tests may include what is not exported."""
    if path.parts[0] == "tests":
        return set()
    return {(str(path), include) for _, include in INCLUDE.findall(text)
            if include.split("/")[0] in MODULES}


def size_problems(path, text):
    lines = len(text.splitlines())
    if lines > MAX_LINES:
        yield f"{path}: {lines} lines, {MAX_LINES} are the limit"


def spdx_problems(path, text):
    head = text.splitlines()[:SPDX_WITHIN_LINES]
    if not all(any(mark in line for line in head) for mark in SPDX_MARKS):
        yield f"{path}: does not begin with the two SPDX lines"


def types_of(path, text):
    """Names, with their namespace, of the types that a header of a module defines."""
    if path.suffix != ".h" or path.parts[0] not in MODULES:
        return set()
    namespace = NAMESPACE.search(text)
    return {f"{namespace[1]}::{name}" for name in TYPE.findall(text)} if namespace else set()


def readme_problems(root):
    for module in sorted(MODULES):
        folder = root / module
        if (folder / "CMakeLists.txt").exists() and not (folder / "README.md").exists():
            yield f"{module}: has no README.md"


def problems(root):
    """Every broken rule below `root`, as lines to print."""
    root = pathlib.Path(root)
    found = list(readme_problems(root))
    header_of = {}
    includes, exported = set(), set()
    for path in find_files(root):
        is_source = path.suffix in SOURCES
        if not is_source and path.suffix not in SPDX_SUFFIXES and path.name != "CMakeLists.txt":
            continue
        text = (root / path).read_text(encoding="utf-8", errors="replace")
        found += spdx_problems(path, text)
        found += size_problems(path, text)
        if is_source:
            found += include_problems(path, text)
            found += floor_problems(path)
            includes |= includes_of(path, text)
        elif path.name == "CMakeLists.txt":
            found += link_lists.problems(path, text, may_include(path) or MODULES, MODULES)
            if path.parts[0] in MODULES:
                exported |= include_graph.exported_headers(path, text)
        for name in sorted(types_of(path, text)):
            if name in header_of:
                found.append(f"{path}: {name} is a type of {header_of[name]}, too")
            header_of.setdefault(name, path)
    inside = {pair for pair in includes if pair[0].split("/")[0] in MODULES}
    found += include_graph.circle_problems(inside)
    found += include_graph.export_problems(includes, exported)
    return found


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    found = problems(arguments[1])
    print("\n".join(found) or "The architecture holds.")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv))
