#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Says what of a CityJSON file does not follow CityJSON 2.0.

Usage: check_cityjson.py FILE...

By the text of the specification (https://www.cityjson.org/specs/2.0.1/), without its schemas and
without a line of the program's: members and their types, objects and their parents, indices of
corners, surfaces, textures and their corners, depths of arrays, pictures beside the file, corners
that are twice there or that nothing uses. Whether solids are closed is not looked at. Ends with 1
where something is wrong.
"""
import argparse
import json
import pathlib
import re
import sys

ROOT = {"type", "version", "transform", "CityObjects", "vertices", "metadata", "extensions",
        "appearance", "geometry-templates"}
FIRST_LEVEL = {"Bridge", "Building", "CityFurniture", "CityObjectGroup", "GenericCityObject",
               "LandUse", "OtherConstruction", "PlantCover", "Railway", "Road",
               "SolitaryVegetationObject", "TINRelief", "TransportSquare", "Tunnel", "WaterBody",
               "Waterway"}
PARENTS = {"BuildingPart": {"Building"}, "BuildingInstallation": {"Building", "BuildingPart"},
           "BuildingRoom": {"Building", "BuildingPart"}, "BuildingStorey": {"Building", "BuildingPart"},
           "BuildingUnit": {"Building", "BuildingPart"}}
MEMBERS = {"type", "attributes", "geographicalExtent", "children", "parents", "geometry", "address"}
# Depth of `boundaries`: 3 are corners in rings in surfaces.
DEPTHS = {"MultiPoint": 1, "MultiLineString": 2, "MultiSurface": 3, "CompositeSurface": 3, "Solid": 4,
          "MultiSolid": 5, "CompositeSolid": 5}
SURFACES = {"RoofSurface", "GroundSurface", "WallSurface", "ClosureSurface", "OuterCeilingSurface",
            "OuterFloorSurface", "Window", "Door", "InteriorWallSurface", "CeilingSurface",
            "FloorSurface"}
REFERENCE = re.compile(r"https?://www\.opengis\.net/def/crs/[^/]+/[^/]+/[^/]+$")


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def is_index(value, count):
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < count


def are_numbers(values, count):
    return isinstance(values, list) and len(values) == count and all(map(is_number, values))


class Checker:
    def __init__(self, city, folder):
        self.city = city
        self.folder = folder
        self.wrong = []
        self.used = set()

    def say(self, where, what):
        self.wrong.append(f"{where}: {what}")

    def run(self):
        city = self.city
        if not isinstance(city, dict) or city.get("type") != "CityJSON":
            self.say("root", "is no CityJSON")
            return self.wrong
        if city.get("version") != "2.0":
            self.say("root", f"version {city.get('version')!r} is not 2.0")
        for name in city:
            if name not in ROOT and not name.startswith("+"):
                self.say("root", f"unknown member {name}")
        transform = city.get("transform", {})
        for name in ("scale", "translate"):
            if not are_numbers(transform.get(name), 3):
                self.say("transform", f"{name} is not three numbers")
        self.metadata(city.get("metadata", {}))
        self.appearance(city.get("appearance", {}))
        self.vertices = city.get("vertices")
        if not isinstance(self.vertices, list):
            self.say("vertices", "is no list")
            self.vertices = []
        objects = city.get("CityObjects")
        if not isinstance(objects, dict):
            self.say("CityObjects", "is no object")
            objects = {}
        for name, thing in objects.items():
            self.object(name, thing, objects)
        self.corners()
        return self.wrong

    def metadata(self, metadata):
        if "geographicalExtent" in metadata and not are_numbers(metadata["geographicalExtent"], 6):
            self.say("metadata", "geographicalExtent is not six numbers")
        reference = metadata.get("referenceSystem")
        if reference is not None and not REFERENCE.match(str(reference)):
            self.say("metadata", f"referenceSystem {reference!r} is no OGC address")
        date = metadata.get("referenceDate")
        if date is not None and not re.match(r"\d{4}-\d\d-\d\d$", str(date)):
            self.say("metadata", f"referenceDate {date!r} is no date")

    def appearance(self, appearance):
        self.textures = appearance.get("textures", [])
        self.texture_corners = appearance.get("vertices-texture", [])
        for i, texture in enumerate(self.textures):
            where = f"texture {i}"
            if texture.get("type") not in ("PNG", "JPG"):
                self.say(where, f"type {texture.get('type')!r} is neither PNG nor JPG")
            image = texture.get("image")
            if not isinstance(image, str):
                self.say(where, "has no image")
            elif "://" not in image and not (self.folder / image).is_file():
                self.say(where, f"there is no {image}")
            if texture.get("wrapMode", "none") not in ("none", "wrap", "mirror", "clamp", "border"):
                self.say(where, f"unknown wrapMode {texture['wrapMode']}")
            if texture.get("textureType", "unknown") not in ("unknown", "specific", "typical"):
                self.say(where, f"unknown textureType {texture['textureType']}")
        for i, corner in enumerate(self.texture_corners):
            if not are_numbers(corner, 2):
                self.say(f"vertices-texture {i}", "is not two numbers")

    def object(self, name, thing, objects):
        kind = thing.get("type", "")
        if kind not in FIRST_LEVEL and kind not in PARENTS and not kind.startswith("+"):
            self.say(name, f"unknown type {kind!r}")
        for member in thing:
            if member not in MEMBERS and not member.startswith("+"):
                self.say(name, f"unknown member {member}")
        if kind in PARENTS and not thing.get("parents"):
            self.say(name, f"a {kind} without parents")
        for parent in thing.get("parents", []):
            if name not in objects.get(parent, {}).get("children", []):
                self.say(name, f"is no child of its parent {parent}")
            elif kind in PARENTS and objects[parent].get("type") not in PARENTS[kind]:
                self.say(name, f"a {kind} of a {objects[parent].get('type')}")
        for child in thing.get("children", []):
            if name not in objects.get(child, {}).get("parents", []):
                self.say(name, f"is no parent of its child {child}")
        if not isinstance(thing.get("attributes", {}), dict):
            self.say(name, "attributes are no object")
        for i, geometry in enumerate(thing.get("geometry", [])):
            self.geometry(f"{name}, geometry {i}", geometry)

    def geometry(self, where, geometry):
        depth = DEPTHS.get(geometry.get("type"))
        if depth is None:
            self.say(where, f"unknown type {geometry.get('type')!r}")
            return
        if not re.match(r"[0-3](\.[0-3])?$", str(geometry.get("lod"))) or not isinstance(
                geometry["lod"], str):
            self.say(where, f"lod {geometry.get('lod')!r} is no text such as \"2.2\"")
        boundaries = geometry.get("boundaries")
        self.rings(where, boundaries, depth)
        if "semantics" in geometry:
            self.semantics(where, geometry["semantics"], boundaries, depth - 2)
        for theme, texture in geometry.get("texture", {}).items():
            self.texture_values(f"{where}, theme {theme}", texture.get("values"), boundaries, depth)

    def rings(self, where, part, depth):
        if not isinstance(part, list):
            self.say(where, "boundaries are not as deep as their type asks")
            return
        if depth > 1:
            for inner in part:
                self.rings(where, inner, depth - 1)
            return
        for corner in part:
            if not is_index(corner, len(self.vertices)):
                self.say(where, f"there is no corner {corner}")
                return
        self.used.update(part)
        if len(part) < 3 or len(set(part)) != len(part):
            self.say(where, f"ring {part} has fewer than three corners, or one twice")

    def semantics(self, where, semantics, boundaries, depth):
        surfaces = semantics.get("surfaces")
        if not isinstance(surfaces, list):
            self.say(where, "semantics without surfaces")
            return
        for i, surface in enumerate(surfaces):
            kind = surface.get("type", "")
            if kind not in SURFACES and not kind.startswith("+"):
                self.say(where, f"surface {i}: unknown type {kind!r}")
            for name, value in surface.items():
                if name == "children" and all(is_index(c, len(surfaces)) for c in value):
                    continue
                if isinstance(value, (list, dict)):
                    self.say(where, f"surface {i}: {name} is no single value")
        self.values(where, semantics.get("values"), boundaries, depth, len(surfaces))

    def values(self, where, values, boundaries, depth, count):
        """An index, or null, for each surface of the boundaries."""
        if values is None:
            return
        if not isinstance(values, list) or len(values) != len(boundaries):
            self.say(where, "semantics have not as many values as there are boundaries")
        elif depth > 1:
            for inner, boundary in zip(values, boundaries):
                self.values(where, inner, boundary, depth - 1, count)
        else:
            for value in values:
                if value is not None and not is_index(value, count):
                    self.say(where, f"there is no surface {value}")

    def texture_values(self, where, values, boundaries, depth):
        """For each ring its texture and a corner of it for each corner, or null."""
        if not isinstance(values, list):
            self.say(where, "has no values")
        elif depth > 1:
            if len(values) != len(boundaries):
                self.say(where, "has not as many values as there are boundaries")
                return
            for inner, boundary in zip(values, boundaries):
                self.texture_values(where, inner, boundary, depth - 1)
        elif values != [None]:
            if len(values) != len(boundaries) + 1:
                self.say(where, f"a ring of {len(boundaries)} corners has {len(values)} values")
            elif not is_index(values[0], len(self.textures)):
                self.say(where, f"there is no texture {values[0]}")
            elif not all(is_index(v, len(self.texture_corners)) for v in values[1:]):
                self.say(where, f"ring {values} has a corner that no texture has")

    def corners(self):
        seen = set()
        for i, corner in enumerate(self.vertices):
            whole = isinstance(corner, list) and len(corner) == 3 and all(
                isinstance(c, int) and not isinstance(c, bool) for c in corner)
            if not whole:
                self.say(f"corner {i}", "is not three whole numbers")
                continue
            if tuple(corner) in seen:
                self.say(f"corner {i}", "is there twice")
            seen.add(tuple(corner))
            if i not in self.used:
                self.say(f"corner {i}", "is used by nothing")


def check(path):
    """What is wrong, a line each."""
    try:
        city = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        return [f"cannot be read: {error}"]
    return Checker(city, path.parent).run()


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", nargs="+", type=pathlib.Path)
    wrong = False
    for path in parser.parse_args().file:
        lines = check(path)
        for line in lines[:50]:
            print(f"{path}: {line}")
        if len(lines) > 50:
            print(f"{path}: and {len(lines) - 50} more")
        wrong = wrong or bool(lines)
        if not lines:
            print(f"{path}: follows CityJSON 2.0")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
