# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the CMakeLists.txt of modules and of their tests link."""

import re

LINKS = re.compile(r"\b(?:PUBLIC|PRIVATE|LINK)\b([^()]*?)(?=\b(?:PUBLIC|PRIVATE|LINK)\b|\))")

# What a build without the virtual drone has not, and where a list may count on it.
OPTIONAL = {"simulate", "evaluate"}
WITH_OPTIONAL = re.compile(r"\bif\(STUCCO_SIMULATE\).*?\b(?:else|endif)\(", re.DOTALL)


def links(text, modules):
    words = {word for linked in LINKS.findall(text) for word in linked.split()}
    return sorted(words & modules)


def problems(path, text, allowed, modules):
    """`allowed` are the modules that the sources beside `path` may include."""
    text = re.sub(r"#.*", "", text)
    for module in links(text, modules):
        if module not in allowed:
            yield f"{path}: may not link {module}"
    if OPTIONAL & set(path.parts):
        return
    for module in links(WITH_OPTIONAL.sub("", text), OPTIONAL):
        yield f"{path}: links {module} where STUCCO_SIMULATE may be off"
