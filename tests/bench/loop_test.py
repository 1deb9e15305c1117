# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the loop scripts in bench/, with a stand-in for the program."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "bench")]
import loop  # noqa: E402
import methods_flown  # noqa: E402
import stage_scaling  # noqa: E402
import steps  # noqa: E402
import surveys  # noqa: E402

EVALUATION = {
    "version": 1, "plan": {"method": "cocapture", "photos": 46, "hovers": 20, "length_m": 1234.5,
                           "time_min": 7.25, "battery_percent": 30, "q_s": 0.9, "q_d": 0.8,
                           "q_u": 0.7, "q_c": 1},
    "poses": {"posed": 45, "total": 46, "position_mean_m": 0.0123, "position_max_m": 0.03,
              "rotation_mean_deg": 0.01, "rotation_max_deg": 0.02, "georeferenced_mean_m": 1.5},
    "dense": {"error95_m": 0.1, "building_error95_m": 0.21, "building_completeness": 0.955,
              "building_completeness_all": 0.9, "wall_completeness": 0.6},
    "mesh": {"error95_m": None, "completeness": None, "completeness_all": None},
    "proxy": {"buildings": 3, "truth_buildings": 3, "watertight": 2, "manifold": 3,
              "self_intersecting": 0, "facets": 40, "truth_facets": 38,
              "superstructure_facets": 5, "error95_m": 0.1,
              "building_error95_m": 0.3, "building_completeness": 0.8,
              "building_completeness_all": 0.75, "wall_error95_m": 0.25, "wall_seen95_m": 0.11,
              "wall_completeness": 0.7,
              "facade_id_rate": 0.9},
    "texture": {**{name + "_mean": 0.5 for name in ("ssim", "ms_ssim", "gmsd", "flip")},
                "psnr_mean": 21.25, "lpips_mean": None, "misregistration_px": 0.75,
                "ceiling": {"ssim": 0.875}, "plane": {"ssim": 0.5, "ceiling": {"ssim": 0.9375}},
                "misregistration_m": 0.015, "painted": 0.625, "facades": [{"area_m2": 30}]},
    "views": {"compared": 0.95, "ssim_mean": 0.6, "psnr_mean": 19.5, "flip_mean": 0.2, "photos": []}, "notes": []}

# Notes its commands and makes what the real one would make, as far as the scripts look at it.
STAND_IN = f"#!{sys.executable} -S\n" + """
import os, pathlib, sys
words = sys.argv[1:]
with open(os.environ["COMMANDS"], "a") as log:
    log.write(" ".join(words) + "\\n")
half = os.environ.get("FAILS") == words[0] + " half" and "city" not in words
if os.environ.get("FAILS") == words[0]:
    sys.exit("something is wrong")
out = pathlib.Path(words[words.index("-o") + 1] if "-o" in words else words[1])
plan = '{"footprints": [], "facades": [], "views": []}'
files = {"plan": {"plan/plan.json": plan}, "run": {
             ".stucco/manifests/dense.json": '{"usage": {"wall_s": 90.5, "cpu_s": 170.5}}'},
         "evaluate": {"evaluation/evaluation.json": os.environ["EVALUATION"]},
         "simulate": {"scene.json": "{}", "terrain.tif": ""} if "city" in words else
                     {"truth/flight.json": "{}"}, "init": {"survey.toml": ""}}
for name, text in files[words[0]].items():
    (out / name).parent.mkdir(parents=True, exist_ok=True)
    (out / name).write_text(text)
if half:
    sys.exit("stopped")
"""


class WithStandIn(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name) / "it's a place"
        self.root.mkdir()
        self.program = self.root / "stucco"
        self.program.write_text(STAND_IN)
        self.program.chmod(0o755)

    def call(self, script, *words, fails="", code=0):
        environment = dict(os.environ, COMMANDS=str(self.root / "commands"), FAILS=fails,
                           EVALUATION=json.dumps(EVALUATION))
        process = subprocess.run(
            [sys.executable, "-B", ROOT / "bench" / script, *words, "--stucco", self.program],
            env=environment, capture_output=True, text=True, check=False)
        self.assertEqual(process.returncode, code, process.stderr)
        return process

    def last_commands(self):
        """First words of what was run since the last time."""
        words = [line.split()[0] for line in self.commands()]
        (self.root / "commands").write_text("")
        return words

    def commands(self):
        return (self.root / "commands").read_text().replace(str(self.root) + "/", "").splitlines()


class Loop(WithStandIn):
    def test_goes_from_a_style_to_a_row(self):
        out = self.root / "out"
        table = self.call("loop.py", out, "--seed", "3", "--plan-args", "--altitude 30",
                          "--fly-args=--rtk").stdout
        self.assertEqual(self.commands(), [
            "simulate city -o out/hamlet-3.part --style hamlet --seed 3",
            "plan out/hamlet-3/map.geojson -o out/hamlet-3-cocapture-0.25 --method cocapture "
            "--terrain out/hamlet-3/terrain.tif --altitude 30",
            "simulate out/hamlet-3 out/hamlet-3-cocapture-0.25 -o out/hamlet-3-cocapture-0.25 "
            "--scale 0.25 --rtk",
            "run out/hamlet-3-cocapture-0.25",
            "evaluate out/hamlet-3-cocapture-0.25 --truth out/hamlet-3"])
        start = "| hamlet-3 | cocapture "
        for row in ("| 46 | 20 | 1234 | 7.2 | 30 | 0.90 | 0.80 | 0.70 | 1.00 |",
                    "| 45 / 46 | 12.3 | 0.0100 | 1.50 | 0.210 | 95.5 % | 90.0 % | 60.0 % | 0.300 "
                    "| 80.0 % | 75.0 % | 0.250 | 0.110 | 70.0 % | 2 / 3 | 40 / 38 | 5 | 90.0 % |",
                    "| 62.5 % | 0.500 | 0.875 | 0.500 | 0.938 | 0.500 | 21.25 | 0.500 | 0.500 | - | 0.75 | 0.015 | 95.0 % "
                    "| 0.600 | 19.50 | 0.200 |"):
            self.assertIn(start + row, table)
        # The made-up program takes next to nothing, and a second or two on a busy machine.
        self.assertRegex(table, re.escape(start) + r"\| 46 \| wall \| \d \| \d \| - \| - \| 90 "
                                r"\| - \| - \| - \| \d \| 9\d \|")
        figures = json.loads((out / "figures/hamlet-3-cocapture-0.25.json").read_text())
        self.assertEqual(figures["name"], "hamlet-3-cocapture-0.25")
        self.assertEqual(figures["stages"]["dense"]["cpu_s"], 170.5)
        self.assertGreater(figures["steps"]["fly"]["cpu_s"], 0)
        self.assertNotIn("facades", figures["texture"])

    def map_errors(self, name):
        plan = self.root / "out" / name / "plan"
        self.assertNotIn("map_errors", json.loads((plan / "plan.exact.json").read_text()))
        return json.loads((plan / "plan.json").read_text())["map_errors"]

    def test_the_map_has_errors_unless_it_is_to_be_exact(self):
        out, name = self.root / "out", "hamlet-1-cocapture-0.25"
        self.call("loop.py", out)
        self.assertEqual(self.map_errors(name)["seed"], 1)
        self.last_commands()
        self.call("loop.py", out, "--map-seed", "2", "--missing", "1")
        self.assertEqual(self.last_commands(), ["run", "evaluate"])
        self.assertEqual(self.map_errors(name)["missing"], 1)
        self.call("loop.py", out, "--exact-map")
        self.assertFalse((out / (name + "-exact") / "plan/plan.exact.json").exists())

    def test_does_not_repeat_what_is_there(self):
        out = self.root / "out"
        first = self.call("loop.py", out).stdout
        self.last_commands()
        self.assertEqual(self.call("loop.py", out).stdout, first)
        self.assertEqual(self.last_commands(), [])
        self.call("loop.py", out, "--again", "run")
        self.assertEqual(self.last_commands(), ["run", "evaluate"])
        self.call("loop.py", out, "--fly-args=--rtk")  # other words: what follows is stale
        self.assertEqual(self.last_commands(), ["simulate", "run", "evaluate"])
        (out / "hamlet-1-cocapture-0.25/evaluation/evaluation.json").unlink()
        self.call("loop.py", out, "--fly-args=--rtk")
        self.assertEqual(self.last_commands(), ["evaluate"])

    def test_goes_on_with_a_flight_that_was_stopped(self):
        out = self.root / "out"
        self.call("loop.py", out, fails="simulate half", code=1)
        self.assertEqual(self.last_commands(), ["simulate", "plan", "simulate"])
        self.assertTrue((out / "hamlet-1-cocapture-0.25/truth/flight.json").exists())
        table = self.call("loop.py", out).stdout
        self.assertEqual(self.last_commands(), ["simulate", "run", "evaluate"])
        self.assertRegex(table, r"\| wall \| \d \| ≥ \d \|")

    def test_makes_a_scene_anew_that_was_stopped(self):
        out = self.root / "out"
        (out / "hamlet-1.part").mkdir(parents=True)
        (out / "hamlet-1.part/scene.glb").write_text("half of it")
        self.call("loop.py", out)
        self.assertFalse((out / "hamlet-1/scene.glb").exists())
        self.assertTrue((out / "hamlet-1/scene.json").exists())

    def test_a_run_that_fails_is_measured_as_far_as_it_came(self):
        process = self.call("loop.py", self.root / "out", fails="run")
        self.assertIn("run", process.stderr)
        self.assertIn("| 0.500 | - | 0.75 | 0.015 | 95.0 % | 0.600 |", process.stdout)
        self.assertIn("| wall | 0 | 0 | - | - | - | - | - | - | 0 | - |", process.stdout)
        self.last_commands()
        self.call("loop.py", self.root / "out")
        self.assertEqual(self.last_commands(), ["run", "evaluate"])

    def test_says_where_to_look_when_a_step_fails(self):
        process = self.call("loop.py", self.root / "out", fails="plan", code=1)
        log = self.root / "out/logs/hamlet-1-cocapture-0.25-plan.log"
        self.assertIn(str(log), process.stderr)
        self.assertIn("something is wrong", log.read_text())

    def test_what_was_not_measured_is_a_dash(self):
        figures = json.loads(json.dumps(EVALUATION))
        figures.update(stages={}, steps={}, plan=None, commits=[])
        figures["texture"]["painted"] = figures["poses"]["position_mean_m"] = None
        figures["dense"]["building_completeness"] = None
        table = loop.tables([("a", "b", figures)])
        for row in ("| a | b |" + " - |" * 9, "| a | b | 45 / 46 | - | 0.0100 | 1.50 | 0.210 | - |",
                    "| a | b | - | 0.500 |", "| a | b | 46 | CPU |" + " - |" * 10):
            self.assertIn(row, table)

    def test_rows_have_as_many_cells_as_heads(self):
        table = self.call("loop.py", self.root / "out").stdout
        for part in table.split("\n\n")[:4]:
            self.assertEqual(len({line.count("|") for line in part.splitlines()}), 1, part)


class MethodsFlown(WithStandIn):
    def test_flies_all_methods_in_one_scene(self):
        table = self.call("methods_flown.py", self.root / "out").stdout
        self.assertEqual(sum(words.startswith("simulate city") for words in self.commands()), 1)
        for method in methods_flown.METHODS:
            self.assertIn(f"| hamlet-1 | {method} | 46 | 20 | 1234 | 7.2 |", table)
            self.assertIn(f"| hamlet-1 | {method} | 62.5 % | 0.500 |", table)

    def test_fails_when_a_method_does(self):
        self.call("methods_flown.py", self.root / "out", fails="evaluate", code=1)


class StageScaling(WithStandIn):
    def test_cuts_a_flight_into_its_beginnings(self):
        survey = self.root / "flown"
        photos = [{"path": f"f1/{name}.jpg"} for name in "dcab"]
        photos += [{"path": "lost.jpg", "lost": True}, {"path": "x.jpg", "held_out": True}]
        (survey / "truth").mkdir(parents=True)
        (survey / "truth/flight.json").write_text(json.dumps({"photos": photos}))
        (survey / "photos/f1").mkdir(parents=True)
        for name in "abcd":
            (survey / f"photos/f1/{name}.jpg").write_text(name)
        table = self.call("stage_scaling.py", survey, self.root / "out", "--photos", "2", "9").stdout
        self.assertEqual(sorted(p.name for p in (self.root / "out/links-2").rglob("*.jpg")),
                         ["c.jpg", "d.jpg"])
        self.assertEqual([words.split()[0] for words in self.commands()],
                         ["init", "run", "init", "run"])
        self.assertIn("| 4 | - | - | 90.5 (0.00) | - | - | - | 90.5 (0.00) |", table)
        self.assertIn("| 4 | - | - | 170.5 (0.00) | - | - | - | 170.5 (0.00) |", table)
        self.last_commands()
        again = self.call("stage_scaling.py", survey, self.root / "out", "--photos", "2", "9").stdout
        self.assertEqual(again, table)
        self.assertEqual(self.last_commands(), [])

    def test_a_stage_that_went_on_has_no_exponent(self):
        costs = {"dense": {"wall_s": 9, "cpu_s": 9, "in_part": False}}
        went_on = {"dense": {"wall_s": 5, "cpu_s": 5, "in_part": True}}
        table = stage_scaling.table([(2, costs, []), (4, went_on, [])], "wall_s")
        self.assertIn("| 4 | - | - | ≥ 5.0 | - | - | - | - |", table)

    def test_exponents(self):
        found = stage_scaling.exponents((10, {"dense": 20, "proxy": 0.2}),
                                        (20, {"dense": 40, "proxy": 5, "calib": 9}))
        self.assertEqual(set(found), {"dense"})
        self.assertAlmostEqual(found["dense"], 1)


class Chain(unittest.TestCase):
    def test_a_kill_leaves_no_record_of_success(self):
        with tempfile.TemporaryDirectory() as name:
            chain = steps.Chain(name, "a", ("one", "two"))
            made = pathlib.Path(name)
            for step in ("one", "two"):
                chain.run(step, ["true"], made)
            with self.assertRaises(steps.Failed):
                chain.run("one", ["sh", "-c", "kill -9 $$"], made)
            self.assertNotEqual(chain.record("one").get("exit_code"), 0)
            self.assertEqual(chain.record("two"), {})  # it used what is no more

    def test_stops_its_command_when_it_is_stopped(self):
        with tempfile.TemporaryDirectory() as name:
            code = ("import sys; sys.path[:0] = [sys.argv[1]]; import pathlib, steps\n"
                    "steps.Chain(sys.argv[2], 'a', ('one',)).run('one', ['sh', '-c', "
                    "'trap \"touch $1; exit\" TERM; touch $0; while true; do sleep 0.1; done', "
                    "sys.argv[2] + '/ready', sys.argv[2] + '/ended'], pathlib.Path('/'))")
            process = subprocess.Popen([sys.executable, "-B", "-c", code, ROOT / "bench", name])
            while not pathlib.Path(name, "ready").exists():
                self.assertIsNone(process.poll())
                time.sleep(0.05)
            process.terminate()
            self.assertEqual(process.wait(timeout=30), 143)
            self.assertTrue(pathlib.Path(name, "ended").exists())
            self.assertNotIn("exit_code", steps.Chain(name, "a", ("one",)).record("one"))


class Numbers(unittest.TestCase):
    def test_unknown_ones_are_dashes(self):
        self.assertEqual([surveys.number(v) for v in (1.234, 2, None, float("nan"))],
                         ["1.23", "2.00", "-", "-"])


if __name__ == "__main__":
    unittest.main()
