# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""bench/plan_check.py finds what is wrong with a plan, and nothing else."""
import copy
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "bench"))
import plan_check  # noqa: E402

BOX = [[0, 0], [10, 0], [10, 10], [0, 10]]
PLAN = {
    "d_min_m": 5, "d_max_m": 50,
    "footprints": [{"building": "B0001", "rings_m": [BOX], "blocked_to_m": 30}],
    "facades": [{"id": f"B0001/F0{i}", "a_m": BOX[i], "b_m": BOX[(i + 1) % 4]} for i in range(4)],
    "views": [{"id": f"v{i}", "position_m": p, "kind": "dipping",
               "targets": [{"facade": f"B0001/F0{i}", "along_m": [0, 10]}]}
              for i, p in enumerate([[5, -5, 4], [15, 5, 4], [5, 15, 4], [-5, 5, 4]])],
    "flights": [{"waypoints": [{"position_m": p} for p in
                               ([5, -5, 4], [15, -5, 4], [15, 5, 30], [-5, 5, 30], [-5, 5, 4])]}],
}


class PlanCheck(unittest.TestCase):
    def setUp(self):
        self.plan = copy.deepcopy(PLAN)

    def unsafe(self):
        return plan_check.unsafe_segments(self.plan, list(plan_check.all_segments(self.plan)))

    def test_accepts_a_plan_at_exactly_the_least_distance(self):
        self.assertEqual(self.unsafe(), [])

    def test_finds_a_view_that_is_a_millimetre_too_near(self):
        self.plan["views"][0]["position_m"][1] = -4.999
        self.assertEqual([line.split(":")[0] for line in self.unsafe()], ["v0"])

    def test_finds_a_leg_through_a_building_between_safe_points(self):
        self.plan["flights"][0]["waypoints"][2]["position_m"][2] = 29
        self.assertIn("flight 0 leg 2", self.unsafe()[0])

    def test_finds_no_fly_polygons(self):
        self.plan["no_fly_m"] = [[[4, -9], [6, -9], [6, -3], [4, -3]]]
        self.assertTrue(any("no-fly" in line for line in self.unsafe()))

    def test_accepts_a_complete_plan_and_finds_a_missing_view(self):
        tested, missed = plan_check.unseen_parts(self.plan, 200)
        self.assertGreater(tested, 100)
        self.assertEqual(missed, [])
        self.plan["views"][2]["targets"][0]["along_m"] = [0, 6]
        _, missed = plan_check.unseen_parts(self.plan, 200)
        self.assertTrue(missed and all(line.startswith("B0001/F02") for line in missed))


if __name__ == "__main__":
    unittest.main()
