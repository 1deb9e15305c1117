#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A point cloud from the exact depth maps of a simulated flight, to try the model's stage alone.

Usage: true_cloud.py SURVEY CLOUD_PLY [--step 2] [--noise 0.02] [--holes 0.2] [--seed 1]

SURVEY was flown with --write-depth. Every step-th pixel of each map becomes a point that its photo
sees, moved along its ray by the noise (metres, one standard deviation); of a share of all squares of
16 pixels no point is taken. The cloud is in the frame of truth/sparse: import both.
"""
import argparse
import array
import json
import pathlib
import random
import struct


def undistorted(params, x, y):
    """The ray of a pixel of COLMAP's OPENCV camera, by fixed-point iteration."""
    fx, fy, cx, cy, k1, k2, p1, p2 = params
    u = a = (x - cx) / fx
    v = b = (y - cy) / fy
    for _ in range(12):
        r = u * u + v * v
        radial = k1 * r + k2 * r * r
        u = a - u * radial - 2 * p1 * u * v - p2 * (r + 2 * u * u)
        v = b - v * radial - 2 * p2 * u * v - p1 * (r + 2 * v * v)
    return u, v


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("survey", type=pathlib.Path)
    parser.add_argument("cloud", type=pathlib.Path)
    parser.add_argument("--step", type=int, default=2)
    parser.add_argument("--noise", type=float, default=0.02)
    parser.add_argument("--holes", type=float, default=0.2)
    parser.add_argument("--seed", type=int, default=1)
    wanted = parser.parse_args()
    dice = random.Random(wanted.seed)
    flight = json.loads((wanted.survey / "truth/flight.json").read_text())
    ids = {}
    for line in (wanted.survey / "truth/sparse/images.txt").read_text().splitlines():
        words = line.split()
        if len(words) == 10 and not line.startswith("#"):
            ids[words[9]] = int(words[0])
    rays, body, count = {}, bytearray(), 0
    for photo in flight["photos"]:
        path = wanted.survey / "truth/depth" / f"{photo['path']}.dmap"
        if photo["path"] not in ids or not path.exists():
            continue
        data = path.read_bytes()
        width, height = struct.unpack("<ii", data[4:12])
        depths = array.array("f", data[12:12 + 4 * width * height])
        camera = photo["camera"]
        if camera not in rays:
            params = flight["cameras"][camera]["params"]
            rays[camera] = [(x, y) + undistorted(params, x + 0.5, y + 0.5)
                            for y in range(0, height, wanted.step)
                            for x in range(0, width, wanted.step)]
        w, i, j, k = photo["rotation"]
        r = [[1 - 2 * (j * j + k * k), 2 * (i * j - w * k), 2 * (i * k + w * j)],
             [2 * (i * j + w * k), 1 - 2 * (i * i + k * k), 2 * (j * k - w * i)],
             [2 * (i * k - w * j), 2 * (j * k + w * i), 1 - 2 * (i * i + j * j)]]
        t = photo["translation"]
        hole = {(a, b) for a in range(width // 16 + 1) for b in range(height // 16 + 1)
                if dice.random() < wanted.holes}
        for x, y, u, v in rays[camera]:
            depth = depths[y * width + x]
            if not 0 < depth < 200 or (x // 16, y // 16) in hole:
                continue
            depth += dice.gauss(0, wanted.noise)
            q = (u * depth - t[0], v * depth - t[1], depth - t[2])
            p = [sum(r[c][a] * q[c] for c in range(3)) for a in range(3)]
            body += struct.pack("<fffBI", *p, 1, ids[photo["path"]])
            count += 1
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {count}\nproperty float x\nproperty float y\nproperty float z\n"
              "property list uchar uint view_indices\nend_header\n")
    wanted.cloud.write_bytes(header.encode() + bytes(body))
    print(f"{count} points")


if __name__ == "__main__":
    main()
