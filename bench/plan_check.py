#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks a plan.json by its own numbers, with exact arithmetic and none of Stucco's code.

  bench/plan_check.py PLAN.json [--samples N]

Safety: every view and every leg of every flight keeps d_min from every footprint below the height
up to which that is blocked, and stays outside no-fly polygons. Completeness: N random points
between the buildings are tried, and every wall point that one of them sees within d_max and 75
degrees has to be in the target of a view. Exit code 1 when anything is wrong.
"""
import argparse
import json
import math
import pathlib
import random
import sys
from fractions import Fraction


def exact(point):
    """Millimetres, as they stand in the file."""
    return tuple(Fraction(round(value * 1000)) for value in point)


def squared_distance(p, q, a, b):
    """Between two segments that do not cross."""
    return min(point_segment(p, a, b), point_segment(q, a, b), point_segment(a, p, q),
               point_segment(b, p, q))


def point_segment(p, a, b):
    d = (b[0] - a[0], b[1] - a[1])
    length = d[0] * d[0] + d[1] * d[1]
    t = Fraction(0)
    if length:
        t = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / length
        t = max(Fraction(0), min(Fraction(1), t))
    x, y = a[0] + t * d[0] - p[0], a[1] + t * d[1] - p[1]
    return x * x + y * y


def side(a, b, c):
    value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (value > 0) - (value < 0)


def cross(p, q, a, b):
    return side(p, q, a) * side(p, q, b) <= 0 and side(a, b, p) * side(a, b, q) <= 0 and p != q


def edges(rings):
    for ring in rings:
        yield from zip(ring, ring[1:] + ring[:1])


def inside(p, rings):
    result = False
    for a, b in edges(rings):
        if (a[1] > p[1]) != (b[1] > p[1]):
            if p[0] < a[0] + (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1]):
                result = not result
    return result


def is_near(p, q, rings, limit):
    """Whether the segment comes nearer than `limit` to the polygon."""
    if inside(p, rings):
        return True
    low = [min(p[i], q[i]) - limit for i in (0, 1)]
    high = [max(p[i], q[i]) + limit for i in (0, 1)]
    for a, b in edges(rings):
        if any(max(a[i], b[i]) < low[i] or min(a[i], b[i]) > high[i] for i in (0, 1)):
            continue
        if cross(p, q, a, b) or squared_distance(p, q, a, b) < limit * limit:
            return True
    return False


def below(p, q, height):
    """The part of the segment that is lower than `height`, or None."""
    if p[2] >= height and q[2] >= height:
        return None
    if p[2] > height or q[2] > height:
        t = (height - p[2]) / (q[2] - p[2])
        middle = tuple(p[i] + t * (q[i] - p[i]) for i in range(3))
        return (middle, q) if p[2] > height else (p, middle)
    return p, q


def unsafe_segments(plan, segments):
    limit = Fraction(round(plan["d_min_m"] * 1000))
    footprints = [([[exact(c) for c in ring] for ring in f["rings_m"]],
                   Fraction(round(f.get("blocked_to_m", math.inf) * 1000))
                   if math.isfinite(f.get("blocked_to_m", math.inf)) else Fraction(10**9))
                  for f in plan["footprints"]]
    no_fly = [[exact(c) for c in ring] for ring in plan.get("no_fly_m", [])]
    boxes = [tuple(f(c[i] for ring in rings for c in ring) for i in (0, 1) for f in (min, max))
             for rings, _ in footprints]
    found = []
    for name, p, q in segments:
        p, q = exact(p), exact(q)
        for (rings, height), box in zip(footprints, boxes):
            if (max(p[0], q[0]) < box[0] - limit or min(p[0], q[0]) > box[1] + limit
                    or max(p[1], q[1]) < box[2] - limit or min(p[1], q[1]) > box[3] + limit):
                continue
            part = below(p, q, height)
            if part and is_near(part[0][:2], part[1][:2], rings, limit):
                found.append(f"{name}: nearer than {plan['d_min_m']} m to a footprint")
        if no_fly and (inside(p[:2], no_fly)
                       or any(cross(p[:2], q[:2], a, b) for a, b in edges(no_fly))):
            found.append(f"{name}: in a no-fly polygon")
    return found


def all_segments(plan):
    for view in plan["views"]:
        yield view["id"], view["position_m"], view["position_m"]
    for i, flight in enumerate(plan.get("flights", [])):
        points = [w["position_m"] for w in flight["waypoints"]]
        for k, (p, q) in enumerate(zip(points, points[1:])):
            yield f"flight {i} leg {k}", p, q


def unseen_parts(plan, samples, seed=1):
    """Wall points that random allowed points see and no view is meant for. In floating point: a
    point within a decimetre of an end of a target is not counted."""
    source = random.Random(seed)
    walls = [edge for f in plan["footprints"] for edge in edges(f["rings_m"])]
    xs = [c[0] for w in walls for c in w]
    ys = [c[1] for w in walls for c in w]
    targets = {}
    for view in plan["views"]:
        for target in view.get("targets", []):
            if view["kind"] in ("dipping", "dipping_foot"):
                targets.setdefault(target["facade"], []).append(target["along_m"])
    reach, tested, missed = plan["d_max_m"], 0, []
    for _ in range(samples):
        p = (source.uniform(min(xs) - 30, max(xs) + 30), source.uniform(min(ys) - 30, max(ys) + 30))
        exact_p = exact(p)
        if any(is_near(exact_p, exact_p, [[exact(c) for c in r] for r in f["rings_m"]],
                       Fraction(round(plan["d_min_m"] * 1000) + 50)) for f in plan["footprints"]):
            continue
        near = [w for w in walls if point_segment_float(p, *w) < reach]
        for facade in plan["facades"]:
            a, b = facade["a_m"], facade["b_m"]
            if point_segment_float(p, a, b) > reach:
                continue
            length = math.dist(a, b)
            along = source.uniform(0, length)
            u = ((b[0] - a[0]) / length, (b[1] - a[1]) / length)
            x = (a[0] + u[0] * along, a[1] + u[1] * along)
            ray = (p[0] - x[0], p[1] - x[1])
            distance = math.hypot(*ray)
            front = (ray[0] * u[1] - ray[1] * u[0]) / distance
            if distance > reach - 0.1 or front < math.cos(math.radians(74.9)):
                continue
            start = (x[0] + ray[0] / distance * 0.02, x[1] + ray[1] / distance * 0.02)
            if any(crosses(start, p, *wall) for wall in near):
                continue
            tested += 1
            if not any(i[0] - 0.1 <= along <= i[1] + 0.1 for i in targets.get(facade["id"], [])):
                missed.append(f"{facade['id']} at {along:.2f} m, "
                              f"seen from ({p[0]:.2f}, {p[1]:.2f})")
    return tested, missed


def point_segment_float(p, a, b):
    d = (b[0] - a[0], b[1] - a[1])
    t = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / (d[0] * d[0] + d[1] * d[1])
    t = max(0, min(1, t))
    return math.hypot(a[0] + t * d[0] - p[0], a[1] + t * d[1] - p[1])


def crosses(p, q, a, b):
    return side(p, q, a) != side(p, q, b) and side(a, b, p) != side(a, b, q)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("plan", type=pathlib.Path)
    parser.add_argument("--samples", type=int, default=200)
    arguments = parser.parse_args()
    plan = json.loads(arguments.plan.read_text())
    segments = list(all_segments(plan))
    unsafe = unsafe_segments(plan, segments)
    print(f"{len(segments)} positions and legs, {len(unsafe)} unsafe")
    tested, missed = unseen_parts(plan, arguments.samples)
    print(f"{tested} wall points in sight of allowed points, {len(missed)} without a view")
    for line in (unsafe + missed)[:20]:
        print("  " + line)
    sys.exit(bool(unsafe or missed))


if __name__ == "__main__":
    main()
