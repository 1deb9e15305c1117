#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fits what the energy model of plan/path/energy.cpp cannot take from a data sheet, and says how far
it can be believed.

  bench/fit_energy.py

Data: the fourteen flights of a Mavic 3E in Xiong et al., "Aerial Path Planning for Urban Geometry
and Texture Co-Capture" (2025), table "Comparison of battery consumption under identical flight
paths" (2) and table "Quantitative comparison and statistics on the planning ... of real scenes"
(12). Free: seconds of a stop (slowing down, coming to
rest, speeding up), seconds a photo, percent of a battery a minute.
Least squares of the relative errors of energy and time together; each flight left out in turn.
"""
import math

# Site, method, metres, hovers, photos, percent of a battery, minutes.
FLIGHTS = (
    ("campus", "250", 895, 250, 250, 86, 29), ("campus", "119", 895, 119, 250, 57, 16),
    ("Hitech", "OP", 2085, 72, 360, 44, 13), ("Hitech", "DS", 7629, 567, 567, 214, 76),
    ("Hitech", "Ours", 2806, 87, 347, 51, 15), ("ArtSci", "OP", 4908, 97, 485, 103, 31),
    ("ArtSci", "DS", 20498, 1722, 1722, 825, 241), ("ArtSci", "Ours", 9737, 302, 1121, 206, 63),
    ("Polytech", "OP", 6261, 240, 1200, 140, 45), ("Polytech", "DS", 18521, 1337, 1337, 530, 162),
    ("Polytech", "Ours", 10499, 334, 1252, 212, 65), ("SEng", "OP", 5960, 220, 1100, 123, 38),
    ("SEng", "DS", 26248, 1850, 1850, 783, 217), ("SEng", "Ours", 11710, 417, 1559, 230, 74))
SPEED, WIND = 5, 3  # PlannedPace; the paper tells none of them
TOP_AIRSPEED, TOP_DRAG = 15, math.tan(math.radians(30))  # data sheet of the Mavic 3E
WEIGHT_N, BATTERY_J, EFFICIENCY = 0.939 * 9.81, 77 * 3600, 0.6


def power_factor(airspeed, percent_per_min):
    """PowerFactor of plan/path/energy.cpp."""
    hover_w = percent_per_min / 100 * BATTERY_J / 60
    drag = TOP_DRAG * (airspeed / TOP_AIRSPEED) ** 2
    return (1 + drag * drag) ** 0.75 + drag * WEIGHT_N * airspeed / (EFFICIENCY * hover_w)


def predict(flight, constants, speed=SPEED):
    """Percent and minutes."""
    stop_s, photo_s, percent_per_min = constants
    length, hovers, photos = flight[2:5]
    moving = length / speed / 60
    resting = (hovers * stop_s + photos * photo_s) / 60
    airspeeds = (speed + WIND, abs(speed - WIND), math.hypot(speed, WIND), math.hypot(speed, WIND))
    moving_factor = sum(power_factor(v, percent_per_min) for v in airspeeds) / 4
    resting_factor = power_factor(WIND, percent_per_min)
    return (percent_per_min * (moving_factor * moving + resting_factor * resting),
            moving + resting)


def errors(flight, constants, speed=SPEED):
    energy, minutes = predict(flight, constants, speed)
    return energy / flight[5] - 1, minutes / flight[6] - 1


def fit(flights, speed=SPEED, photo_s=None):
    """Pattern search: three constants, none below 0; `photo_s` given is held."""
    def squares(constants):
        return sum(e * e for f in flights for e in errors(f, constants, speed))

    constants = [5, 0.5 if photo_s is None else photo_s, 3]
    free = (0, 1, 2) if photo_s is None else (0, 2)
    best, step = squares(constants), [1, 0.5, 0.3]
    while max(step) > 1e-5:
        moved = False
        for i in free:
            for sign in (1, -1):
                trial = list(constants)
                trial[i] = max(1e-9, trial[i] + sign * step[i])
                value = squares(trial)
                if value < best - 1e-15:
                    constants, best, moved = trial, value, True
        if not moved:
            step = [s / 2 for s in step]
    return constants


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def mean_errors(pairs):
    """Mean of the absolute errors of energy and of time, percent."""
    pairs = list(pairs)
    return tuple(100 * mean(abs(p[i]) for p in pairs) for i in (0, 1))


def left_out(**args):
    return [errors(f, fit([g for g in FLIGHTS if g is not f], **args), args.get("speed", SPEED))
            for f in FLIGHTS]


def with_site_factors(found):
    """Mean error of energy that is left when every site may have a factor of its own."""
    left = 0
    for site in dict.fromkeys(f[0] for f in FLIGHTS):
        ratios = [1 + e[0] for f, e in zip(FLIGHTS, found) if f[0] == site]
        left += min(sum(abs(factor / 1000 * r - 1) for r in ratios) for factor in range(700, 1400))
    return 100 * left / len(FLIGHTS)


def same_proportions():
    """Least mean error of any model in which more photos do not cost less, and a flight of k times
    the metres, hovers and photos costs k times as much, for two flights of one site each."""
    small = next(f for f in FLIGHTS if f[:2] == ("Hitech", "Ours"))
    large = next(f for f in FLIGHTS if f[:2] == ("ArtSci", "Ours"))
    k = max(l / s for l, s in zip(large[2:5], small[2:5]))
    at_most = k * small[5]  # what the small flight says of the large one
    return k, at_most, large[5], 100 * (large[5] - at_most) / (large[5] + at_most)


def main():
    constants = fit(FLIGHTS)
    found = [errors(f, constants) for f in FLIGHTS]
    print("{:.2f} s a stop, {:.2f} s a photo, {:.3f} % of a battery a minute"
          .format(*constants))
    print("flight           energy %  model  error    min  model  error")
    for flight, (energy, minutes) in zip(FLIGHTS, found):
        print(f"{flight[0]:9}{flight[1]:5}{flight[5]:10}{flight[5] * (1 + energy):7.0f}"
              f"{100 * energy:+6.0f} %{flight[6]:7}{flight[6] * (1 + minutes):7.0f}"
              f"{100 * minutes:+6.0f} %")
    print("mean error: energy {:.1f} %, time {:.1f} %".format(*mean_errors(found)))
    print("mean error of each flight, fitted without it: energy {:.1f} %, time {:.1f} %"
          .format(*mean_errors(left_out())))
    print("with a factor for each site besides: energy {:.1f} %".format(with_site_factors(found)))
    print("Hitech Ours taken {:.2f} times is ArtSci Ours or more, and costs {:.0f} % where that costs "
          "{} %: at least {:.1f} % off on the two".format(*same_proportions()))
    for photo_s in (1, 2.2):
        fixed = fit(FLIGHTS, photo_s=photo_s)
        print("{} s a photo held: energy {:.1f} %, time {:.1f} %".format(
            photo_s, *mean_errors(errors(f, fixed) for f in FLIGHTS)))
    ours = (constants[0], 2.2, constants[2])
    print("2.2 s a photo beside the stops and minutes above, as plans of ours count: energy {:.1f} %, "
          "time {:.1f} %".format(*mean_errors(errors(f, ours) for f in FLIGHTS)))
    for speed in (4, 6, 8):
        other = fit(FLIGHTS, speed=speed)
        print("{} m/s instead of {}: energy {:.1f} %, time {:.1f} %; left out {:.1f} %, {:.1f} %"
              .format(speed, SPEED, *mean_errors(errors(f, other, speed) for f in FLIGHTS),
                      *mean_errors(left_out(speed=speed))))


if __name__ == "__main__":
    main()
