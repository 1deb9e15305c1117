# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The virtual drone: where it takes photos, its lens, and how a photo is rendered."""
import dataclasses

import numpy as np

import textures

WIDTH, HEIGHT = 1000, 750
FOCAL_PX = 705.0
CENTRE_PX = (503.2, 372.9)
K1, K2 = -0.035, 0.012  # COLMAP's RADIAL model
SAMPLES = 3  # along each side of a pixel


@dataclasses.dataclass
class View:
    name: str
    centre: np.ndarray
    cam_from_world: np.ndarray  # rotation
    yaw_deg: float  # clockwise from north
    pitch_deg: float  # 0 level, -90 down
    exposure: float


def view_at(name, centre, target, exposure):
    centre, forward = np.array(centre, float), np.subtract(target, centre).astype(float)
    forward /= np.linalg.norm(forward)
    right = np.array([forward[1], -forward[0], 0.0])
    right /= np.linalg.norm(right)
    rotation = np.stack([right, np.cross(forward, right), forward])
    return View(name, centre, rotation, np.degrees(np.arctan2(forward[0], forward[1])) % 360,
                np.degrees(np.arcsin(forward[2])), exposure)


def flight():
    """Two rings around the houses and four looks from above; every neighbour shares well over 70 %
    of the scene."""
    places = []
    for i in range(16):
        a = 2 * np.pi * (i + 0.3) / 16
        places.append(((28 * np.sin(a), 1.5 + 22.5 * np.cos(a), 6.5 + 0.8 * np.sin(3 * a)),
                       (1.5 * np.sin(a), 1.5 + 1.0 * np.cos(a), 3.4)))
    for i in range(8):
        a = 2 * np.pi * i / 8
        places.append(((22 * np.sin(a), 1.5 + 18.5 * np.cos(a), 18.5 + np.cos(2 * a)),
                       (1.0 * np.sin(a), 1.5, 2.0)))
    for x, y in ((-6, -3), (6, -3), (6.5, 5), (-5.5, 5)):
        places.append(((x, y, 29.0), (0.55 * x, 0.55 * y + 2.0, 0.0)))
    return [view_at(f"DJI_{i + 1:04d}.JPG", centre, target,
                    1.0 + 0.06 * np.sin(0.35 * i) + 0.015 * np.cos(2.3 * i))
            for i, (centre, target) in enumerate(places)]


def sample_rays():
    """x / z and y / z of every sample of a photo, lens distortion undone."""
    xs = ((np.arange(WIDTH * SAMPLES) + 0.5) / SAMPLES - CENTRE_PX[0]) / FOCAL_PX
    ys = ((np.arange(HEIGHT * SAMPLES) + 0.5) / SAMPLES - CENTRE_PX[1]) / FOCAL_PX
    x, y = np.meshgrid(xs, ys)
    ideal = np.linspace(0, 1.5, 20001)
    bent = ideal * (1 + K1 * ideal**2 + K2 * ideal**4)
    radius = np.hypot(x, y)
    scale = np.interp(radius, bent, ideal) / np.maximum(radius, 1e-12)
    return (x * scale).astype(np.float32), (y * scale).astype(np.float32)


def lookup(pyramid, column, row, level):
    """Bilinear texture values at texel coordinates of the finest level."""
    out = np.empty((len(column), 3), np.float32)
    level = np.clip(level, 0, len(pyramid) - 1)
    for i, texture in enumerate(pyramid):
        chosen = np.nonzero(level == i)[0]
        if not len(chosen):
            continue
        x = np.clip(column[chosen] / 2**i - 0.5, 0, texture.shape[1] - 1.001)
        y = np.clip(row[chosen] / 2**i - 0.5, 0, texture.shape[0] - 1.001)
        x0, y0 = x.astype(np.int32), y.astype(np.int32)
        fx, fy = (x - x0)[:, None], (y - y0)[:, None]
        upper = texture[y0, x0] * (1 - fx) + texture[y0, x0 + 1] * fx
        lower = texture[y0 + 1, x0] * (1 - fx) + texture[y0 + 1, x0 + 1] * fx
        out[chosen] = upper * (1 - fy) + lower * fy
    return out


def render(view, surfaces, rays):
    """A photo as 8-bit sRGB. Visibility by the nearest of all surfaces per sample."""
    x, y = rays
    depth = np.full(x.shape, np.inf, np.float32)
    owner = np.full(x.shape, -1, np.int8)
    for i, surface in enumerate(surfaces):
        from_plane = float((surface.origin - view.centre) @ surface.normal)
        if from_plane >= 0:
            continue  # seen from behind
        n, u, v = (view.cam_from_world @ axis
                   for axis in (surface.normal, surface.u_axis, surface.v_axis))
        along = (n[0] * x + n[1] * y + n[2]).astype(np.float32)
        t = np.where(along < -1e-6, from_plane / np.minimum(along, -1e-6), np.inf)
        rows, columns = np.nonzero((t > 0.1) & (t < depth))
        xs, ys, ts = x[rows, columns], y[rows, columns], t[rows, columns]
        offset = view.centre - surface.origin
        us = offset @ surface.u_axis + ts * (u[0] * xs + u[1] * ys + u[2])
        vs = offset @ surface.v_axis + ts * (v[0] * xs + v[1] * ys + v[2])
        inside = surface.contains(us, vs)
        depth[rows[inside], columns[inside]] = ts[inside]
        owner[rows[inside], columns[inside]] = i
    light = shade(view, surfaces, rays, depth, owner)
    light = light.reshape(HEIGHT, SAMPLES, WIDTH, SAMPLES, 3).mean(axis=(1, 3)) * view.exposure
    grain = np.random.default_rng(int(view.name[4:8])).normal(0, 0.4 / 255, light.shape)
    return np.clip(255 * (textures.to_srgb(light) + grain) + 0.5, 0, 255).astype(np.uint8)


def shade(view, surfaces, rays, depth, owner):
    x, y = rays
    length = np.sqrt(1 + x * x + y * y)
    up = view.cam_from_world @ np.array([0.0, 0.0, 1.0])
    height = np.clip((up[0] * x + up[1] * y + up[2]) / length, 0, 1)[..., None]
    horizon, zenith = np.array([0.62, 0.70, 0.78]), np.array([0.22, 0.38, 0.66])
    light = (horizon + (zenith - horizon) * np.sqrt(height)).astype(np.float32)
    for i, surface in enumerate(surfaces):
        rows, columns = np.nonzero(owner == i)
        if not len(rows):
            continue
        xs, ys, ts = x[rows, columns], y[rows, columns], depth[rows, columns]
        n, u, v = (view.cam_from_world @ axis
                   for axis in (surface.normal, surface.u_axis, surface.v_axis))
        offset = view.centre - surface.origin
        us = offset @ surface.u_axis + ts * (u[0] * xs + u[1] * ys + u[2])
        vs = offset @ surface.v_axis + ts * (v[0] * xs + v[1] * ys + v[2])
        cosine = -(n[0] * xs + n[1] * ys + n[2]) / length[rows, columns]
        footprint = ts / (FOCAL_PX * SAMPLES) / np.sqrt(np.maximum(cosine, 0.05))
        level = np.round(np.log2(np.maximum(footprint / surface.texel_m, 1))).astype(int)
        colour = lookup(surface.pyramid, us / surface.texel_m, vs / surface.texel_m, level)
        haze = np.clip(ts / 900, 0, 0.8)[:, None] if surface.kind == "far" else 0
        light[rows, columns] = colour * (1 - haze) + horizon.astype(np.float32) * haze
    return light
