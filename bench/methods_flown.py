#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The three planning methods flown in the same scenes and reconstructed by the same pipeline.

  bench/methods_flown.py OUT [--style hamlet] [--seeds 1] [--scale 0.25] [--methods ...]
                         [--plan-args ...] [--fly-args ...] [--run-args ...] [--stucco PROGRAM]

Prints the tables of the paper (Xiong et al., "Aerial Path Planning for Urban Geometry and Texture
Co-Capture", 2025): what flying costs with what the cloud and the model are worth (its table 2), and
what the textures are worth (its tables 3 and 4). Completeness is of everything, seen or not, so that
no method gains by photos that show less. What OUT already has is not made again.
"""
import argparse
import sys

import loop
import surveys

METHODS = ("oblique", "dronescan", "cocapture")
GEOMETRY = ["scene", "method", "photos", "hovers", "length (m)", "time (min)", "cloud error (m)",
            "cloud complete", "model error (m)", "model complete", "walls (m)", "ids"]
TEXTURE = ["scene", "method", "photos", "SSIM", "MS-SSIM", "PSNR", "GMSD", "FLIP", "LPIPS",
           "misregistration (px)", "held out SSIM", "held out PSNR"]


def geometry_row(scene, method, figures):
    plan, dense, proxy = figures.get("plan") or {}, figures["dense"], figures["proxy"]
    return [scene, method, plan.get("photos", "-"), plan.get("hovers", "-"),
            surveys.number(plan.get("length_m"), 0), surveys.number(plan.get("time_min"), 1),
            surveys.number(dense["error95_m"], 3), loop.percent(dense["completeness_all"]),
            surveys.number(proxy["error95_m"], 3), loop.percent(proxy["completeness_all"]),
            surveys.number(proxy["wall_error95_m"], 3), loop.percent(proxy["facade_id_rate"])]


def texture_row(scene, method, figures):
    plan, texture, views = figures.get("plan") or {}, figures["texture"], figures["views"]
    return [scene, method, plan.get("photos", "-"),
            *(surveys.number(texture[name + "_mean"], 2 if name == "psnr" else 3)
              for name in ("ssim", "ms_ssim", "psnr", "gmsd", "flip", "lpips")),
            surveys.number(texture["misregistration_px"]),
            surveys.number(views["ssim_mean"], 3), surveys.number(views["psnr_mean"])]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    loop.add_loop_arguments(parser)
    parser.add_argument("--seeds", type=int, nargs="+")
    parser.add_argument("--methods", nargs="+", default=METHODS)
    arguments = parser.parse_args()
    geometry, texture = [], []
    for arguments.seed in arguments.seeds or [arguments.seed]:
        for method in arguments.methods:
            try:
                scene, figures = loop.fly(arguments, method)
            except (OSError, surveys.Failed) as error:  # the other methods still count
                print(f"methods_flown: {error}", file=sys.stderr)
                continue
            geometry.append(geometry_row(scene, method, figures))
            texture.append(texture_row(scene, method, figures))
    print(surveys.markdown_table(GEOMETRY, geometry))
    print()
    print(surveys.markdown_table(TEXTURE, texture))
    return 0 if len(geometry) == len(arguments.methods) * len(arguments.seeds or [0]) else 1


if __name__ == "__main__":
    sys.exit(main())
