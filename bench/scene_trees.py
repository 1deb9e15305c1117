#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The trees of a made scene as obstacles that a plan can go by, as a register of trees has them.

Usage: scene_trees.py SCENE OUT.geojson

SCENE is what `stucco simulate city` made. Each tree of scene.glb becomes a point with its height and
the diameter of its crown: stucco plan SCENE/map.geojson --obstacles OUT.geojson ...
"""
import json
import math
import pathlib
import struct
import sys

# WGS 84
EQUATOR_M = 6378137.0
E2 = 6.69437999014e-3


def read_glb(path):
    """The JSON chunk of a binary glTF file."""
    data = path.read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    return json.loads(data[20:20 + length])


def box_of(model, node):
    """Lowest and highest corner of a node's mesh: x east, y up, z south, metres."""
    places = [model["accessors"][part["attributes"]["POSITION"]]
              for part in model["meshes"][node["mesh"]]["primitives"]]
    return ([min(p["min"][axis] for p in places) for axis in range(3)],
            [max(p["max"][axis] for p in places) for axis in range(3)])


def degrees(origin, east, north):
    """Longitude and latitude of a place so many metres from the scene's origin."""
    latitude = math.radians(origin["latitude_deg"])
    w = 1 - E2 * math.sin(latitude) ** 2
    meridian, parallel = EQUATOR_M * (1 - E2) / w ** 1.5, EQUATOR_M / math.sqrt(w)
    return [origin["longitude_deg"] + math.degrees(east / (parallel * math.cos(latitude))),
            origin["latitude_deg"] + math.degrees(north / meridian)]


def trees_of(scene):
    origin = json.loads((scene / "scene.json").read_text())["origin"]
    model = read_glb(scene / "scene.glb")
    for node in model["nodes"]:
        if not node.get("name", "").startswith("occluder/tree-"):
            continue
        low, high = box_of(model, node)
        place = degrees(origin, (low[0] + high[0]) / 2, -(low[2] + high[2]) / 2)
        crown = max(high[0] - low[0], high[2] - low[2])
        yield {"type": "Feature", "geometry": {"type": "Point", "coordinates": place},
               "properties": {"id": node["name"], "height": round(high[1] - low[1], 1),
                              "diameter_crown": round(crown, 1)}}


def main(words):
    if len(words) != 3:
        sys.exit(__doc__)
    trees = list(trees_of(pathlib.Path(words[1])))
    pathlib.Path(words[2]).write_text(
        json.dumps({"type": "FeatureCollection", "features": trees}, indent=1) + "\n")
    print(f"{len(trees)} trees")


if __name__ == "__main__":
    main(sys.argv)
