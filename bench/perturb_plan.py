#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gives the map in a plan the errors of real maps, so that a model that goes by it has to find them.

Usage: perturb_plan.py PLAN_JSON [--shift M] [--turn DEG] [--jitter 0.4] [--eaves 0.5]
                       [--corners 0]
                       [--gone N] [--missing N] [--simpler N] [--smaller N]
                       [--seed 1]

Rewrites plan.json in place and keeps the exact one beside it, as plan.exact.json, where it starts
from when it is called again: all buildings shifted and turned together, each shifted by itself (one
standard deviation), outlines moved outwards (eaves), each corner measured by itself (one standard
deviation), and N rectangles added that are not there; N
buildings that stand missing from it; N outlines drawn more simply, without one of their corners
that point inwards (an L becomes a rectangle), and N Ls without one of their wings. What is not said
is as real maps are: the shift 0.5 to 3 m, the turn half a degree (one standard deviation), a
twentieth of the buildings missing, a tenth of the outlines simpler (one at least), a tenth of the Ls
without a wing.
Views keep their places: only what the model goes by changes.
"""
import argparse
import json
import math
import os
import pathlib
import random


def outwards(ring, by):
    """The ring with every edge moved to its right by so many metres."""
    moved = []
    for i, corner in enumerate(ring):
        before, after = ring[i - 1], ring[(i + 1) % len(ring)]
        n = []
        for a, b in ((before, corner), (corner, after)):
            length = math.hypot(b[0] - a[0], b[1] - a[1])
            n.append(((b[1] - a[1]) / length, (a[0] - b[0]) / length))
        cross = n[0][0] * n[1][1] - n[0][1] * n[1][0]
        if abs(cross) < 0.1:
            step = (by * n[0][0], by * n[0][1])
        else:
            step = (by * (n[1][1] - n[0][1]) / cross, by * (n[0][0] - n[1][0]) / cross)
        moved.append([corner[0] + step[0], corner[1] + step[1]])
    return moved


def take_away(plan, facades):
    """Facades, by id, and what views were to show of them."""
    plan["facades"] = [f for f in plan["facades"] if f["id"] not in facades]
    for view in plan["views"]:
        view["facades"] = [f for f in view.get("facades", []) if f not in facades]
        view["targets"] = [t for t in view.get("targets", []) if t["facade"] not in facades]


def leave_out(plan, count, dice):
    """Buildings of which the map knows nothing."""
    names = sorted({f["building"] for f in plan["footprints"]})
    gone = set(dice.sample(names, min(count, len(names))))
    plan["footprints"] = [f for f in plan["footprints"] if f["building"] not in gone]
    take_away(plan, {f["id"] for f in plan["facades"] if f["id"].split("/")[0] in gone})
    return gone


def cross(a, b, c):
    return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])


def facades_on(plan, building, edges):
    """Ids of the building's facades that are one of these edges."""
    return {f["id"] for f in plan["facades"] if f["id"].split("/")[0] == building
            and any(math.dist(f["a_m"], a) < 0.1 and math.dist(f["b_m"], b) < 0.1
                    for a, b in edges)}


def move_ends(plan, building, places, to):
    """Facades of the building that end at one of the places end somewhere else."""
    for facade in plan["facades"]:
        for end in ("a_m", "b_m"):
            near = min(math.dist(facade[end], place) for place in places) < 0.1
            if near and facade["id"].split("/")[0] == building:
                facade[end] = to


def inward_corner(ring):
    """Index of a corner that points inwards, or nothing."""
    for i, corner in enumerate(ring):
        if len(ring) >= 6 and cross(ring[i - 1], corner, ring[(i + 1) % len(ring)]) < -1:
            return i
    return None


def simplify(plan, footprint):
    """Fills one corner that points inwards to a parallelogram; False where there is none."""
    ring, name = footprint["rings_m"][0], footprint["building"]
    i = inward_corner(ring)
    if i is None:
        return False
    before, corner, after = ring[i - 1], ring[i], ring[(i + 1) % len(ring)]
    filled = [before[k] + after[k] - corner[k] for k in (0, 1)]
    take_away(plan, facades_on(plan, name, [(before, corner), (corner, after)]))
    move_ends(plan, name, (before, after), filled)
    footprint["rings_m"][0] = [filled if p is corner else p for p in ring
                               if p is not before and p is not after]
    return True


def cut_wing(plan, footprint):
    """Takes away the wing behind a corner that points inwards; False where it is no L."""
    ring, name = footprint["rings_m"][0], footprint["building"]
    i = inward_corner(ring)
    if i is None or len(ring) != 6:
        return False
    before, corner, second, third, last = (ring[(i + k) % 6] for k in range(-1, 4))
    # Where the edge before the corner, drawn on, meets the far side of the wing.
    along = [corner[k] - before[k] for k in (0, 1)]
    side = [last[k] - third[k] for k in (0, 1)]
    t = ((third[0] - corner[0]) * side[1] - (third[1] - corner[1]) * side[0]) / (
        along[0] * side[1] - along[1] * side[0])
    end = [corner[k] + t * along[k] for k in (0, 1)]
    take_away(plan, facades_on(plan, name, [(corner, second), (second, third)]))
    move_ends(plan, name, (corner, third), end)
    footprint["rings_m"][0] = [end if p is third else p for p in ring
                               if p is not corner and p is not second]
    return True


def redraw(plan, count, draw, what):
    """Draws so many footprints again, and says where there are fewer that can be."""
    drawn = 0
    for footprint in plan["footprints"]:
        if drawn < count:
            drawn += draw(plan, footprint)
    if drawn < count:
        print(f"only {drawn} outlines {what}")


def fill_in(wanted, plan):
    """What was not asked for, as real maps have it."""
    dice = random.Random(f"as real maps {wanted.seed}")  # the other dice fall as they did
    shift, turn = dice.uniform(0.5, 3), dice.gauss(0, 0.5)
    ls = sum(inward_corner(f["rings_m"][0]) is not None and len(f["rings_m"][0]) == 6
             for f in plan["footprints"])
    buildings = len({f["building"] for f in plan["footprints"]})
    for name, value in (("shift", round(shift, 2)), ("turn", round(turn, 2)),
                        ("missing", round(buildings / 20)), ("simpler", max(1, round(ls / 10))),
                        ("smaller", round(ls / 10))):
        if getattr(wanted, name) is None:
            setattr(wanted, name, value)


def exact_plan(path):
    """The plan as it was made, which is kept beside the one with errors."""
    kept = path.with_suffix(".exact.json")
    plan = json.loads(path.read_text())
    if "map_errors" in plan:
        return json.loads(kept.read_text())
    scratch = kept.with_suffix(".new")
    scratch.write_text(json.dumps(plan))
    os.replace(scratch, kept)
    return plan


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("plan", type=pathlib.Path)
    for name, value in (("shift", None), ("turn", None), ("jitter", 0.4), ("eaves", 0.5),
                        ("corners", 0.0)):
        parser.add_argument(f"--{name}", type=float, default=value)
    for name, value in (("gone", 0), ("missing", None), ("simpler", None), ("smaller", None)):
        parser.add_argument(f"--{name}", type=int, default=value)
    parser.add_argument("--seed", type=int, default=1)
    wanted = parser.parse_args()
    dice = random.Random(wanted.seed)
    plan = exact_plan(wanted.plan)
    fill_in(wanted, plan)
    plan["map_errors"] = {name: value for name, value in vars(wanted).items() if name != "plan"}
    missing = leave_out(plan, wanted.missing, dice) if wanted.missing else set()
    redraw(plan, wanted.simpler, simplify, "have corners that point inwards")
    redraw(plan, wanted.smaller, cut_wing, "are an L")
    if missing:
        print("missing:", ", ".join(sorted(missing)))
    angle = dice.uniform(0, 2 * math.pi)
    shift = (wanted.shift * math.cos(angle), wanted.shift * math.sin(angle))
    turn = math.radians(wanted.turn)

    def common(p, own):
        return [round(math.cos(turn) * p[0] - math.sin(turn) * p[1] + shift[0] + own[0], 3),
                round(math.sin(turn) * p[0] + math.cos(turn) * p[1] + shift[1] + own[1], 3)]

    measured = random.Random(f"corners {wanted.seed}")  # the other dice fall as they did

    def off(p):
        return [c + (measured.gauss(0, wanted.corners) if wanted.corners else 0) for c in p]

    corners = {}  # of a building: where each corner went
    for footprint in plan["footprints"]:
        own = (dice.gauss(0, wanted.jitter), dice.gauss(0, wanted.jitter))
        table = corners.setdefault(footprint["building"], [])
        for r, ring in enumerate(footprint["rings_m"]):
            moved = [common(off(p), own) for p in outwards(ring, wanted.eaves)]
            table += zip(ring, moved)
            footprint["rings_m"][r] = moved
    for facade in plan["facades"]:
        table = corners[facade["id"].split("/")[0]]
        for end in ("a_m", "b_m"):
            facade[end] = min(table, key=lambda pair: math.dist(pair[0], facade[end]))[1]
        facade["unobservable_m"] = []  # of the wall as it was
    lengths = {f["id"]: math.dist(f["a_m"], f["b_m"]) for f in plan["facades"]}
    for view in plan["views"]:
        for target in view.get("targets", []):
            length = lengths[target["facade"]]
            target["along_m"] = [min(along, length) for along in target["along_m"]]
    xs = [p[0] for f in plan["footprints"] for p in f["rings_m"][0]]
    ys = [p[1] for f in plan["footprints"] for p in f["rings_m"][0]]
    boxes = [(min(p[0] for p in f["rings_m"][0]), min(p[1] for p in f["rings_m"][0]),
              max(p[0] for p in f["rings_m"][0]), max(p[1] for p in f["rings_m"][0]))
             for f in plan["footprints"]]
    added = 0
    for _ in range(10000 if boxes else 0):
        if added == wanted.gone:
            break
        x, y = dice.uniform(min(xs), max(xs) - 6), dice.uniform(min(ys), max(ys) - 5)
        if any(x < b[2] + 2 and x + 6 > b[0] - 2 and y < b[3] + 2 and y + 5 > b[1] - 2
               for b in boxes):
            continue
        boxes.append((x, y, x + 6, y + 5))
        added += 1
        ring = [[x, y], [x + 6, y], [x + 6, y + 5], [x, y + 5]]
        name = f"B09{added:02}"
        plan["footprints"].append({"building": name, "z_m": [0.0, 5.0], "blocked_to_m": 15.0,
                                   "rings_m": [[[round(c, 3) for c in p] for p in ring]]})
    scratch = wanted.plan.with_suffix(".new")  # the old file may have other names
    scratch.write_text(json.dumps(plan))
    os.replace(scratch, wanted.plan)


if __name__ == "__main__":
    main()
