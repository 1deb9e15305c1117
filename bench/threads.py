#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a survey once with one thread and once with two and compares every output byte.

  bench/threads.py PHOTOS OUT [--counts 1 2] [--stucco PROGRAM] [-- ARGS for `stucco run`]
"""
import argparse
import pathlib
import subprocess
import sys
import time

import surveys


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("photos", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--counts", type=int, nargs=2, default=[1, 2])
    parser.add_argument("--stucco", default=str(surveys.PROGRAM))
    arguments = surveys.parse(parser)
    arguments.out.mkdir(parents=True)
    results = []
    for count in arguments.counts:
        survey = arguments.out / f"threads-{count}"
        surveys.init(arguments.stucco, survey, arguments.photos)
        begin = time.monotonic()
        with (arguments.out / "log").open("ab") as log:
            subprocess.run([arguments.stucco, "run", survey, "--threads", str(count),
                            *arguments.args], check=True, stdout=subprocess.DEVNULL, stderr=log)
        print(f"{count} threads: {time.monotonic() - begin:.1f} s", flush=True)
        results.append(surveys.outputs(survey))
    found = surveys.differences(*results)
    print("\n".join(found) or f"{len(results[0])} outputs, identical to the byte")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
