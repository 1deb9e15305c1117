#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the figures of a finished survey that docs/benchmarks.md quotes.

  bench/key_figures.py SURVEY [COST.json]
"""
import json
import math
import pathlib
import sys


def load(path):
    return json.loads(path.read_text()) if path.exists() else None


def tilt_deg(normal, up):
    """How far a wall is from vertical."""
    length = math.hypot(*normal) * math.hypot(*up)
    return math.degrees(math.asin(min(1, abs(sum(a * b for a, b in zip(normal, up))) / length)))


def stage_lines(survey):
    """The peak of every stage: each resets the kernel's count, so that of the process says less."""
    peaks = []
    for path in sorted((survey / ".stucco/manifests").glob("*.json")):
        usage = load(path).get("usage") or {}
        peaks.append((usage.get("peak_memory_mb", -1), path.stem, usage.get("wall_s", -1)))
    known = [peak for peak in peaks if peak[0] >= 0]
    if known:
        yield f"peak memory {max(known)[0]:.0f} MiB ({max(known)[1]})"
        order = ["ingest", "calib", "dense", "proxy", "texture", "report"]
        known.sort(key=lambda peak: order.index(peak[1]) if peak[1] in order else len(order))
        yield "stages: " + ", ".join(f"{name} {wall:.0f} s" for _, name, wall in known)


def calibration_lines(calibration):
    yield (f"photos posed: {calibration['photos_posed']} of {calibration['photos_total']}, "
           f"reprojection error {calibration['reprojection_error_px']:.3f} px, "
           f"{calibration['points']} points, track length {calibration['mean_track_length']:.2f}")
    rms = calibration.get("prior_rms_m")
    if rms and rms.get("horizontal") is not None and rms["horizontal"] >= 0:
        yield (f"distance to the recorded positions (rms): {rms['horizontal']:.3f} m horizontally, "
               f"{rms['vertical']:.3f} m vertically")
    for photo in calibration.get("unposed", []):
        yield f"not posed: {photo['path']}: {photo['why']}"
    for finding in calibration.get("findings", []):
        yield f"finding: {finding}"


def proxy_lines(proxy):
    up = proxy.get("up", [0, 0, 1])
    for building in proxy["buildings"]:
        facets = building["facets"]
        yield (f"{building['id']}: {len(facets)} facets, "
               f"{'watertight' if building['watertight'] else 'open'}")
        walls = [f for f in facets if f["class"] == "WallSurface" and "normal" in f]
        for facet in sorted(walls, key=lambda f: -f["area_m2"])[:4]:
            yield (f"  {facet['id']}: {facet['area_m2']:.1f} m2, "
                   f"{tilt_deg(facet['normal'], up):.2f} deg from vertical, "
                   f"seen {100 * facet['seen']:.0f} %, rms {facet['rms_m']:.4f} m")


def report_lines(report):
    for name, counts in report["verdicts"].items():
        colours = ", ".join(f"{counts[v]} {v}" for v in ("green", "amber", "red", "unknown"))
        yield f"facets ({name}): {counts['total']} ({colours})"


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    survey = pathlib.Path(sys.argv[1])
    if len(sys.argv) > 2 and (cost := load(pathlib.Path(sys.argv[2]))):
        print(f"wall {cost['wall_s']:.0f} s, CPU {cost['cpu_s']:.0f} s, "
              f"exit code {cost['exit_code']}")
    for line in stage_lines(survey):
        print(line)
    for name, lines in (("calib/calibration.json", calibration_lines),
                        ("proxy/facets.json", proxy_lines), ("report/report.json", report_lines)):
        content = load(survey / name)
        if content is None:
            print(f"{name}: missing")
            continue
        for line in lines(content):
            print(line)


if __name__ == "__main__":
    main()
