# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""bench/check_cityjson.py finds what does not follow the specification, and nothing else."""
import copy
import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "bench"))
import check_cityjson  # noqa: E402

# A block of one metre with a picture on its front.
FACES = [[0, 3, 2, 1], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [4, 5, 6, 7]]
CITY = {
    "type": "CityJSON", "version": "2.0",
    "transform": {"scale": [0.001] * 3, "translate": [0, 0, 0]},
    "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/5555",
                 "geographicalExtent": [0, 0, 0, 1, 1, 1]},
    "CityObjects": {
        "B1": {"type": "Building", "children": ["B1-1"], "attributes": {"source": "map"}},
        "B1-1": {"type": "BuildingPart", "parents": ["B1"], "geometry": [{
            "type": "Solid", "lod": "2.2", "boundaries": [[[face] for face in FACES]],
            "semantics": {"surfaces": [{"type": "GroundSurface"}, {"type": "WallSurface", "id": "W"},
                                       {"type": "RoofSurface"}],
                          "values": [[0, 1, 1, 1, 1, 2]]},
            "texture": {"now": {"values": [[[[None]], [[0, 0, 1, 2, 3]]] + 4 * [[[None]]]]}},
        }]}},
    "vertices": [[1000 * x, 1000 * y, z] for z in (0, 1000)
                 for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))],
    "appearance": {"textures": [{"type": "PNG", "image": "front.png"}],
                   "vertices-texture": [[0, 0], [1, 0], [1, 1], [0, 1]]},
}


def part(city):
    return city["CityObjects"]["B1-1"]


def shape(city):
    return part(city)["geometry"][0]


def put(member, value):
    return lambda thing: thing.__setitem__(member, value)


# What is done to the file, and a word of what is said of it.
FAULTS = {
    "is no CityJSON": put("type", "FeatureCollection"),
    "is not 2.0": put("version", "1.1"),
    "unknown member colour": put("colour", "red"),
    "scale is not": lambda c: c["transform"].pop("scale"),
    "is no OGC address": lambda c: c["metadata"].update(referenceSystem="EPSG:5555"),
    "is not six numbers": lambda c: c["metadata"].update(geographicalExtent=[0, 0, 1, 1]),
    "unknown type 'House'": lambda c: c["CityObjects"]["B1"].update(type="House"),
    "is no child of its parent": lambda c: c["CityObjects"]["B1"].update(children=[]),
    "is no parent of its child": lambda c: part(c).update(parents=[]),
    "without parents": lambda c: part(c).pop("parents"),
    "is no text": lambda c: shape(c).update(lod=2.2),
    "not as deep": lambda c: shape(c).update(boundaries=[FACES]),
    "there is no corner 8": lambda c: c["vertices"].pop() and shape(c)["boundaries"][0][5].append(
        [4, 5, 8]),
    "one twice": lambda c: shape(c)["boundaries"][0][0][0].append(0),
    "not as many values": lambda c: shape(c)["semantics"]["values"][0].pop(),
    "there is no surface 3": lambda c: shape(c)["semantics"]["values"][0].__setitem__(0, 3),
    "is no single value": lambda c: shape(c)["semantics"]["surfaces"][1].update(others=["F1"]),
    "unknown type 'Wall'": lambda c: shape(c)["semantics"]["surfaces"][1].update(type="Wall"),
    "has 4 values": lambda c: shape(c)["texture"]["now"]["values"][0][1][0].pop(),
    "no texture 1": lambda c: shape(c)["texture"]["now"]["values"][0][1][0].__setitem__(0, 1),
    "that no texture has": lambda c: c["appearance"]["vertices-texture"].pop(),
    "there is no front.jpg": lambda c: c["appearance"]["textures"][0].update(image="front.jpg"),
    "neither PNG nor JPG": lambda c: c["appearance"]["textures"][0].update(type="TIF"),
    "is there twice": lambda c: c["vertices"].append([0, 0, 0]),
    "is used by nothing": lambda c: c["vertices"].append([5, 5, 5]),
    "is not three whole numbers": lambda c: c["vertices"].__setitem__(0, [0.5, 0, 0]),
}


class CheckCityJson(unittest.TestCase):
    def said_of(self, city):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "block.city.json"
            (path.parent / "front.png").write_bytes(b"")
            path.write_text(json.dumps(city))
            return check_cityjson.check(path)

    def test_says_nothing_of_a_sound_file(self):
        self.assertEqual(self.said_of(CITY), [])

    def test_finds_each_fault(self):
        for said, fault in FAULTS.items():
            with self.subTest(said):
                city = copy.deepcopy(CITY)
                fault(city)
                self.assertTrue(any(said in line for line in self.said_of(city)),
                                self.said_of(city))

    def test_says_that_a_file_cannot_be_read(self):
        self.assertIn("cannot be read", check_cityjson.check(pathlib.Path("/nowhere"))[0])


if __name__ == "__main__":
    unittest.main()
