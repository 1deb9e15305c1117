# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program from the outside: words, messages, exit codes, JSON. Stages are not run here, except
the quick ones (ingest)."""
import json
import os
import shutil
import signal
import struct
import subprocess
import time
import unittest
import zipfile

import stucco

VERBS = ["plan", "simulate", "lint", "init", "check", "run", "status", "ingest", "calib", "dense",
         "proxy", "texture", "report", "import", "export", "evaluate", "options", "completion"]
STAGES = ["ingest", "calib", "dense", "proxy", "texture", "report"]


class Help(stucco.TestCase):
    def test_every_verb_explains_itself_with_an_example(self):
        overview = self.check(stucco.run("--help")).stdout
        self.assertIn("stucco init my-survey --photos my-photos", overview)
        self.assertIn("Exit codes", overview)
        for verb in VERBS:
            self.assertIn(verb, overview)
            text = self.check(stucco.run(verb, "--help")).stdout
            self.assertIn(f"stucco {verb}", text)
            for option in ("--json", "--threads", "--memory-limit", "--quiet", "--verbose"):
                self.assertIn(option, text, verb)

    def test_version(self):
        self.assertRegex(self.check(stucco.run("--version")).stdout, r"^stucco \d+\.\d+\.\d+\n$")

    def test_no_words_show_the_help_and_are_wrong_usage(self):
        self.assertIn("Start here", self.check(stucco.run(), 2).stdout)


class WrongUsage(stucco.TestCase):
    def test_unknown_verbs_and_options_get_a_suggestion(self):
        self.refused(stucco.run("statsu"), 2, "did you mean status?")
        self.refused(stucco.run("run", "s", "--untli", "calib"), 2, "did you mean --until?")
        self.refused(stucco.run("calib", "s", "--max-imge-px=3"), 2, "did you mean --max-image-px?")
        self.refused(stucco.run("frobnicate"), 2, "stucco --help lists the verbs")
        self.refused(stucco.run("init", "s"), 2, "--photos", "stucco init --help")
        self.refused(stucco.run("run", "s", "--threads", "0"), 2, "--threads")
        self.refused(stucco.run("completion", "tcsh"), 2, "bash")

    def test_unknown_stages_and_formats_get_a_suggestion(self):
        survey = self.init(self.photo_folder(2))
        self.refused(stucco.run("run", survey, "--until", "calibb"), 2, "did you mean calib?")
        self.refused(stucco.run("run", survey, "--from", "dense", "--until", "calib"), 2, "--from")
        self.refused(stucco.run("export", survey, "--format", "gltf", "-o", "x"), 2,
                     "did you mean glb?")

    def test_errors_are_json_when_json_is_asked_for(self):
        result = json.loads(self.check(stucco.run("statsu", "--json"), 2).stdout)
        self.assertEqual(result["exit_code"], 2)
        self.assertEqual(result["kind"], "usage")
        result = json.loads(self.check(stucco.run("run", self.root / "no", "--json"), 3).stdout)
        self.assertIn("no survey folder", result["error"])
        self.assertIn("stucco init", result["remedy"])


class Init(stucco.TestCase):
    def test_writes_settings_with_every_option(self):
        survey = self.init(self.photo_folder(3))
        settings = (survey / "survey.toml").read_text()
        for stage in STAGES:
            self.assertIn(f"\n[{stage}]", settings)
        self.assertIn("max_image_px = ", settings)
        sections = json.loads(self.check(stucco.run("options", "--json")).stdout)
        for section in sections:
            for option in section["options"]:
                self.assertIn(f"\n{option['name']} = {option['default']}\n", settings)

    def test_says_what_to_type_next(self):
        survey = self.root / "a b"
        process = self.check(stucco.run("init", survey, "--photos", self.photo_folder(2)))
        self.assertIn(f"Next: stucco run '{self.root}/a b'", process.stdout)
        self.assertIn("2 photos", process.stdout)

    def test_refuses_what_cannot_be_a_survey(self):
        photos = self.photo_folder(2)
        self.refused(stucco.run("init", self.root / "s", "--photos", self.root / "none"), 3,
                     "none", "is not there")
        self.refused(stucco.run("init", photos / "s", "--photos", photos), 3,
                     "inside the photo folder")
        survey = self.init(photos)
        before = stucco.contents(survey)
        self.refused(stucco.run("init", survey, "--photos", photos), 3, "already is a survey")
        self.assertEqual(stucco.contents(survey), before)

    def test_json_also_of_names_that_are_not_utf8(self):
        survey = os.fsencode(self.root) + b"/s\xff"
        process = subprocess.run([stucco.PROGRAM, "init", survey, "--photos", self.photo_folder(2),
                                  "--json"], capture_output=True, check=True)
        self.assertEqual(json.loads(process.stdout)["photos"], 2)
        status = subprocess.run([stucco.PROGRAM, "status", survey, "--json"], capture_output=True,
                                check=True)
        self.assertEqual(len(json.loads(status.stdout)["stages"]), len(STAGES))


@unittest.skipUnless(os.path.exists("/dev/full"), "there is no /dev/full")
class FullOutput(stucco.TestCase):
    def test_a_result_that_cannot_be_written_is_no_success(self):
        survey = self.init(self.photo_folder(2))
        with open("/dev/full", "w", encoding="utf-8") as full:
            for words in (["status", survey, "--json"], ["check", survey], ["options"], ["--help"]):
                process = subprocess.run([stucco.PROGRAM, *words], stdout=full, text=True,
                                         stderr=subprocess.PIPE, check=False)
                self.assertEqual(process.returncode, 5, words)
                self.assertIn("standard output", process.stderr)

    def test_messages_that_cannot_be_written_stop_nothing(self):
        survey = self.init(self.photo_folder(2))
        with open("/dev/full", "w", encoding="utf-8") as full:
            process = subprocess.run([stucco.PROGRAM, "ingest", survey], stderr=full,
                                     stdout=subprocess.PIPE, check=False)
        self.assertEqual(process.returncode, 0)
        self.assertEqual(self.states(survey)["ingest"], "done")


class Check(stucco.TestCase):
    def test_estimates_every_stage(self):
        survey = self.init(self.photo_folder(3))
        result = json.loads(self.check(stucco.run("check", survey, "--json")).stdout)
        self.assertTrue(result["ok"])
        self.assertEqual(result["photos"]["count"], 3)
        self.assertEqual([need["stage"] for need in result["estimates"]], STAGES)
        self.assertGreater(sum(need["wall_s"] for need in result["estimates"]), 1)
        self.assertIn("Next: stucco run", self.check(stucco.run("check", survey)).stdout)
        self.assertFalse((survey / ".stucco").exists(), "check writes nothing")

    def test_names_bad_pictures_and_refuses_none_at_all(self):
        photos = self.photo_folder(2)
        (photos / "empty.jpg").write_bytes(b"")
        survey = self.init(photos)
        self.assertIn("left out: ", self.check(stucco.run("check", survey)).stdout)
        result = json.loads(self.check(stucco.run("check", survey, "--json")).stdout)
        self.assertEqual([file["path"] for file in result["photos"]["left_out"]], ["empty.jpg"])
        shutil.rmtree(photos)
        process = self.check(stucco.run("check", survey, "--json"), 3)
        self.assertFalse(json.loads(process.stdout)["ok"])

    def test_all_settings_errors_at_once(self):
        survey = self.init(self.photo_folder(2))
        settings = survey / "survey.toml"
        text = settings.read_text()
        settings.write_text(text.replace("max_features = ", "max_feature = ")
                            .replace("[dense]", "[dens]")
                            .replace("threads = 0", "threads = -4"))
        self.refused(stucco.run("check", survey), 2, "calib.max_feature: unknown option",
                     "did you mean", "dens: unknown section", "run.threads", "survey.toml:")
        settings.write_text("photos = \n")
        self.refused(stucco.run("run", survey), 3, "survey.toml:1", "not valid TOML")


class RunAndStatus(stucco.TestCase):
    def test_ingest_runs_once(self):
        survey = self.init(self.photo_folder(3))
        self.assertEqual(set(self.states(survey).values()), {"missing"})
        result = json.loads(self.check(stucco.run("ingest", survey, "--json")).stdout)
        self.assertEqual(result["stages"][0]["action"], "ran")
        captures = json.loads((survey / "ingest/captures.json").read_text())
        self.assertEqual(len(captures["photos"]), 3)
        result = json.loads(self.check(stucco.run("ingest", survey, "--json")).stdout)
        self.assertEqual(result["stages"][0]["action"], "up_to_date")
        self.assertEqual(self.states(survey)["ingest"], "done")
        status = self.check(stucco.run("status", survey)).stdout
        self.assertIn("Next: stucco run", status)

    def test_time_and_busy_cores_are_told(self):
        survey = self.init(self.photo_folder())
        self.assertNotIn("core", self.check(stucco.run("status", survey)).stdout)
        process = self.check(stucco.run("ingest", survey))
        cores = len(os.sched_getaffinity(0))
        busy = rf"[0-9]+\.[0-9] of {cores} cores?"
        self.assertRegex(process.stderr,
                         rf"ingest: done in [0-9.]+ s, {busy} busy, [0-9.]+ [MG]iB of memory\n")
        self.assertRegex(self.check(stucco.run("status", survey)).stdout,
                         rf"ingest +done +[0-9.]+ s +[0-9.]+ s +{busy} ")
        status = json.loads(self.check(stucco.run("status", survey, "--json")).stdout)
        self.assertEqual(status["stages"][0]["cores"], cores)
        self.assertGreater(status["stages"][0]["cpu_s"], 0)
        self.assertNotIn("cores", status["stages"][1])
        process = stucco.run("ingest", survey, "--force", "--json")
        self.assertEqual(json.loads(self.check(process).stdout)["stages"][0]["cores"], cores)

    def test_options_of_a_stage_verb_hold_for_that_run(self):
        survey = self.init(self.photo_folder(3))
        self.check(stucco.run("ingest", survey))
        process = self.check(stucco.run("ingest", survey, "--min-side-px", "100"))
        self.assertIn("option ingest.min_side_px changed", process.stderr)
        self.refused(stucco.run("ingest", survey, "--min-side-px", "many"), 2, "min_side_px")
        self.refused(stucco.run("run", survey, "--set", "ingest.min_sid_px=3"), 2, "did you mean")

    def test_an_epoch_to_be_made_again_has_to_be_there(self):
        survey = self.init(self.photo_folder(3))
        self.refused(stucco.run("texture", survey, "--epoch", "may"), 3, "stucco retexture")
        epoch = survey / "epochs/may"
        epoch.mkdir(parents=True)
        (epoch / "textures.json").write_text("{}")
        (epoch / "retexture.json").write_text('{"version": 1, "name": "may", "replace": "often"}')
        self.refused(stucco.run("texture", survey, "--epoch", "may"), 3, '"replace" must be')
        self.refused(stucco.run("proxy", survey, "--epoch", "may"), 2, "--epoch")
        self.assertNotIn("done", self.states(survey).values())

    def test_progress_is_on_stderr_and_quiet_is_quiet(self):
        survey = self.init(self.photo_folder(3))
        process = self.check(stucco.run("ingest", survey))
        self.assertIn("ingest: done in", process.stderr)
        self.assertEqual(process.stdout, "")
        process = self.check(stucco.run("ingest", survey, "--force", "--quiet"))
        self.assertEqual(process.stderr, "")

    def test_the_survey_is_the_current_folder_by_default(self):
        survey = self.init(self.photo_folder(3))
        self.assertIn("ingest", self.check(stucco.run("status", cwd=survey)).stdout)

    def test_a_second_run_names_the_first(self):
        survey = self.init(self.photo_folder(3))
        (survey / ".stucco").mkdir()
        holder = subprocess.Popen(
            ["/usr/bin/env", "python3", "-c",
             "import fcntl, json, os, sys, time\n"
             "lock = open(sys.argv[1], 'a')\n"
             "fcntl.flock(lock, fcntl.LOCK_EX)\n"
             "lock.write(json.dumps({'pid': os.getpid(), 'host': 'here', 'started': 'now',"
             " 'command': 'stucco run somewhere'}))\n"
             "lock.flush()\n"
             "print('locked', flush=True)\n"
             "time.sleep(600)", survey / ".stucco/lock"], stdout=subprocess.PIPE, text=True)
        try:
            self.assertEqual(holder.stdout.readline(), "locked\n")
            self.refused(stucco.run("run", survey), 3, f"process {holder.pid}",
                         "stucco run somewhere", f"kill {holder.pid}")
            status = json.loads(self.check(stucco.run("status", survey, "--json")).stdout)
            self.assertEqual(status["running"]["pid"], holder.pid)
        finally:
            holder.kill()
            holder.wait()
            holder.stdout.close()
        self.check(stucco.run("ingest", survey))

    def test_a_second_interruption_ends_it_at_once(self):
        survey = self.init(self.photo_folder())
        process = subprocess.Popen([stucco.PROGRAM, "calib", survey, "--max-features=8000"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and not self.units(survey):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        for line in process.stderr:
            if "Stopping at the next safe point" in line:
                break
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 130, stderr)
        self.assertIn("Stopped at once", stderr)
        self.assertNotIn("failed", self.states(survey).values())

    def test_interrupted_it_ends_with_130_and_goes_on(self):
        survey = self.init(self.photo_folder())
        words = ["run", survey, "--until", "calib", "--set", "calib.max_features=3000"]
        process = subprocess.Popen([stucco.PROGRAM, *words, "--force"],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and not self.units(survey):
            time.sleep(0.01)
        process.send_signal(signal.SIGTERM)
        _, stderr = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 130, stderr)
        self.assertIn("To go on from here: stucco " + " ".join(map(str, words)) + "\n", stderr)
        computed = self.units(survey)
        self.assertNotIn("failed", self.states(survey).values())
        self.assertGreater(len(computed), 0)

    @staticmethod
    def units(survey):
        try:
            return stucco.events(survey, "unit")
        except FileNotFoundError:
            return []


def write_colmap(folder, names, width, height, poses=None):
    """A text model with one pinhole camera, the photos in a row and a point that all see."""
    folder.mkdir()
    (folder / "cameras.txt").write_text(f"1 PINHOLE {width} {height} {width} {width} "
                                        f"{width / 2} {height / 2}\n")
    lines, track = [], []
    for number, name in enumerate(names, 1):
        lines.append(f"{number} 1 0 0 0 {-number} 0 0 1 {name}")
        x = width / 2 + width * (4 - number) / 10
        lines.append(f"{x} {height / 2} 1")
        track.append(f"{number} 0")
    (folder / "images.txt").write_text("\n".join(lines) + "\n")
    (folder / "points3D.txt").write_text(f"1 4 0 10 200 200 200 0.1 {' '.join(track)}\n")


def jpeg_size(path):
    data = path.read_bytes()
    at = 2
    while data[at + 1] not in (0xC0, 0xC1, 0xC2):
        at += 2 + struct.unpack(">H", data[at + 2:at + 4])[0]
    height, width = struct.unpack(">HH", data[at + 5:at + 9])
    return width, height


class ImportAndExport(stucco.TestCase):
    def test_an_imported_model_is_the_calibration(self):
        photos = self.photo_folder(3)
        survey = self.init(photos)
        width, height = jpeg_size(stucco.sample_photos(1)[0])
        names = [photo.name for photo in stucco.sample_photos(3)]
        write_colmap(self.root / "model", ["other/" + name for name in names], width // 2,
                     height // 2)
        process = self.check(stucco.run("import", survey, self.root / "model"))
        self.assertIn("Imported 3 photos", process.stdout)
        self.assertIn("was scaled", process.stdout)
        calibration = json.loads((survey / "calib/calibration.json").read_text())
        self.assertEqual(calibration["photos_posed"], 3)
        self.assertLess(calibration["reprojection_error_px"], 1e-6)
        self.assertEqual(self.states(survey)["calib"], "done")
        process = self.check(stucco.run("run", survey, "--until", "calib", "--json"))
        result = json.loads(process.stdout)
        # Ingest ran with the import, which looks for positions.
        self.assertEqual([stage["action"] for stage in result["stages"][:2]],
                         ["up_to_date", "up_to_date"])
        self.check(stucco.run("export", survey, "--format", "colmap-txt", "-o", self.root / "out"))
        images = (self.root / "out/images.txt").read_text()
        for name in names:
            self.assertIn(f" {name}\n", images)

    def test_an_imported_model_finds_the_photos_that_ingest_sees(self):
        photos = self.root / "photos"
        photos.mkdir()
        (photos / "card").symlink_to(self.photo_folder(3, "elsewhere"))
        names = [photo.name for photo in stucco.sample_photos(3)]
        for hidden in (photos / ".thumbnails", photos / "@eaDir"):
            hidden.mkdir()
            shutil.copy(stucco.sample_photos(1)[0], hidden)
        survey = self.init(photos)
        width, height = jpeg_size(stucco.sample_photos(1)[0])
        write_colmap(self.root / "model", names, width, height)
        self.assertIn("Imported 3 photos",
                      self.check(stucco.run("import", survey, self.root / "model")).stdout)

    def test_refuses_models_of_other_photos(self):
        survey = self.init(self.photo_folder(3))
        width, height = jpeg_size(stucco.sample_photos(1)[0])
        write_colmap(self.root / "strange", ["x.jpg", "y.jpg"], width, height)
        self.refused(stucco.run("import", survey, self.root / "strange"), 3, "x.jpg")
        names = [photo.name for photo in stucco.sample_photos(2)]
        write_colmap(self.root / "cropped", names, width, height // 2)
        self.refused(stucco.run("import", survey, self.root / "cropped"), 3, "camera 1")
        self.refused(stucco.run("import", survey, self.root / "none"), 3, "none")
        self.assertFalse((survey / "calib").exists())

    def write_ply(self, name, points):
        path = self.root / name
        path.write_text("ply\nformat ascii 1.0\nelement vertex "
                        f"{len(points)}\nproperty float x\nproperty float y\n"
                        "property float z\nend_header\n" +
                        "".join(f"{x} {y} {z}\n" for x, y, z in points))
        return path

    def test_an_imported_cloud_is_the_dense_one(self):
        survey = self.init(self.photo_folder(3))
        wall = [(4 + 0.01 * x, 0.01 * y, 10) for x in range(20) for y in range(20)]
        cloud = self.write_ply("wall.PLY", wall)
        self.refused(stucco.run("import", survey, cloud), 3, "no camera poses", "until calib")
        width, height = jpeg_size(stucco.sample_photos(1)[0])
        write_colmap(self.root / "model", [photo.name for photo in stucco.sample_photos(3)], width,
                     height)
        # The cloud is in the model's own frame.
        settings = survey / "survey.toml"
        text = settings.read_text()
        self.assertIn("use_positions = true", text)
        settings.write_text(text.replace("use_positions = true", "use_positions = false"))
        self.check(stucco.run("import", survey, self.root / "model"))
        georef = json.loads((survey / "calib/georef.json").read_text())
        self.assertEqual(georef["frame"], "arbitrary")
        elsewhere = self.write_ply("utm.ply", [(x + 5e5, y + 5e6, z) for x, y, z in wall])
        self.refused(stucco.run("import", survey, elsewhere), 3, "frame of the camera poses")
        self.refused(stucco.run("import", survey, self.root / "gone.ply"), 3, "gone.ply")
        self.assertFalse((survey / "dense").exists())
        process = self.check(stucco.run("import", survey, cloud))
        self.assertIn("Imported 400 points", process.stdout)
        self.assertIn("no normals", process.stdout)
        self.assertEqual(self.states(survey)["dense"], "done")
        self.check(stucco.run("export", survey, "--format", "ply", "-o", self.root / "out.ply"))
        self.assertIn(b"element vertex 400", (self.root / "out.ply").read_bytes())

    def test_export_says_what_has_to_run_first_and_overwrites_nothing(self):
        survey = self.init(self.photo_folder(2))
        self.refused(stucco.run("export", survey, "--format", "glb", "-o", self.root / "m.glb"), 3,
                     "stucco texture")
        (survey / "texture").mkdir()
        (survey / "texture/model.glb").write_bytes(b"glTF")
        out = self.root / "m.glb"
        self.check(stucco.run("export", survey, "--format", "glb", "-o", out))
        self.assertEqual(out.read_bytes(), b"glTF")
        self.refused(stucco.run("export", survey, "--format", "glb", "-o", out), 3, "--overwrite")
        self.check(stucco.run("export", survey, "--format", "glb", "-o", out, "--overwrite"))


class Lint(stucco.TestCase):
    """The rules are tested in tests/plan."""

    def test_faults_are_listed_and_are_a_gate_that_is_not_met(self):
        mission = self.root / "mission.kmz"
        with zipfile.ZipFile(mission, "w") as archive:
            archive.writestr("wpmz/template.kml", "<kml/>")
        process = self.check(stucco.run("lint", mission), 4)
        faults = json.loads(self.check(stucco.run("lint", mission, "--json"), 4).stdout)["faults"]
        self.assertGreater(len(faults), 0)
        for fault in faults:
            line = " | ".join(fault[name] for name in ("element", "rule", "text"))
            self.assertIn(line + "\n", process.stdout)
        self.refused(stucco.run("lint", self.root / "none.kmz"), 3, "none.kmz")


class Completion(stucco.TestCase):
    def test_bash_completes_verbs_options_and_stages(self):
        script = self.check(stucco.run("completion", "bash")).stdout
        self.assertEqual(self.complete(script, "stucco", "sta"), ["status"])
        self.assertIn("--until", self.complete(script, "stucco", "run", "--un"))
        self.assertEqual(self.complete(script, "stucco", "run", "--until", "ca"), ["calib"])
        self.assertIn("--max-image-px", self.complete(script, "stucco", "calib", "--max-im"))
        self.assertEqual(self.complete(script, "stucco", "export", "--format", "g"), ["glb"])

    def complete(self, script, *words):
        process = subprocess.run(
            ["bash", "-c", script + '\nCOMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _stucco; '
             'printf "%s\\n" "${COMPREPLY[@]}"', "bash", *words],
            capture_output=True, text=True, check=True)
        self.assertEqual(process.stderr, "")
        return process.stdout.split()

    def test_other_shells_accept_theirs(self):
        for shell in ("zsh", "fish"):
            script = self.check(stucco.run("completion", shell)).stdout
            for verb in VERBS:
                self.assertIn(verb, script)
            if shutil.which(shell):
                subprocess.run([shell, "-n"], input=script, text=True, check=True,
                               env={**os.environ, "HOME": str(self.root)})


class Options(stucco.TestCase):
    def test_markdown_has_a_row_for_every_option(self):
        markdown = self.check(stucco.run("options")).stdout
        for section in json.loads(self.check(stucco.run("options", "--json")).stdout):
            self.assertIn(f"## [{section['section']}]", markdown)
            for option in section["options"]:
                self.assertIn(f"| `{option['name']}` |", markdown)


if __name__ == "__main__":
    unittest.main()
