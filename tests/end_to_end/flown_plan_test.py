# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A made house, planned, flown by the virtual drone and calibrated: its photos find their poses by
plan and records, and the model lies where positions or, when asked, the map put it."""
import json
import sys
import unittest

import stucco

CAMERA = ("--camera", "17.3x13mm,12.29mm,1000x750", "--gsd", 0.08)
CALIB = ("--until", "calib", "--set", "calib.max_features=3000", "--set", "calib.neighbours=10")


class FlownPlan(stucco.TestCase):
    def fly(self):
        """The scene, and a survey with photos of one of its houses."""
        scene, survey = self.root / "scene", self.root / "survey"
        self.check(stucco.run("simulate", "city", "-o", scene, "--style", "hamlet", "--seed", 21))
        self.check(stucco.run("plan", scene / "map.geojson", "-o", survey, *CAMERA))
        plan = json.loads((survey / "plan/plan.json").read_text())
        house = [f["id"] for f in plan["facades"] if f["id"].startswith("B0001/")]
        self.assertGreater(len(house), 3)
        self.check(stucco.run("simulate", scene, survey, "-o", survey, "--scale", 0.8,
                              "--facades", ",".join(house)))
        return scene, survey

    def calibrate(self, scene, survey, *words):
        """calibration.json, and how far poses are off."""
        self.check(stucco.run("run", survey, *CALIB, *words))
        self.check(stucco.run("evaluate", survey, "--truth", scene))
        calibration = json.loads((survey / "calib/calibration.json").read_text())
        return calibration, json.loads((survey / "evaluation/evaluation.json").read_text())["poses"]

    def test_photos_find_their_poses_and_the_model_its_place(self):
        scene, survey = self.fly()
        calibration, poses = self.calibrate(scene, survey)
        # What is left without a pose shows the other houses, of which there are hardly any photos.
        self.assertGreaterEqual(poses["posed"], 0.9 * poses["total"])
        self.assertLess(poses["position_max_m"], 0.15)
        self.assertLess(poses["georeferenced_rotation_mean_deg"], 0.3)
        # The receiver of the virtual drone is off by a metre and a half, and up by less.
        by_positions = poses["georeferenced_mean_m"]
        self.assertGreater(by_positions, 1)
        self.assertFalse(calibration["map"]["moved"])
        self.assertTrue(any("calib.georef" in text for text in calibration["findings"]))
        calibration, poses = self.calibrate(scene, survey, "--set", "calib.georef=map")
        self.assertTrue(calibration["map"]["moved"])
        self.assertLess(poses["georeferenced_mean_m"], 0.5 * by_positions)
        self.assertLess(poses["georeferenced_rotation_mean_deg"], 0.3)
        self.assertTrue(json.loads((survey / "calib/georef.json").read_text())["on_map"])


if __name__ == "__main__":
    sys.exit(unittest.main())
