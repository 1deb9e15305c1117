#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The ten slowest translation units of the builds recorded in a .ninja_log.

  scripts/slowest_units.py [build/dev/.ninja_log]
"""
import pathlib
import sys


def slowest(lines, count=10):
    """(seconds, object file), slowest first. A file's last build counts."""
    seconds = {}
    for line in lines:
        fields = line.split("\t")
        if len(fields) >= 4 and fields[3].endswith(".o"):
            seconds[fields[3]] = (int(fields[1]) - int(fields[0])) / 1000
    return sorted(((s, name) for name, s in seconds.items()), reverse=True)[:count]


def main():
    path = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/dev/.ninja_log")
    if not path.exists():
        sys.exit(f"slowest_units: {path} is missing; build first")
    print("slowest translation units (s):")
    for seconds, name in slowest(path.read_text().splitlines()):
        print(f"{seconds:8.1f}  {name}")


if __name__ == "__main__":
    main()
