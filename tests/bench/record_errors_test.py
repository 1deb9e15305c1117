# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Faults that bench/record_errors.py puts into records, and what it tells Exiv2 of them."""
import math
import pathlib
import random
import sys
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).parents[2] / "bench")]
import record_errors  # noqa: E402


def records(count=1):
    photo = {"position": {"latitude_deg": 60.0, "longitude_deg": -20.0, "height_m": 12.5,
                          "has_height": True},
             "gimbal": {"yaw_deg": 170.0, "pitch_deg": -30.0, "roll_deg": 0.0}}
    return [record_errors.Record(photo) for _ in range(count)]


def moved_m(record):
    north = (record.position["latitude_deg"] - 60) * record_errors.METRES_PER_DEGREE
    east = (record.position["longitude_deg"] + 20) * record_errors.METRES_PER_DEGREE / 2
    return math.hypot(east, north)


class Faults(unittest.TestCase):
    def test_a_bias_moves_every_position_alike(self):
        for record in record_errors.gps_bias(records(3), random.Random(1)):
            self.assertAlmostEqual(moved_m(record), 5, delta=0.01)

    def test_noise_moves_every_position_by_itself(self):
        moved = [moved_m(r) for r in record_errors.gps_noise(3)(records(1000), random.Random(1))]
        self.assertAlmostEqual(sum(m * m for m in moved) / 1000, 18, delta=2)
        self.assertEqual(len(set(moved)), 1000)

    def test_a_fifth_of_the_positions_is_wild(self):
        far = [moved_m(r) for r in record_errors.wild_positions(records(1000), random.Random(1))]
        self.assertAlmostEqual(sum(d > 29 for d in far), 200, delta=40)
        self.assertEqual(sum(0.01 < d < 29 for d in far), 0)

    def test_photos_do_not_share_what_is_changed(self):
        first, second = records(2)
        first.move(1, 0, 0)
        self.assertEqual(moved_m(second), 0)

    def test_a_map_moves_without_its_views(self):
        plan = {"footprints": [{"rings_m": [[[0, 0], [1, 0], [0, 1]]]}],
                "facades": [{"a_m": [0, 0], "b_m": [1, 0]}],
                "views": [{"position_m": [5, 5, 5]}]}
        moved = record_errors.moved_map(plan, 2, -1)
        self.assertEqual(moved["footprints"][0]["rings_m"][0][1], [3, -1])
        self.assertEqual(moved["facades"][0]["b_m"], [3, -1])
        self.assertEqual(moved["views"][0]["position_m"], [5, 5, 5])


class Commands(unittest.TestCase):
    def test_positions_are_exact_to_millimetres(self):
        text = record_errors.degrees(-52.123456789)
        degree, minute, second = (int(a) / int(b) for a, b in
                                  (part.split("/") for part in text.split()))
        self.assertAlmostEqual(degree + minute / 60 + second / 3600, 52.123456789, delta=2e-8)

    def test_yaw_stays_within_half_a_turn(self):
        turned = record_errors.compass(records(), random.Random(1))[0]
        self.assertIn("set Xmp.drone-dji.GimbalYawDegree -165.00", record_errors.commands(turned))

    def test_without_heights_none_is_left(self):
        record = record_errors.no_heights(records(), random.Random(1))[0]
        words = record_errors.commands(record)
        self.assertFalse([word for word in words if "Altitude" in word and word[:3] != "del"])
        self.assertIn("del Xmp.drone-dji.RelativeAltitude", words)


if __name__ == "__main__":
    unittest.main()
