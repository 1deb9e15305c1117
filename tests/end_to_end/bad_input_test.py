# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that goes wrong in practice: each has to end with the right exit code and a message
that says what, which file and what to do, and nothing may be lost. Photos are never written to."""
import json
import os
import pathlib
import shutil
import subprocess
import time
import unittest

import stucco

PNG = bytes.fromhex("89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c489"
                    "0000000d49444154789c6360000002000154a24f5d0000000049454e44ae426082")

QUICK = ("--threads", 2, "--set", "calib.max_features=1500")


def without_metadata(data):
    """The JPEG without its APP and comment segments (EXIF, XMP, GPS)."""
    result, at = data[:2], 2
    while data[at + 1] != 0xDA:
        size = 2 + int.from_bytes(data[at + 2:at + 4], "big")
        if not (0xE1 <= data[at + 1] <= 0xEF or data[at + 1] == 0xFE):
            result += data[at:at + size]
        at += size
    return result + data[at:]


def segments_end(data):
    """Where the picture data of a JPEG begin."""
    at = 2
    while data[at + 1] != 0xDA:
        at += 2 + int.from_bytes(data[at + 2:at + 4], "big")
    return at


class BadInput(stucco.TestCase):
    def setUp(self):
        super().setUp()
        self.watched = {}

    def watch(self, photos):
        """From here on no photo may change."""
        self.watched[photos] = self.snapshot(photos)

    def tearDown(self):
        for photos, before in self.watched.items():
            self.assertEqual(self.snapshot(photos), before, "a photo folder was written to")
        super().tearDown()

    @staticmethod
    def snapshot(photos):
        return {path: (path.read_bytes(), path.stat().st_mtime_ns, path.stat().st_mode)
                for path in sorted(pathlib.Path(photos).rglob("*")) if path.is_file()}

    def captures(self, survey):
        photos = json.loads((survey / "ingest/captures.json").read_text())["photos"]
        return {photo["path"]: photo for photo in photos}

    def test_an_empty_folder(self):
        photos = self.root / "empty"
        photos.mkdir()
        survey = self.init(photos)
        self.refused(stucco.run("run", survey), 3, str(photos), "is empty", "copy the photos")

    def test_a_folder_that_went_away(self):
        photos = self.photo_folder(3)
        survey = self.init(photos)
        photos.rename(self.root / "gone")
        self.refused(stucco.run("run", survey), 3, str(photos), "is not there")

    def test_one_photo(self):
        survey = self.init(self.photo_folder(1))
        self.refused(stucco.run("run", survey), 3, "only one usable photo", "overlap")

    def test_bad_files_among_good_ones_are_listed_with_the_reason(self):
        photos = self.photo_folder(3)
        good = stucco.sample_photos(4)[3].read_bytes()
        (photos / "zero.jpg").write_bytes(b"")
        (photos / "truncated.jpg").write_bytes(good[:len(good) // 2])
        (photos / "cut-header.jpg").write_bytes(good[:30])
        (photos / "really-a-png.jpg").write_bytes(PNG)
        (photos / "really-text.jpg").write_text("not a photo\n")
        (photos / "notes.txt").write_text("not even named like one\n")
        self.watch(photos)
        survey = self.init(photos)
        process = self.check(stucco.run("ingest", survey))
        captures = self.captures(survey)
        for name in ("zero.jpg", "truncated.jpg", "cut-header.jpg", "really-a-png.jpg",
                     "really-text.jpg"):
            self.assertFalse(captures[name]["usable"], name)
            self.assertTrue(captures[name]["why"], name)
            self.assertIn(name, process.stderr)
        self.assertIn("PNG", captures["really-a-png.jpg"]["why"])
        self.assertNotIn("notes.txt", captures)
        self.assertEqual(sum(photo["usable"] for photo in captures.values()), 3)

    def test_a_folder_that_cannot_be_read_costs_only_itself(self):
        photos = self.photo_folder(3)
        locked = photos / "locked"
        locked.mkdir()
        locked.chmod(0)
        self.addCleanup(locked.chmod, 0o755)
        self.root.chmod(0o777)
        # Root reads everything.
        user = {"user": 65534} if os.geteuid() == 0 else {}
        survey = self.root / "survey"
        try:
            self.check(stucco.run("init", survey, "--photos", photos, **user))
        except PermissionError:
            self.skipTest("another user cannot start the program here")
        process = self.check(stucco.run("check", survey, **user))
        self.assertIn("locked: the folder cannot be read", process.stdout)
        self.assertIn("Ready", process.stdout)
        process = self.check(stucco.run("ingest", survey, **user))
        self.assertIn("locked is not used: the folder cannot be read", process.stderr)
        captures = self.captures(survey)
        self.assertFalse(captures["locked"]["usable"])
        self.assertEqual(sum(photo["usable"] for photo in captures.values()), 3)

    def test_photos_and_folders_of_the_user_are_never_replaced(self):
        project = self.root / "project"
        project.mkdir()
        photos = self.photo_folder(3, "project/ingest")
        self.watch(photos)
        self.refused(stucco.run("init", project, "--photos", photos), 3, "which a run replaces",
                     "move the photos")
        self.refused(stucco.run("init", project, "--photos", self.photo_folder(3)), 3,
                     "already has an entry ingest")
        survey = self.init(self.root / "photos")
        settings = survey / "survey.toml"
        settings.write_text(settings.read_text().replace('photos = "', 'photos = "calib" # ', 1))
        shutil.copytree(photos, survey / "calib")
        self.watch(survey / "calib")
        for words in (["check", survey], ["run", survey]):
            process = self.check(stucco.run(*words), 3)
            self.assertIn("which a run replaces", process.stdout + process.stderr)

    def test_only_bad_files(self):
        photos = self.root / "bad"
        photos.mkdir()
        good = stucco.sample_photos(1)[0].read_bytes()
        for number in range(3):
            # The header is whole, so that only decoding tells.
            (photos / f"{number}.jpg").write_bytes(good[:segments_end(good) + 1000 + number])
        self.watch(photos)
        survey = self.init(photos)
        self.refused(stucco.run("run", survey), 3, "0.jpg", "copy the photos")
        self.assertTrue((survey / "report/report.html").is_file())

    def test_two_cameras_mixed(self):
        photos = self.photo_folder()
        for path in sorted(photos.iterdir())[::2]:
            data = path.read_bytes()
            self.assertIn(b"FC-SAMPLE", data, "the camera's name in data/sample")
            path.write_bytes(data.replace(b"FC-SAMPLE", b"FC-OTHER2"))
        self.watch(photos)
        survey = self.init(photos)
        self.check(stucco.run("run", survey, "--until", "calib", *QUICK))
        cameras = json.loads((survey / "ingest/captures.json").read_text())["cameras"]
        self.assertEqual(len(cameras), 2)
        calibration = json.loads((survey / "calib/calibration.json").read_text())
        self.assertEqual(calibration["photos_posed"], len(stucco.sample_photos()))
        self.assertEqual(len(calibration["cameras"]), 2)

    def test_no_overlap(self):
        photos = self.root / "apart"
        photos.mkdir()
        pictures = sorted((stucco.ROOT / "data/sample/source").glob("*.jpg"))[:4]
        for picture in pictures:
            shutil.copy(picture, photos)
        self.watch(photos)
        survey = self.init(photos)
        # The pictures are small.
        process = self.check(stucco.run("run", survey, "--set", "ingest.min_side_px=64"), 1)
        self.assertIn("calib: failed:", process.stderr)
        self.assertIn("Once that is mended: stucco run", process.stderr)
        page = (survey / "report/report.html").read_text()
        self.assertIn("calib", page)

    def test_no_metadata(self):
        photos = self.photo_folder()
        for path in photos.iterdir():
            path.write_bytes(without_metadata(path.read_bytes()))
        self.watch(photos)
        survey = self.init(photos)
        self.check(stucco.run("run", survey, "--until", "calib", *QUICK))
        calibration = json.loads((survey / "calib/calibration.json").read_text())
        self.assertGreaterEqual(calibration["photos_posed"], len(stucco.sample_photos()) - 1)
        self.assertEqual(json.loads((survey / "calib/georef.json").read_text())["frame"],
                         "arbitrary")

    def test_unknown_option(self):
        survey = self.init(self.photo_folder(3))
        settings = survey / "survey.toml"
        settings.write_text(settings.read_text().replace("max_image_px", "max_imge_px", 1))
        self.refused(stucco.run("run", survey), 2, "survey.toml:", "max_imge_px", "did you mean")
        self.assertFalse((survey / "ingest").exists())

    def test_damaged_manifest_output_and_unit(self):
        survey = self.init(self.photo_folder(3))
        self.check(stucco.run("ingest", survey))
        before = stucco.contents(survey)
        manifest = survey / ".stucco/manifests/ingest.json"
        manifest.write_bytes(manifest.read_bytes()[:200])
        self.assertIn("damaged", self.check(stucco.run("status", survey)).stdout)
        self.check(stucco.run("ingest", survey))
        self.assertEqual(stucco.contents(survey), before)
        (survey / "ingest/captures.json").write_text("{}")
        self.assertIn("was changed or damaged", self.check(stucco.run("ingest", survey)).stderr)
        self.assertEqual(stucco.contents(survey), before)
        for unit in (survey / ".stucco/units/ingest").rglob("*"):
            if unit.is_file():
                unit.write_bytes(unit.read_bytes()[:-1])
        shutil.rmtree(survey / "ingest")
        self.check(stucco.run("ingest", survey))
        self.assertEqual(stucco.contents(survey), before)

    def test_a_second_run_in_the_same_survey(self):
        survey = self.init(self.photo_folder())
        first = subprocess.Popen([stucco.PROGRAM, "run", survey, "--until", "calib"],
                                 stderr=subprocess.PIPE, text=True)
        try:
            deadline = time.monotonic() + 30
            while time.monotonic() < deadline and not (survey / ".stucco/events.ndjson").exists():
                time.sleep(0.01)
            self.refused(stucco.run("run", survey), 3, f"process {first.pid}", "wait until")
        finally:
            first.terminate()
            first.communicate(timeout=120)

    @unittest.skipUnless(os.geteuid() == 0 and shutil.which("mount"), "only root may mount")
    def test_full_and_read_only_disks(self):
        photos = self.photo_folder()
        self.watch(photos)
        disk = self.root / "disk"
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=600k", "none", disk],
                          check=False).returncode != 0:
            self.skipTest("mounting is not allowed here")
        try:
            survey = disk / "survey"
            self.check(stucco.run("init", survey, "--photos", photos))
            self.refused(stucco.run("run", survey), 5, "disk", "free some space")
            (disk / "filler").write_bytes(bytes(450_000))
            settings = (survey / "survey.toml").read_bytes()
            process = self.check(stucco.run("ingest", survey), 5)
            self.assertIn("No space left", process.stderr)
            self.assertEqual((survey / "survey.toml").read_bytes(), settings)
            (disk / "filler").unlink()
            self.check(stucco.run("ingest", survey))
            subprocess.run(["mount", "-o", "remount,ro", disk], check=True)
            self.refused(stucco.run("run", survey), 3, str(survey), "writ")
            self.check(stucco.run("status", survey))
            self.refused(stucco.run("init", disk / "other", "--photos", photos), 3,
                         "cannot be created")
        finally:
            subprocess.run(["umount", "-l", disk], check=True)


if __name__ == "__main__":
    unittest.main()
