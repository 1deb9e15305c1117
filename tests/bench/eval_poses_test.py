# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of bench/eval_poses.py: a wrong ruler would make every figure in docs/benchmarks.md
wrong."""
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "bench"))
import eval_poses  # noqa: E402


def random_rotation(rng):
    return eval_poses.rotation_from_quaternion(*rng.standard_normal(4))


def random_cameras(rng, count):
    return {f"{i:04d}.jpg": eval_poses.PosedCamera(random_rotation(rng), rng.standard_normal(3))
            for i in range(count)}


def moved(cameras, scale, rotation, translation):
    return {name: eval_poses.PosedCamera(rotation @ c.rotation,
                                         scale * rotation @ c.centre + translation)
            for name, c in cameras.items()}


class Align(unittest.TestCase):
    def test_recovers_a_similarity(self):
        rng = np.random.default_rng(1)
        source = rng.standard_normal((9, 3))
        rotation, translation = random_rotation(rng), rng.standard_normal(3)
        scale, found, offset = eval_poses.align(source, 2.5 * source @ rotation.T + translation)
        self.assertAlmostEqual(scale, 2.5, places=12)
        np.testing.assert_allclose(found, rotation, atol=1e-12)
        np.testing.assert_allclose(offset, translation, atol=1e-12)

    def test_never_mirrors(self):
        source = np.random.default_rng(2).standard_normal((9, 3))
        _, rotation, _ = eval_poses.align(source, source * [1, 1, -1])
        self.assertAlmostEqual(np.linalg.det(rotation), 1, places=12)

    def test_refuses_positions_on_a_line(self):
        line = np.outer(np.arange(5.0), [1, 2, 3])
        with self.assertRaisesRegex(ValueError, "not on one line"):
            eval_poses.align(line, line)


class Compare(unittest.TestCase):
    def test_ignores_the_choice_of_world_frame(self):
        rng = np.random.default_rng(3)
        truth = random_cameras(rng, 8)
        estimated = moved(truth, 0.3, random_rotation(rng), rng.standard_normal(3))
        result = eval_poses.compare(estimated, truth)
        self.assertLess(result["position_max_m"], 1e-12)
        self.assertLess(result["rotation_max_deg"], 1e-6)
        self.assertAlmostEqual(result["scale"], 1 / 0.3, places=9)

    def test_measures_noise(self):
        rng = np.random.default_rng(4)
        truth = random_cameras(rng, 400)
        estimated = {n: eval_poses.PosedCamera(c.rotation, c.centre + 0.01 * rng.standard_normal(3))
                     for n, c in truth.items()}
        result = eval_poses.compare(estimated, truth)
        # The mean length of a normal 3-vector is sigma * sqrt(8 / pi).
        self.assertAlmostEqual(result["position_mean_m"], 0.01 * np.sqrt(8 / np.pi), delta=0.001)

    def test_measures_a_turned_camera(self):
        truth = random_cameras(np.random.default_rng(5), 5)
        a = np.radians(3)
        turn = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
        estimated = dict(truth)
        estimated["0002.jpg"] = eval_poses.PosedCamera(truth["0002.jpg"].rotation @ turn,
                                                       truth["0002.jpg"].centre)
        result = eval_poses.compare(estimated, truth)
        self.assertAlmostEqual(result["rotation_max_deg"], 3, places=9)
        self.assertAlmostEqual(result["rotation_mean_deg"], 3 / 5, places=9)

    def test_counts_missing_photos(self):
        truth = random_cameras(np.random.default_rng(6), 5)
        estimated = {n: c for n, c in truth.items() if n != "0001.jpg"}
        result = eval_poses.compare(estimated, truth)
        self.assertEqual((result["posed"], result["total"]), (4, 5))
        self.assertEqual(result["missing"], ["0001.jpg"])

    def test_refuses_fewer_than_three_photos(self):
        truth = random_cameras(np.random.default_rng(7), 5)
        with self.assertRaisesRegex(ValueError, "only 2 photos"):
            eval_poses.compare({n: truth[n] for n in list(truth)[:2]}, truth)


class Reading(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = pathlib.Path(self.scratch.name)

    def test_reads_colmap_text(self):
        # A quarter turn around z, cam_from_world; the centre is -R^T t.
        (self.folder / "images.txt").write_text(
            "# comment\n"
            "1 0.7071067811865476 0 0 0.7071067811865476 1 2 3 1 sub/a b.jpg\n"
            "10 20 -1\n"
            "2 1 0 0 0 0 0 5 1 c.jpg\n"
            "\n")
        cameras = eval_poses.read_truth(self.folder)
        self.assertEqual(sorted(cameras), ["a b.jpg", "c.jpg"])
        np.testing.assert_allclose(cameras["a b.jpg"].centre, [-2, 1, -3], atol=1e-12)
        np.testing.assert_allclose(cameras["c.jpg"].centre, [0, 0, -5], atol=1e-12)

    def test_refuses_a_damaged_model(self):
        (self.folder / "images.txt").write_text("1 1 0 0\n\n")
        with self.assertRaisesRegex(ValueError, "4 fields instead of 10"):
            eval_poses.read_truth(self.folder)

    def test_reads_strecha_cameras(self):
        (self.folder / "0001.jpg.camera").write_text(
            "1 0 0\n0 1 0\n0 0 1\n0 0 0\n0 -1 0\n1 0 0\n0 0 1\n4 5 6\n30 20\n")
        camera = eval_poses.read_truth(self.folder)["0001.jpg"]
        np.testing.assert_allclose(camera.centre, [4, 5, 6])
        np.testing.assert_allclose(camera.rotation[0], [0, -1, 0])

    def test_refuses_a_folder_without_truth(self):
        with self.assertRaisesRegex(ValueError, "neither"):
            eval_poses.read_truth(self.folder)


if __name__ == "__main__":
    unittest.main()
