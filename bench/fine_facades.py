#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What it costs to paint facades finely from full photos, and what the pictures are like.

  bench/fine_facades.py OUT [--style block] [--seed 4] [--facades 20] [--photos 60] [--texel 0.01]
                        [--scale 1] [--threads 2 1] [--stucco PROGRAM] [-- OPTIONS OF PLAN]

The largest facades of a made scene that its plan has photos for are flown with the planner's own
camera (20 megapixels at scale 1) and painted from true poses onto true walls, which are imported with
a cloud sampled on them: what is measured is the texture stage alone. Printed are its wall and CPU
seconds and its memory for each number of threads, and the pictures beside what one ideal photo shows.
"""
import argparse
import json
import pathlib
import shutil
import subprocess

import ladder
import own_model
import surveys

SPACING_M = 0.25  # of the cloud on walls
COSTS = ("threads", "wall s", "CPU s", "memory (MiB)")
PICTURES = ("facades", "photos", "texels (millions)", "painted", "SSIM", "ceiling", "on planes",
            "ceiling", "shift (m)", "on relief")


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def scaled(a, factor):
    return [x * factor for x in a]


def unit(a):
    return scaled(a, 1 / dot(a, a) ** 0.5)


def normal_of(ring):
    """Newell's method: of a ring that is counter-clockwise from outside."""
    total = [0, 0, 0]
    for a, b in zip(ring, ring[1:] + ring[:1]):
        total = [t + c for t, c in zip(total, cross(a, b))]
    return unit(total)


def holds(ring, x, y):
    inside = False
    for (x1, y1), (x2, y2) in zip(ring, ring[1:] + ring[:1]):
        if (y1 > y) != (y2 > y) and x < x1 + (y - y1) * (x2 - x1) / (y2 - y1):
            inside = not inside
    return inside


def samples(ring):
    """Points on a flat ring, on a grid along its first edge."""
    normal = normal_of(ring)
    along = unit(minus(ring[1], ring[0]))
    up = cross(normal, along)
    flat = [(dot(minus(p, ring[0]), along), dot(minus(p, ring[0]), up)) for p in ring]
    x0, y0 = (min(p[i] for p in flat) for i in range(2))
    x1, y1 = (max(p[i] for p in flat) for i in range(2))
    for i in range(int((x1 - x0) / SPACING_M)):
        for j in range(int((y1 - y0) / SPACING_M)):
            x, y = x0 + (i + 0.5) * SPACING_M, y0 + (j + 0.5) * SPACING_M
            if holds(flat, x, y):
                yield [o + x * a + y * u for o, a, u in zip(ring[0], along, up)], normal


def write_cloud(rings, path):
    points = [sample for ring in rings for sample in samples(ring)]
    names = "\n".join(f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz"))
    lines = [" ".join(f"{v:.4f}" for v in position + normal) for position, normal in points]
    path.write_text(f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n{names}\nend_header\n" +
                    "\n".join(lines) + "\n")


def largest_facades(plan, count):
    """Ids of those that photos are planned for."""
    def area(facade):
        length = dot(*[minus(facade["b_m"], facade["a_m"])] * 2) ** 0.5
        return length * (facade["z_m"][1] - facade["z_m"][0])
    seen = [facade for facade in plan["facades"] if facade["views"]]
    return [facade["id"] for facade in sorted(seen, key=area, reverse=True)[:count]]


def paint(program, survey, texel, threads):
    """Costs of the texture stage."""
    shutil.rmtree(survey / "texture", ignore_errors=True)
    shutil.rmtree(survey / ".stucco/units/texture", ignore_errors=True)
    subprocess.run([program, "run", survey, "--from", "texture", "--until", "texture", "--threads",
                    str(threads), "--set", f"texture.texel_size={texel}", "--set",
                    "texture.ground=false"], check=True)
    return surveys.stage_costs(survey)["texture"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--style", default="block")
    parser.add_argument("--seed", type=int, default=4)
    parser.add_argument("--facades", type=int, default=20)
    parser.add_argument("--photos", type=int, default=60)
    parser.add_argument("--texel", type=float, default=0.01)
    parser.add_argument("--scale", type=float, default=1)
    parser.add_argument("--threads", type=int, nargs="+", default=[2, 1])
    parser.add_argument("--stucco", default=surveys.PROGRAM)
    wanted = surveys.parse(parser)
    scene, survey = wanted.out / "scene", wanted.out / "survey"

    def stucco(*words):
        subprocess.run([wanted.stucco, *map(str, words)], check=True)

    if not (survey / "truth/sparse").exists():
        stucco("simulate", "city", "-o", scene, "--style", wanted.style, "--seed", wanted.seed)
        stucco("plan", scene / "map.geojson", "-o", survey, "--gsd", wanted.texel, *wanted.args)
        plan = json.loads((survey / "plan/plan.json").read_text())
        stucco("simulate", scene, survey, "-o", survey, "--scale", wanted.scale, "--most-photos",
               wanted.photos, "--facades", ",".join(largest_facades(plan, wanted.facades)))
    rings = own_model.corners_of(scene)
    own_model.write_obj(rings, lambda corner: corner, wanted.out / "walls.obj")
    write_cloud([ring for ring in rings if abs(normal_of(ring)[2]) < 0.1], wanted.out / "walls.ply")
    for folder in ("calib", "dense", "proxy"):
        shutil.rmtree(survey / folder, ignore_errors=True)
    (survey / "calib/sparse").mkdir(parents=True)
    ladder.true_poses(survey)
    stucco("import", survey, wanted.out / "walls.ply")
    stucco("import", survey, wanted.out / "walls.obj", "--no-fit")
    costs = [(threads, paint(wanted.stucco, survey, wanted.texel, threads))
             for threads in wanted.threads]
    stucco("evaluate", survey, "--truth", scene)
    figures = json.loads((survey / "evaluation/evaluation.json").read_text())["texture"]
    textures = json.loads((survey / "texture/textures.json").read_text())["facets"]
    painted = [t for t in textures if t.get("photos")]
    texels = sum(t["width_px"] * t["height_px"] for t in painted)
    plane, relief = figures["plane"], figures["relief"]
    print(surveys.markdown_table(COSTS, [(threads, surveys.number(cost["wall_s"], 0),
                                 surveys.number(cost["cpu_s"], 0),
                                 surveys.number(cost["peak_memory_mb"], 0))
                                for threads, cost in costs]))
    print(surveys.markdown_table(PICTURES, [(
        len(painted), len({name for t in painted for name in t["photos"]}),
        surveys.number(texels / 1e6, 1), f"{100 * figures['painted']:.1f} %",
        surveys.number(figures["ssim_mean"], 3), surveys.number(figures["ceiling"]["ssim"], 3),
        surveys.number(plane["ssim"], 3), surveys.number(plane["ceiling"]["ssim"], 3),
        surveys.number(plane["shift_m"], 3), surveys.number(relief["ssim"], 3))]))


if __name__ == "__main__":
    main()
