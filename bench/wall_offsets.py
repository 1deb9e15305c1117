#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""How far each wall of a simulated survey's model stands from the true one.

Usage: wall_offsets.py SURVEY SCENE

SURVEY was flown by `stucco simulate` in SCENE, and has a model. Outwards of the true wall, metres,
after the similarity between both sets of camera centres; planes of 5 m2 or more.
"""
import json
import pathlib
import sys

import numpy as np

LEAST_AREA_M2 = 5
ALIKE = 0.98     # cosine between normals
NEAR_M = 3.5     # between middles
SAME_M = 0.5     # what is farther off is another wall


def rotation(w, x, y, z):
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def centres(images):
    """By photo, of a COLMAP images.txt."""
    lines = [line for line in images.read_text().splitlines() if not line.startswith("#")]
    out = {}
    for line in lines[::2]:
        words = line.split()
        pose = [float(word) for word in words[1:8]]
        out[words[9]] = -rotation(*pose[:4]).T @ np.array(pose[4:])
    return out


def similarity(source, target):
    """(scale, rotation, translation), Umeyama 1991."""
    a, b = source - source.mean(0), target - target.mean(0)
    u, sizes, v = np.linalg.svd(b.T @ a)
    turn = np.diag([1, 1, np.sign(np.linalg.det(u @ v))])
    scale = (sizes * np.diag(turn)).sum() / (a ** 2).sum()
    return scale, u @ turn @ v, target.mean(0) - scale * u @ turn @ v @ source.mean(0)


def walls(facets):
    return [facet for building in json.loads(facets.read_text())["buildings"]
            for facet in building["facets"]
            if facet["class"] == "WallSurface" and facet["area_m2"] >= LEAST_AREA_M2]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    survey, scene = map(pathlib.Path, sys.argv[1:])
    found = centres(survey / "calib/sparse/0/images.txt")
    true = centres(next((survey / "truth/sparse").rglob("images.txt")))
    names = sorted(found.keys() & true.keys())
    scale, turn, shift = similarity(np.array([found[name] for name in names]),
                                    np.array([true[name] for name in names]))
    offsets = []
    for wall in walls(survey / "proxy/facets.json"):
        corners = scale * np.array(wall["outer"]) @ turn.T + shift
        off = [(corners @ np.array(other["normal"]) - other["offset"]).mean()
               for other in walls(scene / "truth/facets.json")
               if turn @ np.array(wall["normal"]) @ np.array(other["normal"]) > ALIKE
               and np.linalg.norm(np.mean(other["outer"], 0) - corners.mean(0)) < NEAR_M]
        nearest = min(off, key=abs, default=SAME_M)
        if abs(nearest) >= SAME_M:
            continue
        offsets.append(abs(nearest))
        print(f"{wall['id']:16} {nearest:7.3f}  seen {wall['seen']:.2f}")
    if not offsets:
        sys.exit("no wall of the model stands where a true one does")
    print(f"{len(offsets)} walls: mean {np.mean(offsets):.4f} m, largest {max(offsets):.3f} m")


if __name__ == "__main__":
    main()
