#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Textures of one survey with photos chosen in three ways, each beside what ideal photos reach.

  bench/texture_choice.py SURVEY SCENE OUT [--stucco PROGRAM] [--ground] [-- OPTIONS OF RUN]

SURVEY was flown in SCENE and has a model; it is only read. OUT/guided is textured as usual,
OUT/unguided without the plan (texture.guided=false), OUT/single with the best photo of each facet
alone, neither aligned, blended nor evened out, flat and with what stands in front, as programs do that
choose a photo for each triangle. Printed is a table: walls, photos on them and how many of these
were planned for them, the painted share, SSIM and its ceiling, PSNR, and SSIM and shift on the
walls' planes beside their ceilings. The ground is not painted without --ground.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys

import surveys

READ = ("calib", "dense", "ingest", "plan", "proxy", "truth", "survey.toml")
WAYS = {"guided": [], "unguided": ["texture.guided=false"],
        "single": ["texture.guided=false", "texture.max_candidates=1", "texture.occluders=false",
                   "texture.align=false", "texture.colour=false", "texture.blend=false",
                   "texture.relief=false"]}
HEAD = ("way", "walls", "photos on them", "planned", "painted", "SSIM", "ceiling", "PSNR (dB)",
        "SSIM on planes", "ceiling", "shift (m)", "ceiling", "SSIM on relief", "ceiling")


def copied(survey, to):
    """What texture reads, linked where that is possible; texture has to be made again."""
    shutil.rmtree(to, ignore_errors=True)
    to.mkdir(parents=True)
    for name in READ:
        source = survey / name
        if source.is_dir():
            shutil.copytree(source, to / name)
        elif source.exists():
            shutil.copy2(source, to / name)
    photos = survey / "photos"
    if photos.exists():
        (to / "photos").symlink_to(photos.resolve())
    for name in ("manifests", "made"):
        if (survey / ".stucco" / name).exists():
            shutil.copytree(survey / ".stucco" / name, to / ".stucco" / name)
    for stage in ("texture", "report"):
        (to / f".stucco/manifests/{stage}.json").unlink(missing_ok=True)


def row(way, survey):
    """A line of the table, from what texture and evaluate wrote."""
    figures = json.loads((survey / "evaluation/evaluation.json").read_text())["texture"]
    textures = json.loads((survey / "texture/textures.json").read_text())
    facets = {facet["id"]: facet for facet in textures["facets"]}
    walls = [facets[wall["facet"]] for wall in figures["facades"]
             if wall["facet"] in facets and facets[wall["facet"]]["photos"]]
    plane, relief, ceiling = figures["plane"], figures["relief"], figures["ceiling"]
    return (way, len(walls), sum(len(wall["photos"]) for wall in walls),
            sum(len(wall.get("planned_photos", [])) for wall in walls),
            f"{100 * figures['painted']:.1f} %",
            surveys.number(figures["ssim_mean"], 3), surveys.number(ceiling["ssim"], 3),
            surveys.number(figures["psnr_mean"], 1),
            surveys.number(plane["ssim"], 3), surveys.number(plane["ceiling"]["ssim"], 3),
            surveys.number(plane["shift_m"], 3), surveys.number(plane["ceiling"]["shift_m"], 3),
            surveys.number(relief["ssim"], 3), surveys.number(relief["ceiling"]["ssim"], 3))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    parser = argparse.ArgumentParser()
    parser.add_argument("survey", type=pathlib.Path)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--stucco", default=surveys.PROGRAM)
    parser.add_argument("--ground", action="store_true")
    wanted = surveys.parse(parser)
    rows = []
    for way, settings in WAYS.items():
        survey = wanted.out / way
        copied(wanted.survey, survey)
        settings = settings + ([] if wanted.ground else ["texture.ground=false"])
        options = [word for setting in settings for word in ("--set", setting)]
        subprocess.run([wanted.stucco, "run", survey, "--from", "texture", "--until", "texture",
                        *options, *wanted.args], check=True, stdout=sys.stderr)
        subprocess.run([wanted.stucco, "evaluate", survey, "--truth", wanted.scene], check=True,
                       stdout=sys.stderr)
        rows.append(row(way, survey))
    print(surveys.markdown_table(HEAD, rows))


if __name__ == "__main__":
    main()
