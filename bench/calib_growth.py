#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How calibration grows with the area: its steps' time and memory for parts of one flown survey.

  bench/calib_growth.py SURVEY OUT [--photos 50 100 200 400 800] [--records plan gps none]
                        [--run-args WORDS] [--again run] [--stucco PROGRAM]

SURVEY was planned, flown and ingested; it is only read. The 50, 100 ... photos nearest to its
middle become surveys of their own: with the plan, without it, and without any metadata (Exiv2's
program is needed for that, apt-get install exiv2). Printed are CPU and wall seconds by step, the
largest memory, how many photos have poses, the exponents of photos that fit the seconds best (1 is
linear), and what each size costs beside the same photos without metadata. Memory by step is what
the log saw every five seconds. On a machine that does other work as well only CPU seconds mean
something. Sizes that are finished are not run again.
"""
import argparse
import json
import math
import pathlib
import shlex
import shutil
import statistics
import subprocess
import sys

import stage_scaling
import steps
import surveys

SHORT = {"detecting features": "detect", "matching pairs": "match", "correcting records": "correct",
         "placing photos": "place"}
ADJUSTING = ("correcting records", "placing photos")


def usable_photos(survey):
    """What ingest says of the photos that were used."""
    captures = json.loads((survey / "ingest/captures.json").read_text(encoding="utf-8"))
    photos = [photo for photo in captures["photos"] if photo["usable"] and photo.get("position")]
    if not photos:
        raise ValueError(f"{survey}: no photo has a position, so that there is no middle to cut "
                         "parts from; fly it with positions")
    return photos


def nearest_to_middle(photos, count):
    """Paths of the `count` photos nearest to the middle of all, in their order."""
    def place(photo):
        position = photo["position"]
        latitude = position["latitude_deg"]
        return (position["longitude_deg"] * math.cos(math.radians(latitude)), latitude)

    places = [place(photo) for photo in photos]
    middle = [statistics.median(axis) for axis in zip(*places)]
    order = sorted(range(len(photos)), key=lambda i: (math.dist(places[i], middle), i))
    return [photos[i]["path"] for i in sorted(order[:count])]


def copy_photos(survey, paths, folder):
    """Without any metadata."""
    part = folder.with_name(folder.name + ".part")
    shutil.rmtree(part, ignore_errors=True)  # of one that was stopped
    for path in paths:
        target = part / path
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(survey / "photos" / path, target)
        subprocess.run(["exiv2", "-d", "a", target], check=True, stdout=subprocess.DEVNULL)
    part.rename(folder)


def prepare(arguments, records, paths):
    """The survey of these photos, and the chain of what is run in it."""
    name = f"{records}-{len(paths)}"
    survey = arguments.out / name
    chain = steps.Chain(arguments.out / "logs", name, ("init", "run"), again=arguments.again)
    photos = arguments.out / f"photos-{'bare' if records == 'none' else 'as-flown'}-{len(paths)}"
    if not photos.exists():
        copy = copy_photos if records == "none" else stage_scaling.link_photos
        copy(arguments.survey, paths, photos)
    if not (survey / "survey.toml").exists():
        chain.run("init", [arguments.stucco, "init", survey, "--photos", photos],
                  survey / "survey.toml")
    if records == "plan" and not (survey / "plan/plan.json").exists():
        (survey / "plan").mkdir(exist_ok=True)
        shutil.copyfile(arguments.survey / "plan/plan.json", survey / "plan/plan.json")
    return survey, chain


def read_steps(survey):
    """By step of the last calibration: CPU and wall seconds and largest memory; and of all of it."""
    found, peaks = {}, {}
    for line in (survey / ".stucco/events.ndjson").read_text(encoding="utf-8").splitlines():
        try:
            event = json.loads(line)
        except ValueError:
            continue  # torn by a kill
        if event.get("stage") != "calib":
            continue
        if event["event"] == "stage":
            found, peaks = {}, {}
        elif event["event"] == "progress":
            peaks[event["step"]] = max(peaks.get(event["step"], 0), event["memory_mb"])
        elif event["event"] == "step_done":
            cost = found.setdefault(event["step"], {"cpu_s": 0.0, "wall_s": 0.0})
            cost["cpu_s"] += event["cpu_s"]
            cost["wall_s"] += event["wall_s"]
        elif event["event"] == "stage_done":
            found["all"] = {"cpu_s": event["cpu_s"], "wall_s": event["wall_s"],
                            "memory_mb": event["peak_memory_mb"]}
    for step, cost in found.items():
        cost.setdefault("memory_mb", peaks.get(step))
    return found


def measure_part(arguments, records, paths):
    survey, chain = prepare(arguments, records, paths)
    chain.run("run", [arguments.stucco, "run", survey, "--until", "calib", *arguments.run_args],
              survey / "calib")
    result = json.loads((survey / "calib/calibration.json").read_text(encoding="utf-8"))
    return {"photos": len(paths), "posed": result["photos_posed"], "steps": read_steps(survey),
            "commits": chain.commits()}


def exponent(parts, step, which):
    """Of photos, in the power that fits a step's seconds best; nothing where they say too little."""
    points = [(math.log(part["photos"]), math.log(part["steps"][step][which])) for part in parts
              if part["steps"].get(step, {}).get(which, 0) >= 1]
    if len(points) < 2:
        return None
    return statistics.linear_regression(*zip(*points)).slope


def step_names(parts):
    names = dict.fromkeys(step for part in parts for step in part["steps"] if step != "all")
    return [*names, "all"]


def table(parts, which):
    """Seconds by step, and the exponents below."""
    names = step_names(parts)
    rows = []
    for part in parts:
        cells = [surveys.number(part["steps"].get(name, {}).get(which), 1) for name in names]
        adjusting = sum(part["steps"].get(name, {}).get(which, 0) for name in ADJUSTING)
        share = adjusting / part["steps"]["all"][which] if part["steps"]["all"][which] else math.nan
        rows.append([part["photos"], part["posed"], *cells, surveys.number(share, 2)])
    rows.append(["exponent", "", *(surveys.number(exponent(parts, name, which), 2)
                                   for name in names), ""])
    heads = [f"photos, {'CPU' if which == 'cpu_s' else 'wall'} s", "posed",
             *(SHORT.get(name, name) for name in names), "adjusting"]
    return surveys.markdown_table(heads, rows)


def memory_table(parts):
    names = step_names(parts)
    rows = [[part["photos"], *(surveys.number(part["steps"].get(name, {}).get("memory_mb"), 0)
                               for name in names)] for part in parts]
    return surveys.markdown_table(["photos, MB", *(SHORT.get(name, name) for name in names)], rows)


def ratios(by_records):
    """CPU seconds beside those of the same photos without metadata."""
    bare = {part["photos"]: part["steps"]["all"]["cpu_s"] for part in by_records.get("none", [])}
    rows = []
    for records, parts in by_records.items():
        if records == "none":
            continue
        for part in parts:
            if bare.get(part["photos"]):
                ratio = part["steps"]["all"]["cpu_s"] / bare[part["photos"]]
                rows.append([records, part["photos"], surveys.number(ratio, 2)])
    if not rows:
        return ""
    return surveys.markdown_table(["records", "photos", "CPU s, times those without"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("survey", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--photos", type=int, nargs="+", default=[50, 100, 200, 400, 800])
    parser.add_argument("--records", nargs="+", choices=["plan", "gps", "none"], default=["plan"])
    parser.add_argument("--run-args", type=shlex.split, default=[], metavar="WORDS")
    parser.add_argument("--again", choices=["run"])
    parser.add_argument("--stucco", default=str(surveys.PROGRAM))
    arguments = parser.parse_args()
    by_records = {}
    try:
        photos = usable_photos(arguments.survey)
        counts = sorted({min(count, len(photos)) for count in arguments.photos})
        for records in arguments.records:
            parts = by_records.setdefault(records, [])
            for count in counts:
                parts.append(measure_part(arguments, records, nearest_to_middle(photos, count)))
    except (OSError, ValueError, steps.Failed, subprocess.CalledProcessError) as error:
        sys.exit(f"calib_growth: {error}")
    for records, parts in by_records.items():
        print(f"{records}:\n\n{table(parts, 'cpu_s')}\n\n{table(parts, 'wall_s')}\n\n"
              f"{memory_table(parts)}\n")
    if ratios(by_records):
        print(ratios(by_records))
    commits = dict.fromkeys(name for parts in by_records.values() for part in parts
                            for name in part["commits"])
    if commits:
        print("\nCommit " + ", ".join(commits) + ".")


if __name__ == "__main__":
    main()
