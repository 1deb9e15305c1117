#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What one building of many planes costs, and a cloud of many points.

Usage: large_hall.py OUT [--bays 28] [--density 25] [--noise 0.02] [--seed 1] [--stucco PROGRAM]

A hall under BAYS gables of different heights side by side, on level ground, is scanned from all
sides: DENSITY points a square metre at random, moved by NOISE (metres, one standard deviation of
each axis). It is imported with its footprint, without a height, and run until proxy. Printed are
what the stage costs, whether the hall is closed, its walls and roofs beside the true ones, and how
far its roofs are off at places of the scan (root mean square, metres). Needs NumPy.
"""
import argparse
import json
import pathlib
import sys

import numpy as np

import airborne
import proxy_growth
import surveys

BAY_M = 6
LENGTH_M = 30
EAVES_M = 6
MARGIN_M = 12
# On the zone's central meridian, where its north is north; lengths are this much shorter there.
MIDDLE = np.array([500000.0, 5550000.0])
SCALE = 0.9996


def ridge_heights(bays, dice):
    """Above the ground, in steps of a decimetre: no two neighbours are alike."""
    heights = [8.0]
    while len(heights) < bays:
        height = round(dice.uniform(7.5, 9.5), 1)
        if abs(height - heights[-1]) > 0.25:
            heights.append(height)
    return np.array(heights[:bays])


def height_at(xy, ridges):
    """Of the roof; 0 beside the hall."""
    bay = np.floor(xy[:, 0] / BAY_M).astype(int)
    inside = (bay >= 0) & (bay < len(ridges)) & (xy[:, 1] >= 0) & (xy[:, 1] < LENGTH_M)
    to_ridge = np.abs(xy[:, 0] - (bay + 0.5) * BAY_M) / (BAY_M / 2)
    ridge = ridges[np.clip(bay, 0, len(ridges) - 1)]
    return np.where(inside, EAVES_M + (1 - to_ridge) * (ridge - EAVES_M), 0)


def scan(ridges, density, dice):
    """Points of roofs, ground and walls; which of the first are on the roof."""
    width = BAY_M * len(ridges)
    low, high = np.full(2, -MARGIN_M), np.array([width, LENGTH_M]) + MARGIN_M
    xy = dice.uniform(low, high, (dice.poisson(density * np.prod(high - low)), 2))
    level = np.column_stack([xy, height_at(xy, ridges)])
    walls = []
    for x in (0, width):
        count = dice.poisson(density * LENGTH_M * EAVES_M)
        walls.append(np.column_stack([np.full(count, x), dice.uniform(0, LENGTH_M, count),
                                      dice.uniform(0, EAVES_M, count)]))
    for y, inwards in ((0, 1e-6), (LENGTH_M, -1e-6)):
        count = dice.poisson(density * width * ridges.max())
        wall = np.column_stack([dice.uniform(0, width, count), np.full(count, y),
                                dice.uniform(0, ridges.max(), count)])
        walls.append(wall[wall[:, 2] < height_at(wall[:, :2] + [0, inwards], ridges)])
    return np.vstack([level, *walls]), level[level[:, 2] > 0]


def roofs_off(roofs, places):
    """Root mean square of the vertical distances between the model's highest roof and places, their
    middle one left out: heights of the survey count from another level."""
    found = np.full(len(places), -np.inf)
    for roof in roofs:
        normal = np.array(roof["normal"])
        rings = [np.array(ring)[:, :2].tolist() for ring in (roof["outer"], *roof["holes"])]
        height = (roof["offset"] - places[:, :2] @ normal[:2]) / normal[2]
        there = proxy_growth.inside(rings, places[:, :2])
        found[there] = np.maximum(found[there], height[there])
    known = np.isfinite(found)
    off = found[known] - places[known, 2]
    return float(np.sqrt(np.mean((off - np.median(off)) ** 2)))


def measure(wanted):
    folder = wanted.out
    (folder / "no-photos").mkdir(parents=True)
    dice = np.random.default_rng(wanted.seed)
    ridges = ridge_heights(wanted.bays, dice)
    points, on_roof = scan(ridges, wanted.density, dice)
    # The survey's origin is the middle of the map.
    middle = np.array([BAY_M * wanted.bays / 2, LENGTH_M / 2])
    places = (on_roof[:: max(1, len(on_roof) // 10000)] - [*middle, 0]) / [SCALE, SCALE, 1]
    points += dice.normal(0, wanted.noise, points.shape)
    points[:, :2] += MIDDLE - middle
    airborne.write_ply(points, folder / "scan.ply")
    count = len(points)
    del points
    outline = [(-middle).tolist(), [middle[0], -middle[1]], middle.tolist(), [-middle[0], middle[1]]]
    proxy_growth.write_footprints([{"rings": [outline]}], folder / "footprints.geojson", MIDDLE)
    survey = folder / "survey"
    airborne.run(wanted.stucco, "init", survey, "--photos", folder / "no-photos")
    airborne.run(wanted.stucco, "import", survey, folder / "scan.ply", "--map",
                 folder / "footprints.geojson", "--crs", proxy_growth.CRS)
    airborne.run(wanted.stucco, "run", survey, "--until", "proxy")
    buildings = json.loads((survey / "proxy/facets.json").read_text())["buildings"]
    hall = buildings[0]
    of_class = {kind: [facet for facet in hall["facets"] if facet["class"] == kind]
                for kind in ("WallSurface", "RoofSurface")}
    cost = surveys.stage_costs(survey)["proxy"]
    return [count, surveys.number(cost["wall_s"], 1), surveys.number(cost["cpu_s"], 1),
            surveys.number(cost["peak_memory_mb"], 0), "yes" if hall["watertight"] else "no",
            f"{len(of_class['WallSurface'])} (4)",
            f"{len(of_class['RoofSurface'])} ({2 * wanted.bays})",
            surveys.number(roofs_off(of_class["RoofSurface"], places), 3)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--bays", type=int, default=28)
    parser.add_argument("--density", type=float, default=25)
    parser.add_argument("--noise", type=float, default=0.02)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--stucco", type=pathlib.Path,
                        default=pathlib.Path(__file__).parents[1] / "build/dev/cli/stucco")
    print(surveys.markdown_table(
        ["points", "wall (s)", "CPU (s)", "memory (MB)", "closed", "walls (true)", "roofs (true)",
         "roofs off (m)"], [measure(parser.parse_args())]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
