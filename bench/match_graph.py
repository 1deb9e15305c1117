#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the matches that a plan expects with the points that its photos came to share.

  bench/match_graph.py SURVEY...

A SURVEY was planned, flown and calibrated. Printed is, by the strength that the plan expects of a
pair, how many points of the reconstruction both photos see; and by the kind of photo, how many have
a pose. Pairs with a photo that has none are left out of the first table.
"""
import collections
import itertools
import json
import pathlib
import sys

BINS = (0.06, 0.08, 0.1, 0.12, 0.16, 0.24, 0.4, 1.01)
KINDS = ("dipping", "dipping_foot", "link", "nadir", "oblique")


def lines(path):
    with open(path, encoding="utf-8") as file:
        return [line.split() for line in file if not line.startswith("#")]


def view_of(name):
    """DJI_20260430100000_0001_D_h0001v1.JPG was taken for h0001v1."""
    return name.rsplit(".", 1)[0].rsplit("_", 1)[-1]


def posed(model):
    """View ids by image id: of each pair of lines in images.txt the first."""
    rows = [row for row in lines(model / "images.txt") if len(row) == 10]
    return {int(row[0]): view_of(row[9]) for row in rows if "." in row[9]}


def shared_points(model, views):
    counts = collections.Counter()
    for row in lines(model / "points3D.txt"):
        seen = sorted({views[int(image)] for image in row[8::2] if int(image) in views})
        counts.update(itertools.combinations(seen, 2))
    return counts


def expected(plan):
    pairs = {}
    for view in plan["views"]:
        for partner in view.get("partners", []):
            pairs[tuple(sorted((view["id"], partner["view"])))] = partner["strength"]
    return pairs


def print_strengths(pairs, counts, ids):
    print("| expected strength | pairs | median of shared points | 15 or more | 30 or more |")
    print("| --- | --- | --- | --- | --- |")
    for low, high in zip(BINS, BINS[1:]):
        points = sorted(counts[pair] for pair, strength in pairs.items()
                        if low <= strength < high and set(pair) <= ids)
        if not points:
            continue
        share = [100 * sum(n >= least for n in points) / len(points) for least in (15, 30)]
        print(f"| {low:.2f} to {min(high, 1):.2f} | {len(points)} | {points[len(points) // 2]} | "
              f"{share[0]:.0f} % | {share[1]:.0f} % |")


def print_posed(plan, taken, ids):
    for kind in KINDS:
        views = [view["id"] for view in plan["views"]
                 if view["kind"] == kind and view["id"] in taken]
        if views:
            without = [view for view in views if view not in ids]
            print(f"{kind}: {len(views) - len(without)} of {len(views)} photos have a pose",
                  *without)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for survey in map(pathlib.Path, sys.argv[1:]):
        plan = json.loads((survey / "plan/plan.json").read_text(encoding="utf-8"))
        model = next(path.parent for path in sorted((survey / "calib").rglob("points3D.txt")))
        views = posed(model)
        taken = {view_of(path.name) for path in (survey / "photos").iterdir()}
        print(f"{survey.name}: {len(taken)} photos")
        print_strengths(expected(plan), shared_points(model, views), set(views.values()))
        print_posed(plan, taken, set(views.values()))


if __name__ == "__main__":
    main()
