# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of what the scripts in bench/ and scripts/ decide by themselves."""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "bench"), str(ROOT / "scripts")]
import features_per_megapixel  # noqa: E402
import fine_facades  # noqa: E402
import key_figures  # noqa: E402
import measure  # noqa: E402
import slowest_units  # noqa: E402
import surveys  # noqa: E402


def unit(key, kind="features"):
    return json.dumps({"event": "unit", "stage": "calib", "kind": kind, "key": key})


class ComputedTwice(unittest.TestCase):
    def test_accepts_units_that_were_computed_once(self):
        lines = [unit("a"), unit("b"), unit("a", "matches"), '{"event": "run"}']
        self.assertEqual(surveys.computed_twice(lines), ([], 3))

    def test_finds_a_repeated_unit(self):
        twice, _ = surveys.computed_twice([unit("a"), '{"event": "run"}', unit("a")])
        self.assertEqual(twice, [("calib", "features", "a")])

    def test_passes_over_a_torn_line(self):
        self.assertEqual(surveys.computed_twice([unit("a")[:20], unit("a")]), ([], 1))


class FineFacades(unittest.TestCase):
    # An L that stands along y, seen from -x.
    RING = [[0, 4, 0], [0, 0, 0], [0, 0, 3], [0, 2, 3], [0, 2, 1], [0, 4, 1]]

    def test_samples_lie_in_the_ring_and_look_out(self):
        points = list(fine_facades.samples(self.RING))
        self.assertEqual(len(points), 8 / fine_facades.SPACING_M ** 2)
        for (x, y, z), normal in points:
            self.assertAlmostEqual(x, 0)
            self.assertTrue(0 < y < 4 and 0 < z < (3 if y < 2 else 1))
            for value, wanted in zip(normal, (-1, 0, 0)):
                self.assertAlmostEqual(value, wanted)

    def test_the_largest_facades_that_photos_are_planned_for(self):
        def facade(name, length, top, views):
            return {"id": name, "a_m": [0, 0], "b_m": [length, 0], "z_m": [0, top], "views": views}
        plan = {"facades": [facade("small", 5, 4, ["a"]), facade("unseen", 50, 40, []),
                            facade("high", 5, 20, ["b"]), facade("long", 30, 4, ["c"])]}
        self.assertEqual(fine_facades.largest_facades(plan, 2), ["long", "high"])


class Outputs(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folders = []
        for name in ("one", "two"):
            folder = pathlib.Path(self.scratch.name) / name
            for part in ("calib", ".stucco"):
                (folder / part).mkdir(parents=True)
            (folder / "calib/a.bin").write_bytes(b"same")
            (folder / ".stucco/events.ndjson").write_text(name)
            self.folders.append(folder)

    def compare(self):
        return surveys.differences(*(surveys.outputs(folder) for folder in self.folders))

    def test_leaves_out_the_log_of_the_runs(self):
        self.assertEqual(self.compare(), [])

    def test_finds_a_changed_byte(self):
        (self.folders[1] / "calib/a.bin").write_bytes(b"sane")
        self.assertEqual(self.compare(), ["differs: calib/a.bin"])

    def test_finds_missing_files(self):
        (self.folders[0] / "extra").write_text("")
        (self.folders[1] / "other").write_text("")
        self.assertEqual(self.compare(),
                         ["only in the first: extra", "only in the second: other"])


class Measure(unittest.TestCase):
    def test_reports_time_and_exit_code(self):
        result = measure.measure(["sh", "-c", "sleep 0.2; exit 7"])
        self.assertEqual(result["exit_code"], 7)
        self.assertGreaterEqual(result["wall_s"], 0.2)
        self.assertGreater(result["peak_memory_mb"], 0)

    def test_reports_a_signal(self):
        self.assertEqual(measure.measure(["sh", "-c", "kill -9 $$"])["exit_code"], -signal.SIGKILL)


class FeaturesPerMegapixel(unittest.TestCase):
    def test_takes_photos_from_all_of_a_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a.jpg", "b.JPG", "c.png", "d.txt", "e.jpeg", "f.jpg", "g.jpg"):
                pathlib.Path(folder, name).touch()
            def names(most):
                return [photo.name for photo in features_per_megapixel.photos_of(folder, most)]
            self.assertEqual(names(0), ["a.jpg", "b.JPG", "c.png", "e.jpeg", "f.jpg", "g.jpg"])
            self.assertEqual(names(3), ["a.jpg", "c.png", "f.jpg"])

    def test_refuses_a_folder_without_photos(self):
        with tempfile.TemporaryDirectory() as folder, self.assertRaises(SystemExit):
            features_per_megapixel.photos_of(folder, 0)

    def test_compares_medians(self):
        rows = [{"per_megapixel": count, "contrast": 0.2, "slope": -2.5} for count in (1, 2, 900)]
        self.assertEqual(features_per_megapixel.summary(rows, 4)["ratio"], 0.5)
        self.assertEqual(features_per_megapixel.summary(rows, 0)["ratio"], 1)

    def test_finds_the_slope_of_white_noise(self):
        import numpy
        noise = numpy.random.default_rng(1).random((600, 600))
        self.assertAlmostEqual(features_per_megapixel.spectrum_slope(noise), 0, delta=0.1)


class KeyFigures(unittest.TestCase):
    def test_tilt_of_a_wall(self):
        self.assertAlmostEqual(key_figures.tilt_deg([1, 0, 0], [0, 0, 1]), 0)
        self.assertAlmostEqual(key_figures.tilt_deg([1, 0, 1], [0, 0, 2]), 45)

    def test_the_peak_is_that_of_the_hungriest_stage(self):
        with tempfile.TemporaryDirectory() as name:
            survey = pathlib.Path(name)
            self.assertEqual(list(key_figures.stage_lines(survey)), [])
            manifests = survey / ".stucco/manifests"
            manifests.mkdir(parents=True)
            for stage, peak, wall in (("dense", 700, 90), ("calib", 1465.4, 33), ("ingest", -1, 0)):
                (manifests / f"{stage}.json").write_text(
                    json.dumps({"usage": {"peak_memory_mb": peak, "wall_s": wall}}))
            self.assertEqual(list(key_figures.stage_lines(survey)),
                             ["peak memory 1465 MiB (calib)", "stages: calib 33 s, dense 90 s"])


class CompareColmap(unittest.TestCase):
    """With a stand-in for both programs that answers with the true cameras."""
    STAND_IN = """#!/bin/sh
echo "$*" >>"$COMMANDS"
case $1 in model_converter | export) ;; *) exit 0 ;; esac
while [ $# -gt 1 ]; do
  case $1 in --output_path | -o) mkdir -p "$2" && cp "$TRUTH/images.txt" "$2" ;; esac
  shift
done
"""
    CAMERAS = "".join(f"{i} 1 0 0 0 {i} {i * i} 0 1 photo {i}.jpg\n\n" for i in range(1, 5))

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name) / "it's a \"place\" for $1"
        for folder in ("set/photos", "set/truth", "bin"):
            (self.root / folder).mkdir(parents=True)
        (self.root / "set/truth/images.txt").write_text(self.CAMERAS)
        for name in ("colmap", "stucco"):
            program = self.root / "bin" / name
            program.write_text(self.STAND_IN)
            program.chmod(0o755)

    def compare(self, *words):
        environment = dict(os.environ, TRUTH=str(self.root / "set/truth"),
                           COMMANDS=str(self.root / "commands"),
                           PATH=f"{self.root / 'bin'}:{os.environ['PATH']}")
        process = subprocess.run(
            [ROOT / "bench/compare_colmap.sh", self.root / "set", "--out", self.root / "out",
             "--stucco", self.root / "bin/stucco", *words],
            env=environment, capture_output=True, text=True, check=False)
        self.assertEqual(process.returncode, 0, process.stderr)
        return process.stdout

    def test_measures_in_a_folder_with_an_awkward_name(self):
        table = self.compare()
        self.assertIn("| COLMAP | 4 / 4 | 0.00 |", table)
        self.assertIn("| Stucco | 4 / 4 | 0.00 |", table)
        columns = {line.count("|") for line in table.splitlines() if line.startswith("|")}
        self.assertEqual(columns, {9})
        commands = (self.root / "commands").read_text()
        self.assertIn(f"--image_path {self.root}/set/photos --output_path {self.root}/out/colmap/",
                      commands)
        self.assertNotIn("PINHOLE", commands)

    def test_stops_when_a_program_fails(self):
        (self.root / "bin/colmap").write_text("#!/bin/sh\nexit 1\n")
        with self.assertRaises(AssertionError):
            self.compare()
        self.assertFalse((self.root / "out/colmap.json").exists())

    def test_gives_and_holds_a_known_matrix(self):
        (self.root / "set/truth/a.camera").write_text("900 0 400\n0 901 300\n0 0 1\n0 0 0\n")
        self.compare("--known")
        commands = (self.root / "commands").read_text()
        self.assertIn("--ImageReader.camera_model PINHOLE "
                      "--ImageReader.camera_params 900,901,400,300\n", commands)
        self.assertIn("--Mapper.ba_refine_extra_params 0\n", commands)
        self.assertIn("--set ingest.prior_camera=900,901,400,300", commands)


class SlowestUnits(unittest.TestCase):
    def test_sorts_objects_by_their_last_build(self):
        log = ["# ninja log v5", "0\t9000\t1\ta.cpp.o\tx", "0\t100\t2\tb.cpp.o\tx",
               "0\t300\t3\ta.cpp.o\tx", "0\t99000\t4\tlib.a\tx"]
        self.assertEqual(slowest_units.slowest(log), [(0.3, "a.cpp.o"), (0.1, "b.cpp.o")])


class Packages(unittest.TestCase):
    def test_every_package_says_what_it_is_for(self):
        for line in (ROOT / "scripts/packages.txt").read_text().splitlines():
            if not line.startswith("#"):
                self.assertRegex(line, re.compile(r"^[a-z0-9+.-]+ +# \w.+$"))


if __name__ == "__main__":
    unittest.main()
