#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How many megapixels a CPU second the simulator photographs in a made scene.

  bench/render_speed.py OUT [--style block] [--seed 1] [--views 6] [--width 4000] [--threads 1]
                        [--stucco PROGRAM]

Makes the scene and its plan unless OUT has them, keeps N of the planned views, half of them from
before facades and half from above, spread evenly over the flight, gives the plan's camera pictures
of the width wanted, and flies them into OUT/photos-N-WIDTH. Prints photos, megapixels, CPU seconds
and megapixels a CPU second: of drawing with shadows and edges smoothed, and of all that makes a
photo of it, blur, noise, JPEG and EXIF; not of reading the scene and of finding how much of the sky
each place sees, which is done once for a flight. CPU seconds count the threads' own time alone, so
that other work on the machine hardly changes them.
"""
import argparse
import json
import pathlib
import shutil
import subprocess

import loop
import surveys


def spread(views, count):
    views = sorted(views, key=lambda view: view["order"])
    count = min(count, len(views))
    return [views[(2 * i + 1) * len(views) // (2 * count)] for i in range(count)]


def some_views(plan, count, width):
    """The plan with `count` of its views and pictures of another size."""
    from_above = {"nadir", "oblique"}
    views = (spread([view for view in plan["views"] if view["kind"] not in from_above],
                    count - count // 2)
             + spread([view for view in plan["views"] if view["kind"] in from_above], count // 2))
    kept = {view["id"] for view in views}
    camera = plan["camera"]
    size = {"width_px": width,
            "height_px": round(camera["height_px"] * width / camera["width_px"])}
    facades = [{**facade, "views": [view for view in facade["views"] if view in kept]}
               for facade in plan["facades"]]
    rest = {name: value for name, value in plan.items() if name != "flights"}
    return rest | {"views": views, "facades": facades, "camera": camera | size}


def fly(args):
    """What the flight says about itself (stucco simulate --json)."""
    scene = loop.make_scene(args.stucco, args.out, args.style, args.seed)
    planned = args.out / f"{scene.name}-plan"
    if not (planned / "plan/plan.json").exists():
        subprocess.run(loop.plan_command(args.stucco, scene, planned, "cocapture", ["--quiet"]),
                       check=True)
    survey = args.out / f"photos-{args.views}-{args.width}"
    shutil.rmtree(survey, ignore_errors=True)
    plan = args.out / f"{survey.name}.json"
    plan.write_text(json.dumps(some_views(json.loads((planned / "plan/plan.json").read_text()),
                                          args.views, args.width)))
    flown = subprocess.run([args.stucco, "simulate", scene, plan, "-o", survey, "--json",
                            "--threads", str(args.threads)], check=True, stdout=subprocess.PIPE)
    return json.loads(flown.stdout)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--style", default="block")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--views", type=int, default=6)
    parser.add_argument("--width", type=int, default=4000)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--stucco", default=str(surveys.PROGRAM))
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)
    flight = fly(args)
    print(surveys.markdown_table(
        ["photos", "megapixels", "CPU s", "megapixels a CPU second"],
        [[flight["rendered"], surveys.number(flight["megapixels"], 1),
          surveys.number(flight["cpu_s"], 1),
          surveys.number(flight["megapixels"] / flight["cpu_s"])]]))


if __name__ == "__main__":
    main()
