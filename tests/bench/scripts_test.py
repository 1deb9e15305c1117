# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of what the scripts in bench/ and scripts/ decide by themselves."""
import json
import pathlib
import re
import signal
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "bench"), str(ROOT / "scripts")]
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


class KeyFigures(unittest.TestCase):
    def test_tilt_of_a_wall(self):
        self.assertAlmostEqual(key_figures.tilt_deg([1, 0, 0], [0, 0, 1]), 0)
        self.assertAlmostEqual(key_figures.tilt_deg([1, 0, 1], [0, 0, 2]), 45)


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
