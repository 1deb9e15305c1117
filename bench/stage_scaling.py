#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How the time of each stage grows with the number of photos.

  bench/stage_scaling.py SURVEY OUT [--photos 20 40 80 160] [--run-args ...] [--again run]
                         [--stucco PROGRAM]

SURVEY is a flown one. Its first 20, 40 ... photos, in the order in which they were taken and so of
one part of the site after another, become surveys of their own, without the plan. Printed are wall
and CPU seconds by stage, and the exponent of each over photos from one size to the next: 1 is
linear. On a machine that does other work as well only CPU seconds mean something. Sizes that are
finished are not run again; times with a ≥ are of stages that were stopped and went on.
"""
import argparse
import json
import math
import os
import pathlib
import shlex
import shutil
import sys

import steps
import surveys


def photos_in_order(survey):
    """Paths below SURVEY/photos in the order in which they were taken."""
    flight = json.loads((survey / "truth/flight.json").read_text())
    return [photo["path"] for photo in flight["photos"]
            if not photo.get("lost") and not photo.get("held_out")]


def link_photos(survey, paths, folder):
    """A folder with these photos and no others."""
    part = folder.with_name(folder.name + ".part")
    shutil.rmtree(part, ignore_errors=True)  # of one that was stopped
    for path in paths:
        target = part / path
        target.parent.mkdir(parents=True, exist_ok=True)
        try:
            os.link(survey / "photos" / path, target)
        except OSError:  # on another disk
            shutil.copy2(survey / "photos" / path, target)
    part.rename(folder)


def exponents(before, after):
    """By stage, for (photos, {stage: seconds}) of two sizes; stages of under a second say nothing."""
    step = math.log(after[0] / before[0])
    return {stage: math.log(seconds / before[1][stage]) / step
            for stage, seconds in after[1].items() if min(seconds, before[1].get(stage, 0)) >= 1}


def run_part(arguments, paths):
    """Number of photos, and what each stage cost. A run that fails counts as far as it came."""
    survey = arguments.out / f"photos-{len(paths)}"
    chain = steps.Chain(arguments.out / "logs", survey.name, ("init", "run"), again=arguments.again)
    photos = arguments.out / f"links-{len(paths)}"
    if not photos.exists():
        link_photos(arguments.survey, paths, photos)
    settings = survey / "survey.toml"
    if not settings.exists():
        chain.run("init", [arguments.stucco, "init", survey, "--photos", photos], settings)
    try:
        chain.run("run", [arguments.stucco, "run", survey, *arguments.run_args], survey / ".stucco",
                  goes_on=True)
    except steps.Failed as failure:
        print(f"stage_scaling: {failure}", file=sys.stderr)
    return len(paths), surveys.stage_costs(survey), chain.commits()


def seconds_of(costs, which):
    """By stage, of stages that were measured as a whole, and of all where all were."""
    seconds = {stage: cost[which] for stage, cost in costs.items()
               if cost[which] is not None and not cost["in_part"]}
    return {**seconds, "all": sum(seconds.values())} if len(seconds) == len(costs) else seconds


def table(sizes, which):
    rows = []
    for i, (photos, costs, _) in enumerate(sizes):
        seconds = seconds_of(costs, which)
        before = sizes[i - 1] if i else None
        growth = exponents((before[0], seconds_of(before[1], which)), (photos, seconds)) if i else {}
        cells = {stage: surveys.seconds(cost, which, 1) for stage, cost in costs.items()}
        cells["all"] = surveys.number(seconds.get("all"), 1)
        rows.append([photos, *(cells.get(stage, "-") +
                               (f" ({growth[stage]:.2f})" if stage in growth else "")
                               for stage in (*surveys.STAGES, "all"))])
    name = {"wall_s": "wall s", "cpu_s": "CPU s"}[which]
    return surveys.markdown_table([f"photos, {name}", *surveys.STAGES, "all"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("survey", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--photos", type=int, nargs="+", default=[20, 40, 80, 160])
    parser.add_argument("--run-args", type=shlex.split, default=[], metavar="WORDS")
    parser.add_argument("--again", choices=["run"])
    parser.add_argument("--stucco", default=str(surveys.PROGRAM))
    arguments = parser.parse_args()
    try:
        paths = photos_in_order(arguments.survey)
        counts = sorted({min(count, len(paths)) for count in arguments.photos})
        sizes = [run_part(arguments, paths[:count]) for count in counts]
    except (OSError, ValueError, steps.Failed) as error:
        sys.exit(f"stage_scaling: {error}")
    print(table(sizes, "wall_s") + "\n\n" + table(sizes, "cpu_s"))
    commits = dict.fromkeys(name for _, _, found in sizes for name in found)
    if commits:
        print("\nCommit " + ", ".join(commits) + ".")


if __name__ == "__main__":
    main()
