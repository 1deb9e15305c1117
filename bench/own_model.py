#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A model of another program, painted: the true facets of a made scene as an OBJ file.

  bench/own_model.py SURVEY SCENE OUT [--east 2.3] [--north -1.7] [--up 44.2] [--turn 0.4]
                     [--stucco PROGRAM] [-- OPTIONS OF RUN]

SURVEY was flown in SCENE and is evaluated; it is only read. The model is moved by metres and turned,
imported into OUT/survey with --fit, painted and measured. Printed is a table of it beside the survey's
own model: how far the model is off, facets, closed buildings, and what its pictures are like beside
what one ideal photo shows.
"""
import argparse
import json
import math
import pathlib
import shutil
import subprocess
import sys

import surveys
import texture_choice

HEAD = ("model", "error (m)", "its walls (m)", "facets / truth", "of them on roofs", "closed", "ids", "painted", "SSIM",
        "ceiling", "on planes", "ceiling", "shift (m)")


def corners_of(scene):
    """The rings of the true facets of buildings, in the world of the scene."""
    truth = json.loads((scene / "truth/facets.json").read_text())
    return [facet["outer"] for building in truth["buildings"] for facet in building["facets"]
            if building["id"] != "G0" and not facet["holes"]]


def write_obj(rings, move, path):
    """One face for each ring."""
    lines = []
    count = 0
    for ring in rings:
        lines += ["v {:.6f} {:.6f} {:.6f}".format(*move(corner)) for corner in ring]
        lines.append("f " + " ".join(str(count + 1 + i) for i in range(len(ring))))
        count += len(ring)
    path.write_text("\n".join(lines) + "\n")


def mover(rings, wanted):
    """Turns about the middle of all corners, then shifts."""
    all_corners = [corner for ring in rings for corner in ring]
    middle = [sum(corner[i] for corner in all_corners) / len(all_corners) for i in range(2)]
    c, s = math.cos(math.radians(wanted.turn)), math.sin(math.radians(wanted.turn))

    def move(corner):
        x, y = corner[0] - middle[0], corner[1] - middle[1]
        return (middle[0] + c * x - s * y + wanted.east, middle[1] + s * x + c * y + wanted.north,
                corner[2] + wanted.up)
    return move


def row(name, survey):
    figures = json.loads((survey / "evaluation/evaluation.json").read_text())
    proxy, texture = figures["proxy"], figures["texture"]
    plane = texture["plane"]
    return (name, surveys.number(proxy["building_error95_m"], 3),
            surveys.number(proxy["wall_error95_m"], 3),
            f"{proxy['facets']} / {proxy['truth_facets']}", str(proxy["superstructure_facets"]),
            f"{proxy['watertight']} of {proxy['truth_buildings']}",
            f"{100 * proxy['facade_id_rate']:.1f} %", f"{100 * texture['painted']:.1f} %",
            surveys.number(texture["ssim_mean"], 3),
            surveys.number(texture["ceiling"]["ssim"], 3), surveys.number(plane["ssim"], 3),
            surveys.number(plane["ceiling"]["ssim"], 3), surveys.number(plane["shift_m"], 3))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    parser = argparse.ArgumentParser()
    parser.add_argument("survey", type=pathlib.Path)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--stucco", default=surveys.PROGRAM)
    parser.add_argument("--east", type=float, default=2.3)
    parser.add_argument("--north", type=float, default=-1.7)
    parser.add_argument("--up", type=float, default=44.2)
    parser.add_argument("--turn", type=float, default=0.4)
    wanted = surveys.parse(parser)
    rings = corners_of(wanted.scene)
    survey = wanted.out / "survey"
    texture_choice.copied(wanted.survey, survey)
    shutil.rmtree(survey / "proxy", ignore_errors=True)
    model = wanted.out / "true.obj"
    write_obj(rings, mover(rings, wanted), model)
    for words in (["import", survey, model, "--fit"],
                  ["run", survey, "--from", "texture", "--until", "texture", *wanted.args],
                  ["evaluate", survey, "--truth", wanted.scene]):
        subprocess.run([wanted.stucco, *words], check=True, stdout=sys.stderr)
    print(surveys.markdown_table(HEAD, [row("true facets, imported", survey),
                                        row("own", wanted.survey)]))


if __name__ == "__main__":
    main()
