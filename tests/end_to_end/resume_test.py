# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Kills runs of the sample survey at random moments; what is continued has to end in the same
bytes as an undisturbed run, with no unit computed twice after its checkpoint."""
import collections
import os
import random
import subprocess
import time
import unittest

import stucco
from chain_test import SIZES, set_options

KILLS = int(os.environ.get("STUCCO_KILLS", "20"))


class Resume(stucco.TestCase):
    def prepared(self, photos, name):
        survey = self.init(photos, name)
        set_options(survey, SIZES)
        return survey

    def test_kills_at_random_moments(self):
        photos = self.photo_folder()
        whole = self.prepared(photos, "whole")
        start = time.monotonic()
        self.check(stucco.run("run", whole, "--threads", 2))
        undisturbed_s = time.monotonic() - start
        killed = self.prepared(photos, "killed")
        moments = random.Random(20260301)
        kills = 0
        for _ in range(KILLS):
            process = subprocess.Popen([stucco.PROGRAM, "run", killed, "--threads", "2"],
                                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(moments.uniform(0, 2 * undisturbed_s / KILLS))
            process.kill()
            kills += process.wait() == -9
        self.assertGreater(kills, KILLS // 2, "the runs ended before they could be killed")
        self.check(stucco.run("run", killed, "--threads", 2))
        expected, found = stucco.contents(whole), stucco.contents(killed)
        self.assertEqual(sorted(found), sorted(expected))
        self.assertEqual([name for name in found if found[name] != expected[name]], [])
        units = collections.Counter((unit["stage"], unit["kind"], unit["key"])
                                    for unit in stucco.events(killed, "unit"))
        self.assertEqual([unit for unit, count in units.items() if count > 1], [])
        self.assertGreater(len(units), len(stucco.sample_photos()))


if __name__ == "__main__":
    unittest.main()
