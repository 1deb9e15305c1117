#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a model of a made scene loses what: the same flight with the truth put in below each rung.

  bench/ladder.py OUT [--style hamlet] [--seed 1] [--scale 0.25]
                  [--rungs map,nomap,cloud,poses,own,facets] [--textures]
                  [--map-seed 1 | --exact-map] [--gone 3] [and the rest of loop.py's errors]
                  [--plan-args "..."] [--fly-args "..."] [--run-args "..."] [--stucco PROGRAM]

Rungs: "map", the plan's footprints extruded without any photo; "nomap" and "cloud", the true cloud
with holes and noise into proxy, without and with the map; "poses", true poses, of the photos that
have one, into dense and proxy; "own", the survey as it is, from ingest to proxy; "facets", true poses,
the true cloud and the true facets, to be painted. With --textures all but "map" and "nomap" are
painted, and their pictures are compared on walls' planes with those of one ideal photo. The map that
proxy goes by has the errors of real ones (perturb_plan.py) unless --exact-map; the drone has flown by
the exact one. Printed is a table for docs/benchmarks.md. Each rung is a survey OUT/STYLE-SEED-RUNG,
made anew each time from OUT/STYLE-SEED-flown, which is flown once.
"""
import argparse
import json
import math
import os
import pathlib
import shutil
import sys

import loop
import steps
import surveys

BENCH = pathlib.Path(__file__).parent
HEAD = ["scene", "rung", "posed", "model error (m)", "its walls (m)", "walls seen (m)",
        "walls complete",
        "roofs (m)", "roofs complete", "buildings complete", "closed",
        "facets / truth", "of them on roofs", "ids", "CPU s"]
PICTURES = ["painted", "SSIM on planes", "one ideal photo", "shift (m)"]


def local_metres(origin, latitude_deg, longitude_deg):
    """East and north of a place from an origin, exact to millimetres over hundreds of metres."""
    phi = math.radians(origin[0])
    a, e2 = 6378137.0, 6.69437999014e-3  # WGS 84
    w = math.sqrt(1 - e2 * math.sin(phi) ** 2)
    return (math.radians(longitude_deg - origin[1]) * a / w * math.cos(phi),
            math.radians(latitude_deg - origin[0]) * a * (1 - e2) / w ** 3)


def facet(name, facet_class, corners, holes=(), facade=""):
    """By Newell's normal; its figures say that nobody has seen it."""
    n = [0.0, 0.0, 0.0]
    for p, q in zip(corners, corners[1:] + corners[:1]):
        n[0] += (p[1] - q[1]) * (p[2] + q[2])
        n[1] += (p[2] - q[2]) * (p[0] + q[0])
        n[2] += (p[0] - q[0]) * (p[1] + q[1])
    length = math.sqrt(sum(c * c for c in n))
    n = [c / length for c in n]
    return {"id": name, "facade": facade, "other_facades": [], "class": facet_class,
            "area_m2": length / 2, "rms_m": 0.0, "seen": 0.0, "inferred": 1.0, "support": 0,
            "source": "footprint", "normal": n,
            "offset": sum(a * b for a, b in zip(n, corners[0])), "outer": corners,
            "holes": list(holes)}


def level(ring, z):
    return [[x, y, z] for x, y in ring]


def prism(footprint, facades, shift, number):
    """The facets of one footprint between the heights that the map gives."""
    low, high = footprint["z_m"]
    name = footprint["building"]
    rings = [[(x + shift[0], y + shift[1]) for x, y in ring] for ring in footprint["rings_m"]]
    made = [facet(f"{name}/R{number}", "RoofSurface", level(rings[0], high),
                  [level(ring, high) for ring in rings[1:]]),
            facet(f"{name}/G{number}", "OuterFloorSurface", level(rings[0][::-1], low),
                  [level(ring[::-1], low) for ring in rings[1:]])]
    for r, ring in enumerate(rings):
        for i, (p, q) in enumerate(zip(ring, ring[1:] + ring[:1])):
            middle = ((p[0] + q[0]) / 2 - shift[0], (p[1] + q[1]) / 2 - shift[1])
            mine = [f["id"] for f in facades if f["id"].split("/")[0] == name
                    and distance_to(middle, f["a_m"], f["b_m"]) < 0.05]
            made.append(facet(f"{name}/W{number}-{r}-{i}", "WallSurface",
                              [[*p, low], [*q, low], [*q, high], [*p, high]],
                              facade=mine[0] if mine else ""))
    return made


def distance_to(p, a, b):
    along = (b[0] - a[0], b[1] - a[1])
    length2 = along[0] ** 2 + along[1] ** 2 or 1
    t = ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / length2
    t = min(1, max(0, t))
    return math.dist(p, (a[0] + t * along[0], a[1] + t * along[1]))


def extrude_plan(survey, georef):
    """proxy/facets.json from the plan alone, its ground where the survey's origin is."""
    plan = json.loads((survey / "plan/plan.json").read_text())
    origin = (georef["origin_latitude_deg"], georef["origin_longitude_deg"])
    shift = local_metres(origin, plan["origin"]["latitude_deg"], plan["origin"]["longitude_deg"])
    buildings = {}
    for footprint in plan["footprints"]:
        of_one = buildings.setdefault(footprint["building"], [])
        of_one += prism(footprint, plan["facades"], shift, len(of_one))
    (survey / "proxy").mkdir(exist_ok=True)
    (survey / "proxy/facets.json").write_text(json.dumps(
        {"version": 1, "up": [0, 0, 1], "metric": True,
         "buildings": [{"id": name, "watertight": True, "source": "map", "facets": facets}
                       for name, facets in buildings.items()]}))


def true_georef(survey):
    place = json.loads((survey / "truth/flight.json").read_text())["georef"]
    return {"version": 1, "frame": "enu", **place, "up": [0, 0, 1], "metric": True,
            "source": "gps"}


def true_poses(survey):
    """truth/sparse in the place of calib's results."""
    shutil.copytree(survey / "truth/sparse", survey / "calib/sparse/0")
    (survey / "calib/georef.json").write_text(json.dumps(true_georef(survey)))


def centre(words):
    """Where a photo of images.txt was taken: -R^T t."""
    w, x, y, z, *t = map(float, words[1:8])
    rotation = ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
                (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
                (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))
    return [-sum(rotation[k][i] * t[k] for k in range(3)) for i in range(3)]


def lines_of(path):
    return [line for line in path.read_text().splitlines() if not line.startswith("#")]


def correct_poses(survey):
    """True lenses and poses in calib's results. Points, which only tell dense what photos share and
    how far away it is, are shifted into the world of the truth."""
    sparse, truth = survey / "calib/sparse/0", survey / "truth/sparse"
    for binary in sparse.glob("*.bin"):
        binary.unlink()
    true_lines = {line.split()[9]: line.split() for line in lines_of(truth / "images.txt")[::2]}
    images, shifts = [], []
    own = lines_of(sparse / "images.txt")
    for line, observations in zip(own[::2], own[1::2]):
        words = line.split()
        true = true_lines[words[9]]
        shifts.append([a - b for a, b in zip(centre(true), centre(words))])
        images += [" ".join([words[0], *true[1:8], *words[8:]]), observations]
    shift = [sorted(of_axis)[len(shifts) // 2] for of_axis in zip(*shifts)]
    points = []
    for line in lines_of(sparse / "points3D.txt"):
        number, *place, rest = line.split(maxsplit=4)
        points.append(" ".join([number, *(str(float(a) + b) for a, b in zip(place, shift)), rest]))
    camera = lines_of(truth / "cameras.txt")[0].split()[1:]
    cameras = [" ".join([line.split()[0], *camera]) for line in lines_of(sparse / "cameras.txt")]
    for name, lines in (("cameras", cameras), ("images", images), ("points3D", points)):
        steps.write_whole(sparse / f"{name}.txt", "\n".join(lines) + "\n")
    (survey / "calib/georef.json").write_text(json.dumps(true_georef(survey)))


class Ladder:
    def __init__(self, arguments):
        self.arguments = arguments
        self.program = arguments.stucco
        self.scene = loop.make_scene(self.program, arguments.out, arguments.style, arguments.seed)
        self.flown = arguments.out / f"{self.scene.name}-flown"
        chain = steps.Chain(arguments.out / "logs", self.flown.name, ("plan", "fly"))
        chain.run("plan", loop.plan_command(self.program, self.scene, self.flown, "cocapture",
                                            arguments.plan_args), self.flown / "plan/plan.json")
        chain.run("fly", [self.program, "simulate", self.scene, self.flown, "-o", self.flown,
                          "--scale", arguments.scale, "--write-depth", *arguments.fly_args],
                  self.flown / "truth/flight.json", goes_on=True)

    def climb(self, rung):
        """The figures of one rung."""
        survey = self.arguments.out / f"{self.scene.name}-{rung}"
        if survey.exists():
            shutil.rmtree(survey)
        shutil.copytree(self.flown, survey, copy_function=os.link)
        chain = steps.Chain(self.arguments.out / "logs", survey.name,
                            ("errors", "cloud", "calib", "run", "evaluate"), again="errors")
        if not self.arguments.exact_map:
            plan = survey / "plan/plan.json"
            chain.run("errors", loop.map_command(self.arguments, plan), plan)
        last = "texture" if self.is_painted(rung) else "proxy"
        run = [self.program, "run", survey, "--until", last, *self.arguments.run_args]
        if rung == "poses":
            chain.run("calib", [self.program, "run", survey, "--until", "calib",
                                *self.arguments.run_args], survey / "calib/georef.json")
            correct_poses(survey)
        elif rung != "own":
            true_poses(survey)
        if rung == "map":
            extrude_plan(survey, true_georef(survey))
        elif rung in ("cloud", "nomap", "facets"):
            (survey / "dense").mkdir()
            cloud = survey / "dense/cloud.ply"
            chain.run("cloud", [sys.executable, BENCH / "true_cloud.py", survey, cloud,
                                "--step", "2"], cloud)
            if rung == "facets":
                (survey / "proxy").mkdir()
                shutil.copy(self.scene / "truth/facets.json", survey / "proxy/facets.json")
            run += ["--from", "texture" if rung == "facets" else "proxy"]
            run += ["--set", "proxy.use_map=false"] if rung == "nomap" else []
        elif rung == "poses":
            run += ["--from", "dense"]
        if rung != "map":
            chain.run("run", run, survey / ".stucco")
        chain.run("evaluate", [self.program, "evaluate", survey, "--truth", self.scene],
                  survey / "evaluation/evaluation.json")
        evaluation = json.loads((survey / "evaluation/evaluation.json").read_text())
        return {**evaluation, "cpu_s": chain.costs().get("run", {}).get("cpu_s")}

    def is_painted(self, rung):
        return rung == "facets" or (self.arguments.textures and rung not in ("map", "nomap"))

    def row(self, rung):
        figures = self.climb(rung)
        poses, proxy, texture = figures["poses"], figures["proxy"], figures["texture"]
        plane = texture["plane"]
        pictures = [loop.percent(texture["painted"]), surveys.number(plane["ssim"], 3),
                    surveys.number(plane["ceiling"]["ssim"], 3),
                    surveys.number(plane["shift_m"], 3)] if self.is_painted(rung) else ["-"] * 4
        return [self.scene.name, rung,
                loop.of_all(poses["posed"], poses["total"]) if rung == "own" else "truth",
                surveys.number(proxy["building_error95_m"], 3),
                surveys.number(proxy["wall_error95_m"], 3),
                surveys.number(proxy["wall_seen95_m"], 3),
                loop.percent(proxy["wall_completeness"]),
                surveys.number(proxy["roof_error95_m"], 3),
                loop.percent(proxy["roof_completeness"]),
                loop.percent(proxy["building_completeness_all"]),
                loop.of_all(proxy["watertight"], proxy["truth_buildings"]),
                loop.of_all(proxy["facets"], proxy["truth_facets"]),
                str(proxy["superstructure_facets"]),
                loop.percent(proxy["facade_id_rate"]), surveys.number(figures["cpu_s"], 0),
                *(pictures if self.has_pictures() else [])]

    def has_pictures(self):
        return any(self.is_painted(rung) for rung in self.arguments.rungs.split(","))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    loop.add_flight_arguments(parser)
    parser.add_argument("--rungs", default="map,nomap,cloud,poses,own")
    parser.add_argument("--textures", action="store_true")
    loop.add_map_arguments(parser)
    arguments = parser.parse_args()
    try:
        ladder = Ladder(arguments)
        head = HEAD + (PICTURES if ladder.has_pictures() else [])
        print(surveys.markdown_table(head, [ladder.row(rung)
                                            for rung in arguments.rungs.split(",")]))
    except (OSError, steps.Failed) as error:
        sys.exit(f"ladder: {error}")


if __name__ == "__main__":
    main()
