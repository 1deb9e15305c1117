# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Who includes whom below the modules: circles, and what a module shows to the others."""

import collections
import pathlib
import re

EXPORTS = re.compile(r"add_module\((.*?)\bHEADERS\b(.*?)(?:\bSOURCES\b|\bPUBLIC\b|\bPRIVATE\b|\))",
                     re.S)


def folder_of(path):
    """The folder of a source; internal/ belongs to the folder it lies in."""
    return "/".join(part for part in pathlib.PurePath(path).parent.parts if part != "internal")


def unit_of(path):
    """What x.h, x.cpp and internal/x.h are together."""
    return f"{folder_of(path)}/{pathlib.PurePath(path).stem}"


def circles(edges):
    """Groups of nodes that lead back to each other, each sorted. `edges` is {node: set of nodes}.
    Tarjan, "Depth-first search and linear graph algorithms" (1972), without recursion."""
    index, low, on_stack, stack, found = {}, {}, set(), [], []
    for root in sorted(edges):
        walk = [(root, None)] if root not in index else []
        while walk:
            node, rest = walk.pop()
            if rest is None:
                index[node] = low[node] = len(index)
                stack.append(node)
                on_stack.add(node)
                rest = iter(sorted(edges.get(node, ())))
            for other in rest:
                if other not in index:
                    walk += [(node, rest), (other, None)]
                    break
                if other in on_stack:
                    low[node] = min(low[node], low[other])
            else:
                if low[node] == index[node]:
                    cut = stack.index(node)
                    group = sorted(stack[cut:])
                    on_stack.difference_update(group)
                    del stack[cut:]
                    if len(group) > 1:
                        found.append(group)
                elif walk:
                    above = walk[-1][0]
                    low[above] = min(low[above], low[node])
    return found


def circle_problems(includes):
    """`includes` are pairs of paths, of which the first includes the second."""
    for kind, name_of in (("folders", folder_of), ("files", unit_of)):
        edges = collections.defaultdict(set)
        for source, target in includes:
            if name_of(source) != name_of(target):
                edges[name_of(source)].add(name_of(target))
        for group in circles(edges):
            yield f"{group[0]}: {kind} that include each other in a circle: {', '.join(group)}"


def exported_headers(path, text):
    """The headers that the CMakeLists.txt of a module shows to other modules and installs."""
    text = re.sub(r"#.*", "", text)
    return {str(path.parent / header)
            for _, headers in EXPORTS.findall(text) for header in headers.split()}


def export_problems(includes, exported):
    """A module shows what others include, with what that includes, and nothing else. `includes` are
    pairs of paths as above, `exported` paths of headers."""
    modules = {path.split("/")[0] for path in exported}
    used = set()
    for source, target in sorted(includes):
        crosses = source.split("/")[0] != target.split("/")[0]
        if target.split("/")[0] not in modules or not (crosses or source in exported):
            continue
        used.add(target)
        if target not in exported:
            yield f"{source}: {target} is not among the HEADERS that its CMakeLists.txt exports"
    for header in sorted(exported - used):
        yield f"{header}: is exported, but no other module includes it"
