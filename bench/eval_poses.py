#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Position and rotation errors of a COLMAP text model against true cameras.

  bench/eval_poses.py MODEL TRUTH [--json]

MODEL holds images.txt. TRUTH holds either images.txt (COLMAP) or one <photo>.camera file per photo
(Strecha et al., "On Benchmarking Camera Calibration and Multi-View Stereo", CVPR 2008). Positions
are compared after the least-squares similarity of the camera centres (Umeyama 1991), so that
neither side needs to know the other's world frame; errors are in the unit of the truth (metres).
"""
import argparse
import dataclasses
import json
import pathlib
import sys

import numpy as np


@dataclasses.dataclass
class PosedCamera:
    """One camera: world_from_cam rotation and centre."""
    rotation: np.ndarray
    centre: np.ndarray


def rotation_from_quaternion(w, x, y, z):
    norm = np.sqrt(w * w + x * x + y * y + z * z)
    if not norm > 0:
        raise ValueError("quaternion of length 0")
    w, x, y, z = w / norm, x / norm, y / norm, z / norm
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def read_colmap(path):
    """images.txt: a line of pose and name, then a line of observations that may be empty."""
    cameras = {}
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    for number, line in enumerate(lines[0::2]):
        fields = line.split(maxsplit=9)
        if not fields:
            continue
        if len(fields) < 10:
            raise ValueError(f"{path}: photo {number + 1} has {len(fields)} fields instead of 10")
        world_from_cam = rotation_from_quaternion(*map(float, fields[1:5])).T
        translation = np.array([float(value) for value in fields[5:8]])
        name = pathlib.PurePosixPath(fields[9]).name
        cameras[name] = PosedCamera(world_from_cam, -world_from_cam @ translation)
    return cameras


def read_strecha(folder):
    """K (9 numbers), distortion (3), world_from_cam rotation (9), centre (3), size (2)."""
    cameras = {}
    for path in sorted(folder.glob("*.camera")):
        numbers = [float(word) for word in path.read_text().split()]
        if len(numbers) < 24:
            raise ValueError(f"{path}: {len(numbers)} numbers instead of 26")
        cameras[path.name[: -len(".camera")]] = PosedCamera(
            np.array(numbers[12:21]).reshape(3, 3), np.array(numbers[21:24]))
    return cameras


def read_truth(folder):
    if (folder / "images.txt").exists():
        return read_colmap(folder / "images.txt")
    cameras = read_strecha(folder)
    if not cameras:
        raise ValueError(f"{folder}: neither images.txt nor *.camera files")
    return cameras


def align(source, target):
    """Scale, rotation, translation with target ~ scale * rotation * source + translation; n x 3."""
    source_mean, target_mean = source.mean(axis=0), target.mean(axis=0)
    source_centred, target_centred = source - source_mean, target - target_mean
    u, d, vt = np.linalg.svd(target_centred.T @ source_centred / len(source))
    if len(source) < 3 or d[1] < 1e-12 * max(d[0], 1e-300):
        raise ValueError("needs three camera positions that are not on one line")
    signs = np.array([1, 1, np.sign(np.linalg.det(u) * np.linalg.det(vt))])
    rotation = u @ np.diag(signs) @ vt
    scale = (d * signs).sum() / (source_centred**2).sum(axis=1).mean()
    return scale, rotation, target_mean - scale * rotation @ source_mean


def angle_deg(rotation):
    """Exact for small angles too, where the arc cosine of the trace is not."""
    axis = np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0],
                     rotation[1, 0] - rotation[0, 1]])
    return float(np.degrees(np.arctan2(np.linalg.norm(axis), np.trace(rotation) - 1)))


def compare(estimated, truth):
    """Errors of the photos that both sides have."""
    names = [name for name in truth if name in estimated]
    if len(names) < 3:
        raise ValueError(f"only {len(names)} photos in common with the truth")
    scale, rotation, translation = align(np.array([estimated[n].centre for n in names]),
                                         np.array([truth[n].centre for n in names]))
    errors = np.array([
        np.linalg.norm(scale * rotation @ estimated[n].centre + translation - truth[n].centre)
        for n in names])
    angles = np.array([angle_deg(truth[n].rotation.T @ rotation @ estimated[n].rotation)
                       for n in names])
    return {
        "posed": len(names), "total": len(truth),
        "missing": [n for n in truth if n not in estimated],
        "position_mean_m": float(errors.mean()), "position_median_m": float(np.median(errors)),
        "position_rms_m": float(np.sqrt((errors**2).mean())),
        "position_max_m": float(errors.max()), "position_worst": names[int(errors.argmax())],
        "rotation_mean_deg": float(angles.mean()), "rotation_max_deg": float(angles.max()),
        "scale": float(scale),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", type=pathlib.Path)
    parser.add_argument("truth", type=pathlib.Path)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    try:
        result = compare(read_colmap(arguments.model / "images.txt"), read_truth(arguments.truth))
    except (OSError, ValueError) as error:
        print(f"eval_poses: {error}", file=sys.stderr)
        return 3
    if arguments.json:
        print(json.dumps(result, indent=1))
        return 0
    print(f"posed {result['posed']} of {result['total']}, scale {result['scale']:.6f}")
    if result["missing"]:
        print("missing: " + " ".join(result["missing"]))
    print("position (mm): mean {:.3f}, median {:.3f}, rms {:.3f}, max {:.3f} ({})".format(
        *(1000 * result[f"position_{k}_m"] for k in ("mean", "median", "rms", "max")),
        result["position_worst"]))
    print(f"rotation (deg): mean {result['rotation_mean_deg']:.5f}, "
          f"max {result['rotation_max_deg']:.5f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
