# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What several commands share: running surveys, reading their figures, comparing what they wrote."""
import hashlib
import json
import math
import pathlib
import subprocess
import sys

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


def stage_costs(survey):
    """Wall and CPU seconds and peak memory of the stages that have results. A stage that was stopped
    and went on says what its last part cost: "in_part"."""
    costs = {}
    for stage in STAGES:
        path = survey / f".stucco/manifests/{stage}.json"
        if path.exists():
            manifest = json.loads(path.read_text())
            usage, units = manifest.get("usage") or {}, manifest.get("units") or {}
            costs[stage] = {name: usage.get(name) for name in ("wall_s", "cpu_s", "peak_memory_mb")}
            costs[stage]["in_part"] = any(kind.get("reused", 0) > 0 for kind in units.values())
    return costs


def number(value, decimals=2):
    """For a table; what was not measured is a dash."""
    known = isinstance(value, (int, float)) and math.isfinite(value)
    return f"{value:.{decimals}f}" if known else "-"


def seconds(cost, which, decimals=0):
    """For a table: "wall_s" or "cpu_s" of a step or stage, with a ≥ where that is not all of it."""
    text = number((cost or {}).get(which), decimals)
    return "≥ " + text if cost and cost["in_part"] and text != "-" else text


def markdown_row(cells):
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def markdown_table(head, rows):
    return "\n".join([markdown_row(head), "|" + " --- |" * len(head),
                      *(markdown_row(row) for row in rows)])
