#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How much faster two threads optimise dipping views than one, and whether the plans are the same.

  bench/plan_threads.py MAP OUT [--repeat 3] [--stucco PROGRAM] [-- ARGS for `stucco plan`]

Runs alternate between one and two threads; printed are the best times of each and their ratio.
"""
import argparse
import pathlib
import re
import subprocess
import sys
import time

import surveys


def plan(program, arguments, threads, out):
    begin = time.monotonic()
    done = subprocess.run([program, "plan", arguments.map, "-o", out, "--threads", str(threads),
                           *arguments.args], check=True, capture_output=True, text=True)
    found = re.search(r"optimised in \d+ rounds and ([\d.]+) s", done.stderr)
    return float(found[1]), time.monotonic() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("map")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--stucco", default=str(surveys.PROGRAM))
    arguments = surveys.parse(parser)
    times = {1: [], 2: []}
    for _ in range(arguments.repeat):
        for threads, some in times.items():
            some.append(plan(arguments.stucco, arguments, threads,
                             arguments.out / f"threads-{threads}"))
    for index, what in enumerate(("optimisation", "whole plan")):
        one, two = (min(t[index] for t in times[threads]) for threads in (1, 2))
        print(f"{what}: {one:.2f} s with one thread, {two:.2f} s with two: {one / two:.2f} times")
    files = [(arguments.out / f"threads-{threads}/plan/plan.json").read_bytes()
             for threads in (1, 2)]
    print("the same plan" if files[0] == files[1] else "DIFFERENT plans")
    sys.exit(files[0] != files[1])


if __name__ == "__main__":
    main()
