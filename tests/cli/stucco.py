# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests of the built program share: running it and making small files for it.

The program is named by the environment variable STUCCO, which CTest sets.
"""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ.get("STUCCO", "stucco")
ROOT = pathlib.Path(__file__).resolve().parents[2]
SAMPLE = ROOT / "data/sample/photos"


def run(*words, timeout=600, **options):
    """The finished process, with stdout and stderr as text."""
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True,
                          timeout=timeout, check=False, **options)


def sample_photos(count=None):
    photos = sorted(path for path in SAMPLE.iterdir() if path.suffix.lower() == ".jpg")
    return photos[:count]


def contents(folder):
    """Relative path -> bytes of every file of a survey, without what the orchestrator keeps."""
    folder = pathlib.Path(folder)
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*"))
            if path.is_file() and path.relative_to(folder).parts[0] != ".stucco"}


def events(survey, name):
    """The records of one kind; a line torn by a kill is no record."""
    found = []
    for line in (pathlib.Path(survey) / ".stucco/events.ndjson").read_text().splitlines():
        try:
            record = json.loads(line)
        except json.JSONDecodeError:
            continue
        if record.get("event") == name:
            found.append(record)
    return found


class TestCase(unittest.TestCase):
    """A test with a folder of its own, `self.root`, and assertions about the program."""

    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="stucco-test-"))
        self.addCleanup(shutil.rmtree, self.root, ignore_errors=True)

    def photo_folder(self, count=None, name="photos"):
        """Copies, so that no test can harm the sample."""
        folder = self.root / name
        folder.mkdir()
        for photo in sample_photos(count):
            shutil.copy(photo, folder)
        return folder

    def init(self, photos, name="survey"):
        survey = self.root / name
        self.check(run("init", survey, "--photos", photos))
        return survey

    def check(self, process, exit_code=0):
        """The process ended with this exit code; its output is in the failure's message."""
        self.assertEqual(process.returncode, exit_code,
                         f"{process.args}\nstdout: {process.stdout}\nstderr: {process.stderr}")
        return process

    def refused(self, process, exit_code, *words):
        """Ended with this exit code and said all of these words on stderr, and something to do."""
        self.check(process, exit_code)
        for word in words:
            self.assertIn(word, process.stderr)
        return process

    def states(self, survey):
        status = json.loads(self.check(run("status", survey, "--json")).stdout)
        return {stage["stage"]: stage["state"] for stage in status["stages"]}
