#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of bench/proxy_growth.py: towns must be scanned where they stand."""
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
import proxy_growth  # noqa: E402

OUTER = [(0, 0), (20, 0), (20, 10), (0, 10)]
COURT = [(8, 3), (8, 7), (12, 7), (12, 3)]
TOWN = [{"rings": [OUTER, COURT], "height": 9.0}]


class Scan(unittest.TestCase):
    def setUp(self):
        self.dice = np.random.default_rng(1)

    def test_courtyards_are_outside(self):
        xy = np.array([(1, 1), (10, 5), (13, 5), (21, 5), (-1, 5), (10, 11)], dtype=float)
        self.assertEqual(proxy_growth.inside([OUTER, COURT], xy).tolist(),
                         [True, False, True, False, False, False])

    def test_roofs_and_ground(self):
        points = proxy_growth.scan_roofs_and_ground(TOWN, 4, self.dice)
        self.assertAlmostEqual(len(points), 4 * 40 * 30, delta=250)
        high = points[points[:, 2] > 0]
        self.assertAlmostEqual(len(high), 4 * (200 - 16), delta=90)
        self.assertTrue(np.all(high[:, 2] == 9))
        self.assertTrue(proxy_growth.inside([OUTER, COURT], high[:, :2]).all())

    def test_walls(self):
        points = proxy_growth.scan_walls(TOWN, 4, self.dice)
        self.assertAlmostEqual(len(points), 4 * 9 * (60 + 16), delta=200)
        self.assertTrue((points[:, 2] >= 0).all() and (points[:, 2] <= 9).all())
        on_outer = (np.isclose(points[:, 0] % 20, 0) | np.isclose(points[:, 1] % 10, 0))
        self.assertAlmostEqual(on_outer.mean(), 60 / 76, delta=0.05)

    def test_growth(self):
        cost = {"points": 10, "wall_s": 5.0, "peak_memory_mb": 100, "closed": 3}
        rows = list(proxy_growth.rows_of({10: {**cost, "cpu_s": 8.0}, 40: {**cost, "cpu_s": 32.0}}))
        self.assertEqual([row[4] for row in rows], ["-", "1.00"])
        self.assertEqual(rows[1][6], "3 of 40")


if __name__ == "__main__":
    unittest.main()
