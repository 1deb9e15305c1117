#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What bench/ladder.py extrudes from a map is closed, and maps keep sense under errors."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

BENCH = pathlib.Path(__file__).resolve().parents[2] / "bench"
sys.path.insert(0, str(BENCH))
import ladder  # noqa: E402

RING = [[0, 0], [10, 0], [10, 4], [6, 4], [6, 8], [0, 8]]
COURT = [[1, 1], [1, 2], [2, 2], [2, 1]]


def plan():
    """An L with a courtyard; one view is meant for all of its shortest wall."""
    facades = [{"id": f"B0001/F{i:02}", "a_m": p, "b_m": q, "z_m": [0, 5], "unobservable_m": [],
                "views": []} for i, (p, q) in enumerate(zip(RING, RING[1:] + RING[:1]))]
    return {"footprints": [{"building": "B0001", "z_m": [0, 5], "rings_m": [RING, COURT]}],
            "facades": facades,
            "views": [{"id": "v0", "targets": [{"facade": "B0001/F02", "along_m": [0, 4],
                                                "z_m": [0, 5]}]}]}


class Prism(unittest.TestCase):
    def setUp(self):
        made = plan()
        self.facets = ladder.prism(made["footprints"][0], made["facades"], (100, 50), 0)

    def test_is_closed(self):
        edges = {}
        for facet in self.facets:
            for ring in [facet["outer"], *facet["holes"]]:
                for p, q in zip(ring, ring[1:] + ring[:1]):
                    edges[(tuple(p), tuple(q))] = edges.get((tuple(p), tuple(q)), 0) + 1
        self.assertEqual(set(edges.values()), {1})
        self.assertEqual({(q, p) for p, q in edges}, set(edges))

    def test_lies_where_it_was_shifted_to_and_faces_outwards(self):
        roof, floor = self.facets[:2]
        self.assertEqual(roof["outer"][0], [100, 50, 5])
        self.assertEqual(floor["outer"][-1], [100, 50, 0])
        self.assertAlmostEqual(roof["normal"][2], 1)
        self.assertAlmostEqual(floor["normal"][2], -1)
        south = next(f for f in self.facets if f["facade"] == "B0001/F00")
        self.assertAlmostEqual(south["normal"][1], -1)
        self.assertAlmostEqual(south["area_m2"], 50)
        self.assertAlmostEqual(south["offset"], -50)

    def test_names_walls_of_the_map(self):
        named = [f["facade"] for f in self.facets if f["facade"]]
        self.assertEqual(sorted(named), [f"B0001/F{i:02}" for i in range(6)])
        self.assertEqual(len([f for f in self.facets if f["class"] == "WallSurface"]), 10)


class LocalMetres(unittest.TestCase):
    def test_agrees_with_the_ellipsoid(self):
        # A degree of latitude at 50 degrees north is 111.229 km long, one of longitude 71.696 km.
        east, north = ladder.local_metres((50, 14), 50.001, 14.001)
        self.assertAlmostEqual(north, 111.23, delta=0.02)
        self.assertAlmostEqual(east, 71.70, delta=0.02)


class CorrectPoses(unittest.TestCase):
    def test_takes_the_true_poses_and_shifts_the_points(self):
        with tempfile.TemporaryDirectory() as folder:
            survey = pathlib.Path(folder)
            own, truth = survey / "calib/sparse/0", survey / "truth/sparse"
            own.mkdir(parents=True)
            truth.mkdir(parents=True)
            (own / "images.bin").write_bytes(b"")
            (own / "cameras.txt").write_text("# C\n3 PINHOLE 100 80 90 90 50 40\n")
            (truth / "cameras.txt").write_text("1 PINHOLE 100 80 91 91 51 41\n")
            # Turned by 180 degrees about z, so that the centre is (tx, ty, -tz).
            (own / "images.txt").write_text("# I\n7 0 0 0 1 10 20 -5 3 a.jpg\n1 2 11 3 4 -1\n"
                                            "8 0 0 0 1 11 20 -5 3 b.jpg\n1 2 11\n")
            (truth / "images.txt").write_text("1 0 0 0 1 13 24 -5 1 b.jpg\n\n"
                                              "2 0 0 0 1 12 24 -5 1 a.jpg\n\n")
            (own / "points3D.txt").write_text("# P\n11 1 1 1 9 8 7 0.5 7 0 8 0\n")
            (survey / "truth/flight.json").write_text('{"georef": {"origin_latitude_deg": 50}}')
            ladder.correct_poses(survey)
            self.assertFalse((own / "images.bin").exists())
            images = (own / "images.txt").read_text().splitlines()
            self.assertEqual(images, ["7 0 0 0 1 12 24 -5 3 a.jpg", "1 2 11 3 4 -1",
                                      "8 0 0 0 1 13 24 -5 3 b.jpg", "1 2 11"])
            self.assertEqual((own / "points3D.txt").read_text(), "11 3.0 5.0 1.0 9 8 7 0.5 7 0 8 0\n")
            self.assertEqual((own / "cameras.txt").read_text(), "3 PINHOLE 100 80 91 91 51 41\n")
            self.assertEqual(json.loads((survey / "calib/georef.json").read_text())["frame"], "enu")


class PerturbedPlan(unittest.TestCase):
    def test_targets_stay_on_their_facades(self):
        for seed in range(5):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / "plan.json"
                path.write_text(json.dumps(plan()))
                subprocess.run([sys.executable, BENCH / "perturb_plan.py", path, "--seed", str(seed),
                                "--gone", "1", "--simpler", "0"], check=True,
                               stdout=subprocess.DEVNULL)
                moved = json.loads(path.read_text())
                exact = json.loads(path.with_suffix(".exact.json").read_text())
                self.assertEqual(exact, plan())
                again = [sys.executable, BENCH / "perturb_plan.py", path, "--seed", str(seed)]
                subprocess.run([*again, "--gone", "1", "--simpler", "0"], check=True,
                               stdout=subprocess.DEVNULL)
                self.assertEqual(json.loads(path.read_text()), moved)
            self.assertNotEqual(moved["footprints"][0]["rings_m"], [RING, COURT])
            facade = moved["facades"][2]
            length = sum((a - b) ** 2 for a, b in zip(facade["a_m"], facade["b_m"])) ** 0.5
            self.assertLessEqual(moved["views"][0]["targets"][0]["along_m"][1], length)

    def test_corners_are_measured_one_by_one(self):
        rings = []
        for corners in ("0", "0.2"):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / "plan.json"
                path.write_text(json.dumps(plan()))
                subprocess.run([sys.executable, BENCH / "perturb_plan.py", path, "--simpler", "0",
                                "--corners", corners], check=True, stdout=subprocess.DEVNULL)
                moved = json.loads(path.read_text())
            rings.append(moved["footprints"][0]["rings_m"][0])
            ends = {tuple(f[end]) for f in moved["facades"] for end in ("a_m", "b_m")}
            self.assertLessEqual(ends, {tuple(p) for f in moved["footprints"]
                                        for ring in f["rings_m"] for p in ring})
        off = [[a - b for a, b in zip(p, q)] for p, q in zip(*rings)]
        self.assertEqual(len({tuple(p) for p in off}), len(off))
        self.assertTrue(all(0 < math.hypot(*p) < 1 for p in off))

    def test_what_is_not_said_is_as_real_maps_are(self):
        ring = [[0, 0], [20, 0], [20, 10], [8, 10], [8, 20], [0, 20]]
        town = {"facades": [], "views": [], "footprints": [
            {"building": f"B{n:04}", "rings_m": [[[x + 40 * n, y] for x, y in ring]]}
            for n in range(20)]}
        shifts = set()
        for seed in range(4):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / "plan.json"
                path.write_text(json.dumps(town))
                subprocess.run([sys.executable, BENCH / "perturb_plan.py", path, "--seed", str(seed)],
                               check=True, stdout=subprocess.DEVNULL)
                moved = json.loads(path.read_text())
            errors = moved["map_errors"]
            shifts.add(errors["shift"])
            self.assertTrue(0.5 <= errors["shift"] <= 3)
            self.assertEqual((errors["missing"], errors["simpler"], errors["smaller"]), (1, 2, 2))
            self.assertEqual(len(moved["footprints"]), 19)
            corners = sorted(len(f["rings_m"][0]) for f in moved["footprints"])
            self.assertEqual(corners, [4] * 4 + [6] * 15)
        self.assertEqual(len(shifts), 4)


if __name__ == "__main__":
    unittest.main()
