# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What several commands share: running surveys, reading their figures, comparing what they wrote."""
import hashlib
import json
import math
import pathlib
import subprocess
import sys

import measure

PROGRAM = pathlib.Path(__file__).parents[1] / "build/dev/cli/stucco"


def parse(parser):
    """The parsed command line, with everything after `--` as `args`."""
    words = sys.argv[1:]
    split = words.index("--") if "--" in words else len(words)
    arguments = parser.parse_args(words[:split])
    arguments.args = words[split + 1:]
    return arguments


def init(program, survey, photos):
    subprocess.run([program, "init", survey, "--photos", photos], check=True,
                   stdout=subprocess.DEVNULL)


def outputs(folder):
    """Relative path -> hash of every file that is not the orchestrator's own record."""
    folder = pathlib.Path(folder)
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(folder.rglob("*"))
            if path.is_file() and path.relative_to(folder).parts[0] != ".stucco"}


def differences(a, b):
    """What two results of outputs() do not have in common."""
    found = [f"only in the first: {name}" for name in a if name not in b]
    found += [f"only in the second: {name}" for name in b if name not in a]
    return found + [f"differs: {name}" for name in a if name in b and a[name] != b[name]]


def computed_twice(lines):
    """Units that .stucco/events.ndjson says were computed and checkpointed more than once. A line
    torn by a kill is no record."""
    seen, twice = set(), []
    for line in lines:
        try:
            event = json.loads(line)
        except json.JSONDecodeError:
            continue
        if event.get("event") != "unit":
            continue
        unit = (event["stage"], event["kind"], event["key"])
        if unit in seen:
            twice.append(unit)
        seen.add(unit)
    return twice, len(seen)


STAGES = ("ingest", "calib", "dense", "proxy", "texture", "report")


class Failed(Exception):
    """A command that a benchmark needs has failed; the message names its log."""


def run_step(command, log):
    """Runs a command with its output in `log`. Returns what it cost (measure.py)."""
    log.parent.mkdir(parents=True, exist_ok=True)
    words = [str(word) for word in command]
    with open(log, "wb") as output:
        cost = measure.measure(words, output.fileno())
    if cost["exit_code"] != 0:
        raise Failed(f"{' '.join(words[:3])} ... ended with {cost['exit_code']}; see {log}")
    return cost


def make_scene(program, folder, style, seed, args=()):
    """A scene folder OUT/STYLE-SEED, made unless it is there."""
    scene = folder / f"{style}-{seed}"
    if not (scene / "scene.json").exists():
        run_step([program, "simulate", "city", "-o", scene, "--style", style, "--seed", seed,
                  *args], folder / f"logs/{scene.name}.log")
    return scene


def plan_command(program, scene, survey, method, args=()):
    terrain = scene / "terrain.tif"
    return [program, "plan", scene / "map.geojson", "-o", survey, "--method", method,
            *(["--terrain", terrain] if terrain.exists() else []), *args]


def fly_loop(program, scene, survey, options):
    """Plans, flies, reconstructs and measures one survey, each step unless its result is there.

    `options` has "method", "scale" and, where wanted, lists of arguments "plan", "fly" and "run".
    Returns figures(survey). A run whose stages fail in part is measured as far as it came."""
    logs = survey.parent / "logs"
    if not (survey / "plan/plan.json").exists():
        run_step(plan_command(program, scene, survey, options["method"], options.get("plan", ())),
                 logs / f"{survey.name}-plan.log")
    if not (survey / "truth/flight.json").exists():
        run_step([program, "simulate", scene, survey, "-o", survey, "--scale", options["scale"],
                  *options.get("fly", ())], logs / f"{survey.name}-fly.log")
    try:
        run_step([program, "run", survey, *options.get("run", ())], logs / f"{survey.name}-run.log")
    except Failed as failure:
        print(f"{survey.name}: {failure}", file=sys.stderr)
    run_step([program, "evaluate", survey, "--truth", scene], logs / f"{survey.name}-evaluate.log")
    return figures(survey)


def stage_costs(survey):
    """Wall and CPU seconds and peak memory of the stages that have results."""
    costs = {}
    for stage in STAGES:
        path = survey / f".stucco/manifests/{stage}.json"
        if path.exists():
            usage = json.loads(path.read_text()).get("usage") or {}
            costs[stage] = {name: usage.get(name) for name in ("wall_s", "cpu_s", "peak_memory_mb")}
    return costs


def figures(survey):
    """evaluation.json without its lists, and what the stages cost."""
    evaluation = json.loads((survey / "evaluation/evaluation.json").read_text())
    evaluation.get("texture", {}).pop("facades", None)
    evaluation.get("views", {}).pop("photos", None)
    evaluation["stages"] = stage_costs(survey)
    return evaluation


def number(value, decimals=2):
    """For a table; what was not measured is a dash."""
    known = isinstance(value, (int, float)) and math.isfinite(value)
    return f"{value:.{decimals}f}" if known else "-"


def markdown_row(cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def markdown_table(head, rows):
    return "\n".join([markdown_row(head), "|" + " --- |" * len(head),
                      *(markdown_row(row) for row in rows)])
