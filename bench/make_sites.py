#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the list of sites that plan_methods.py compares on: a part of Prague whole and in quarters,
generated towns, and Delft whole and in quarters where its CityJSON (3D BAG, from cjio) is given.

  bench/make_sites.py OUT [--delft delft.json]
"""
import argparse
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
# West, south, east, north in degrees.
PRAGUE = (14.3999, 50.1011, 14.4056, 50.1049)
DELFT = (4.3619, 52.0107, 4.3697, 52.0138)


def quarters(bounds):
    west, south, east, north = bounds
    x, y = (west + east) / 2, (south + north) / 2
    return {"sw": (west, south, x, y), "se": (x, south, east, y), "nw": (west, y, x, north),
            "ne": (x, y, east, north)}


def write_area(path, bounds):
    west, south, east, north = bounds
    ring = [[west, south], [east, south], [east, north], [west, north], [west, south]]
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {},
         "geometry": {"type": "Polygon", "coordinates": [ring]}}]}))


def whole_and_quarters(out, site, bounds, wanted):
    name, source, args = site["name"], site["map"], site["args"]
    sites = [site]
    for quarter, part in quarters(bounds).items():
        if quarter not in wanted:
            continue
        area = out / f"{name}-{quarter}.geojson"
        write_area(area, part)
        sites.append({"name": f"{name}-{quarter}", "map": source,
                      "args": [*args, "--area", f"@{area.name}"]})
    return sites


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--delft", type=pathlib.Path)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    prague = {"name": "prague", "map": str(ROOT / "data/maps/prague_bubenec.geojson"),
              "args": ["--altitude", "35"]}
    sites = whole_and_quarters(arguments.out, prague, PRAGUE, ("sw", "se", "nw", "ne"))
    if arguments.delft:
        delft = {"name": "delft", "map": str(arguments.delft.resolve()), "args": []}
        # There are no buildings in the north of it.
        sites += whole_and_quarters(arguments.out, delft, DELFT, ("sw", "se"))
    for seed in (1, 2, 3):
        town = arguments.out / f"town-{seed}.geojson"
        subprocess.run([sys.executable, ROOT / "bench/make_town.py", "--buildings", "40", "--seed",
                        str(seed), "-o", town], check=True)
        sites.append({"name": f"town-{seed}", "map": town.name, "args": []})
    (arguments.out / "sites.json").write_text(json.dumps(sites, indent=1) + "\n")
    print(arguments.out / "sites.json")


if __name__ == "__main__":
    main()
