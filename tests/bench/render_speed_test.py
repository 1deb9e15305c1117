# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of bench/render_speed.py: which views it keeps of a plan."""
import pathlib
import sys
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).parents[2] / "bench")]
import render_speed  # noqa: E402


def plan(before_facades, above):
    views = [{"id": f"d{i}", "kind": "dipping", "order": 2 * i} for i in range(before_facades)]
    views += [{"id": f"o{i}", "kind": "oblique", "order": 2 * i + 1} for i in range(above)]
    return {"camera": {"name": "c", "width_px": 5280, "height_px": 3956}, "flights": [{}],
            "facades": [{"id": "B0001/F00", "views": [view["id"] for view in views]}],
            "views": views[::-1]}


class SomeViews(unittest.TestCase):
    def test_half_are_from_before_facades_and_half_from_above(self):
        some = render_speed.some_views(plan(40, 60), 6, 4000)
        kinds = [view["kind"] for view in some["views"]]
        self.assertEqual((kinds.count("dipping"), kinds.count("oblique")), (3, 3))
        self.assertEqual([view["id"] for view in some["views"]][:3], ["d6", "d20", "d33"])
        self.assertEqual(some["facades"][0]["views"],
                         [f"d{i}" for i in (6, 20, 33)] + [f"o{i}" for i in (10, 30, 50)])
        self.assertNotIn("flights", some)

    def test_photos_have_the_width_wanted_and_their_shape(self):
        camera = render_speed.some_views(plan(4, 4), 2, 4000)["camera"]
        self.assertEqual((camera["width_px"], camera["height_px"]), (4000, 2997))

    def test_a_plan_with_few_views_gives_what_it_has(self):
        self.assertEqual(len(render_speed.some_views(plan(1, 1), 10, 4000)["views"]), 2)


if __name__ == "__main__":
    unittest.main()
