# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""bench/fit_energy.py finds the constants that made the flights, and the program has those it finds."""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "bench"))
import fit_energy  # noqa: E402


class FitEnergy(unittest.TestCase):
    def test_finds_the_constants_of_flights_without_error(self):
        constants = (4.5, 0.75, 2.9)
        made = [(*f[:5], *fit_energy.predict(f, constants)) for f in fit_energy.FLIGHTS]
        for found, true in zip(fit_energy.fit(made), constants):
            self.assertAlmostEqual(found, true, delta=0.01)

    def test_the_program_has_what_it_finds(self):
        stop_s, _, percent_per_min = fit_energy.fit(fit_energy.FLIGHTS)
        energy = (ROOT / "plan/path/energy.cpp").read_text()
        plan = (ROOT / "survey/plan.h").read_text()
        self.assertAlmostEqual(
            float(re.search(r"kPercentPerMinute = ([\d.]+);", energy)[1]), percent_per_min, delta=2e-3)
        self.assertAlmostEqual(float(re.search(r"stop_s = ([\d.]+);", plan)[1]), stop_s, delta=0.01)

    def test_a_flight_left_out_is_fitted_without(self):
        worse, better = (fit_energy.mean_errors(e)[0] for e in (
            fit_energy.left_out(),
            [fit_energy.errors(f, fit_energy.fit(fit_energy.FLIGHTS)) for f in fit_energy.FLIGHTS]))
        self.assertGreater(worse, better)


if __name__ == "__main__":
    unittest.main()
