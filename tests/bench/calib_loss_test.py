# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""bench/calib_loss.py names photos without a pose and those with a wrong one."""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

COMMAND = pathlib.Path(__file__).parents[2] / "bench/calib_loss.py"
HEAD = ("path,candidates,raw_matches,verified_pairs,verified_matches,used_pairs,used_matches,"
        "keypoints,wall_keypoints,coincident_keypoints,points_seen,observations,posed,why")


def name(number):
    return f"DJI_2026_{number:04}_D_h{number}v1.JPG"


def images(poses):
    """Of photos that look along z, turned about it: number, degrees, centre."""
    text = "# two lines each\n"
    for number, degrees, (x, y, z) in poses:
        angle = math.radians(degrees)
        t = (-(math.cos(angle) * x - math.sin(angle) * y),
             -(math.sin(angle) * x + math.cos(angle) * y), -z)
        text += (f"{number} {math.cos(angle / 2)} 0 0 {math.sin(angle / 2)} "
                 f"{t[0]} {t[1]} {t[2]} 1 {name(number)}\n\n")
    return text


TRUE = [(i, 10 * i, (5.0 * i, (i * i) % 7, i % 3)) for i in range(1, 8)]


class Survey(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.survey = pathlib.Path(folder.name)
        for part in ("plan", "calib/sparse/0", "truth/sparse"):
            (self.survey / part).mkdir(parents=True)
        views = [{"id": f"h{i}v1", "kind": "nadir" if i < 5 else "dipping"} for i in range(1, 9)]
        (self.survey / "plan/plan.json").write_text(json.dumps({"views": views}))
        rows = [f"{name(i)},9,500,4,200,3,150,900,40,30,60,50,yes," for i in range(1, 8)]
        rows.append(name(8) + ',9,80,0,0,0,0,900,40,30,0,0,no,"it overlaps, but not enough"')
        (self.survey / "calib/photos.csv").write_text("\r\n".join([HEAD, *rows, ""]))
        photos = [{"path": name(i), "position_sigma": 0.5 if i < 7 else -1,
                   "rotation_sigma_deg": 10} for i in range(1, 8)]
        (self.survey / "calib/calibration.json").write_text(json.dumps({"photos": photos}))

    def run_with(self, found):
        (self.survey / "calib/sparse/0/images.txt").write_text(images(found))
        return subprocess.run([sys.executable, COMMAND, self.survey], capture_output=True,
                              text=True, check=True).stdout

    def test_without_truth_nothing_is_wrong(self):
        printed = self.run_with(TRUE)
        self.assertIn("| nadir | 4 | 4 | - | 9 | 500 | 4 |", printed)
        self.assertIn("| dipping | 4 | 3 | - |", printed)
        self.assertIn("without a pose: 1", printed)
        self.assertIn("it overlaps, but not enough", printed)
        self.assertNotIn("posed wrongly", printed)

    def test_names_wrong_poses_in_any_frame(self):
        (self.survey / "truth/sparse/images.txt").write_text(images(TRUE))
        # Everything turned by a quarter, half as large and moved; one photo is off by 2 m, one by
        # 30 degrees.
        found = [(i, degrees - 90, (-y / 2 + 3, x / 2, z / 2 + 1))
                 for i, degrees, (x, y, z) in TRUE]
        self.assertIn("posed wrongly: 0", self.run_with(found))
        number, degrees, (x, y, z) = found[3]
        found[3] = (number, degrees, (x, y + 1, z))
        number, degrees, place = found[5]
        found[5] = (number, degrees + 30, place)
        printed = self.run_with(found)
        self.assertIn("posed wrongly: 2", printed)
        self.assertIn("2.00 m, 0.0 degrees", printed)
        self.assertIn("0.00 m, 30.0 degrees", printed)
        self.assertIn("| nadir | 4 | 4 | 1 |", printed)
        # The frame is half as large: a metre is two of its deviations' metres.
        self.assertIn("| place | 0.82 | 0.00 | 2.00 | 0 |", printed)
        self.assertIn("| rotation | 1.22 | 0.00 | 3.00 | 0 |", printed)


if __name__ == "__main__":
    unittest.main()
