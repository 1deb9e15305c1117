# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of bench/make_town.py: growth is measured on its towns, so they must be alike."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

BENCH = pathlib.Path(__file__).parents[2] / "bench"
sys.path.insert(0, str(BENCH))
import make_town  # noqa: E402


def signed_area(ring):
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:] + ring[:1])) / 2


def built(town):
    return sum(signed_area(ring) for building in town for ring in building["rings"])


def ground(town):
    """Area of the square-ish hull of all corners."""
    points = sorted({p for building in town for p in building["rings"][0]})

    def half(points):
        chain = []
        for p in points:
            while len(chain) > 1 and signed_area([chain[-2], chain[-1], p]) <= 0:
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return signed_area(half(points) + half(points[::-1]))


def crosses(a, b, c, d):
    def side(p, q, r):
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    eps = 1e-6
    return (side(a, b, c) * side(a, b, d) < -eps and side(c, d, a) * side(c, d, b) < -eps)


class Town(unittest.TestCase):
    def test_has_as_many_buildings_as_asked_for(self):
        for count in (1, 10, 137):
            self.assertEqual(len(make_town.make_town(count, 1, 0.25)), count)

    def test_grows_from_the_middle(self):
        small, large = make_town.make_town(40, 3, 0.25), make_town.make_town(160, 3, 0.25)
        self.assertEqual(small, large[:40])

    def test_density_is_what_was_asked_for_and_does_not_grow(self):
        for density in (0.15, 0.25, 0.3):
            for count in (320, 1250):
                town = make_town.make_town(count, 1, density)
                self.assertAlmostEqual(built(town) / ground(town), density, delta=0.12 * density)

    def test_rings_are_oriented_and_heights_possible(self):
        for building in make_town.make_town(400, 2, 0.25):
            self.assertGreater(signed_area(building["rings"][0]), 20)
            for hole in building["rings"][1:]:
                self.assertLess(signed_area(hole), -20)
            self.assertTrue(4 <= building["height"] <= 30)

    def test_walls_do_not_cross(self):
        town = make_town.make_town(160, 5, 0.3)
        edges = [(k, ring[i], ring[(i + 1) % len(ring)]) for k, b in enumerate(town)
                 for ring in b["rings"] for i in range(len(ring))]
        for i, (k, a, b) in enumerate(edges):
            for n, c, d in edges[:i]:
                if n != k and abs(a[0] - c[0]) + abs(a[1] - c[1]) < 80:
                    self.assertFalse(crosses(a, b, c, d), (k, n))

    def test_neighbours_share_walls(self):
        corners = {}
        for k, building in enumerate(make_town.make_town(160, 1, 0.25)):
            for x, y in building["rings"][0]:
                corners.setdefault((round(x, 3), round(y, 3)), set()).add(k)
        self.assertGreater(sum(len(owners) > 1 for owners in corners.values()), 100)


class Sheds(unittest.TestCase):
    def test_stand_alone_nine_metres_apart(self):
        sheds = make_town.make_sheds(7)
        self.assertEqual(len(sheds), 7)
        boxes = [(min(p[0] for p in ring), min(p[1] for p in ring),
                  max(p[0] for p in ring), max(p[1] for p in ring))
                 for ring in (shed["rings"][0] for shed in sheds)]
        for i, a in enumerate(boxes):
            self.assertEqual((a[2] - a[0], a[3] - a[1]), (4, 3))
            self.assertGreater(signed_area(sheds[i]["rings"][0]), 0)
            gaps = [max(b[0] - a[2], a[0] - b[2], b[1] - a[3], a[1] - b[3])
                    for n, b in enumerate(boxes) if n != i]
            self.assertEqual(min(gaps), 9)


class Program(unittest.TestCase):
    def run_it(self, *args):
        return subprocess.run([sys.executable, BENCH / "make_town.py", *args],
                              capture_output=True, text=True)

    def test_same_arguments_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            files = [pathlib.Path(folder, name) for name in ("a.geojson", "b.geojson")]
            for file in files:
                self.assertEqual(self.run_it("--buildings", "50", "-o", file).returncode, 0)
            self.assertEqual(files[0].read_bytes(), files[1].read_bytes())
            features = json.loads(files[0].read_text())["features"]
            self.assertEqual([f["properties"]["id"] for f in features], list(range(1, 51)))
            for feature in features:
                for ring in feature["geometry"]["coordinates"]:
                    self.assertEqual(ring[0], ring[-1])
                    self.assertTrue(all(abs(p[0] - 14.4) < 0.01 for p in ring))

    def test_refuses_impossible_towns(self):
        self.assertEqual(self.run_it("--buildings", "0", "-o", "x").returncode, 2)
        self.assertEqual(self.run_it("--buildings", "5", "--density", "0.9", "-o", "x").returncode, 2)


if __name__ == "__main__":
    unittest.main()
