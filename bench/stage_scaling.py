#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How the time of each stage grows with the number of photos.

  bench/stage_scaling.py SURVEY OUT [--photos 20 40 80 160] [--run-args ...] [--stucco PROGRAM]

SURVEY is a flown one. Its first 20, 40 ... photos, in the order in which they were taken and so of
one part of the site after another, become surveys of their own, without the plan. Printed are wall
seconds by stage, and the exponent of the time over photos from each size to the next: 1 is linear.
"""
import argparse
import json
import math
import os
import pathlib
import shlex
import sys

import surveys


def photos_in_order(survey):
    """Paths below SURVEY/photos in the order in which they were taken."""
    flight = json.loads((survey / "truth/flight.json").read_text())
    return [photo["path"] for photo in flight["photos"]
            if not photo.get("lost") and not photo.get("held_out")]


def link_photos(survey, paths, folder):
    for path in paths:
        target = folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        os.link(survey / "photos" / path, target)


def exponents(before, after):
    """By stage, for (photos, {stage: seconds}) of two sizes; stages of under a second say nothing."""
    step = math.log(after[0] / before[0])
    return {stage: math.log(seconds / before[1][stage]) / step
            for stage, seconds in after[1].items() if min(seconds, before[1].get(stage, 0)) >= 1}


def seconds_of(survey):
    seconds = {stage: cost["wall_s"] for stage, cost in surveys.stage_costs(survey).items()
               if cost["wall_s"] is not None}
    return {**seconds, "all": sum(seconds.values())}


def run_part(arguments, paths):
    survey = arguments.out / f"photos-{len(paths)}"
    if not survey.exists():
        photos = arguments.out / f"links-{len(paths)}"
        link_photos(arguments.survey, paths, photos)
        surveys.run_step([arguments.stucco, "init", survey, "--photos", photos],
                         arguments.out / f"logs/{survey.name}-init.log")
    surveys.run_step([arguments.stucco, "run", survey, *arguments.run_args],
                     arguments.out / f"logs/{survey.name}-run.log")
    return len(paths), seconds_of(survey)


def table(sizes):
    columns = [*surveys.STAGES, "all"]
    rows = []
    for i, (photos, seconds) in enumerate(sizes):
        growth = exponents(sizes[i - 1], sizes[i]) if i else {}
        rows.append([photos, *(surveys.number(seconds.get(stage), 1) +
                               (f" ({growth[stage]:.2f})" if stage in growth else "")
                               for stage in columns)])
    return surveys.markdown_table(["photos", *columns], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("survey", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--photos", type=int, nargs="+", default=[20, 40, 80, 160])
    parser.add_argument("--run-args", type=shlex.split, default=[], metavar="WORDS")
    parser.add_argument("--stucco", default=str(surveys.PROGRAM))
    arguments = parser.parse_args()
    try:
        paths = photos_in_order(arguments.survey)
        sizes = sorted({min(count, len(paths)) for count in arguments.photos})
        print(table([run_part(arguments, paths[:count]) for count in sizes]))
    except (OSError, ValueError, surveys.Failed) as error:
        sys.exit(f"stage_scaling: {error}")


if __name__ == "__main__":
    main()
