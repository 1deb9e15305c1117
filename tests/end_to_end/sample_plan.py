# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A plan for the sample survey, as if it had been flown by one: the truth's walls are its facades,
the photos its views.

    tests/end_to_end/sample_plan.py SURVEY/plan/plan.json [EAST NORTH]

moves the whole plan by so many metres, as biased GPS moves a survey.
"""
import json
import math
import pathlib
import sys

TRUTH = pathlib.Path(__file__).resolve().parents[2] / "data/sample/truth"
PHOTOS_PER_FACADE = 2
FARTHEST_M = 60


def cameras(images_txt):
    """Name of the file -> centre and viewing direction, from COLMAP's images.txt."""
    found = {}
    lines = [line for line in images_txt.read_text().splitlines() if not line.startswith("#")]
    for line in lines[0::2]:
        fields = line.split(maxsplit=9)
        w, x, y, z = map(float, fields[1:5])
        t = [float(value) for value in fields[5:8]]
        rotation = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
        centre = [-sum(rotation[k][i] * t[k] for k in range(3)) for i in range(3)]
        found[fields[9]] = centre, rotation[2]
    return found


def facade_id(building, edge):
    """Ids of a map, which no run of the program gives by itself."""
    return f"B01{building:02}/F{edge:02}"


def worth(facade, centre, forward):
    """How well a photo shows the facade: frontal, near and aimed at it; below 0: not at all."""
    (ax, ay), (bx, by) = facade["a_m"], facade["b_m"]
    middle = [(ax + bx) / 2, (ay + by) / 2, facade["z_m"][1] / 2]
    length = math.hypot(bx - ax, by - ay)
    normal = [(by - ay) / length, -(bx - ax) / length, 0]
    ray = [m - c for m, c in zip(middle, centre)]
    distance = math.hypot(*ray)
    ray = [value / distance for value in ray]
    frontal = -sum(a * b for a, b in zip(ray, normal))
    aimed = sum(a * b for a, b in zip(ray, forward))
    if frontal < 0.5 or aimed < 0.85:
        return -1
    return frontal + aimed - distance / FARTHEST_M


def make_plan(east_m=0, north_m=0):
    truth = json.loads((TRUTH / "planes.json").read_text())
    facades, footprints = [], []
    for number, building in enumerate(truth["buildings"], 1):
        ring = building["footprint_m"]
        z_m = [0, building["eave_m"]]
        footprints.append({"building": f"B01{number:02}", "rings_m": [ring], "z_m": z_m})
        for edge, (a, b) in enumerate(zip(ring, ring[1:] + ring[:1])):
            facades.append({"id": facade_id(number, edge), "a_m": list(a), "b_m": list(b), "z_m": z_m,
                            "views": [],
                            "predicted": {"q_s": 0.9, "q_d": 0.8, "q_u": 0.6, "q_c": 1.0}})
    photos = cameras(TRUTH / "images.txt")
    meant = {name: [] for name in photos}
    for facade in facades:
        ranked = sorted(photos, key=lambda name, f=facade: (-worth(f, *photos[name]), name))
        for name in ranked[:PHOTOS_PER_FACADE]:
            if worth(facade, *photos[name]) > 0:
                meant[name].append(facade["id"])
    views = []
    for order, name in enumerate(sorted(photos)):
        centre, forward = photos[name]
        pitch = math.degrees(math.asin(forward[2]))
        views.append({
            "id": pathlib.PurePath(name).stem.rsplit("_", 1)[-1], "position_m": centre,
            "yaw_deg": math.degrees(math.atan2(forward[0], forward[1])), "pitch_deg": pitch,
            "kind": "nadir" if pitch < -80 else "oblique", "hover": order, "order": order,
            "flight": 0, "facades": meant[name]})
        for facade in facades:
            if facade["id"] in meant[name]:
                facade["views"].append(views[-1]["id"])
    for place in ([view["position_m"] for view in views]
                  + [facade[end] for facade in facades for end in ("a_m", "b_m")]
                  + [corner for footprint in footprints for corner in footprint["rings_m"][0]]):
        place[0] += east_m
        place[1] += north_m
    origin = {key: truth["origin"][key] for key in ("latitude_deg", "longitude_deg")}
    return {"version": 1, "method": "made for the sample",
            "crs": f"+proj=tmerc +lat_0={origin['latitude_deg']} +lon_0={origin['longitude_deg']} "
                   "+k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m",
            "origin": origin, "d_min_m": 5, "d_max_m": FARTHEST_M, "footprints": footprints,
            "facades": facades, "views": views}


def write_plan(path, east_m=0, north_m=0):
    path.parent.mkdir(exist_ok=True)
    path.write_text(json.dumps(make_plan(east_m, north_m)))


if __name__ == "__main__":
    write_plan(pathlib.Path(sys.argv[1]), *map(float, sys.argv[2:4]))
