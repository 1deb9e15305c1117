#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The three planning methods flown in the same scenes and reconstructed by the same pipeline.

  bench/methods_flown.py OUT [--style hamlet] [--seeds 1 2 ...] [--methods oblique ...]
                         and all that loop.py takes

Prints the tables of the paper (Xiong et al., "Aerial Path Planning for Urban Geometry and Texture
Co-Capture", 2025): what flying costs, what the cloud and the model are worth (its table 2), and
what the textures are worth (its tables 3 and 4); and the time of each stage. Compare methods by
what is complete of everything, seen or not: no method gains by photos that show less. Goes on where
it was stopped, as loop.py does.
"""
import argparse
import sys

import loop
import steps

METHODS = ("oblique", "dronescan", "cocapture")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    loop.add_loop_arguments(parser)
    parser.add_argument("--seeds", type=int, nargs="+")
    parser.add_argument("--methods", nargs="+", default=METHODS)
    arguments = parser.parse_args()
    flown, failures = [], 0
    for arguments.seed in arguments.seeds or [arguments.seed]:
        for method in arguments.methods:
            try:
                scene, figures = loop.fly(arguments, method)
                flown.append((scene, method, figures))
            except (OSError, steps.Failed) as error:  # the other methods still count
                print(f"methods_flown: {error}", file=sys.stderr)
                failures += 1
    print(loop.tables(flown))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
