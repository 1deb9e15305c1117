# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`stucco simulate` and `stucco evaluate` from the outside: scenes that are made, flights through
them, what is refused."""
import json
import os
import shutil
import unittest

import stucco


class SimulateCity(stucco.TestCase):
    def test_makes_a_scene_that_can_be_planned(self):
        scene = self.root / "scene"
        result = json.loads(self.check(stucco.run(
            "simulate", "city", "-o", scene, "--style", "terrain", "--seed", "4", "--texel", "0.3",
            "--json")).stdout)
        self.assertEqual(result["buildings"], 5)
        self.assertGreater(result["facades"], 15)
        self.assertEqual((scene / "scene.glb").read_bytes()[:4], b"glTF")
        self.check(stucco.run("plan", result["map"], "-o", self.root / "survey", "--terrain",
                              scene / "terrain.tif", "--quiet"))
        facades = json.loads((self.root / "survey/plan/plan.json").read_text())["facades"]
        walls = {facet["facade"] for building in json.loads(
            (scene / "truth/facets.json").read_text())["buildings"] for facet in building["facets"]}
        self.assertEqual({facade["id"] for facade in facades} - walls, set())
        self.assertEqual(len(facades), result["facades"])

    def test_refuses_what_it_does_not_know_and_folders_of_other_things(self):
        self.refused(stucco.run("simulate", "city", "-o", self.root / "s", "--style", "castle"), 2,
                     "castle", "hamlet")
        self.assertFalse((self.root / "s").exists())
        (self.root / "thesis").mkdir()
        (self.root / "thesis/one.txt").write_text("years of work")
        self.refused(stucco.run("simulate", "city", "-o", self.root / "thesis"), 3, "no scene")
        self.assertEqual(os.listdir(self.root / "thesis"), ["one.txt"])


class Simulate(stucco.TestCase):
    """A flight around a house without textures, in small photos."""

    MODEL = """
v 0 0 0\nv 12 0 0\nv 12 8 0\nv 0 8 0\nv 0 0 6\nv 12 0 6\nv 12 8 6\nv 0 8 6
v -90 -90 0\nv 90 -90 0\nv 90 90 0\nv -90 90 0
f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 7 8\nf 9 10 11 12
"""

    def scene_and_plan(self, **changes):
        model, plan = self.root / "house.obj", self.root / "plan.json"
        model.write_text(self.MODEL)
        views = [{"id": f"v{i}", "position_m": [2 + 2 * i, -15, 4], "yaw_deg": 0, "pitch_deg": 0,
                  "kind": "dipping", "hover": i, "order": i, "flight": 0,
                  "facades": ["B0001/F00"]} for i in range(5)]
        plan.write_text(json.dumps({
            "version": 1, "crs": "+proj=tmerc +lat_0=52 +lon_0=4 +datum=WGS84",
            "origin": {"latitude_deg": 52, "longitude_deg": 4}, "d_min_m": 10,
            "camera": {"name": "mavic-3e", "label": "Mavic", "focal_m": 0.01229,
                       "sensor_width_m": 0.0173, "sensor_height_m": 0.013,
                       "width_px": 5280, "height_px": 3956},
            "footprints": [{"building": "B0001", "rings_m": [[[0, 0], [12, 0], [12, 8], [0, 8]]]}],
            "facades": [{"id": "B0001/F00", "a_m": [0, 0], "b_m": [12, 0],
                         "views": [view["id"] for view in views]}],
            "views": views} | changes))
        return model, plan

    def fly(self, model, plan, *words):
        return stucco.run("simulate", model, plan, "-o", self.root / "survey", "--scale", "0.06",
                          "--up", "z", *words)

    def test_photos_are_those_of_the_planned_views(self):
        flown = self.fly(*self.scene_and_plan(), "--lost-share", "0.2", "--no-sun", "--json")
        summary = json.loads(self.check(flown).stdout)
        self.assertEqual((summary["photos"], summary["lost"], summary["rendered"]), (4, 1, 4))
        self.assertIn("no textures", " ".join(summary["notes"]))
        survey = self.root / "survey"
        self.check(stucco.run("ingest", survey))
        captures = json.loads((survey / "ingest" / "captures.json").read_text())
        states = sorted(view["status"] for view in captures["views"])
        self.assertEqual(states, ["captured"] * 4 + ["missing"])
        # The same command has nothing to do.
        again = self.fly(*self.scene_and_plan(), "--lost-share", "0.2", "--no-sun", "--json")
        self.assertEqual(json.loads(self.check(again).stdout)["rendered"], 0)

    def test_a_scene_that_was_changed_is_flown_again(self):
        model, plan = self.scene_and_plan()
        paint = self.root / "house.mtl"
        paint.write_text("newmtl wall\nKd 0.8 0.2 0.2\n")
        model.write_text("mtllib house.mtl\nusemtl wall\n" + self.MODEL)
        self.check(self.fly(model, plan, "--quiet"))
        paint.write_text("newmtl wall\nKd 0.2 0.2 0.8\n")
        again = json.loads(self.check(self.fly(model, plan, "--json")).stdout)
        self.assertEqual(again["rendered"], 5)
        self.assertGreater(again["cpu_s"], 0)
        self.assertIn("5 photos of the flight before were replaced", again["notes"])

    def test_what_cannot_be_flown_leaves_no_survey(self):
        model, plan = self.scene_and_plan()
        self.refused(stucco.run("simulate", model, "-o", self.root / "survey"), 2, "no plan")
        self.refused(self.fly(model, plan, "--start-hour", "23"), 2, "sun")
        self.refused(self.fly(model, plan, "--scale", "7"), 2, "scale")
        self.refused(self.fly(self.root / "none.glb", plan), 3, "none.glb")
        self.refused(self.fly(model, plan, "--unit", "0.001"), 3, "--unit")
        self.refused(self.fly(model, plan, "--unit", "-1"), 2, "--unit")
        self.refused(stucco.run("simulate", model, plan, "-o", ""), 2, "-o")
        empty = self.root / "empty.json"
        empty.write_text("")
        self.refused(self.fly(model, empty), 3, "empty.json", "stucco plan")
        self.refused(self.fly(*self.scene_and_plan(
            views=[], facades=[])), 3, "plan.json", "no views")
        self.refused(self.fly(*self.scene_and_plan(camera={})), 3, "plan.json", "camera")
        cut = self.root / "cut.obj"
        cut.write_text("")
        self.refused(self.fly(cut, plan), 3, "cut.obj", "export")
        far = {"footprints": [{"building": "B0001",
                               "rings_m": [[[900, 0], [912, 0], [912, 8], [900, 8]]]}]}
        self.refused(self.fly(*self.scene_and_plan(**far)), 3, "another place")
        self.assertFalse((self.root / "survey").exists())

    def test_real_photos_are_left_alone(self):
        survey = self.root / "survey"
        (survey / "photos").mkdir(parents=True)
        shutil.copy(stucco.sample_photos(1)[0], survey / "photos" / "real.jpg")
        self.refused(self.fly(*self.scene_and_plan()), 3, "real.jpg")
        self.assertEqual(os.listdir(survey), ["photos"])
        self.assertEqual(os.listdir(survey / "photos"), ["real.jpg"])

    def test_a_survey_with_another_plan_is_left_alone(self):
        survey = self.root / "survey"
        (survey / "plan").mkdir(parents=True)
        (survey / "plan" / "plan.json").write_text("{}")
        self.refused(self.fly(*self.scene_and_plan()), 3, "another plan", "new survey")
        self.assertEqual(os.listdir(survey), ["plan"])
        self.assertEqual((survey / "plan" / "plan.json").read_text(), "{}")


class Evaluate(stucco.TestCase):
    """What measures right is tested in tests/evaluate."""

    def test_refuses_what_has_no_truth(self):
        survey = self.init(self.photo_folder(2))
        self.refused(stucco.run("evaluate", survey), 2, "--truth")
        self.refused(stucco.run("evaluate", survey, "--truth", self.root / "town"), 3, "town")
        self.refused(stucco.run("evaluate", survey, "--truth", survey), 3, "scene.json")
        self.refused(stucco.run("evaluate", survey, "--truth", survey, "--tolerance", "0"), 2,
                     "--tolerance")
        self.assertFalse((survey / "evaluation").exists())


if __name__ == "__main__":
    unittest.main()
