# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`stucco plan` from a map to mission files, checked by bench/plan_check.py, which shares no code
with it; bad maps; and a plan that waits for its photos."""
import json
import shutil
import subprocess
import sys
import unittest
import zipfile

import stucco

# Metres to degrees near 50 degrees north.
LATITUDE, LONGITUDE = 50.1, 14.4
NORTH, EAST = 1 / 111_229, 1 / 71_583


def degrees(x, y):
    return [LONGITUDE + x * EAST, LATITUDE + y * NORTH]


def box(x0, y0, x1, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


def feature(rings, **properties):
    closed = [[degrees(*corner) for corner in ring + ring[:1]] for ring in rings]
    return {"type": "Feature", "properties": properties,
            "geometry": {"type": "Polygon", "coordinates": closed}}


# A street with two terraces, a yard, an L-shaped and a free-standing house.
HOUSES = [
    feature([box(0, 0, 12, 10)], id=1, height=9), feature([box(12, 0, 26, 10)], id=2, height=11),
    feature([box(0, 34, 20, 46)], id=3, height=8),
    feature([box(50, 0, 100, 50), box(62, 12, 88, 38)[::-1]], id=4, height=14),
    feature([[(-60, 0), (-30, 0), (-30, 12), (-45, 12), (-45, 30), (-60, 30)]], id=5, height=7),
]


class Plan(stucco.TestCase):
    def map(self, features, name="map.geojson"):
        path = self.root / name
        path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
        return path

    def plan(self, *words, survey="survey", **options):
        return stucco.run("plan", *words, "-o", self.root / survey, **options)

    @staticmethod
    def files(survey):
        return {path.name: path.read_bytes() for path in sorted((survey / "plan").iterdir())}


class GoodMaps(Plan):
    """The street is planned once, with two threads; tests that change it work on a copy."""

    @classmethod
    def setUpClass(cls):
        cls.suite = Plan()
        cls.suite.setUp()
        cls.suite.check(cls.suite.plan(cls.suite.map(HOUSES), "--threads", 2))
        cls.street = cls.suite.root / "survey"

    @classmethod
    def tearDownClass(cls):
        cls.suite.doCleanups()

    def copy(self):
        return shutil.copytree(self.street, self.root / "survey")

    def test_plans_a_street_safely_and_completely(self):
        folder = self.street / "plan"
        for name in ("plan.json", "stats.json", "preview.svg", "coverage.svg",
                     "matches.svg", "checklist.html", "mission.kml", "plan.geojson"):
            self.assertGreater((folder / name).stat().st_size, 500, name)
        checked = subprocess.run(
            [sys.executable, stucco.ROOT / "bench/plan_check.py", folder / "plan.json",
             "--samples", "60"], capture_output=True, text=True, check=False)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        stats = json.loads((folder / "stats.json").read_text())
        self.assertEqual(stats["method"], "cocapture")
        plan = json.loads((folder / "plan.json").read_text())
        self.assertEqual(stats["photos"], len(plan["views"]))
        self.assertEqual({f["building"] for f in plan["footprints"]},
                         {"B0001", "B0002", "B0003", "B0004", "B0005"})
        for facade in stats["facades"]:
            for term in ("q_s", "q_d", "q_u", "q_c"):
                self.assertTrue(0 <= facade[term] <= 1, facade)

    def test_missions_command_the_time_that_the_plan_says(self):
        done = self.plan(self.map(HOUSES), "--gsd", 0.05, "--wind", 6, "--battery-percent", 30)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("wind 6 m/s", done.stdout)
        folder = self.root / "survey/plan"
        counted = subprocess.run([sys.executable, stucco.ROOT / "bench/count_missions.py", folder],
                                 capture_output=True, text=True, check=False)
        self.assertEqual(counted.returncode, 0, counted.stdout + counted.stderr)
        plan = json.loads((folder / "plan.json").read_text())
        self.assertEqual(plan["pace"]["wind_m_per_s"], 6)
        self.assertGreater(len(plan["flights"]), 1)
        for flight in plan["flights"]:
            self.assertLessEqual(flight["battery_percent"] + flight["reserve_percent"], 30.002)
            self.assertAlmostEqual(sum(flight["parts"].values()), flight["time_min"], delta=0.005)

    def test_flights_start_at_the_home_that_is_given(self):
        home = degrees(-20, -40)
        done = self.plan(self.map(HOUSES), "--gsd", 0.05, "--battery-percent", 30, "--home",
                         f"{home[1]:.7f},{home[0]:.7f}")
        self.assertEqual(done.returncode, 0, done.stderr)
        plan = json.loads((self.root / "survey/plan/plan.json").read_text())
        self.assertGreater(len(plan["flights"]), 1)
        for flight in plan["flights"]:
            self.assertEqual(flight["home_m"], plan["home_m"])

    def test_keeps_clear_of_obstacles_and_says_what_to_mind(self):
        house = self.map([feature([box(0, 0, 12, 10)], id=1, height=9)])
        trees = self.map([feature([box(20, -30, 26, -24)], height=12),
                          feature([box(-30, 0, -26, 4)], height="14 m")], "trees.geojson")
        done = self.plan(house, "--obstacles", trees, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        folder = self.root / "survey/plan"
        stats = json.loads((folder / "stats.json").read_text())
        self.assertEqual(json.loads(done.stdout)["warnings"], stats["warnings"])
        preview = (folder / "preview.svg").read_text()
        for words in ("--terrain", "trees, lamps and wires"):
            self.assertTrue(any(words in line for line in stats["warnings"]), stats["warnings"])
            self.assertIn(words, preview)
        plan = json.loads((folder / "plan.json").read_text())
        self.assertEqual([f["building"] for f in plan["footprints"] if f.get("obstacle")],
                         ["O0002", "O0001"])
        self.assertEqual(plan["safe_altitude_m"], 24)
        checked = subprocess.run([sys.executable, stucco.ROOT / "bench/plan_check.py",
                                  folder / "plan.json", "--samples", "60"], capture_output=True,
                                 text=True, check=False)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        quiet = self.plan(house, "--obstacles", trees, "--quiet", survey="quiet")
        self.assertIn("warning: no terrain was given", quiet.stderr)

    def test_plans_a_single_shed(self):
        done = self.plan(self.map([feature([box(0, 0, 3, 2.5)], id=1, height=2.4)]))
        self.assertEqual(done.returncode, 0, done.stderr)
        stats = json.loads((self.root / "survey/plan/stats.json").read_text())
        self.assertEqual(len(stats["facades"]), 4)
        self.assertTrue(all(facade["views"] > 0 for facade in stats["facades"]))

    def test_every_photo_of_the_mission_carries_the_id_of_its_view(self):
        views = {v["id"] for v in json.loads((self.street / "plan/plan.json").read_text())["views"]}
        found = set()
        for mission in (self.street / "plan").glob("mission*.kmz"):
            text = zipfile.ZipFile(mission).read("wpmz/waylines.wpml").decode()
            for part in text.split("<wpml:fileSuffix>")[1:]:
                found.add(part.split("<")[0])
        self.assertEqual(found, views)

    def test_missions_pass_the_linter_and_damaged_ones_do_not(self):
        missions = sorted((self.street / "plan").glob("mission*.kmz"))
        self.assertTrue(missions)
        for mission in missions:
            self.assertEqual(stucco.run("lint", mission).returncode, 0)
            damaged = self.root / "damaged.kmz"
            with zipfile.ZipFile(mission) as old, zipfile.ZipFile(damaged, "w") as new:
                for name in old.namelist():
                    new.writestr(name, old.read(name).replace(b"<wpml:index>1<", b"<wpml:index>7<"))
            found = stucco.run("lint", damaged, "--json")
            self.assertEqual(found.returncode, 4, found.stderr)
            faults = json.loads(found.stdout)["faults"]
            self.assertTrue(any("index" in fault["element"] for fault in faults), faults)

    def test_is_the_same_at_any_number_of_threads(self):
        self.check(self.plan(self.map(HOUSES), "--threads", 1))
        one, two = self.files(self.root / "survey"), self.files(self.street)
        self.assertEqual(one.keys(), two.keys())
        for name in one:
            if name != "stats.json":  # holds the time that planning took
                self.assertEqual(one[name], two[name], name)

    def test_every_method_writes_a_plan(self):
        for method in ("oblique", "dronescan"):
            done = self.plan(self.map(HOUSES), "--method", method, "--json", survey=method)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(json.loads(done.stdout)["method"], method)

    def test_becomes_a_survey_that_waits_for_photos(self):
        survey = self.copy()
        self.assertTrue((survey / "survey.toml").exists())
        waiting = stucco.run("run", survey)
        self.assertEqual(waiting.returncode, 3, waiting.stderr)
        self.assertIn("photos", waiting.stderr)
        views = json.loads((survey / "plan/plan.json").read_text())["views"]
        for view, photo in zip(views, stucco.sample_photos(3)):
            (survey / "photos" / f"DJI_0001_{view['id']}.JPG").write_bytes(photo.read_bytes())
        self.assertEqual(stucco.run("ingest", survey).returncode, 0)
        captures = json.loads((survey / "ingest/captures.json").read_text())
        self.assertEqual(len(captures["views"]), len(views))
        self.assertEqual([v["status"] for v in captures["views"][:4]],
                         ["captured", "captured", "captured", "missing"])

    def test_a_new_plan_replaces_the_old_one_and_nothing_else(self):
        survey = self.copy()
        settings = survey / "survey.toml"
        settings.write_text(settings.read_text() + "# mine\n")
        self.check(self.plan(self.map(HOUSES), "--d-min", 6))
        self.assertNotEqual(self.files(survey)["plan.json"], self.files(self.street)["plan.json"])
        self.assertIn("# mine", settings.read_text())
        self.assertFalse(list((self.root / "survey").glob("plan.old*")))


class BadMaps(Plan):
    def refused(self, *words, code=3):
        """The message of a plan that fails, which must leave no plan behind."""
        done = self.plan(*words)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertFalse((self.root / "survey/plan").exists())
        return done.stderr

    def test_maps_that_are_none(self):
        self.assertIn("nowhere.geojson", self.refused(self.root / "nowhere.geojson"))
        self.assertIn("map.geojson", self.refused(self.map([])))
        text = self.root / "text.geojson"
        text.write_text("these are not the buildings you are looking for")
        self.assertIn("text.geojson", self.refused(text))

    def test_buildings_without_height_need_an_altitude(self):
        bare = self.map([feature([box(0, 0, 12, 10)], id=1)])
        self.assertIn("altitude", self.refused(bare))
        self.assertEqual(self.plan(bare, "--altitude", 30).returncode, 0)

    def test_storeys_are_no_heights(self):
        storeys = feature([box(0, 0, 12, 10)], **{"id": 1, "building:levels": "4"})
        message = self.refused(self.map([storeys]))
        self.assertIn("building:levels", message)
        self.assertIn("--altitude 35", message)

    def test_an_altitude_below_an_obstacle_is_refused(self):
        crane = self.map([feature([box(30, -40, 34, -36)], height=45)], "crane.geojson")
        message = self.refused(self.map(HOUSES), "--obstacles", crane, "--altitude", 40, code=2)
        self.assertIn("O0001 is 45.0 m high", message)
        self.assertIn("--altitude 55", message)

    def test_an_altitude_below_a_building_is_refused(self):
        self.assertIn("B0004", self.refused(self.map(HOUSES), "--altitude", 15, code=2))

    def test_home_in_a_no_fly_polygon_is_refused(self):
        zone = self.map([feature([box(-20, -60, 40, -20)])], "zone.geojson")
        x, y = degrees(0, -40)
        message = self.refused(self.map(HOUSES), "--no-fly", zone, f"--home={y},{x}", code=2)
        self.assertIn("home", message)

    def test_a_home_walled_in_by_no_fly_polygons_is_refused(self):
        moat = self.map([feature([box(-110, -110, 150, 150), box(-100, -100, 140, 140)[::-1]])],
                        "moat.geojson")
        x, y = degrees(300, 300)
        message = self.refused(self.map(HOUSES), "--no-fly", moat, f"--home={y},{x}")
        self.assertIn("no-fly", message)

    def test_no_folder_to_write_to_is_refused(self):
        done = stucco.run("plan", self.map(HOUSES), "-o", "", cwd=self.root)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual([path.name for path in self.root.iterdir()], ["map.geojson"])

    def test_a_camera_that_cannot_see_so_finely_is_refused(self):
        self.assertIn("gsd_m", self.refused(self.map(HOUSES), "--gsd", 0.002, code=2))
        self.assertIn("wind_m_per_s", self.refused(self.map(HOUSES), "--wind", 40, code=2))
        self.assertIn("mavic-3e", self.refused(self.map(HOUSES), "--camera", "mavik-3e", code=2))

    def test_repairs_are_reported_and_the_plan_is_still_safe(self):
        scribble = [(0, 0), (33, 20), (5, 18), (30, -2), (20, 24), (12, -6), (36, 9)]
        crossed = feature([scribble], id=1, height=8)
        twice = feature([box(60, 0, 80, 12)], id=2, height=8)
        done = self.plan(self.map([crossed, twice, twice]))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("B0001", done.stderr)
        checked = subprocess.run(
            [sys.executable, stucco.ROOT / "bench/plan_check.py",
             self.root / "survey/plan/plan.json", "--samples", "20"],
            capture_output=True, text=True, check=False)
        self.assertEqual(checked.returncode, 0, checked.stdout)


if __name__ == "__main__":
    unittest.main()
