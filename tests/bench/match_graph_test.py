# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""bench/match_graph.py sets what a plan expects beside what a reconstruction has."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

COMMAND = pathlib.Path(__file__).parents[2] / "bench/match_graph.py"


def view(name, kind, *partners):
    return {"id": name, "kind": kind,
            "partners": [{"view": other, "strength": strength} for other, strength in partners]}


class Survey(unittest.TestCase):
    def test_counts_points_that_both_photos_see(self):
        with tempfile.TemporaryDirectory() as folder:
            survey = pathlib.Path(folder)
            for name in ("plan", "photos", "calib/sparse/0"):
                (survey / name).mkdir(parents=True)
            plan = {"views": [view("h1v1", "dipping", ("h2v1", 0.3), ("h3v1", 0.09)),
                              view("h2v1", "link", ("h1v1", 0.3)),
                              view("h3v1", "nadir", ("h1v1", 0.09))]}
            (survey / "plan/plan.json").write_text(json.dumps(plan))
            for i in (1, 2, 3):
                (survey / f"photos/DJI_2026_{i:04}_D_h{i}v1.JPG").touch()
            model = survey / "calib/sparse/0"
            (model / "images.txt").write_text("# two lines each\n" + "".join(
                f"{i} 1 0 0 0 0 0 0 1 DJI_2026_{i:04}_D_h{i}v1.JPG\n\n" for i in (1, 2)))
            (model / "points3D.txt").write_text("# id x y z r g b error track\n" + "".join(
                f"{k} 0 0 0 0 0 0 1 1 {k} 2 {k}\n" for k in range(20)) + "99 0 0 0 0 0 0 1 1 77\n")
            done = subprocess.run([sys.executable, COMMAND, survey], capture_output=True, text=True,
                                  check=True)
        self.assertIn("| 0.24 to 0.40 | 1 | 20 | 100 % | 0 % |", done.stdout)
        self.assertNotIn("0.08 to 0.10", done.stdout)  # h3v1 has no pose
        self.assertIn("dipping: 1 of 1 photos have a pose", done.stdout)
        self.assertIn("nadir: 0 of 1 photos have a pose h3v1", done.stdout)


if __name__ == "__main__":
    unittest.main()
