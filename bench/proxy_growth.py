#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How the model's time and memory grow with the number of buildings.

Usage: proxy_growth.py OUT [--buildings 40 160 640] [--density 6] [--noise 0.02] [--seed 1]
                       [--no-map] [--stucco PROGRAM]

Towns of make_town.py, whose blocks are the same at every size, are scanned: DENSITY points a square
metre at random on roofs, walls and the level ground around, moved by NOISE (metres, one standard
deviation of each axis). Each is imported with its footprints, without heights, and run until proxy.
Printed are wall and CPU seconds, peak memory, and the exponent of the CPU time over buildings from
one size to the next: 1 is linear. Also how many buildings are closed. With --no-map the model is
made from the cloud alone (proxy.use_map): houses that touch may be one then. Needs NumPy.
"""
import argparse
import json
import math
import pathlib
import sys

import numpy as np

import airborne
import make_town
import surveys

CRS = "EPSG:32633"
MIDDLE = np.array([460000.0, 5550000.0])
MARGIN_M = 10


def inside(rings, xy):
    """Which points an odd number of edges lies to the right of."""
    odd = np.zeros(len(xy), bool)
    for ring in rings:
        for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1]):
            if ay == by:
                continue
            between = (xy[:, 1] >= min(ay, by)) & (xy[:, 1] < max(ay, by))
            odd ^= between & (xy[:, 0] < ax + (xy[:, 1] - ay) / (by - ay) * (bx - ax))
    return odd


def scan_roofs_and_ground(town, density, dice):
    corners = np.vstack([ring for building in town for ring in building["rings"]])
    low, high = corners.min(axis=0) - MARGIN_M, corners.max(axis=0) + MARGIN_M
    xy = dice.uniform(low, high, (dice.poisson(density * np.prod(high - low)), 2))
    xy = xy[np.argsort(xy[:, 0])]
    z = np.zeros(len(xy))
    for building in town:
        ring = np.array(building["rings"][0])
        begin, end = np.searchsorted(xy[:, 0], [ring[:, 0].min(), ring[:, 0].max()])
        part = z[begin:end]
        part[inside(building["rings"], xy[begin:end])] = building["height"]
    return np.column_stack([xy, z])


def scan_walls(town, density, dice):
    walls = []
    for building in town:
        for ring in building["rings"]:
            for a, b in zip(ring, ring[1:] + ring[:1]):
                a, b = np.array(a), np.array(b)
                area = np.linalg.norm(b - a) * building["height"]
                count = dice.poisson(density * area)
                xy = a + dice.uniform(0, 1, (count, 1)) * (b - a)
                walls.append(np.column_stack([xy, dice.uniform(0, building["height"], count)]))
    return np.vstack(walls)


def write_footprints(town, path, middle=MIDDLE):
    features = []
    for number, building in enumerate(town, 1):
        rings = [(np.array(ring + ring[:1]) + middle).tolist() for ring in building["rings"]]
        features.append({"type": "Feature", "properties": {"id": number},
                         "geometry": {"type": "Polygon", "coordinates": rings}})
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))


def measure(count, wanted):
    """Costs of the stage, and how many of the buildings it closed."""
    folder = wanted.out / f"town-{count}"
    (folder / "no-photos").mkdir(parents=True)
    dice = np.random.default_rng(wanted.seed)
    town = make_town.make_town(count, wanted.seed, 0.25)
    points = np.vstack([scan_roofs_and_ground(town, wanted.density, dice),
                        scan_walls(town, wanted.density, dice)])
    points += dice.normal(0, wanted.noise, points.shape)
    points[:, :2] += MIDDLE
    airborne.write_ply(points, folder / "scan.ply")
    write_footprints(town, folder / "footprints.geojson")
    survey = folder / "survey"
    airborne.run(wanted.stucco, "init", survey, "--photos", folder / "no-photos")
    airborne.run(wanted.stucco, "import", survey, folder / "scan.ply", "--map",
                 folder / "footprints.geojson", "--crs", CRS)
    settings = ["--set", "proxy.use_map=false"] if wanted.no_map else []
    airborne.run(wanted.stucco, "run", survey, "--until", "proxy", *settings)
    buildings = json.loads((survey / "proxy/facets.json").read_text())["buildings"]
    return {"points": len(points), **surveys.stage_costs(survey)["proxy"],
            "closed": sum(building["watertight"] for building in buildings)}


def rows_of(figures):
    before = None
    for count, found in figures.items():
        grown = "-" if before is None else surveys.number(
            math.log(found["cpu_s"] / before[1]["cpu_s"]) / math.log(count / before[0]))
        yield [count, found["points"], surveys.number(found["wall_s"], 1),
               surveys.number(found["cpu_s"], 1), grown, surveys.number(found["peak_memory_mb"], 0),
               f"{found['closed']} of {count}"]
        before = count, found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--buildings", type=int, nargs="+", default=[40, 160, 640])
    parser.add_argument("--density", type=float, default=6)
    parser.add_argument("--noise", type=float, default=0.02)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--no-map", action="store_true")
    parser.add_argument("--stucco", type=pathlib.Path,
                        default=pathlib.Path(__file__).parents[1] / "build/dev/cli/stucco")
    wanted = parser.parse_args()
    figures = {count: measure(count, wanted) for count in sorted(wanted.buildings)}
    print(surveys.markdown_table(
        ["buildings", "points", "wall (s)", "CPU (s)", "exponent", "memory (MB)", "closed"],
        rows_of(figures)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
