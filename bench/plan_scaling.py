#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How planning time and memory grow with the number of buildings at equal density.

  bench/plan_scaling.py OUT [--buildings 10 40 160 640] [--seed 1] [--stucco PROGRAM]
                        [-- ARGS for `stucco plan`]

The exponent is that of time over buildings from each size to the next: 1 is linear.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys

import measure
import surveys

BENCH = pathlib.Path(__file__).parent


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--buildings", type=int, nargs="+", default=[10, 40, 160, 640])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--stucco", default=str(surveys.PROGRAM))
    arguments = surveys.parse(parser)
    arguments.out.mkdir(parents=True)
    before = None
    for count in arguments.buildings:
        town = arguments.out / f"town-{count}.geojson"
        subprocess.run([sys.executable, BENCH / "make_town.py", "--buildings", str(count),
                        "--seed", str(arguments.seed), "-o", town], check=True)
        survey = arguments.out / f"plan-{count}"
        cost = measure.measure([arguments.stucco, "plan", str(town), "-o", str(survey), "--quiet",
                                *arguments.args])
        if cost["exit_code"] != 0:
            sys.exit(f"{town}: stucco plan ended with {cost['exit_code']}")
        stats = json.loads((survey / "plan/stats.json").read_text())
        found = len(json.loads((survey / "plan/plan.json").read_text())["footprints"])
        exponent = (math.log(cost["wall_s"] / before[1]) / math.log(found / before[0])
                    if before else float("nan"))
        print(f"{found:6} buildings: {cost['wall_s']:8.1f} s wall {cost['cpu_s']:8.1f} s CPU "
              f"{cost['peak_memory_mb']:7.0f} MiB  {stats['photos']:6} photos "
              f"{stats['hovers']:6} hovers  gap {100 * stats['tsp_gap']:.1f} %  "
              f"exponent {exponent:.2f}", flush=True)
        before = (found, cost["wall_s"])


if __name__ == "__main__":
    main()
