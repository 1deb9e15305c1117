# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The chain on real photo sets, which are not part of the repository: they are looked for in the
folder that STUCCO_DATA names, else in ../shared/data beside the repository."""
import json
import math
import os
import pathlib
import unittest

import stucco

DATA = pathlib.Path(os.environ.get("STUCCO_DATA", stucco.ROOT.parent / "shared/data"))


class RealSets(stucco.TestCase):
    def run_set(self, name, *words, exit_code=0):
        photos = DATA / name / "images"
        if not photos.is_dir():
            self.skipTest(f"{photos} is not here")
        survey = self.init(photos)
        self.check(stucco.run("run", survey, *words, timeout=7200), exit_code)
        return survey

    @staticmethod
    def load(survey, path):
        return json.loads((survey / path).read_text())

    def assert_posed(self, survey, count, most_px):
        calibration = self.load(survey, "calib/calibration.json")
        self.assertEqual((calibration["photos_posed"], calibration["photos_total"]), (count, count))
        self.assertLessEqual(calibration["reprojection_error_px"], most_px)
        return calibration

    def test_sceaux(self):
        survey = self.run_set("sceaux")
        self.assert_posed(survey, 11, 0.7)
        proxy = self.load(survey, "proxy/facets.json")
        walls = [facet for building in proxy["buildings"] for facet in building["facets"]
                 if facet["class"] == "WallSurface"]
        front = max(walls, key=lambda facet: facet["area_m2"])
        tilt = abs(sum(a * b for a, b in zip(front["normal"], proxy["up"])))
        self.assertLess(math.degrees(math.asin(tilt)), 2)
        painted = {facet["id"]: facet for facet in
                   self.load(survey, "texture/textures.json")["facets"]}
        self.assertGreater(painted[front["id"]]["painted"], 0.7)
        self.assertTrue((survey / "report/report.html").is_file())
        for stage in json.loads(self.check(stucco.run("status", survey, "--json")).stdout)["stages"]:
            self.assertLess(stage["peak_memory_mb"], 4096, stage["stage"])

    def test_castle(self):
        self.assert_posed(self.run_set("castle-P19", "--until", "calib"), 19, 1)

    def test_fountain(self):
        self.assert_posed(self.run_set("fountain-P11", "--until", "calib"), 11, 1)

    def test_mirafiori(self):
        survey = self.run_set("mirafiori", "--until", "calib")
        calibration = self.assert_posed(survey, 32, 1)
        self.assertLess(calibration["prior_rms_m"]["horizontal"], 0.1)
        self.assertLess(calibration["prior_rms_m"]["vertical"], 0.1)
        self.assertEqual(self.load(survey, "calib/georef.json")["frame"], "enu")

    def test_minsk_says_that_it_cannot_know(self):
        photos = DATA / "minsk/images"
        if not photos.is_dir():
            self.skipTest(f"{photos} is not here")
        survey = self.init(photos)
        process = stucco.run("run", survey, timeout=7200)
        self.assertIn(process.returncode, (0, 1), process.stderr)
        said = process.stderr + (survey / "report/report.html").read_text()
        self.assertIn("rotation", said)
        calibration = survey / "calib/calibration.json"
        if calibration.is_file():
            self.assertLess(json.loads(calibration.read_text())["photos_posed"], 8)


if __name__ == "__main__":
    unittest.main()
