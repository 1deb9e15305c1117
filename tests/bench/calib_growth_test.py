# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of bench/calib_growth.py, with a stand-in for the program."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "bench")]
import calib_growth  # noqa: E402

# Calibration of n photos takes 2 n CPU seconds, most of it for matching.
STAND_IN = f"#!{sys.executable} -S\n" + """
import json, os, pathlib, sys
words = sys.argv[1:]
with open(os.environ["COMMANDS"], "a") as log:
    log.write(" ".join(words) + "\\n")
survey = pathlib.Path(words[1])
if words[0] == "init":
    survey.mkdir(parents=True)
    (survey / "survey.toml").write_text(words[words.index("--photos") + 1])
    sys.exit()
count = len(list(pathlib.Path((survey / "survey.toml").read_text()).iterdir()))
(survey / "calib").mkdir()
(survey / "calib/calibration.json").write_text(json.dumps({"photos_posed": count - 1}))
events = [{"event": "stage"}, {"event": "progress", "step": "matching pairs", "memory_mb": 7},
          {"event": "progress", "step": "matching pairs", "memory_mb": 5},
          {"event": "step_done", "step": "matching pairs", "cpu_s": 1.5 * count, "wall_s": count},
          {"event": "step_done", "step": "placing photos", "cpu_s": count / 2, "wall_s": 0.1},
          {"event": "stage_done", "cpu_s": 2 * count, "wall_s": count, "peak_memory_mb": 9}]
(survey / ".stucco").mkdir()
(survey / ".stucco/events.ndjson").write_text(
    "".join(json.dumps({"stage": "calib", **event}) + "\\n" for event in events) + '{"stage": "ca')
"""


def photo(number, east):
    return {"path": f"{number}.jpg", "usable": True,
            "position": {"latitude_deg": 50, "longitude_deg": east}}


class CalibGrowth(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name)
        self.survey = self.root / "survey"
        for folder in ("ingest", "photos", "plan"):
            (self.survey / folder).mkdir(parents=True)
        photos = [photo(i, i) for i in range(9)] + [{"path": "blurred.jpg", "usable": False}]
        (self.survey / "ingest/captures.json").write_text(json.dumps({"photos": photos}))
        for each in photos:
            (self.survey / "photos" / each["path"]).write_text("x")
        (self.survey / "plan/plan.json").write_text("{}")
        self.program = self.root / "program"
        self.program.write_text(STAND_IN)
        self.program.chmod(0o755)

    def call(self, *words):
        return subprocess.run(
            [sys.executable, "-B", ROOT / "bench/calib_growth.py", self.survey, self.root / "out",
             "--stucco", self.program, *words],
            capture_output=True, text=True, check=True,
            env={**os.environ, "COMMANDS": str(self.root / "commands")}).stdout

    def commands(self):
        path = self.root / "commands"
        return path.read_text().splitlines() if path.exists() else []

    def test_measures_parts_from_the_middle(self):
        table = self.call("--photos", "3", "6", "--records", "plan", "gps")
        names = sorted(path.name for path in (self.root / "out/photos-as-flown-3").iterdir())
        self.assertEqual(names, ["3.jpg", "4.jpg", "5.jpg"])
        self.assertTrue((self.root / "out/plan-3/plan/plan.json").exists())
        self.assertFalse((self.root / "out/gps-3/plan").exists())
        self.assertIn("| photos, CPU s | posed | match | place | all | adjusting |", table)
        self.assertIn("| 6 | 5 | 9.0 | 3.0 | 12.0 | 0.25 |", table)
        self.assertIn("| exponent |  | 1.00 | 1.00 | 1.00 |  |", table)
        self.assertIn("| 6 | 7 | - | 9 |", table)
        done = self.commands()
        self.assertEqual(self.call("--photos", "3", "6", "--records", "plan", "gps"), table)
        self.assertEqual(self.commands(), done)

    def test_takes_all_photos_once_where_there_are_fewer(self):
        self.assertIn("| 9 | 8 |", self.call("--photos", "50", "100"))
        self.assertEqual(len(self.commands()), 2)

    def test_memory_is_the_largest_that_the_log_saw(self):
        self.call("--photos", "3")
        found = calib_growth.read_steps(self.root / "out/plan-3")
        self.assertEqual(found["matching pairs"]["memory_mb"], 7)
        self.assertIsNone(found["placing photos"]["memory_mb"])

    def test_compares_with_the_same_photos_without_metadata(self):
        def part(photos, cpu_s):
            return {"photos": photos, "steps": {"all": {"cpu_s": cpu_s}}}

        found = calib_growth.ratios({"none": [part(50, 100)], "plan": [part(50, 30), part(99, 9)]})
        self.assertIn("| plan | 50 | 0.30 |", found)
        self.assertNotIn("| plan | 99", found)
        self.assertEqual(calib_growth.ratios({"plan": [part(50, 30)]}), "")

    def test_exponent_fits_all_sizes(self):
        parts = [{"photos": n, "steps": {"all": {"cpu_s": 0.1 * n ** 1.5}}} for n in (50, 100, 400)]
        self.assertAlmostEqual(calib_growth.exponent(parts, "all", "cpu_s"), 1.5)
        self.assertIsNone(calib_growth.exponent(parts[:1], "all", "cpu_s"))

    def test_says_that_there_is_no_middle_without_positions(self):
        path = self.survey / "ingest/captures.json"
        path.write_text(json.dumps({"photos": [{"path": "a.jpg", "usable": True}]}))
        with self.assertRaises(subprocess.CalledProcessError) as failed:
            self.call()
        self.assertIn("no photo has a position", failed.exception.stderr)


if __name__ == "__main__":
    unittest.main()
