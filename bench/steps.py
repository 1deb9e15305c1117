# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Long chains of commands that go on where they were stopped."""
import json
import os
import pathlib
import subprocess

import measure


class Failed(Exception):
    """A command that a benchmark needs has failed; the message names its log."""


def commit():
    """Of the repository, with a plus where files were changed since; empty outside of one."""
    root = pathlib.Path(__file__).parents[1]
    words = ["git", "-C", str(root), "describe", "--always", "--exclude=*", "--dirty=+"]
    try:
        found = subprocess.run(words, capture_output=True, text=True, check=False)
    except OSError:
        return ""
    return found.stdout.strip() if found.returncode == 0 else ""


def write_whole(path, text):
    """A kill leaves the old file or the new one."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(path.name + ".part")
    part.write_text(text, encoding="utf-8")
    os.replace(part, path)


class Chain:
    """Steps in a fixed order, of which each uses what the ones before it made.

    LOGS/NAME-STEP.log has what a step printed, LOGS/NAME-STEP.json what was run and what it cost.
    A step that ended well with the same words is not run again, unless one before it was or what it
    made is gone. Steps from `again` on are run anyway."""

    def __init__(self, logs, name, steps, again=None):
        self.logs, self.name, self.steps = pathlib.Path(logs), name, steps
        if again in steps:
            self._forget(again)

    def log(self, step):
        return self.logs / f"{self.name}-{step}.log"

    def record(self, step):
        """What LOGS/NAME-STEP.json says; empty where the step was never begun."""
        try:
            return json.loads(self.log(step).with_suffix(".json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}

    def costs(self):
        """By step that was run: wall and CPU seconds, and whether they are of its last part only."""
        records = {step: self.record(step) for step in self.steps}
        return {step: {"wall_s": record["wall_s"], "cpu_s": record["cpu_s"],
                       "in_part": record["in_part"]}
                for step, record in records.items() if "wall_s" in record}

    def commits(self):
        """Of the steps that were run, each once."""
        found = (self.record(step).get("commit") for step in self.steps)
        return list(dict.fromkeys(name for name in found if name))

    def run(self, step, command, made, goes_on=False):
        """`made` is a file or folder that the step leaves; `goes_on` says that the command goes on
        where it was stopped, so that its last part costs less than all. Raises Failed."""
        words = [str(word) for word in command]
        before = self.record(step)
        same = before.get("command") == words and made.exists()
        if same and before.get("exit_code") == 0:
            return
        self._forget(step)
        record = {"command": words, "commit": commit(), "in_part": same and goes_on}
        path = self.log(step).with_suffix(".json")
        write_whole(path, json.dumps(record) + "\n")
        with open(self.log(step), "wb") as output:
            record.update(measure.measure(words, output.fileno()))
        write_whole(path, json.dumps(record) + "\n")
        if record["exit_code"] != 0:
            raise Failed(f"{' '.join(words[:3])} ... ended with {record['exit_code']}; "
                         f"see {self.log(step)}")

    def _forget(self, step):
        for later in self.steps[self.steps.index(step):]:
            self.log(later).with_suffix(".json").unlink(missing_ok=True)
