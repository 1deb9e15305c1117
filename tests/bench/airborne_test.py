#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of bench/airborne.py: what it calls valid, near and found again must be so."""
import argparse
import pathlib
import sys
import unittest

try:
    import numpy as np
except ImportError:
    print("no numpy for this interpreter: skipped")
    sys.exit(0)

BENCH = pathlib.Path(__file__).parents[2] / "bench"
sys.path.insert(0, str(BENCH))
import airborne  # noqa: E402

# A house of 8 x 6 m with a gable roof, its ridge along x between 5 and 6 m.
CORNERS = np.array([(0, 0, 0), (8, 0, 0), (8, 6, 0), (0, 6, 0), (0, 0, 5), (8, 0, 5), (8, 6, 5),
                    (0, 6, 5), (0, 3, 6), (8, 3, 6)], dtype=float)
FACES = [("GroundSurface", [3, 2, 1, 0]), ("WallSurface", [0, 1, 5, 4]),
         ("WallSurface", [1, 2, 6, 9, 5]), ("WallSurface", [2, 3, 7, 6]),
         ("WallSurface", [3, 0, 4, 8, 7]), ("RoofSurface", [4, 5, 9, 8]),
         ("RoofSurface", [8, 9, 6, 7])]


def house(corners=CORNERS, faces=FACES):
    return [airborne.Surface(kind, [ring], corners) for kind, ring in faces]


class Fault(unittest.TestCase):
    def test_a_house_has_none(self):
        self.assertEqual(airborne.fault_of(house()), "")

    def test_what_is_open_turned_or_bent_has_one(self):
        self.assertIn("open", airborne.fault_of(house(faces=FACES[:-1])))
        self.assertIn("open", airborne.fault_of(house(
            faces=FACES[:-1] + [("RoofSurface", FACES[-1][1][::-1])])))
        self.assertEqual(airborne.fault_of(house(faces=[(k, r[::-1]) for k, r in FACES])),
                         "inside out")
        bent = CORNERS.copy()
        bent[9, 2] += 0.1
        self.assertEqual(airborne.fault_of(house(bent)), "not planar")
        self.assertIn("twice", airborne.fault_of(house(
            faces=FACES[:-1] + [("RoofSurface", [8, 9, 6, 9, 7])])))
        self.assertEqual(airborne.fault_of([]), "missing")


class Roofs(unittest.TestCase):
    def test_the_truth_is_near_itself_and_all_planes_are_found(self):
        area, near, planes = airborne.hold_against(house(), house())
        self.assertAlmostEqual(area, 2 * 8 * 10 ** 0.5, delta=0.5)
        self.assertEqual(area, near)
        self.assertEqual([found for _, found in planes], [True, True])

    def test_a_roof_that_is_too_high_or_leans_otherwise_is_not(self):
        high = CORNERS + [0, 0, 0.15]
        _, near, planes = airborne.hold_against(house(), house(high))
        self.assertEqual(near, 0)
        self.assertFalse(any(found for _, found in planes))
        level = CORNERS.copy()
        level[8:, 2] = 5
        area, near, planes = airborne.hold_against(house(), house(level))
        self.assertLess(near, 0.15 * area)
        self.assertFalse(any(found for _, found in planes))

    def test_coplanar_surfaces_that_touch_are_one_plane(self):
        corners = np.vstack([CORNERS, [(4, 0, 5), (4, 3, 6)]])
        faces = FACES[:5] + [("RoofSurface", [4, 10, 11, 8]), ("RoofSurface", [10, 5, 9, 11]),
                             ("RoofSurface", [8, 11, 9, 6, 7])]
        roofs = airborne.of_kind(house(corners, faces), "RoofSurface")
        self.assertEqual(sorted(map(len, airborne.planes_of(roofs))), [1, 2])

    def test_a_scan_lies_on_roofs_and_ground(self):
        wanted = argparse.Namespace(margin=4, density=8, noise=0)
        points = airborne.scan(house(), wanted, np.random.default_rng(1))
        self.assertAlmostEqual(len(points), 8 * 16 * 14, delta=150)
        x, y, z = points.T
        inside = (x > 0) & (x < 8) & (y > 0) & (y < 6)
        self.assertTrue(np.allclose(z[inside], 6 - np.abs(y[inside] - 3) / 3))
        self.assertTrue((z[~inside] == 0).all())


if __name__ == "__main__":
    unittest.main()
