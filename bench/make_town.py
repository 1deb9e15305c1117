#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes up a town: building footprints with heights, as GeoJSON, to measure the planner on.

Usage: make_town.py --buildings N [--seed S] [--density SHARE | --sheds] -o town.geojson

Blocks between streets, slightly turned and unequal: closed rows around a courtyard with party
walls, terraces, free-standing houses (rectangles, L and U) and large buildings with a courtyard.
Houses are 6 to 22 m high, a few towers 24 to 30 m. The blocks grow outwards from the middle, so that
towns of 10 and of 1000 buildings have the same density and mix. With --sheds all are alike, 4 x 3 m
and 2.5 m high, in rows nine metres apart. The same arguments give the same bytes.
"""

import argparse
import json
import math
import random

MEAN_WIDTH, MEAN_DEPTH = 75, 60  # of a block, in metres
BUILT_SHARE = 0.44  # of a block, on average over its kinds
SHED_WIDTH, SHED_DEPTH, SHED_HEIGHT, SHED_GAP = 4, 3, 2.5, 9
KINDS = ["closed"] * 4 + ["terraces"] * 2 + ["houses"] * 4 + ["large"]


def height(rng, levels):
    """Of so many levels, with a roof."""
    return round(levels * 3 + rng.uniform(1.5, 4), 1)


def house(corners, metres, *holes):
    return {"rings": [corners, *holes], "height": metres}


def rectangle(x0, y0, x1, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def cuts(rng, low, high, width):
    """Splits low..high into pieces of about `width`."""
    pieces = max(1, round((high - low) / width))
    step = (high - low) / pieces
    inner = [low + step * (i + rng.uniform(-0.2, 0.2)) for i in range(1, pieces)]
    return [low, *inner, high]


def closed_block(rng, width, depth):
    """Houses wall to wall around a courtyard, L-shaped at the corners."""
    x, y, deep, corner = width / 2, depth / 2, rng.uniform(10.5, 13), rng.uniform(15, 18)
    levels = rng.randint(3, 5)
    found = []
    for turn in range(4):
        w, d = (x, y) if turn % 2 == 0 else (y, x)

        def turned(points, turn=turn):
            for _ in range(turn):
                points = [(-b, a) for a, b in points]
            return points

        ell = [(-w, -d), (-w + corner, -d), (-w + corner, -d + deep), (-w + deep, -d + deep),
               (-w + deep, -d + corner), (-w, -d + corner)]
        found.append(house(turned(ell), height(rng, levels + rng.randint(0, 1))))
        sides = cuts(rng, -w + corner, w - corner, rng.uniform(11, 17))
        for a, b in zip(sides, sides[1:]):
            found.append(house(turned(rectangle(a, -d, b, -d + deep)),
                               height(rng, levels + rng.randint(-1, 1))))
    return found


def terraces(rng, width, depth):
    """Two rows of narrow houses, back to back with gardens between."""
    x, y, deep = width / 2, depth / 2, rng.uniform(9, 11)
    found = []
    for low, high in ((-y, -y + deep), (y - deep, y)):
        sides = cuts(rng, -x, x, rng.uniform(7, 9.5))
        levels = rng.randint(2, 3)
        gap = rng.randrange(1, len(sides) - 1)  # a passage through the row
        for i, (a, b) in enumerate(zip(sides, sides[1:])):
            if i != gap:
                found.append(house(rectangle(a, low, b, high), height(rng, levels)))
    return found


def shape(rng, width, depth):
    x, y = width / 2, depth / 2
    cut, wing = y - rng.uniform(0.4, 0.55) * depth, rng.uniform(0.32, 0.4) * width
    kind = rng.choice(["rectangle", "rectangle", "ell", "you"])
    if kind == "ell":
        return [(-x, -y), (x, -y), (x, cut), (-x + wing, cut), (-x + wing, y), (-x, y)]
    if kind == "you":
        return [(-x, -y), (x, -y), (x, y), (x - wing, y), (x - wing, cut), (-x + wing, cut),
                (-x + wing, y), (-x, y)]
    return rectangle(-x, -y, x, y)


def houses(rng, width, depth):
    """Six free-standing houses, each turned a little on its lot; now and then a tower."""
    found = []
    for column in (-1, 0, 1):
        for row in (-0.5, 0.5):
            lot_x, lot_y = width / 3, depth / 2
            tower = rng.random() < 0.06
            size = (rng.uniform(0.62, 0.78) * lot_x, rng.uniform(0.6, 0.74) * lot_y)
            corners = rectangle(-9, -9, 9, 9) if tower else shape(rng, *size)
            angle = math.radians(rng.uniform(-6, 6))
            c, s = math.cos(angle), math.sin(angle)
            metres = round(rng.uniform(24, 30), 1) if tower else height(rng, rng.randint(1, 4))
            found.append(house([(column * lot_x + c * a - s * b, row * lot_y + s * a + c * b)
                                for a, b in corners], metres))
    return found


def large(rng, width, depth):
    """One building with a courtyard, such as a school."""
    x, y, deep = 0.42 * width, 0.42 * depth, rng.uniform(11, 14)
    yard = rectangle(-x + deep, -y + deep, x - deep, y - deep)[::-1]
    return [house(rectangle(-x, -y, x, y), height(rng, rng.randint(3, 5)), yard)]


MAKERS = {"closed": closed_block, "terraces": terraces, "houses": houses, "large": large}


def street_width(density):
    """So that this share of the ground is built on."""
    block = MEAN_WIDTH * MEAN_DEPTH
    around = MEAN_WIDTH + MEAN_DEPTH
    return (-around + math.sqrt(around ** 2 + 4 * block * (BUILT_SHARE / density - 1))) / 2


def places_from_the_middle():
    """Cells of a grid, in squares around (0, 0)."""
    ring = 0
    while True:
        cells = [(i, j) for i in range(-ring, ring + 1) for j in range(-ring, ring + 1)
                 if max(abs(i), abs(j)) == ring]
        yield from cells
        ring += 1


def make_town(count, seed, density):
    """Buildings in metres around the middle: rings (first corner not repeated) and height."""
    street = street_width(density)
    rng = random.Random(f"town {seed}")
    turn = math.radians(rng.uniform(0, 90))
    town = []
    for i, j in places_from_the_middle():
        # A block is the same in towns of every size.
        block = random.Random(f"block {seed} {i} {j}")
        width = MEAN_WIDTH * block.uniform(0.9, 1.08)
        depth = MEAN_DEPTH * block.uniform(0.9, 1.08)
        middle = (i * (MEAN_WIDTH + street), j * (MEAN_DEPTH + street))
        angle = math.radians(block.uniform(-2, 2))
        for building in MAKERS[block.choice(KINDS)](block, width, depth):
            if len(town) == count:
                return town
            town.append({
                "rings": [[moved(moved(p, angle, middle), turn, (0, 0)) for p in ring]
                          for ring in building["rings"]],
                "height": building["height"]})
    return town


def make_sheds(count):
    """As of make_town: the fewest rows that make a square of sheds."""
    columns = math.ceil(math.sqrt(count))
    sheds = []
    for number in range(count):
        x = number % columns * (SHED_WIDTH + SHED_GAP)
        y = number // columns * (SHED_DEPTH + SHED_GAP)
        sheds.append({"rings": [rectangle(x, y, x + SHED_WIDTH, y + SHED_DEPTH)],
                      "height": SHED_HEIGHT})
    return sheds


def moved(point, angle, by):
    c, s = math.cos(angle), math.sin(angle)
    return (by[0] + c * point[0] - s * point[1], by[1] + s * point[0] + c * point[1])


def to_degrees(point, latitude, longitude):
    """Longitude and latitude (WGS 84) of metres east and north of a place."""
    a, e2 = 6378137.0, 0.00669437999014
    root = math.sqrt(1 - e2 * math.sin(math.radians(latitude)) ** 2)
    north = a * (1 - e2) / root ** 3
    east = a / root * math.cos(math.radians(latitude))
    return [round(longitude + math.degrees(point[0] / east), 9),
            round(latitude + math.degrees(point[1] / north), 9)]


def to_geojson(town, latitude, longitude):
    features = []
    for number, building in enumerate(town, 1):
        rings = [[to_degrees(p, latitude, longitude) for p in ring + ring[:1]]
                 for ring in building["rings"]]
        features.append({"type": "Feature",
                         "properties": {"id": number, "height": building["height"]},
                         "geometry": {"type": "Polygon", "coordinates": rings}})
    return {"type": "FeatureCollection", "features": features}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--buildings", type=int, required=True, help="how many")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--density", type=float, default=0.25,
                        help="share of the ground that is built on, 0.05 to 0.35 (default 0.25)")
    parser.add_argument("--sheds", action="store_true", help="rows of small sheds, all alike")
    parser.add_argument("--origin", default="50.1,14.4", help="latitude,longitude of the middle")
    parser.add_argument("-o", "--output", required=True, help="the GeoJSON file")
    args = parser.parse_args()
    if args.buildings < 1:
        parser.error("--buildings: at least 1")
    if not 0.05 <= args.density <= 0.35:
        parser.error("--density: 0.05 to 0.35")
    latitude, longitude = (float(part) for part in args.origin.split(","))
    town = (make_sheds(args.buildings) if args.sheds
            else make_town(args.buildings, args.seed, args.density))
    with open(args.output, "w", encoding="utf-8") as file:
        json.dump(to_geojson(town, latitude, longitude), file, separators=(",", ":"))
        file.write("\n")


if __name__ == "__main__":
    main()
