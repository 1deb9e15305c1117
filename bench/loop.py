#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole loop in a made scene: plans, flies, reconstructs and measures it against truth.

  bench/loop.py OUT [--style hamlet] [--seed 1] [--method cocapture] [--scale 0.25]
                [--plan-args="--altitude 30"] [--fly-args="--rtk --held-out 5"] [--run-args "..."]
                [--stucco PROGRAM]

Scale is that of the camera's pixels: 0.25 gives photos a quarter as wide. What OUT already has is
not made again. Printed is a row for docs/benchmarks.md; the figures of every loop are added to
OUT/figures.ndjson as one line of JSON.
"""
import argparse
import json
import pathlib
import shlex
import sys

import surveys

HEAD = ["scene", "method", "photos", "posed", "position (mm)", "georeferenced (m)", "rotation (deg)",
        "cloud error, m", "complete", "model error, m", "complete", "walls, m", "watertight",
        "facets / truth", "ids", "SSIM", "FLIP", "misregistration (px)", "run (s)"]


def percent(value):
    return "-" if value is None else f"{100 * value:.1f} %"


def row(scene, figures):
    """The cells of HEAD."""
    poses, dense, proxy = figures["poses"], figures["dense"], figures["proxy"]
    texture, plan = figures["texture"], figures.get("plan") or {}
    position = poses["position_mean_m"]
    walls = [cost["wall_s"] for cost in figures["stages"].values()
             if cost["wall_s"] is not None]
    return [scene, plan.get("method", "-"), plan.get("photos", "-"),
            f"{poses['posed']} / {poses['total']}",
            surveys.number(None if position is None else 1000 * position, 1),
            surveys.number(poses["georeferenced_mean_m"]),
            surveys.number(poses["rotation_mean_deg"], 4),
            surveys.number(dense["error95_m"], 3), percent(dense["completeness"]),
            surveys.number(proxy["error95_m"], 3), percent(proxy["completeness"]),
            surveys.number(proxy["wall_error95_m"], 3),
            f"{proxy['watertight']} / {proxy['truth_buildings']}",
            f"{proxy['facets']} / {proxy['truth_facets']}", percent(proxy["facade_id_rate"]),
            surveys.number(texture["ssim_mean"], 3), surveys.number(texture["flip_mean"], 3),
            surveys.number(texture["misregistration_px"]), surveys.number(sum(walls) if walls else None, 0)]


def add_loop_arguments(parser):
    """What every command that flies a made scene understands."""
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--style", default="hamlet")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scale", default="0.25")
    for step in ("plan", "fly", "run"):
        parser.add_argument(f"--{step}-args", type=shlex.split, default=[], metavar="WORDS")
    parser.add_argument("--stucco", default=str(surveys.PROGRAM))


def fly(arguments, method):
    """One loop; its survey is OUT/STYLE-SEED-METHOD-SCALE."""
    scene = surveys.make_scene(arguments.stucco, arguments.out, arguments.style, arguments.seed)
    survey = arguments.out / f"{scene.name}-{method}-{arguments.scale}"
    options = {"method": method, "scale": arguments.scale, "plan": arguments.plan_args,
               "fly": arguments.fly_args, "run": arguments.run_args}
    figures = surveys.fly_loop(arguments.stucco, scene, survey, options)
    with open(arguments.out / "figures.ndjson", "a", encoding="utf-8") as log:
        log.write(json.dumps({"name": survey.name, "scale": arguments.scale, **figures}) + "\n")
    return scene.name, figures


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    add_loop_arguments(parser)
    parser.add_argument("--method", default="cocapture")
    arguments = parser.parse_args()
    try:
        print(surveys.markdown_table(HEAD, [row(*fly(arguments, arguments.method))]))
    except (OSError, surveys.Failed) as error:
        sys.exit(f"loop: {error}")


if __name__ == "__main__":
    main()
