#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where photos lost what would have given them a pose, and which poses are wrong.

  bench/calib_loss.py SURVEY [--position M] [--rotation DEG]

SURVEY was calibrated. By the kind of photo that the plan has are printed how many have a pose and
the medians of what calib/photos.csv counts, then every photo without a pose. Where truth/ has true
poses (stucco simulate), every photo whose pose is farther off than the limits is printed too, and
how the errors compare with the standard deviations in calibration.json, and which photos are beyond
four. True and found frames are aligned by medians, which wrong poses do not move.
"""
import argparse
import csv
import json
import math
import pathlib
import statistics

import match_graph
import surveys

FIGURES = ("candidates", "raw_matches", "verified_pairs", "verified_matches", "used_pairs",
           "keypoints", "wall_keypoints", "coincident_keypoints", "points_seen", "observations")
FAR = 4  # standard deviations
LISTED = ("candidates", "raw_matches", "verified_pairs", "verified_matches", "used_pairs",
          "points_seen")


def product(p, q):
    """Hamilton's, of quaternions w x y z."""
    return (p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
            p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0])


def conjugate(q):
    return (q[0], -q[1], -q[2], -q[3])


def turned(q, v):
    return product(product(q, (0, *v)), conjugate(q))[1:]


def read_poses(model):
    """Name -> (cam_from_world rotation, centre) of a COLMAP text model."""
    poses = {}
    for row in match_graph.lines(model / "images.txt"):
        if len(row) != 10 or "." not in row[9]:
            continue
        numbers = [float(word) for word in row[1:8]]
        length = math.hypot(*numbers[:4])
        rotation = tuple(value / length for value in numbers[:4])
        centre = turned(conjugate(rotation), [-value for value in numbers[4:]])
        poses[row[9]] = (rotation, centre)
    return poses


def median_point(points):
    return [statistics.median(axis) for axis in zip(*points)]


def true_from_found(true, found):
    """Rotation, scale and translation between the frames."""
    names = sorted(true.keys() & found.keys())
    turns = [product(conjugate(true[name][0]), found[name][0]) for name in names]
    # One sign for q and -q: that of the middle one by its largest component.
    largest = max(range(4), key=lambda i: statistics.median(abs(turn[i]) for turn in turns))
    turns = [turn if turn[largest] > 0 else tuple(-value for value in turn) for turn in turns]
    middle = median_point(turns)
    length = math.hypot(*middle)
    rotation = tuple(value / length for value in middle)
    # Distances between photos far apart in the list: each photo is in two.
    others = names[len(names) // 2:] + names[:len(names) // 2]
    spread = [(math.dist(true[a][1], true[b][1]), math.dist(found[a][1], found[b][1]))
              for a, b in zip(names, others)]
    scale = statistics.median(a / b for a, b in spread if b > 0)
    shift = median_point([
        [a - scale * b for a, b in zip(true[name][1], turned(rotation, found[name][1]))]
        for name in names])
    return rotation, scale, shift


def pose_errors(true, found):
    """Name -> (metres, degrees)."""
    rotation, scale, shift = true_from_found(true, found)
    errors = {}
    for name in true.keys() & found.keys():
        place = [scale * a + b for a, b in zip(turned(rotation, found[name][1]), shift)]
        between = product(product(true[name][0], rotation), conjugate(found[name][0]))
        angle = 2 * math.atan2(math.hypot(*between[1:]), abs(between[0]))
        errors[name] = (math.dist(place, true[name][1]), math.degrees(angle))
    return errors


def kinds_of(survey):
    """By view id, where there is a plan."""
    path = survey / "plan/plan.json"
    if not path.exists():
        return {}
    return {view["id"]: view["kind"] for view in json.loads(path.read_text(encoding="utf-8"))["views"]}


def true_and_found(survey):
    """Poses; nothing without true ones."""
    truth = survey / "truth/sparse"
    if not (truth / "images.txt").exists():
        return None
    return read_poses(truth), read_poses(survey / "calib/sparse/0")


def errors_of(survey):
    """As pose_errors; nothing without true poses."""
    poses = true_and_found(survey)
    return None if poses is None else pose_errors(*poses)


def normalised(survey):
    """Name -> (error of the place, of the rotation) over their standard deviations, where
    calibration.json states these. Requires true poses."""
    poses = true_and_found(survey)
    errors, scale = pose_errors(*poses), true_from_found(*poses)[1]
    calibration = json.loads((survey / "calib/calibration.json").read_text(encoding="utf-8"))
    return {photo["path"]: (errors[photo["path"]][0] / scale / photo["position_sigma"],
                            errors[photo["path"]][1] / photo["rotation_sigma_deg"])
            for photo in calibration["photos"]
            if photo["path"] in errors and photo["position_sigma"] > 0}


def root_mean_square(values):
    return math.sqrt(statistics.fmean(value * value for value in values))


def print_normalised(ratios):
    rows = []
    for label, which in (("place", 0), ("rotation", 1)):
        values = [ratio[which] for ratio in ratios.values()]
        rows.append([label, *(surveys.number(figure(values)) for figure in
                              (root_mean_square, statistics.median, max)),
                     sum(value > FAR for value in values)])
    print("\nerrors over their standard deviations")
    print(surveys.markdown_table(["of the", "root mean square", "median", "largest", "above 4"],
                                 rows))


def wrong_poses(errors, limits):
    return {name: error for name, error in errors.items()
            if error[0] > limits.position or error[1] > limits.rotation}


def print_kinds(rows, wrong):
    table = []
    for kind in sorted({row["kind"] for row in rows}):
        of_kind = [row for row in rows if row["kind"] == kind]
        posed = sum(row["posed"] == "yes" for row in of_kind)
        off = "-" if wrong is None else sum(row["path"] in wrong for row in of_kind)
        medians = [surveys.number(statistics.median(int(row[name] or 0) for row in of_kind), 0)
                   for name in FIGURES]
        table.append([kind, len(of_kind), posed, off, *medians])
    head = [name.replace("_", " ") for name in FIGURES]
    print(surveys.markdown_table(["kind", "photos", "posed", "wrong", *head], table))


def print_list(title, rows, last):
    print(f"\n{title}: {len(rows)}")
    if rows:
        head = ["photo", "kind", *(name.replace("_", " ") for name in LISTED), "why"]
        print(surveys.markdown_table(head, [
            [row["path"], row["kind"], *(row[name] for name in LISTED), last(row)]
            for row in rows]))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("survey", type=pathlib.Path)
    parser.add_argument("--position", type=float, default=0.5, help="metres (0.5)")
    parser.add_argument("--rotation", type=float, default=2, help="degrees (2)")
    limits = parser.parse_args()
    kinds = kinds_of(limits.survey)
    with open(limits.survey / "calib/photos.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        row["kind"] = kinds.get(match_graph.view_of(row["path"]), "other")
    errors = errors_of(limits.survey)
    wrong = None if errors is None else wrong_poses(errors, limits)
    print_kinds(rows, wrong)
    print_list("without a pose", [row for row in rows if row["posed"] == "no"],
               lambda row: row["why"])
    if wrong is not None:
        print_list("posed wrongly", [row for row in rows if row["path"] in wrong],
                   lambda row: "{:.2f} m, {:.1f} degrees".format(*wrong[row["path"]]))
        ratios = normalised(limits.survey)
        if ratios:
            print_normalised(ratios)
            print_list("beyond four of them",
                       [row for row in rows if max(ratios.get(row["path"], (0,))) > FAR],
                       lambda row: "{:.3f} m, {:.2f} degrees; {:.1f} and {:.1f} deviations".format(
                           *errors[row["path"]], *ratios[row["path"]]))


if __name__ == "__main__":
    main()
