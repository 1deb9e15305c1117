# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""bench/count_missions.py counts every second that a mission commands."""
import json
import math
import pathlib
import sys
import tempfile
import unittest
import zipfile

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "bench"))
import count_missions  # noqa: E402

PACE = {"speed_m_per_s": 5, "transfer_speed_m_per_s": 8, "hold_s": 1.5, "climb_m_per_s": 4,
        "sink_m_per_s": 2, "yaw_deg_per_s": 90, "tilt_deg_per_s": 45, "shutter_s": 0.5,
        "ground_s": 10, "corner_s": 3, "stop_s": 6, "wind_m_per_s": 0}
CONFIG = """<wpml:missionConfig><wpml:takeOffSecurityHeight>40</wpml:takeOffSecurityHeight>
{}<wpml:globalTransitionalSpeed>8.0</wpml:globalTransitionalSpeed>
<wpml:globalRTHHeight>40</wpml:globalRTHHeight></wpml:missionConfig>"""
HOME = "<wpml:takeOffRefPoint>0.0,0.0,0.0</wpml:takeOffRefPoint>"
DEGREES = 180 / math.pi / count_missions.EARTH_M  # of a metre at the equator


def document(inside):
    return ('<?xml version="1.0"?><kml xmlns="http://www.opengis.net/kml/2.2" '
            f'xmlns:wpml="http://www.dji.com/wpmz/1.0.2"><Document>{inside}</Document></kml>')


def action(name, parameters=""):
    return (f"<wpml:action><wpml:actionActuatorFunc>{name}</wpml:actionActuatorFunc>"
            f"<wpml:actionActuatorFuncParam>{parameters}</wpml:actionActuatorFuncParam>"
            "</wpml:action>")


def placemark(east_m, height, yaw, actions=""):
    group = f"<wpml:actionGroup>{actions}</wpml:actionGroup>" if actions else ""
    return (f"<Placemark><Point><coordinates>{east_m * DEGREES},0</coordinates></Point>"
            f"<wpml:executeHeight>{height}</wpml:executeHeight>"
            "<wpml:waypointSpeed>5.0</wpml:waypointSpeed><wpml:waypointHeadingParam>"
            f"<wpml:waypointHeadingAngle>{yaw}</wpml:waypointHeadingAngle>"
            f"</wpml:waypointHeadingParam>{group}</Placemark>")


PHOTO = action("hover", "<wpml:hoverTime>1.5</wpml:hoverTime>") + action("takePhoto")
ACTIONS = (action("rotateYaw", "<wpml:aircraftHeading>90</wpml:aircraftHeading>")
           + action("gimbalRotate", "<wpml:gimbalPitchRotateAngle>-45</wpml:gimbalPitchRotateAngle>")
           + PHOTO + action("rotateYaw", "<wpml:aircraftHeading>-90</wpml:aircraftHeading>") + PHOTO)
POINTS = [placemark(0, 10, 90), placemark(30, 10, 90), placemark(30, 30, 90, ACTIONS),
          placemark(0, 10, -90)]


class CountMissions(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def seconds(self, points, pace=None):
        with zipfile.ZipFile(self.folder / "mission.kmz", "w") as archive:
            archive.writestr("wpmz/template.kml", document(CONFIG.format(HOME)))
            archive.writestr("wpmz/waylines.wpml", document(
                CONFIG.format("") + f"<Folder>{''.join(points)}</Folder>"))
        return count_missions.count_mission(self.folder / "mission.kmz", pace or PACE)

    def test_counts_climbs_legs_turns_tilts_holds_and_photos(self):
        ground = 10 + 40 / 4 + 30 / 2 + 10 / 2
        legs = 30 / 5 + 3 + 20 / 5 + math.hypot(30, 20) / 5
        stop = 6 + 45 / 45 + 2 * (1.5 + 0.5) + 180 / 90
        seconds, photos = self.seconds(POINTS)
        self.assertAlmostEqual(seconds, ground + legs + stop, places=4)
        self.assertEqual(photos, 2)

    def test_a_turn_that_outlasts_its_leg_counts(self):
        still = [placemark(0, 10, 0), placemark(1, 10, 180), placemark(0, 10, 180)]
        straight = [placemark(0, 10, 0), placemark(1, 10, 0), placemark(0, 10, 0)]
        self.assertAlmostEqual(self.seconds(still)[0] - self.seconds(straight)[0],
                               180 / 90 - 1 / 5, places=4)

    def test_wind_that_the_drone_can_hold_against_costs_no_time(self):
        calm = self.seconds(POINTS)[0]
        self.assertAlmostEqual(self.seconds(POINTS, {**PACE, "wind_m_per_s": 9})[0], calm)
        self.assertGreater(self.seconds(POINTS, {**PACE, "wind_m_per_s": 12})[0], calm + 1)

    def test_compares_with_the_plan_and_knows_missing_photos(self):
        seconds, _ = self.seconds(POINTS)
        plan = {"pace": PACE, "flights": [{"time_min": 2 * seconds / 60}],
                "views": [{"flight": 0}, {"flight": 0}]}
        (self.folder / "plan.json").write_text(json.dumps(plan))
        planned, commanded, photos = count_missions.compare(self.folder)[0]
        self.assertAlmostEqual(planned / commanded, 2)
        self.assertEqual(photos, 2)
        plan["views"].append({"flight": 0})
        (self.folder / "plan.json").write_text(json.dumps(plan))
        with self.assertRaises(SystemExit):
            count_missions.compare(self.folder)


if __name__ == "__main__":
    unittest.main()
