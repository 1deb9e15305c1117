# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of bench/scene_trees.py: trees must come out where they stand."""
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

BENCH = pathlib.Path(__file__).parents[2] / "bench"


def write_scene(folder):
    """A wall, and a tree of two materials 100 m east and 200 m north of the origin."""
    corners = [([98, 0, -202], [102, 3, -198]), ([97, 2, -203], [103, 9, -197]),
               ([0, 0, 0], [10, 5, 1])]
    model = {"nodes": [{"name": "B0001/F00", "mesh": 1}, {"name": "occluder/tree-000", "mesh": 0},
                       {"name": "occluder/car-000", "mesh": 1}],
             "meshes": [{"primitives": [{"attributes": {"POSITION": i}} for i in (0, 1)]},
                        {"primitives": [{"attributes": {"POSITION": 2}}]}],
             "accessors": [{"min": low, "max": high} for low, high in corners]}
    chunk = json.dumps(model).encode()
    (folder / "scene.glb").write_bytes(
        struct.pack("<4sIIII", b"glTF", 2, 20 + len(chunk), len(chunk), 0x4E4F534A) + chunk)
    (folder / "scene.json").write_text(json.dumps(
        {"origin": {"latitude_deg": 50.0, "longitude_deg": 14.0, "height_m": 200.0}}))


class SceneTrees(unittest.TestCase):
    def test_a_tree_is_a_point_with_height_and_crown(self):
        with tempfile.TemporaryDirectory() as made:
            folder = pathlib.Path(made)
            write_scene(folder)
            subprocess.run([sys.executable, BENCH / "scene_trees.py", folder, folder / "trees.json"],
                           check=True, capture_output=True)
            trees = json.loads((folder / "trees.json").read_text())["features"]
        self.assertEqual(len(trees), 1)
        self.assertEqual(trees[0]["properties"],
                         {"id": "occluder/tree-000", "height": 9, "diameter_crown": 6})
        longitude, latitude = trees[0]["geometry"]["coordinates"]
        # Metres a degree at 50 degrees north: 111 229 along the meridian, 71 696 along the parallel.
        self.assertTrue(math.isclose((longitude - 14) * 71696, 100, rel_tol=1e-3), longitude)
        self.assertTrue(math.isclose((latitude - 50) * 111229, 200, rel_tol=1e-3), latitude)


if __name__ == "__main__":
    unittest.main()
