#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Calibrates a simulated flight again and again, each time with another fault in what it recorded.

  bench/record_errors.py FLIGHT SCENE OUT [--only NAME ...] [--stucco PROGRAM] [-- OPTIONS OF RUN]

FLIGHT is a survey that `stucco simulate` flew in SCENE and of which ingest was run; it is only
read. For each fault OUT/NAME gets copies of its photos with changed metadata (Exiv2's program is
needed, apt-get install exiv2), its plan and its truth, and is calibrated and evaluated. Printed is
a table: photos with a pose, how many of these are wrong (--position, --rotation), errors of positions
after alignment by medians and, with rotations, as they stand in the world, what calib says of the
records, and the CPU time.
"""
import argparse
import concurrent.futures
import json
import math
import pathlib
import random
import shutil
import statistics
import subprocess
import sys

import calib_loss
import steps
import surveys

METRES_PER_DEGREE = 111320
ONE_STOREY_M = 3
DJI = "Xmp.drone-dji."
FIGURES = ("fault", "posed", "wrong", "position, median (mm)", "largest", "in the world (m)",
           "in the world (deg)", "CPU s", "what calib says of it")


class Record:
    """Position and gimbal angles of a photo, as ingest read them."""

    def __init__(self, photo):
        self.position = dict(photo["position"])
        self.gimbal = dict(photo["gimbal"])
        self.has_height = self.position.get("has_height", True)
        self.has_any = True

    def move(self, east, north, up):
        latitude = self.position["latitude_deg"]
        self.position["latitude_deg"] += north / METRES_PER_DEGREE
        self.position["longitude_deg"] += (
            east / METRES_PER_DEGREE / math.cos(math.radians(latitude)))
        self.position["height_m"] += up


def as_flown(records, _chance):
    return records


def gps_bias(records, _chance):
    for record in records:
        record.move(4, -3, 0)
    return records


def gps_noise(sigma):
    """Of every position anew: what photos say of where they are to each other is as rough."""
    def add(records, chance):
        for record in records:
            record.move(chance.gauss(0, sigma), chance.gauss(0, sigma), chance.gauss(0, sigma))
        return records
    return add


def gimbal_mount(records, _chance):
    for record in records:
        record.gimbal["pitch_deg"] += 3
    return records


def gimbal_noise(records, chance):
    for record in records:
        for angle in ("yaw_deg", "pitch_deg"):
            record.gimbal[angle] += chance.gauss(0, 3)
    return records


def compass(records, _chance):
    for record in records:
        record.gimbal["yaw_deg"] += 25
    return records


def wild_positions(records, chance):
    for record in records:
        direction = chance.uniform(0, 2 * math.pi)
        if chance.random() < 0.2:
            record.move(30 * math.sin(direction), 30 * math.cos(direction), 0)
    return records


def no_heights(records, _chance):
    for record in records:
        record.has_height = False
    return records


def no_metadata(records, _chance):
    for record in records:
        record.has_any = False
    return records


FAULTS = {"as-flown": as_flown, "gps-5m": gps_bias,
          "gps-noise-1m": gps_noise(1), "gps-noise-3m": gps_noise(3),
          "mount-3deg": gimbal_mount, "gimbal-noise-3deg": gimbal_noise, "compass-25deg": compass,
          "wild-20-percent": wild_positions, "map-3m": as_flown, "map-no-heights": as_flown,
          "no-heights": no_heights, "no-metadata": no_metadata}


def degrees(value):
    units = round(abs(value) * 3600 * 10000)
    minute = 60 * 10000
    return f"{units // (60 * minute)}/1 {units // minute % 60}/1 {units % minute}/10000"


def commands(record):
    """What Exiv2 has to change; heights that are not there are taken out everywhere."""
    position, gimbal = record.position, record.gimbal
    height = position["height_m"]
    lines = ["reg drone-dji http://www.dji.com/drone-dji/1.0/",
             f"set Exif.GPSInfo.GPSLatitude {degrees(position['latitude_deg'])}",
             f"set Exif.GPSInfo.GPSLongitude {degrees(position['longitude_deg'])}",
             f"set {DJI}GpsLatitude {position['latitude_deg']:+.9f}",
             f"set {DJI}GpsLongitude {position['longitude_deg']:+.9f}",
             f"set {DJI}GimbalYawDegree {math.remainder(gimbal['yaw_deg'], 360):+.2f}",
             f"set {DJI}GimbalPitchDegree {gimbal['pitch_deg']:+.2f}"]
    if record.has_height:
        return [*lines, f"set Exif.GPSInfo.GPSAltitude {round(abs(height) * 1000)}/1000",
                f"set Exif.GPSInfo.GPSAltitudeRef {int(height < 0)}",
                f"set {DJI}AbsoluteAltitude {height:+.3f}"]
    return [*lines, "del Exif.GPSInfo.GPSAltitude", "del Exif.GPSInfo.GPSAltitudeRef",
            f"del {DJI}AbsoluteAltitude", f"del {DJI}RelativeAltitude"]


def write_photo(source, target, record):
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, target)
    words = ["exiv2", "-d", "a", target]
    if record.has_any:
        words = ["exiv2", *(f"-M{line}" for line in commands(record)), target]
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)


def moved_map(plan, east, north):
    """The plan as if its map lay there: what is built moves, what is flown does not."""
    for footprint in plan["footprints"]:
        footprint["rings_m"] = [[[x + east, y + north] for x, y in ring]
                                for ring in footprint["rings_m"]]
    for facade in plan["facades"]:
        for end in ("a_m", "b_m"):
            facade[end] = [facade[end][0] + east, facade[end][1] + north]
    return plan


def map_without_heights(plan):
    """The plan as if nobody knew how high its buildings are: one storey is all that is sure."""
    for footprint in plan["footprints"]:
        footprint["z_m"][1] = footprint["z_m"][0] + ONE_STOREY_M
    for facade in plan["facades"]:
        facade["z_m"][1] = facade["z_m"][0] + ONE_STOREY_M
        facade["top_known"] = False
    return plan


MAPS = {"map-3m": lambda plan: moved_map(plan, 2.4, -1.8), "map-no-heights": map_without_heights}


def make_survey(flight, fault, survey):
    """A survey of the flight's photos with the fault in their metadata."""
    captures = json.loads((flight / "ingest/captures.json").read_text(encoding="utf-8"))
    photos = [photo for photo in captures["photos"] if photo["usable"]]
    records = FAULTS[fault]([Record(photo) for photo in photos], random.Random(1))
    part = survey.with_name(survey.name + ".part")
    shutil.rmtree(part, ignore_errors=True)
    with concurrent.futures.ThreadPoolExecutor() as pool:
        list(pool.map(lambda item: write_photo(flight / "photos" / item[0]["path"],
                                               part / "photos" / item[0]["path"], item[1]),
                      zip(photos, records)))
    shutil.copy(flight / "survey.toml", part)
    for folder in ("plan", "truth"):
        shutil.copytree(flight / folder, part / folder)
    if fault in MAPS:
        path = part / "plan/plan.json"
        plan = MAPS[fault](json.loads(path.read_text(encoding="utf-8")))
        path.write_text(json.dumps(plan), encoding="utf-8")
    part.rename(survey)


def findings(survey):
    """Sentences of calibration.json that name a cause, and how many records it does not believe."""
    calibration = json.loads((survey / "calib/calibration.json").read_text(encoding="utf-8"))
    outliers = sum(photo["prior_outlier"] for photo in calibration["photos"])
    texts = list(calibration["findings"])
    if outliers:
        texts.append(f"{outliers} positions not used")
    return "; ".join(texts) or "-"


def row(fault, survey, limits):
    poses = json.loads((survey / "evaluation/evaluation.json").read_text())["poses"]
    errors = calib_loss.errors_of(survey)
    wrong = calib_loss.wrong_poses(errors, limits)
    return [fault, f"{poses['posed']} / {poses['total']}", len(wrong),
            *(surveys.number(1000 * figure(error[0] for error in errors.values()), 1)
              for figure in (statistics.median, max)),
            surveys.number(poses["georeferenced_mean_m"]),
            surveys.number(poses["georeferenced_rotation_mean_deg"], 3),
            surveys.seconds(surveys.stage_costs(survey)["calib"], "cpu_s"), findings(survey)]


def calibrate(arguments, fault):
    survey = arguments.out / fault
    if not survey.exists():
        make_survey(arguments.flight, fault, survey)
    chain = steps.Chain(arguments.out / "logs", fault, ("run", "evaluate"))
    chain.run("run", [arguments.stucco, "run", survey, "--until", "calib", *arguments.args],
              survey / "calib/calibration.json", goes_on=True)
    chain.run("evaluate", [arguments.stucco, "evaluate", survey, "--truth", arguments.scene],
              survey / "evaluation/evaluation.json")
    return row(fault, survey, arguments)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    for name in ("flight", "scene", "out"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--only", nargs="+", choices=FAULTS, default=list(FAULTS))
    parser.add_argument("--position", type=float, default=0.1, help="a wrong pose, metres")
    parser.add_argument("--rotation", type=float, default=0.5, help="a wrong pose, degrees")
    parser.add_argument("--stucco", default=str(surveys.PROGRAM))
    arguments = surveys.parse(parser)
    rows = []
    for fault in arguments.only:
        try:
            rows.append(calibrate(arguments, fault))
        except (OSError, steps.Failed, subprocess.CalledProcessError) as error:
            print(f"record_errors: {fault}: {error}", file=sys.stderr)
    print(surveys.markdown_table(FIGURES, rows))


if __name__ == "__main__":
    main()
