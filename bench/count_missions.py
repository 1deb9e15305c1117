#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts what the DJI missions of a plan command, action by action, and sets their time beside the
plan's estimate.

  bench/count_missions.py FOLDER...     folders of plans: plan.json, mission.kmz or mission_1.kmz ...

Speeds, waypoints, headings, tilts, holds, photos, heights of take-off and the place of it are read
from the files. What they leave to the drone (turning, climbing, slowing down) is taken from "pace" in
plan.json. Exit code 1 where a flight is off by more than 3 %.
"""
import json
import math
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree
import zipfile

TOP_AIRSPEED = 15  # as plan/path/energy.cpp
LEAST_SPEED = 0.5
EARTH_M = 6371008.8
AT_HOME_M = 20  # nearer than this a drone that is called home lands at once
MOST_OFF = 0.03


def load(archive, name):
    """The document of a file, without namespaces."""
    text = archive.read(name).decode()
    text = re.sub(r'\sxmlns(:\w+)?="[^"]*"', "", text).replace("wpml:", "")
    return ElementTree.fromstring(text).find("Document")


def number(node, path):
    return float(node.find(path).text)


def mean_speed(speed, wind):
    """Over legs against the wind, with it and across it."""
    against = max(LEAST_SPEED, min(speed, TOP_AIRSPEED - wind))
    across = max(LEAST_SPEED, min(speed, math.sqrt(max(0, TOP_AIRSPEED ** 2 - wind ** 2))))
    return 4 / (1 / against + 1 / speed + 2 / across)


def turn(one, other):
    return abs((other - one + 180) % 360 - 180)


def metres(one, other):
    """On the ground, between two pairs of longitude and latitude."""
    latitude = math.radians((one[1] + other[1]) / 2)
    return EARTH_M * math.hypot(math.radians(other[0] - one[0]) * math.cos(latitude),
                                math.radians(other[1] - one[1]))


def waypoint(placemark):
    longitude, latitude = (float(v) for v in placemark.find("Point/coordinates").text.split(","))
    return {"at": (longitude, latitude), "height": number(placemark, "executeHeight"),
            "speed": number(placemark, "waypointSpeed"),
            "yaw": number(placemark, "waypointHeadingParam/waypointHeadingAngle"),
            "actions": [(a.find("actionActuatorFunc").text, a.find("actionActuatorFuncParam"))
                        for a in placemark.findall("actionGroup/action")]}


class Count:
    def __init__(self, pace):
        self.pace, self.seconds, self.photos, self.pitch, self.yaw = pace, 0, 0, 0, None

    def take_off(self, config, home, first):
        height, pace = number(config, "takeOffSecurityHeight"), self.pace
        down = max(0, height - first["height"])
        self.seconds += (pace["ground_s"] + height / pace["climb_m_per_s"]
                         + metres(home, first["at"]) / number(config, "globalTransitionalSpeed")
                         + down / pace["sink_m_per_s"])
        self.yaw = first["yaw"]

    def leg(self, before, point):
        away = math.hypot(metres(before["at"], point["at"]), point["height"] - before["height"])
        turning = turn(self.yaw, point["yaw"]) / self.pace["yaw_deg_per_s"]
        self.seconds += max(away / mean_speed(point["speed"], self.pace["wind_m_per_s"]), turning)
        self.yaw = point["yaw"]

    def stop(self, point):
        actions = point["actions"]
        takes_photos = any(name == "takePhoto" for name, _ in actions)
        self.seconds += self.pace["stop_s" if takes_photos else "corner_s"]
        for name, parameter in actions:
            if name == "rotateYaw":
                yaw = number(parameter, "aircraftHeading")
                self.seconds += turn(self.yaw, yaw) / self.pace["yaw_deg_per_s"]
                self.yaw = yaw
            elif name == "gimbalRotate":
                pitch = number(parameter, "gimbalPitchRotateAngle")
                self.seconds += abs(pitch - self.pitch) / self.pace["tilt_deg_per_s"]
                self.pitch = pitch
            elif name == "hover":
                self.seconds += number(parameter, "hoverTime")
            elif name == "takePhoto":
                self.seconds += self.pace["shutter_s"]
                self.photos += 1
            else:
                raise SystemExit(f"unknown action {name}")

    def go_home(self, config, home, last):
        away, height, pace = metres(home, last["at"]), last["height"], self.pace
        if away > AT_HOME_M:
            climb = max(0, number(config, "globalRTHHeight") - height)
            height += climb
            self.seconds += (climb / pace["climb_m_per_s"]
                             + away / number(config, "globalTransitionalSpeed"))
        self.seconds += height / pace["sink_m_per_s"]


def count_mission(path, pace):
    """Seconds and photos of one KMZ."""
    with zipfile.ZipFile(path) as archive:
        flown = load(archive, "wpmz/waylines.wpml")
        shown = load(archive, "wpmz/template.kml")
    latitude, longitude = (float(v) for v in
                           shown.find("missionConfig/takeOffRefPoint").text.split(",")[:2])
    home, config = (longitude, latitude), flown.find("missionConfig")
    points = [waypoint(placemark) for placemark in flown.findall("Folder/Placemark")]
    count = Count(pace)
    count.take_off(config, home, points[0])
    for k, point in enumerate(points):
        if k > 0:
            count.leg(points[k - 1], point)
        # The first and last are over home: the slowing down there belongs to climb and descent.
        if point["actions"] or 0 < k < len(points) - 1:
            count.stop(point)
    count.go_home(config, home, points[-1])
    return count.seconds, count.photos


def mission_of(folder, flight, flights):
    return folder / ("mission.kmz" if flights == 1 else f"mission_{flight + 1}.kmz")


def compare(folder):
    """For each flight the minutes that were planned and those that are commanded, and photos."""
    plan = json.loads((folder / "plan.json").read_text())
    if "pace" not in plan:
        raise SystemExit(f"{folder}/plan.json does not say how it is flown: plan again")
    photos = [0] * len(plan["flights"])
    for view in plan["views"]:
        photos[view["flight"]] += 1
    rows = []
    for i, flight in enumerate(plan["flights"]):
        seconds, taken = count_mission(mission_of(folder, i, len(photos)), plan["pace"])
        if taken != photos[i]:
            raise SystemExit(f"{folder}: flight {i} takes {taken} photos, planned are {photos[i]}")
        rows.append((flight["time_min"], seconds / 60, taken))
    return rows


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    worst = 0
    for folder in map(pathlib.Path, sys.argv[1:]):
        rows = compare(folder)
        off = [planned / commanded - 1 for planned, commanded, _ in rows]
        print(f"{folder}: {len(rows)} flights, {sum(r[2] for r in rows)} photos, planned "
              f"{sum(r[0] for r in rows):.1f} min, commanded {sum(r[1] for r in rows):.1f} min; "
              f"flights off by {100 * min(off):+.2f} to {100 * max(off):+.2f} %")
        worst = max([worst, *map(abs, off)])
    sys.exit(worst > MOST_OFF)


if __name__ == "__main__":
    main()
