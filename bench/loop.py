#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole loop in a made scene: plans, flies, reconstructs and measures it against truth.

  bench/loop.py OUT [--style hamlet] [--seed 1] [--method cocapture] [--scale 0.25]
                [--plan-args="--altitude 30"] [--fly-args="--rtk --held-out 5"] [--run-args "..."]
                [--exact-map] [--map-seed 1] [--gone 3] [--shift M] [--turn DEG]
                [--jitter M] [--eaves M] [--missing N] [--simpler N] [--smaller N]
                [--again plan|fly|map|run|evaluate] [--stucco PROGRAM]

The drone flies by the exact map; what is reconstructed goes by one with the errors of real ones
(perturb_plan.py) unless --exact-map. Scale is that of the camera's pixels: 0.25 gives photos a
quarter as wide. Printed are tables for docs/benchmarks.md: cost of the flight, poses and surfaces,
pictures, and time. OUT/figures has all figures as JSON, OUT/logs what each step printed and cost. A
step that is finished is not run again with the same words, but with --again from that step on; one
that was stopped goes on. Times with a ≥ are of such a step, after it went on.
"""
import argparse
import json
import pathlib
import shlex
import shutil
import sys

import steps
import surveys

BENCH = pathlib.Path(__file__).parent
STEPS = ("plan", "fly", "map", "run", "evaluate")
MAP_ERRORS = ("shift", "turn", "jitter", "eaves", "corners", "missing", "simpler", "smaller")
FLIGHT = ["scene", "method", "photos", "hovers", "length (m)", "time (min)", "battery (%)",
          "Q_s", "Q_d", "Q_u", "Q_c"]
GEOMETRY = ["scene", "method", "posed", "position (mm)", "rotation (deg)", "georeferenced (m)",
            "cloud error (m)", "complete: seen", "all", "its walls: seen", "model error (m)",
            "complete: seen", "all", "its walls (m)", "of seen (m)", "complete: seen", "watertight",
            "facets / truth", "of them on roofs", "ids"]
PICTURES = ["scene", "method", "painted", "SSIM", "one ideal photo", "on planes", "one ideal photo",
            "MS-SSIM", "PSNR", "GMSD", "FLIP", "LPIPS", "misregistration (px)", "(m)",
            "held out: compared", "SSIM", "PSNR", "FLIP"]
TIMES = ["scene", "method", "photos", "seconds", "plan", "fly", *surveys.STAGES, "evaluate", "all"]


def percent(value):
    return "-" if value is None else f"{100 * value:.1f} %"


def of_all(count, everything):
    return f"{count} / {everything}" if everything else "-"


def flight_cells(figures):
    plan = figures.get("plan") or {}
    return [plan.get("photos", "-"), plan.get("hovers", "-"),
            surveys.number(plan.get("length_m"), 0), surveys.number(plan.get("time_min"), 1),
            surveys.number(plan.get("battery_percent"), 0),
            *(surveys.number(plan.get(name)) for name in ("q_s", "q_d", "q_u", "q_c"))]


def geometry_cells(figures):
    """Cloud and model by their buildings: most of what is near them is ground."""
    poses, dense, proxy = figures["poses"], figures["dense"], figures["proxy"]
    position = poses["position_mean_m"]
    return [of_all(poses["posed"], poses["total"]),
            surveys.number(None if position is None else 1000 * position, 1),
            surveys.number(poses["rotation_mean_deg"], 4),
            surveys.number(poses["georeferenced_mean_m"]),
            surveys.number(dense["building_error95_m"], 3),
            percent(dense["building_completeness"]), percent(dense["building_completeness_all"]),
            percent(dense["wall_completeness"]),
            surveys.number(proxy["building_error95_m"], 3),
            percent(proxy["building_completeness"]), percent(proxy["building_completeness_all"]),
            surveys.number(proxy["wall_error95_m"], 3),
            surveys.number(proxy["wall_seen95_m"], 3), percent(proxy["wall_completeness"]),
            of_all(proxy["watertight"], proxy["truth_buildings"]),
            of_all(proxy["facets"], proxy["truth_facets"]),
            str(proxy["superstructure_facets"]), percent(proxy["facade_id_rate"])]


def picture_cells(figures):
    texture, views = figures["texture"], figures["views"]
    return [percent(texture["painted"]),
            *(surveys.number(figure, 3)
              for figure in (texture["ssim_mean"], texture["ceiling"]["ssim"],
                             texture["plane"]["ssim"], texture["plane"]["ceiling"]["ssim"])),
            *(surveys.number(texture[name + "_mean"], 2 if name == "psnr" else 3)
              for name in ("ms_ssim", "psnr", "gmsd", "flip", "lpips")),
            surveys.number(texture["misregistration_px"]),
            surveys.number(texture["misregistration_m"], 3), percent(views["compared"]),
            surveys.number(views["ssim_mean"], 3),
            surveys.number(views["psnr_mean"]), surveys.number(views["flip_mean"], 3)]


def total(costs, which):
    """Of steps or stages, as one cost; nothing where one of them is unknown."""
    known = [cost[which] for cost in costs if cost.get(which) is not None]
    return {which: sum(known) if costs and len(known) == len(costs) else None,
            "in_part": any(cost["in_part"] for cost in costs)}


def time_rows(figures):
    """Wall and CPU seconds. The planner's and the drone's are not those of the survey, whose stages
    add up to "all"."""
    costs, stages = figures["steps"], figures["stages"]
    photos = figures["poses"]["total"]
    return [[photos, label, *(surveys.seconds(costs.get(step), which) for step in ("plan", "fly")),
             *(surveys.seconds(stages.get(stage), which) for stage in surveys.STAGES),
             surveys.seconds(costs.get("evaluate"), which),
             surveys.seconds(total(list(stages.values()), which), which)]
            for label, which in (("wall", "wall_s"), ("CPU", "cpu_s"))]


def tables(flown):
    """Markdown for (scene, method, figures) of one or more loops."""
    kinds = ((FLIGHT, lambda f: [flight_cells(f)]), (GEOMETRY, lambda f: [geometry_cells(f)]),
             (PICTURES, lambda f: [picture_cells(f)]), (TIMES, time_rows))
    texts = [surveys.markdown_table(head, [[scene, method, *cells] for scene, method, figures in flown
                                           for cells in rows(figures)]) for head, rows in kinds]
    commits = dict.fromkeys(name for _, _, figures in flown for name in figures["commits"])
    if commits:
        texts.append("Commit " + ", ".join(commits) + ".")
    return "\n\n".join(texts)


def figures_of(survey, chain):
    """evaluation.json without its lists, and what all of it cost."""
    evaluation = json.loads((survey / "evaluation/evaluation.json").read_text())
    evaluation["texture"].pop("facades", None)
    evaluation["views"].pop("photos", None)
    return {"name": survey.name, **evaluation, "stages": surveys.stage_costs(survey),
            "steps": chain.costs(), "commits": chain.commits()}


def make_scene(program, folder, style, seed):
    """A scene folder OUT/STYLE-SEED, made unless it is there."""
    scene = folder / f"{style}-{seed}"
    if not (scene / "scene.json").exists():
        part = folder / f"{scene.name}.part"
        shutil.rmtree(part, ignore_errors=True)  # of one that was stopped
        chain = steps.Chain(folder / "logs", scene.name, ("city",), again="city")
        chain.run("city", [program, "simulate", "city", "-o", part, "--style", style,
                           "--seed", seed], part / "scene.json")
        part.rename(scene)
    return scene


def plan_command(program, scene, survey, method, args):
    terrain = scene / "terrain.tif"
    return [program, "plan", scene / "map.geojson", "-o", survey, "--method", method,
            *(["--terrain", terrain] if terrain.exists() else []), *args]


def add_flight_arguments(parser):
    """What every command that flies a made scene understands."""
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--style", default="hamlet")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scale", default="0.25")
    for step in ("plan", "fly", "run"):
        parser.add_argument(f"--{step}-args", type=shlex.split, default=[], metavar="WORDS")
    parser.add_argument("--stucco", default=str(surveys.PROGRAM))


def add_map_arguments(parser):
    """What is wrong with the map, as perturb_plan.py has it; what is not said is as it says."""
    parser.add_argument("--exact-map", action="store_true")
    parser.add_argument("--map-seed", default="1")
    parser.add_argument("--gone", default="3")
    for name in MAP_ERRORS:
        parser.add_argument(f"--{name}")


def map_command(arguments, plan):
    said = [(name, getattr(arguments, name)) for name in ("gone", *MAP_ERRORS)]
    return [sys.executable, "-B", BENCH / "perturb_plan.py", plan, "--seed", arguments.map_seed,
            *(word for name, value in said if value is not None for word in (f"--{name}", value))]


def add_loop_arguments(parser):
    """What every command that goes on with a loop understands."""
    add_flight_arguments(parser)
    add_map_arguments(parser)
    parser.add_argument("--again", choices=STEPS)


def fly(arguments, method):
    """One loop; its survey is OUT/STYLE-SEED-METHOD-SCALE, or with -exact after it. A run whose
    stages fail in part is measured as far as it came. Returns the scene's name and the figures."""
    program = arguments.stucco
    scene = make_scene(program, arguments.out, arguments.style, arguments.seed)
    exact = "-exact" if arguments.exact_map else ""
    survey = arguments.out / f"{scene.name}-{method}-{arguments.scale}{exact}"
    chain = steps.Chain(arguments.out / "logs", survey.name, STEPS, again=arguments.again)
    chain.run("plan", plan_command(program, scene, survey, method, arguments.plan_args),
              survey / "plan/plan.json")
    chain.run("fly", [program, "simulate", scene, survey, "-o", survey, "--scale", arguments.scale,
                      *arguments.fly_args], survey / "truth/flight.json", goes_on=True)
    if not arguments.exact_map:
        plan = survey / "plan/plan.json"
        chain.run("map", map_command(arguments, plan), plan)
    try:
        chain.run("run", [program, "run", survey, *arguments.run_args], survey / ".stucco",
                  goes_on=True)
    except steps.Failed as failure:
        print(f"{survey.name}: {failure}", file=sys.stderr)
    chain.run("evaluate", [program, "evaluate", survey, "--truth", scene],
              survey / "evaluation/evaluation.json")
    figures = figures_of(survey, chain)
    steps.write_whole(arguments.out / f"figures/{survey.name}.json", json.dumps(figures) + "\n")
    return scene.name, figures


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    add_loop_arguments(parser)
    parser.add_argument("--method", default="cocapture")
    arguments = parser.parse_args()
    try:
        scene, figures = fly(arguments, arguments.method)
        print(tables([(scene, arguments.method, figures)]))
    except (OSError, steps.Failed) as error:
        sys.exit(f"loop: {error}")


if __name__ == "__main__":
    main()
