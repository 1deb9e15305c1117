#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders data/sample anew: photos with EXIF and XMP as a drone writes them, and the truth.

Needs python3-numpy, python3-pil and libimage-exiftool-perl. The same packages give the same bytes.

  scripts/sample/make_sample.py OUT [--source data/sample/source]
"""
import argparse
import json
import pathlib
import subprocess

import numpy as np
from PIL import Image

import camera
import scene

ORIGIN_DEG = (47.0500, 15.4000)  # WGS 84; an open field in the maths, not a place that was flown
ORIGIN_HEIGHT_M = 412.0
GPS_SIGMA_M = (0.6, 0.6, 0.8)
GIMBAL_SIGMA_DEG = (0.6, 0.2)
JPEG_QUALITY = 90


def geodetic(enu):
    """Local east, north, up -> WGS 84, through earth-centred coordinates (Farrell and Barth 1999)."""
    a, f = 6378137.0, 1 / 298.257223563
    e2 = f * (2 - f)
    lat, lon = np.radians(ORIGIN_DEG)
    n = a / np.sqrt(1 - e2 * np.sin(lat) ** 2)
    h = ORIGIN_HEIGHT_M
    origin = np.array([(n + h) * np.cos(lat) * np.cos(lon), (n + h) * np.cos(lat) * np.sin(lon),
                       (n * (1 - e2) + h) * np.sin(lat)])
    east = np.array([-np.sin(lon), np.cos(lon), 0])
    north = np.array([-np.sin(lat) * np.cos(lon), -np.sin(lat) * np.sin(lon), np.cos(lat)])
    up = np.array([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)])
    x, y, z = origin + enu[0] * east + enu[1] * north + enu[2] * up
    p, phi, height = np.hypot(x, y), lat, h
    for _ in range(10):
        n = a / np.sqrt(1 - e2 * np.sin(phi) ** 2)
        height = p / np.cos(phi) - n
        phi = np.arctan2(z, p * (1 - e2 * n / (n + height)))
    return np.degrees(phi), np.degrees(np.arctan2(y, x)), height


def write_metadata(path, view, index, rng):
    """EXIF and the drone-dji part of XMP: a focal length, a noisy position, gimbal angles."""
    measured = view.centre + rng.normal(0, GPS_SIGMA_M)
    lat, lon, height = geodetic(measured)
    yaw = (view.yaw_deg + rng.normal(0, GIMBAL_SIGMA_DEG[0]) + 180) % 360 - 180
    pitch = max(-90.0, view.pitch_deg + rng.normal(0, GIMBAL_SIGMA_DEG[1]))
    minute, second = divmod(index * 7, 60)
    when = f"2026:03:01 10:{minute:02d}:{second:02d}"
    tags = {
        "EXIF:Make": "DJI", "EXIF:Model": "FC-SAMPLE", "EXIF:FocalLength": 4.5,
        "EXIF:FocalLengthIn35mmFormat": 24, "EXIF:FNumber": 2.8, "EXIF:ISO": 100,
        "EXIF:ExposureTime": "1/800", "EXIF:DateTimeOriginal": when, "EXIF:CreateDate": when,
        "EXIF:Orientation#": 1, "EXIF:Software": "Stucco sample renderer",
        "EXIF:GPSLatitude": f"{lat:.9f}", "EXIF:GPSLatitudeRef": "N",
        "EXIF:GPSLongitude": f"{lon:.9f}", "EXIF:GPSLongitudeRef": "E",
        "EXIF:GPSAltitude": f"{height:.3f}", "EXIF:GPSAltitudeRef#": 0,
        "EXIF:GPSMapDatum": "WGS-84",
        "XMP-drone-dji:AbsoluteAltitude": f"{height:+.2f}",
        "XMP-drone-dji:RelativeAltitude": f"{measured[2]:+.2f}",
        "XMP-drone-dji:GimbalRollDegree": "+0.00",
        "XMP-drone-dji:GimbalYawDegree": f"{yaw:+.2f}",
        "XMP-drone-dji:GimbalPitchDegree": f"{pitch:+.2f}",
        "XMP-drone-dji:FlightRollDegree": "+0.00",
        "XMP-drone-dji:FlightYawDegree": f"{yaw:+.2f}",
        "XMP-drone-dji:FlightPitchDegree": "+0.00",
    }
    subprocess.run(["exiftool", "-q", "-overwrite_original", "-P",
                    *(f"-{name}={value}" for name, value in tags.items()), str(path)], check=True)


def quaternion(rotation):
    """w, x, y, z with w >= 0, from the eigenvector of Bar-Itzhack's matrix (2000)."""
    r = rotation
    k = np.array([
        [r[0, 0] - r[1, 1] - r[2, 2], r[1, 0] + r[0, 1], r[2, 0] + r[0, 2], r[2, 1] - r[1, 2]],
        [r[1, 0] + r[0, 1], r[1, 1] - r[0, 0] - r[2, 2], r[2, 1] + r[1, 2], r[0, 2] - r[2, 0]],
        [r[2, 0] + r[0, 2], r[2, 1] + r[1, 2], r[2, 2] - r[0, 0] - r[1, 1], r[1, 0] - r[0, 1]],
        [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], np.trace(r)]]) / 3
    x, y, z, w = np.linalg.eigh(k)[1][:, 3]
    q = np.array([w, x, y, z])
    return q if w >= 0 else -q


def write_cameras(folder, views):
    """COLMAP's text format without points; https://colmap.github.io/format.html"""
    (folder / "cameras.txt").write_text(
        f"1 RADIAL {camera.WIDTH} {camera.HEIGHT} {camera.FOCAL_PX} "
        f"{camera.CENTRE_PX[0]} {camera.CENTRE_PX[1]} {camera.K1} {camera.K2}\n")
    lines = []
    for i, view in enumerate(views):
        q = quaternion(view.cam_from_world)
        t = -view.cam_from_world @ view.centre
        numbers = " ".join(f"{value:.12g}" for value in (*q, *t))
        lines += [f"{i + 1} {numbers} 1 {view.name}", ""]
    (folder / "images.txt").write_text("\n".join(lines) + "\n")
    (folder / "points3D.txt").write_text("")


def write_planes(path, surfaces):
    def rounded(values):
        return np.round(np.asarray(values, float), 9).tolist()

    buildings = [{
        "id": house.name, "footprint_m": rounded(house.footprint()), "eave_m": house.eave,
        "ridge_m": house.ridge} for house in scene.HOUSES]
    planes = [{
        "id": s.name, "class": s.kind, "normal": rounded(s.normal),
        "offset": round(float(s.normal @ s.origin), 9),
        # Counter-clockwise seen from outside; the texture's frame turns the other way.
        "outer": rounded(s.world(s.polygon_uv)[::-1])} for s in surfaces if s.kind != "far"]
    truth = {"version": 1, "frame": "enu",
             "origin": {"latitude_deg": ORIGIN_DEG[0], "longitude_deg": ORIGIN_DEG[1],
                        "height_m": ORIGIN_HEIGHT_M},
             "up": [0, 0, 1], "buildings": buildings, "planes": planes}
    path.write_text(json.dumps(truth, indent=1) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--source", type=pathlib.Path,
                        default=pathlib.Path(__file__).parents[2] / "data/sample/source")
    arguments = parser.parse_args()
    photos, truth = arguments.out / "photos", arguments.out / "truth"
    photos.mkdir(parents=True, exist_ok=True)
    truth.mkdir(parents=True, exist_ok=True)
    surfaces = scene.build(arguments.source)
    views = camera.flight()
    write_cameras(truth, views)
    write_planes(truth / "planes.json", surfaces)
    rng = np.random.default_rng(7)
    rays = camera.sample_rays()
    for i, view in enumerate(views):
        path = photos / view.name
        Image.fromarray(camera.render(view, surfaces, rays)).save(
            path, "JPEG", quality=JPEG_QUALITY, optimize=True)
        write_metadata(path, view, i, rng)
        print(path, flush=True)


if __name__ == "__main__":
    main()
