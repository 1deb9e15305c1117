#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""New photos on a finished survey, in a made scene: what they cost, what they change and what not.

  bench/retexture.py OUT [--style hamlet] [--seed 1] [--foreign-seed 2] [--photos 10]
                     [--facades 3] [--plan-args "..."] [--run-args "..."] [--again STEP]
                     [--survey SURVEY]

Makes a scene, plans, flies and runs a first survey; makes the scene of a later day, of which one
facade is repainted and a car is elsewhere, and flies it in another light for that facade and some
others; then `stucco retexture`, with these photos and with photos of another town. Printed is a
table of what came out beside what should. OUT/figures has it as JSON, OUT/logs what each step
printed and cost. A step that is finished is not run again with the same words, but with --again
from that step on. With --survey the first survey is a copy of one that was flown in this scene and
run already.
"""
import argparse
import filecmp
import json
import pathlib
import shlex
import shutil
import sys

import loop
import steps
import surveys

STEPS = ("plan", "fly", "run", "later", "fly-later", "retexture", "evaluate",
         "evaluate-later", "foreign-plan", "foreign-fly", "foreign")
CAMERA = ["--camera", "17.3x13mm,12.29mm,1000x750", "--gsd", "0.05"]
LATER_LIGHT = ["--day-of-year", "200", "--start-hour", "15.5", "--exposure-ev", "-0.3",
               "--warmth", "0.06"]
MOST_OF_RUN = 0.1  # of its CPU time
HEAD = ["scene", "photos", "posed", "run (CPU s)", "retexture (CPU s)", "share", "repainted",
        "replaced", "filled", "kept", "with other bytes", "SSIM of it before", "after",
        "another town"]


def facades_to_fly(plan, repainted, count):
    """The repainted ones and those after them in the plan's list that views are planned for."""
    ids = [facade["id"] for facade in plan["facades"]]
    seen = {target for view in plan["views"] for target in view["facades"]}
    start = ids.index(repainted[0]) if repainted else 0
    others = [facade for facade in ids[start:] + ids[:start]
              if facade in seen and facade not in repainted]
    return [facade for facade in repainted if facade in seen] + others[:count - len(repainted)]


def files_of(facet):
    names = [facet.get(name) or "" for name in ("image", "label_image", "orthophoto")]
    if names[2]:
        names += [names[2].removesuffix(".png") + end for end in (".pgw", ".json")]
    return [name for name in names if name]


def other_bytes(first, epoch, kept):
    """Ids of facets that are said to be kept and of which a file is not the survey's."""
    facets = json.loads((first / "texture/textures.json").read_text())["facets"]
    return [facet["id"] for facet in facets if facet["id"] in kept and not all(
        (epoch / name).exists() and filecmp.cmp(first / "texture" / name, epoch / name, shallow=False)
        for name in files_of(facet))]


def figures_of(first, epoch, repainted, chain):
    result = json.loads((epoch / "retexture.json").read_text())
    facades = {facet["id"]: facet.get("facade") or facet["id"]
               for building in json.loads((first / "proxy/facets.json").read_text())["buildings"]
               for facet in building["facets"]}
    chosen = {choice: [facet["id"] for facet in result["facets"] if facet["choice"] == choice]
              for choice in ("kept", "replaced", "filled", "painted")}
    named = [facet["id"] for facet in result["facets"]
             if facet["choice"] == "replaced" and (facet["changed"]["repainted"] or 0) >= 0.1]
    run = loop.total(list(surveys.stage_costs(first).values()), "cpu_s")
    return {**chosen, "named": named,
            "is_named": sorted({facades[name] for name in named}) == sorted(repainted),
            "other_bytes": other_bytes(first, epoch, set(chosen["kept"])),
            "photos": len(result["photos"]),
            "posed": sum(photo["placed"] for photo in result["photos"]),
            "run": run, "cpu_s": chain.costs()["retexture"]["cpu_s"]}


def row(scene, repainted, f):
    share = f["cpu_s"] / f["run"]["cpu_s"]
    what = "named" if f["is_named"] else "named wrongly: " + (", ".join(f["named"]) or "none")
    return [scene, f["photos"], f["posed"], surveys.seconds(f["run"], "cpu_s"),
            surveys.number(f["cpu_s"], 1),
            f"{100 * share:.1f} %" + ("" if share < MOST_OF_RUN else " (too much)"),
            f"{', '.join(repainted) or 'none'}: {what}", ", ".join(f["replaced"]) or "-",
            ", ".join(f["filled"] + f["painted"]) or "-", len(f["kept"]),
            ", ".join(f["other_bytes"]) or "none", surveys.number(f["ssim_before"], 3),
            surveys.number(f["ssim_after"], 3), f["foreign"]]


def make_first(chain, arguments, scene, first):
    program = arguments.stucco
    chain.run("plan", loop.plan_command(program, scene, first, "cocapture",
                                        CAMERA + arguments.plan_args), first / "plan/plan.json")
    chain.run("fly", [program, "simulate", scene, first, "-o", first],
              first / "truth/flight.json", goes_on=True)
    chain.run("run", [program, "run", first, *arguments.run_args], first / ".stucco", goes_on=True)


def later_scene(chain, program, out, arguments):
    scene = out / f"{arguments.style}-{arguments.seed}-later"
    chain.run("later", [program, "simulate", "city", "-o", scene, "--style", arguments.style,
                        "--seed", arguments.seed, "--day", 2], scene / "scene.glb")
    return scene


def start_over(first, epoch):
    """So that the time is that of a first call: no epoch, no checkpoints."""
    shutil.rmtree(epoch, ignore_errors=True)
    shutil.rmtree(first / ".stucco/units/retexture", ignore_errors=True)


def ssim_of(chain, step, evaluate, facades):
    """Of the pictures of these facades, the mean; `evaluate` is the command, with its survey third."""
    made = evaluate[2] / "evaluation/evaluation.json"
    chain.run(step, evaluate, made)
    measured = [facet["ssim"] for facet in json.loads(made.read_text())["texture"]["facades"]
                if facet["id"] in facades and facet["ssim"] is not None]
    return sum(measured) / len(measured) if measured else None


def link_all(source, made, left_out):
    made.mkdir(exist_ok=True)
    for path in source.iterdir():
        link = made / path.name
        if path.name not in left_out:
            link.unlink(missing_ok=True)
            link.symlink_to(path.resolve())


def as_survey(first, epoch):
    """A survey whose textures are the epoch's, to be evaluated: links, but for what is written, and
    for the flight's word on its scene, which is that of the first day."""
    made = first.with_name(first.name + "-with-epoch")
    link_all(first, made, ("evaluation", "epochs", ".stucco", "texture", "truth"))
    link_all(epoch, made / "texture", ())
    link_all(first / "truth", made / "truth", ("flight.json",))
    flight = json.loads((first / "truth/flight.json").read_text())
    flight.pop("scene_hash", None)
    (made / "truth/flight.json").write_text(json.dumps(flight))
    return made


def foreign(chain, program, arguments, first):
    """What is said of photos of another town."""
    out, seed = arguments.out, arguments.foreign_seed
    scene = loop.make_scene(program, out, arguments.style, seed)
    survey = out / f"{scene.name}-for-{first.name}"
    chain.run("foreign-plan", loop.plan_command(program, scene, survey, "cocapture",
                                                CAMERA + arguments.plan_args),
              survey / "plan/plan.json")
    chain.run("foreign-fly", [program, "simulate", scene, survey, "-o", survey, "--most-photos",
                              arguments.photos], survey / "truth/flight.json", goes_on=True)
    try:
        chain.run("foreign", [program, "retexture", first, "--photos", survey / "photos", "--epoch",
                              "foreign"], survey)
        return "is taken for this one"
    except steps.Failed:
        said = chain.log("foreign").read_text(errors="replace")
        if (first / "epochs/foreign").exists():
            return "left an epoch"
        return "refused" if "none of" in said else "refused for another reason"


def measure(arguments):
    """Returns the scene's name, what was repainted, and the figures."""
    program, out = arguments.stucco, arguments.out
    scene = loop.make_scene(program, out, arguments.style, arguments.seed)
    first = out / f"{scene.name}-first"
    chain = steps.Chain(out / "logs", first.name, STEPS, again=arguments.again)
    if arguments.survey is None:
        make_first(chain, arguments, scene, first)
    elif not first.exists():
        shutil.copytree(arguments.survey, first, symlinks=True)
    later = later_scene(chain, program, out, arguments)
    repainted = json.loads((later / "truth/changes.json").read_text())["repainted"]
    plan = json.loads((first / "plan/plan.json").read_text())
    flown = out / f"{scene.name}-later-flight"
    chain.run("fly-later", [program, "simulate", later, first, "-o", flown, "--seed", 77,
                            "--facades", ",".join(facades_to_fly(plan, repainted,
                                                                 arguments.facades)),
                            "--most-photos", arguments.photos, *LATER_LIGHT],
              flown / "truth/flight.json", goes_on=True)
    epoch = first / "epochs/later"
    if chain.record("retexture").get("exit_code") != 0:
        start_over(first, epoch)
    chain.run("retexture", [program, "retexture", first, "--photos", flown / "photos", "--epoch",
                            "later"], epoch / "retexture.json")
    figures = figures_of(first, epoch, repainted, chain)
    figures["ssim_before"] = ssim_of(
        chain, "evaluate", [program, "evaluate", first, "--truth", scene], repainted)
    figures["ssim_after"] = ssim_of(
        chain, "evaluate-later",
        [program, "evaluate", as_survey(first, epoch), "--truth", later], repainted)
    figures["foreign"] = foreign(chain, program, arguments, first)
    return scene.name, repainted, figures


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--style", default="hamlet")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--foreign-seed", type=int, default=2)
    parser.add_argument("--photos", type=int, default=10)
    parser.add_argument("--facades", type=int, default=3)
    for step in ("plan", "run"):
        parser.add_argument(f"--{step}-args", type=shlex.split, default=[], metavar="WORDS")
    parser.add_argument("--again", choices=STEPS)
    parser.add_argument("--survey", type=pathlib.Path)
    parser.add_argument("--stucco", default=str(surveys.PROGRAM))
    arguments = parser.parse_args()
    try:
        scene, repainted, figures = measure(arguments)
        steps.write_whole(arguments.out / f"figures/{scene}-retexture.json",
                          json.dumps({"repainted": repainted, **figures}) + "\n")
        print(surveys.markdown_table(HEAD, [row(scene, repainted, figures)]))
    except (OSError, steps.Failed) as error:
        sys.exit(f"retexture: {error}")


if __name__ == "__main__":
    main()
