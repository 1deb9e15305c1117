# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole chain on the sample survey at reduced sizes, against its truth, and what a second run,
a changed option, an added photo and another number of threads do."""
import itertools
import json
import math
import shutil
import statistics
import subprocess
import sys
import unittest

import sample_plan
import stucco

TRUTH = stucco.ROOT / "data/sample/truth"
# Small enough for a test, large enough for every wall to be found.
SIZES = {"calib": {"max_image_px": 700, "max_features": 1500}, "dense": {"max_image_px": 320},
         "texture": {"texel_size": 0.05}}


def set_options(survey, sections):
    """Changes values in survey.toml, as a user would."""
    settings = survey / "survey.toml"
    lines, section = settings.read_text().splitlines(), ""
    for number, line in enumerate(lines):
        if line.startswith("["):
            section = line[1:line.index("]")]
        for name, value in sections.get(section, {}).items():
            if line.startswith(f"{name} = "):
                lines[number] = f"{name} = {value}"
    settings.write_text("\n".join(lines) + "\n")


def camera_centres(images_txt):
    """Name -> centre, from COLMAP's images.txt."""
    return {name: centre for name, (centre, _) in sample_plan.cameras(images_txt).items()}


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def area(ring):
    """Of a planar polygon in space."""
    total = [0.0, 0.0, 0.0]
    for a, b in zip(ring, ring[1:] + ring[:1]):
        total[0] += a[1] * b[2] - a[2] * b[1]
        total[1] += a[2] * b[0] - a[0] * b[2]
        total[2] += a[0] * b[1] - a[1] * b[0]
    return math.hypot(*total) / 2


class Chain(stucco.TestCase):
    """One survey, run once with two threads; tests that change something work on a copy."""

    @classmethod
    def setUpClass(cls):
        cls.suite = stucco.TestCase()
        cls.suite.setUp()
        cls.photos = cls.suite.photo_folder()
        cls.finished = cls.suite.init(cls.photos)
        set_options(cls.finished, SIZES)
        cls.first = cls.run_survey(cls.finished)

    @classmethod
    def tearDownClass(cls):
        cls.suite.doCleanups()

    @classmethod
    def run_survey(cls, survey, *words):
        process = cls.suite.check(stucco.run("run", survey, "--json", "--threads", 2, *words))
        return json.loads(process.stdout)

    def copy(self):
        survey = self.root / "copy"
        shutil.copytree(self.finished, survey)
        return survey

    @staticmethod
    def ran(result):
        return {stage["stage"] for stage in result["stages"] if stage["action"] == "ran"}

    def load(self, path):
        return json.loads((self.finished / path).read_text())

    def test_all_photos_are_posed_where_they_were(self):
        calibration = self.load("calib/calibration.json")
        count = len(stucco.sample_photos())
        self.assertEqual((calibration["photos_posed"], calibration["photos_total"]), (count, count))
        self.assertLess(calibration["reprojection_error_px"], 1)
        posed = camera_centres(self.finished / "calib/sparse/0/images.txt")
        truth = camera_centres(TRUTH / "images.txt")
        # Distances between cameras do not depend on the world frame.
        ratios = [math.dist(posed[a], posed[b]) / math.dist(truth[a], truth[b])
                  for a, b in itertools.combinations(sorted(truth), 2)
                  if math.dist(truth[a], truth[b]) > 5]
        scale = statistics.median(ratios)
        self.assertAlmostEqual(scale, 1, delta=0.05)  # from noisy GPS
        for ratio in ratios:
            self.assertAlmostEqual(ratio / scale, 1, delta=0.01)

    def truth_from_survey_m(self, truth_origin):
        """Shift between the two local frames, whose origins are some metres apart. Both are level
        to well below a millimetre at that distance."""
        georef = self.load("calib/georef.json")
        self.assertEqual(georef["frame"], "enu")
        metres_per_deg = math.radians(1) * 6378137
        latitude = truth_origin["latitude_deg"]
        return [metres_per_deg * math.cos(math.radians(latitude))
                * (georef["origin_longitude_deg"] - truth_origin["longitude_deg"]),
                metres_per_deg * (georef["origin_latitude_deg"] - latitude),
                georef["origin_height_m"] - truth_origin["height_m"]]

    def test_large_walls_and_roofs_are_found(self):
        truth = json.loads((TRUTH / "planes.json").read_text())
        planes, shift = truth["planes"], self.truth_from_survey_m(truth["origin"])
        facets = [facet for building in self.load("proxy/facets.json")["buildings"]
                  for facet in building["facets"]]
        large = [plane for plane in planes if plane["class"] != "ground"
                 and area(plane["outer"]) > 20]
        self.assertGreater(len(large), 6)
        missing = [plane["id"] for plane in large if not any(
            dot(plane["normal"], facet["normal"]) > math.cos(math.radians(5))
            and abs(plane["offset"] - facet["offset"] - dot(facet["normal"], shift)) < 0.6
            for facet in facets)]
        self.assertEqual(missing, [])

    def test_facades_are_textured_and_reported(self):
        textures = self.load("texture/textures.json")["facets"]
        painted = [facet for facet in textures if facet["image"]]
        self.assertGreater(len(painted), 6)
        for facet in painted:
            self.assertTrue((self.finished / "texture" / facet["image"]).is_file())
            self.assertTrue(facet["photos"])
            self.assertGreater(facet["metres_per_texel"], 0)
        for name in ("model.glb", "model.obj"):
            self.assertGreater((self.finished / "texture" / name).stat().st_size, 1000)
        self.assertEqual((self.finished / "texture/model.glb").read_bytes()[:4], b"glTF")
        facades = self.load("report/report.json")["facades"]
        self.assertGreater(len(facades), 6)
        page = (self.finished / "report/report.html").read_text()
        for facade in facades:
            is_floor = facade["class"] == "GroundSurface" and facade["building"] != "G0"
            verdicts = (None,) if is_floor else ("green", "amber", "red")
            self.assertIn(facade["verdict"], verdicts, facade["id"])
            self.assertIn(facade["id"], page)
        self.assertTrue((self.finished / "report/facades.csv").is_file())

    def test_results_can_be_exported(self):
        for name, size in (("glb", 1000), ("ply", 10000)):
            out = self.root / f"model.{name}"
            self.check(stucco.run("export", self.finished, "--format", name, "-o", out))
            self.assertGreater(out.stat().st_size, size)
        out = self.root / "obj"
        self.check(stucco.run("export", self.finished, "--format", "obj", "-o", out))
        text = (out / "model.obj").read_text()
        self.assertIn("mtllib", text)
        materials = next(out.glob("*.mtl")).read_text()
        for line in materials.splitlines():
            if line.strip().startswith("map_Kd"):
                self.assertTrue((out / line.split(maxsplit=1)[1]).is_file(), line)

    def test_cityjson_names_pictures_that_are_there(self):
        out = self.root / "cities/sample.city.json"
        process = self.check(stucco.run("export", self.finished, "--format", "cityjson", "-o", out))
        self.assertIn("sample_appearance", process.stdout)
        city = json.loads(out.read_text())
        textures = city["appearance"]["textures"]
        self.assertGreater(len(textures), 6)
        for texture in textures:
            self.assertTrue((out.parent / texture["image"]).is_file(), texture)
        checker = stucco.ROOT / "bench/check_cityjson.py"
        written = [out, self.finished / "proxy/proxy.city.json"]
        self.check(subprocess.run([sys.executable, "-B", checker, *written], capture_output=True,
                                  text=True, check=False))

    def test_everything_is_measured(self):
        for stage in self.first["stages"]:
            self.assertEqual(stage["action"], "ran")
            self.assertGreater(stage["wall_s"], 0)
            self.assertGreater(stage["cpu_s"], 0)
            self.assertGreater(stage["peak_memory_mb"], 1)

    def test_a_second_run_does_nothing(self):
        before = {path: path.stat().st_mtime_ns for path in self.finished.rglob("*")
                  if ".stucco" not in path.parts}
        self.assertEqual(self.ran(self.run_survey(self.finished)), set())
        after = {path: path.stat().st_mtime_ns for path in self.finished.rglob("*")
                 if ".stucco" not in path.parts}
        self.assertEqual(before, after)

    def test_a_changed_option_runs_exactly_its_dependants(self):
        survey = self.copy()
        set_options(survey, {"report": {"picture_px": 400}})
        self.assertEqual(self.ran(self.run_survey(survey)), {"report"})
        set_options(survey, {"texture": {"seam_cost": 0.7}})
        status = json.loads(self.check(stucco.run("status", survey, "--json")).stdout)
        reasons = {stage["stage"]: stage["reasons"] for stage in status["stages"]}
        self.assertEqual(reasons["texture"],
                         ["option texture.seam_cost changed from 1.0 to 0.7"])
        self.assertEqual(reasons["report"], ["texture will change"])
        self.assertEqual(self.ran(self.run_survey(survey)), {"texture", "report"})

    def test_one_thread_gives_the_same_bytes_as_two(self):
        survey = self.suite.init(self.photos, "one-thread")
        set_options(survey, SIZES)
        self.check(stucco.run("run", survey, "--threads", 1))
        one, two = stucco.contents(survey), stucco.contents(self.finished)
        self.assertEqual(sorted(one), sorted(two))
        self.assertEqual([name for name in one if one[name] != two[name]], [])

    def test_an_added_photo_computes_only_what_involves_it(self):
        photos = self.photo_folder()
        last = sorted(photos.iterdir())[-1]
        aside = self.root / last.name
        last.rename(aside)
        survey = self.init(photos)
        set_options(survey, SIZES)
        self.run_survey(survey, "--until", "calib")
        others = len(stucco.sample_photos()) - 1
        aside.rename(last)
        result = self.run_survey(survey, "--until", "calib")
        units = {stage["stage"]: stage["units"] for stage in result["stages"]}
        self.assertEqual(units["ingest"]["photo"], {"computed": 1, "reused": others})
        self.assertEqual(units["calib"]["features"], {"computed": 1, "reused": others})
        self.assertLessEqual(units["calib"]["pairs"]["computed"], others)
        self.assertGreater(units["calib"]["pairs"]["reused"], others)


if __name__ == "__main__":
    unittest.main()
