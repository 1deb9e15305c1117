#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Kills runs of a survey at random moments, continues them, and compares the result with a run that
nobody disturbed.

  bench/kill_campaign.py PHOTOS OUT [--kills 20] [--seed 1] [--threads 2] [--stucco PROGRAM]
                         [-- ARGS]

Fails when an output differs in a byte, when a unit was computed again after its checkpoint, or when
a file of the photo folder changed. ARGS go to `stucco run`.
"""
import argparse
import pathlib
import random
import signal
import subprocess
import sys
import time

import surveys


def start(arguments, survey):
    return subprocess.Popen(
        [arguments.stucco, "run", survey, "--threads", str(arguments.threads), *arguments.args],
        stdout=subprocess.DEVNULL, stderr=(arguments.out / "log").open("ab"))


def finish(process):
    code = process.wait()
    if code != 0:
        sys.exit(f"kill_campaign: a run ended with exit code {code}; see the log")


def undisturbed(arguments):
    survey = arguments.out / "undisturbed"
    surveys.init(arguments.stucco, survey, arguments.photos)
    begin = time.monotonic()
    finish(start(arguments, survey))
    return survey, time.monotonic() - begin


def killed_survey(arguments, survey, wall_s, kills, rng):
    """Kills up to `kills` runs of one survey, then lets it finish. Returns the number of kills."""
    surveys.init(arguments.stucco, survey, arguments.photos)
    done = 0
    while done < kills:
        process = start(arguments, survey)
        moment = rng.uniform(0, 2 * wall_s / arguments.kills)
        try:
            code = process.wait(timeout=moment)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.wait()
            done += 1
            print(f"{survey.name}: killed after {moment:.2f} s", flush=True)
            continue
        if code != 0:
            sys.exit(f"kill_campaign: a continued run ended with exit code {code}; see the log")
        return done
    finish(start(arguments, survey))
    return done


def problems(survey, expected):
    found = surveys.differences(expected, surveys.outputs(survey))
    twice, units = surveys.computed_twice(
        (survey / ".stucco/events.ndjson").read_text().splitlines())
    found += [f"computed twice: {' '.join(unit)}" for unit in twice]
    print(f"{survey.name}: {len(expected)} outputs, {units} units, {len(found)} problems")
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("photos", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--stucco", default=str(surveys.PROGRAM))
    arguments = surveys.parse(parser)
    arguments.out.mkdir(parents=True)
    rng = random.Random(arguments.seed)
    photos_before = surveys.outputs(arguments.photos)
    survey, wall_s = undisturbed(arguments)
    expected = surveys.outputs(survey)
    print(f"undisturbed: {len(expected)} outputs in {wall_s:.1f} s", flush=True)
    found, kills, number = problems(survey, expected), 0, 0
    # A survey that finishes before all kills are spent makes room for another one.
    while kills < arguments.kills:
        number += 1
        survey = arguments.out / f"killed-{number}"
        kills += killed_survey(arguments, survey, wall_s, arguments.kills - kills, rng)
        found += problems(survey, expected)
    if surveys.outputs(arguments.photos) != photos_before:
        found.append("the photo folder changed")
    print("\n".join(found) or f"{kills} kills in {number} surveys: outputs identical to the byte, "
          "no unit computed twice, photos untouched")
    sys.exit(bool(found))


if __name__ == "__main__":
    main()
