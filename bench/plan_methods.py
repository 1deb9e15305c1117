#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plans every site with all three methods and compares what they cost and promise.

  bench/plan_methods.py SITES.json OUT [--stucco PROGRAM] [-- ARGS for `stucco plan`]

SITES.json is a list of {"name": ..., "map": FILE, "args": [...]}; relative files count from where
SITES.json lies, and so do arguments that begin with @. Printed are the figures of every plan,
cocapture over oblique and over dronescan per site, and the means of these ratios. Quality is the
mean of q_s + q_d over the facades that the cocapture plan does not find wholly unobservable. A
baseline means no photo for any facade: all that see one count for it.
"""
import argparse
import json
import pathlib
import subprocess

import surveys

METHODS = ("cocapture", "oblique", "dronescan")


def run_plan(program, site, method, out, args):
    command = [program, "plan", site["map"], "-o", out, "--method", method, "--quiet",
               *site.get("args", []), *args]
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL)
    return json.loads((out / "plan/stats.json").read_text())


def captured(stats):
    """Ids of facades that can be captured from between the buildings, at least in part."""
    return {facade["id"] for facade in stats["facades"]
            if sum(to - begin for begin, to in facade.get("unobservable_m", []))
            < facade["length_m"] - 0.1}


def quality(stats, ids):
    values = [facade["q_s"] + facade["q_d"] for facade in stats["facades"] if facade["id"] in ids]
    return sum(values) / len(values) if values else 0


def ratios(ours, theirs, ids):
    return {"photos": ours["photos"] / theirs["photos"],
            "hovers": ours["hovers"] / theirs["hovers"],
            "length": ours["length_m"] / theirs["length_m"],
            "quality": quality(ours, ids) / max(1e-9, quality(theirs, ids))}


def mean(rows):
    return {key: sum(row[key] for row in rows) / len(rows) for key in rows[0]}


def text(row):
    return "  ".join(f"{key} {value:5.2f}" for key, value in row.items())


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("sites", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--stucco", default=str(surveys.PROGRAM))
    arguments = surveys.parse(parser)
    compared = {method: [] for method in METHODS[1:]}
    for site in json.loads(arguments.sites.read_text()):
        site["map"] = arguments.sites.parent / site["map"]
        site["args"] = [str(arguments.sites.parent / word[1:]) if word.startswith("@") else word
                        for word in site.get("args", [])]
        stats = {method: run_plan(arguments.stucco, site, method,
                                  arguments.out / f"{site['name']}-{method}", arguments.args)
                 for method in METHODS}
        ids = captured(stats["cocapture"])
        print(f"{site['name']}: {len(ids)} of {len(stats['cocapture']['facades'])} facades")
        for method in METHODS:
            s = stats[method]
            print(f"  {method:10} {s['photos']:6} photos {s['hovers']:6} hovers "
                  f"{s['length_m']:9.0f} m {s['battery_percent']:7.0f} % battery "
                  f"q_s+q_d {quality(s, ids):.3f}  gap {100 * s['tsp_gap']:.1f} %  "
                  f"{s['planning_s']:.1f} s", flush=True)
        for method, rows in compared.items():
            rows.append(ratios(stats["cocapture"], stats[method], ids))
            print(f"  cocapture / {method:10} {text(rows[-1])}", flush=True)
    for method, rows in compared.items():
        print(f"mean of {len(rows)}: cocapture / {method:10} {text(mean(rows))}")


if __name__ == "__main__":
    main()
