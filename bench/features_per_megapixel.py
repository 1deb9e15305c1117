#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares how much texture sets of photos have: made-up ones should be like real ones.

  bench/features_per_megapixel.py FOLDER... [--most N] [--scale S] [--json OUT]

Of every JPEG and PNG in each folder (at most N, spread over the folder; all unless said), scaled by
S (1 unless said): SIFT keypoints per megapixel, found as `calib` finds them; contrast, the standard
deviation of grey in shares of white; and the slope of the power spectrum over frequency, both
logarithms, about -2 to -3 in photos (Field, "Relations between the statistics of natural images and
the response properties of cortical cells", 1987). One line a folder: medians and the range of
keypoints, and the ratio to the first folder's.

Needs apt-get install python3-opencv, which Stucco itself does not.
"""
import argparse
import json
import pathlib
import statistics

# As in calib/features/features.cpp.
LAYERS, CONTRAST, EDGE, SIGMA = 3, 0.02, 10, 1.6


def photos_of(folder, most):
    photos = sorted(path for path in pathlib.Path(folder).iterdir()
                    if path.suffix.lower() in (".jpg", ".jpeg", ".png"))
    if not photos:
        raise SystemExit(f"{folder}: no JPEG or PNG")
    if not most or len(photos) <= most:
        return photos
    return [photos[i * len(photos) // most] for i in range(most)]


def spectrum_slope(grey):
    import numpy
    side = min(512, *grey.shape)
    window = numpy.outer(numpy.hanning(side), numpy.hanning(side))
    frequencies = numpy.fft.fftfreq(side)
    radius = numpy.hypot(*numpy.meshgrid(frequencies, frequencies))
    lows = numpy.geomspace(4 / side, 0.27, 8)
    power = numpy.zeros(len(lows))
    for top in range(0, grey.shape[0] - side + 1, side):
        for left in range(0, grey.shape[1] - side + 1, side):
            patch = grey[top:top + side, left:left + side]
            energy = abs(numpy.fft.fft2((patch - patch.mean()) * window)) ** 2
            power += [energy[(radius >= low) & (radius < 1.5 * low)].mean() for low in lows]
    return float(numpy.polyfit(numpy.log(lows), numpy.log(power + 1e-12), 1)[0])


def measure(path, scale):
    import cv2
    image = cv2.imread(str(path))
    if image is None:
        raise SystemExit(f"{path}: cannot be read")
    grey = cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    if scale != 1:
        grey = cv2.resize(grey, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    sift = cv2.SIFT_create(nfeatures=0, nOctaveLayers=LAYERS, contrastThreshold=CONTRAST,
                           edgeThreshold=EDGE, sigma=SIGMA)
    share = grey.astype(float) / 255
    return {"photo": path.name, "per_megapixel": len(sift.detect(grey, None)) * 1e6 / grey.size,
            "contrast": float(share.std()), "slope": spectrum_slope(share)}


def summary(rows, reference):
    counts = [row["per_megapixel"] for row in rows]
    middle = statistics.median(counts)
    return {"photos": len(rows), "per_megapixel": middle, "least": min(counts),
            "most": max(counts), "contrast": statistics.median(row["contrast"] for row in rows),
            "slope": statistics.median(row["slope"] for row in rows),
            "ratio": middle / reference if reference else 1.0}


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--most", type=int, default=0)
    parser.add_argument("--scale", type=float, default=1)
    parser.add_argument("--json")
    args = parser.parse_args()
    results = {}
    reference = 0
    print("per megapixel (least to most)  contrast  slope  ratio  folder")
    for folder in args.folders:
        rows = [measure(path, args.scale) for path in photos_of(folder, args.most)]
        result = summary(rows, reference)
        reference = reference or result["per_megapixel"]
        results[folder] = {**result, "rows": rows}
        print(f"{result['per_megapixel']:13.0f} ({result['least']:5.0f} to {result['most']:5.0f})"
              f"  {result['contrast']:8.3f}  {result['slope']:5.2f}  {result['ratio']:5.2f}  {folder}")
    if args.json:
        pathlib.Path(args.json).write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    main()
