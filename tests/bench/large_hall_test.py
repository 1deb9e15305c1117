#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of bench/large_hall.py: the hall must be scanned where it stands."""
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
import large_hall  # noqa: E402


class Hall(unittest.TestCase):
    def setUp(self):
        self.ridges = np.array([8.0, 9.0])

    def test_gables(self):
        xy = np.array([(0, 5), (3, 5), (6, 5), (9, 5), (10.5, 5), (12, 5), (3, -1), (3, 31)])
        np.testing.assert_allclose(large_hall.height_at(xy, self.ridges),
                                   [6, 8, 6, 9, 7.5, 0, 0, 0])

    def test_scan(self):
        points, on_roof = large_hall.scan(self.ridges, 4, np.random.default_rng(1))
        self.assertAlmostEqual(len(on_roof), 4 * 12 * 30, delta=150)
        self.assertTrue((on_roof[:, 2] >= 6).all())
        front = points[(points[:, 1] == 0) & (points[:, 2] > 0)]
        self.assertAlmostEqual(len(front), 4 * 6 * (7 + 7.5), delta=60)

    def test_roofs_off(self):
        # One roof that is half a metre too high over its second half.
        half = [[0, 0, 0], [5, 0, 0], [5, 10, 0], [0, 10, 0]]
        rest = [[5, 0, 0], [10, 0, 0], [10, 10, 0], [5, 10, 0]]
        roofs = [{"normal": [0, 0, 1], "offset": height, "outer": ring, "holes": []}
                 for height, ring in ((6, half), (6.5, rest))]
        places = np.array([(x + 0.5, 4.5, 26) for x in range(10)])
        self.assertAlmostEqual(large_hall.roofs_off(roofs, places), 0.25, places=6)


if __name__ == "__main__":
    unittest.main()
