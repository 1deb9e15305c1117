#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What becomes of buildings that only a scan from above has seen.

Usage: airborne.py CITYJSON OUT --crs EPSG:n [--density 8] [--noise 0.02] [--margin 8] [--seed 1]
                   [--stucco PROGRAM]

The LoD2 buildings of CITYJSON are scanned from above: DENSITY points a square metre at random, each on
the highest roof there, else on level ground at the building's foot, MARGIN metres around it, moved
by NOISE (metres, one standard deviation of each axis); walls have none. OUT gets footprints.geojson
(ground surfaces, without heights) and scan.ply; then the program is run as a user would: init, import
with --map, run --until proxy, export as CityJSON in the CRS. That file is held against the truth: how
many buildings are closed and valid as written, what share of the roofs' area lies within 0.1 m
(vertically), and which planes of the roofs were found again: half of what shows of one from above
lies within 0.1 m of a roof that is inclined as it within 5 degrees. A plane is all surfaces of a
building that are coplanar within 2 degrees and 5 cm and share an edge, and shows at least two square
metres.
"""
import argparse
import collections
import json
import math
import pathlib
import subprocess
import sys

import numpy as np

NEAR_M = 0.1
ALIKE_DEG = 5
LARGE_M2 = 10
LEAST_M2 = 2  # sixteen points
FLAT_M = 0.01  # val3dity's tolerance of planarity
CELL_M = 0.25  # of the grid on which areas are counted


def vertices_of(city):
    """As rows x, y, z."""
    found = np.array(city["vertices"], dtype=float).reshape(-1, 3)
    if "transform" in city:
        found = found * city["transform"]["scale"] + city["transform"]["translate"]
    return found


class Surface:
    """A polygon with holes, by its rings of indices; z = slope . (x, y) + height where not upright."""

    def __init__(self, kind, rings, corners):
        self.kind = kind
        self.rings = [list(ring) for ring in rings]
        self.points = [corners[ring] for ring in self.rings]
        normal = np.zeros(3)
        for ring in self.points:
            at = ring - self.points[0][0]
            normal += np.cross(at, np.roll(at, -1, axis=0)).sum(axis=0)
        length = np.linalg.norm(normal)
        self.normal = normal / length if length > 0 else normal
        self.middle = self.points[0].mean(axis=0)

    def heights(self, xy):
        return self.middle[2] - (xy - self.middle[:2]) @ self.normal[:2] / self.normal[2]

    def covers(self, xy):
        """Seen from above, by crossings of a ray."""
        inside = np.zeros(len(xy), dtype=bool)
        for ring in self.points:
            for p, q in zip(ring, np.roll(ring, -1, axis=0)):
                if p[1] == q[1]:
                    continue
                between = (xy[:, 1] < p[1]) != (xy[:, 1] < q[1])
                at = p[0] + (xy[:, 1] - p[1]) / (q[1] - p[1]) * (q[0] - p[0])
                inside ^= between & (xy[:, 0] < at)
        return inside


def surfaces_of(geometry, corners):
    """Of a MultiSurface or the first shell of a Solid."""
    semantics = geometry.get("semantics", {"surfaces": [], "values": None})
    boundaries, values = geometry["boundaries"], semantics["values"]
    if geometry["type"] == "Solid":
        boundaries, values = boundaries[0], values[0] if values else None
    kinds = [semantics["surfaces"][v]["type"] if v is not None else "" for v in
             values or [None] * len(boundaries)]
    return [Surface(kind, rings, corners) for kind, rings in zip(kinds, boundaries)]


def buildings_of(city):
    """Surfaces by the id of the building."""
    corners = vertices_of(city)
    found = {}
    for name, thing in city["CityObjects"].items():
        if thing["type"] != "Building":
            continue
        found[name] = [surface for part in [name, *thing.get("children", [])]
                       for geometry in city["CityObjects"][part].get("geometry", [])
                       for surface in surfaces_of(geometry, corners)]
    return found


def of_kind(surfaces, kind):
    return [s for s in surfaces if s.kind == kind]


def seen_from_above(surfaces, xy):
    """Index of the highest surface at each place (-1: none), and its height."""
    best = np.full(len(xy), -1)
    height = np.full(len(xy), -np.inf)
    for i, surface in enumerate(surfaces):
        if abs(surface.normal[2]) < 1e-3:
            continue
        low, high = surface.points[0].min(axis=0), surface.points[0].max(axis=0)
        near = np.flatnonzero(((xy >= low[:2]) & (xy <= high[:2])).all(axis=1))
        near = near[surface.covers(xy[near])]
        z = surface.heights(xy[near])
        above = z > height[near]
        best[near[above]] = i
        height[near[above]] = z[above]
    return best, height


def box_of(surfaces, margin):
    corners = np.vstack([ring for s in surfaces for ring in s.points])
    return corners[:, :2].min(axis=0) - margin, corners[:, :2].max(axis=0) + margin


def scan(surfaces, wanted, dice):
    low, high = box_of(surfaces, wanted.margin)
    count = dice.poisson(wanted.density * np.prod(high - low))
    xy = dice.uniform(low, high, (count, 2))
    foot = min(ring[:, 2].min() for s in surfaces for ring in s.points)
    _, z = seen_from_above(of_kind(surfaces, "RoofSurface"), xy)
    z[np.isinf(z)] = foot
    return np.column_stack([xy, z]) + dice.normal(0, wanted.noise, (count, 3))


def write_ply(points, path):
    head = ("ply\nformat binary_little_endian 1.0\n"
            f"element vertex {len(points)}\nproperty double x\nproperty double y\n"
            "property double z\nend_header\n")
    path.write_bytes(head.encode() + points.astype("<f8").tobytes())


def write_footprints(buildings, path):
    features = []
    for number, surfaces in enumerate(buildings, 1):
        polygons = [[np.vstack([ring, ring[:1]])[:, :2].tolist() for ring in s.points]
                    for s in of_kind(surfaces, "GroundSurface")]
        features.append({"type": "Feature", "properties": {"id": number},
                         "geometry": {"type": "MultiPolygon", "coordinates": polygons}})
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))


def planes_of(roofs):
    """Lists of indices of surfaces that lie in one plane and hang together by edges."""
    parent = list(range(len(roofs)))

    def root(i):
        while parent[i] != i:
            i = parent[i]
        return i

    by_edge = collections.defaultdict(list)
    for i, roof in enumerate(roofs):
        for ring in roof.rings:
            for edge in zip(ring, ring[1:] + ring[:1]):
                by_edge[frozenset(edge)].append(i)
    for shared in by_edge.values():
        for a, b in zip(shared, shared[1:]):
            alike = abs(roofs[a].normal @ roofs[b].normal) > math.cos(math.radians(2))
            apart = abs((roofs[b].middle - roofs[a].middle) @ roofs[a].normal)
            if alike and apart < 0.05:
                parent[root(a)] = root(b)
    groups = collections.defaultdict(list)
    for i in range(len(roofs)):
        groups[root(i)].append(i)
    return list(groups.values())


def fault_of(surfaces):
    """Why surfaces, whose corners are numbered, do not bound a solid as written; "" where they do."""
    edges = collections.Counter()
    volume = 0.0
    if not surfaces:
        return "missing"
    origin = surfaces[0].points[0][0]
    for surface in surfaces:
        if not surface.normal.any():
            return "a surface without area"
        for ring, points in zip(surface.rings, surface.points):
            if len(set(ring)) != len(ring) or len(ring) < 3:
                return "a corner twice in a ring"
            if np.abs((points - surface.middle) @ surface.normal).max() > FLAT_M:
                return "not planar"
            edges.update(zip(ring, ring[1:] + ring[:1]))
            at = points - points[0]
            area = np.cross(at, np.roll(at, -1, axis=0)).sum(axis=0)
            volume += (points[0] - origin) @ area / 6
    for edge, count in edges.items():
        if count != 1 or edges[edge[::-1]] != 1:
            return "open, or not 2-manifold"
    return "" if volume > 0 else "inside out"


def hold_against(truth, made):
    """Of one building: areas, near areas and planes as (visible area, found)."""
    roofs = of_kind(truth, "RoofSurface")
    low, high = box_of(truth, 0)
    xy = np.stack(np.meshgrid(*(np.arange(a + CELL_M / 2, b, CELL_M) for a, b in zip(low, high))),
                  axis=-1).reshape(-1, 2)
    built = np.zeros(len(xy), dtype=bool)
    for ground in of_kind(truth, "GroundSurface"):
        built |= ground.covers(xy)
    xy = xy[built]
    top, z = seen_from_above(roofs, xy)
    model = of_kind(made, "RoofSurface")
    found, model_z = seen_from_above(model, xy)
    lean = np.array([abs(s.normal[2]) for s in roofs] or [1])
    area = np.where(top >= 0, CELL_M ** 2 / np.maximum(lean[top], 0.05), 0)
    near = (top >= 0) & (found >= 0) & (np.abs(np.where(found >= 0, model_z, 0)
                                               - np.where(top >= 0, z, 0)) < NEAR_M)
    planes = []
    for group in planes_of(roofs):
        shows = np.isin(top, group)
        if area[shows].sum() < LEAST_M2:
            continue
        normal = roofs[group[0]].normal
        alike = [i for i, s in enumerate(model)
                 if abs(s.normal @ normal) > math.cos(math.radians(ALIKE_DEG))]
        hit = shows & near & np.isin(found, alike)
        planes.append((area[shows].sum(), area[hit].sum() > area[shows].sum() / 2))
    return area.sum(), area[near].sum(), planes


def compare(truth, city):
    made = buildings_of(city)
    figures = {"buildings": len(truth), "closed": 0, "full": 0, "area_m2": 0.0, "near_m2": 0.0,
               "planes": 0, "planes_found": 0, "large": 0, "large_found": 0, "faults": {}}
    for number, surfaces in enumerate(truth, 1):
        name = f"B{number:04}"
        fault = fault_of(made.get(name, []))
        if fault:
            figures["faults"][name] = fault
        else:
            figures["closed"] += 1
            figures["full"] += city["CityObjects"][name]["attributes"].get("detail") == "full"
        area, near, planes = hold_against(surfaces, made.get(name, []))
        figures["area_m2"] += area
        figures["near_m2"] += near
        for shows, found in planes:
            figures["planes"] += 1
            figures["planes_found"] += bool(found)
            figures["large"] += bool(shows >= LARGE_M2)
            figures["large_found"] += bool(found and shows >= LARGE_M2)
    return figures


def run(program, *words):
    command = [str(word) for word in (program, *words)]
    print("+", *command, flush=True)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cityjson", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--crs", required=True)
    parser.add_argument("--density", type=float, default=8)
    parser.add_argument("--noise", type=float, default=0.02)
    parser.add_argument("--margin", type=float, default=8)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--stucco", type=pathlib.Path,
                        default=pathlib.Path(__file__).parents[1] / "build/dev/cli/stucco")
    wanted = parser.parse_args()
    truth = list(buildings_of(json.loads(wanted.cityjson.read_text())).values())
    dice = np.random.default_rng(wanted.seed)
    wanted.out.mkdir(parents=True)
    (wanted.out / "no-photos").mkdir()
    write_footprints(truth, wanted.out / "footprints.geojson")
    write_ply(np.vstack([scan(surfaces, wanted, dice) for surfaces in truth]),
              wanted.out / "scan.ply")
    survey, model = wanted.out / "survey", wanted.out / "model.city.json"
    run(wanted.stucco, "init", survey, "--photos", wanted.out / "no-photos")
    run(wanted.stucco, "import", survey, wanted.out / "scan.ply", "--map",
        wanted.out / "footprints.geojson", "--crs", wanted.crs)
    run(wanted.stucco, "run", survey, "--until", "proxy")
    run(wanted.stucco, "export", survey, "--format", "cityjson", "--crs", wanted.crs, "-o", model)
    figures = compare(truth, json.loads(model.read_text()))
    (wanted.out / "figures.json").write_text(json.dumps(figures, indent=1))
    for name, fault in figures["faults"].items():
        print(f"{name}: {fault}")
    print(f"closed and valid {figures['closed']} of {figures['buildings']}, full {figures['full']}; "
          f"roof area within {NEAR_M} m {100 * figures['near_m2'] / figures['area_m2']:.1f} %; planes "
          f"found {figures['planes_found']} of {figures['planes']}, of {LARGE_M2} m2 and more "
          f"{figures['large_found']} of {figures['large']}")
    return 0 if figures["closed"] == figures["buildings"] else 1


if __name__ == "__main__":
    sys.exit(main())
