# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surface textures of the sample scene: public-domain facade pictures, enlarged and given the fine
structure (bricks, tiles, stains, grain) that a photo from a few metres away would show.

Textures are float32 arrays of linear light, rows downwards.
"""
import pathlib

import numpy as np
from PIL import Image


def to_linear(srgb):
    return np.power(np.clip(srgb, 0.0, 1.0), 2.2).astype(np.float32)


def to_srgb(linear):
    return np.power(np.clip(linear, 0.0, 1.0), 1 / 2.2).astype(np.float32)


def resized(plane, width, height):
    return np.asarray(Image.fromarray(plane.astype(np.float32), "F").resize(
        (width, height), Image.BICUBIC))


def resized_rgb(picture, width, height):
    return np.stack([resized(picture[..., c], width, height) for c in range(3)], axis=-1)


def load(path):
    return np.asarray(Image.open(path).convert("RGB"), np.float32) / 255


def noise(rng, width, height, cell):
    """Smooth noise of unit standard deviation with blobs of about `cell` texels."""
    coarse = rng.standard_normal((int(height / cell) + 3, int(width / cell) + 3))
    plane = resized(coarse, int(coarse.shape[1] * cell), int(coarse.shape[0] * cell))
    plane = plane[:height, :width]
    return plane / plane.std()


def grain(rng, width, height, texel_m):
    """Weathering from grains of 4 cm to stains of 2.5 m; the share of each size is chosen so that
    corners are found at every scale."""
    total = np.zeros((height, width), np.float32)
    for size_m, share in ((0.04, 0.03), (0.09, 0.08), (0.2, 0.08), (0.5, 0.06), (2.5, 0.06)):
        total += share * noise(rng, width, height, max(1.0, size_m / texel_m))
    return total


def blocks(rng, width, height, texel_m, block_m, joint_m, spread, stagger=True):
    """Brightness factor of a wall of blocks: every block with its own shade, darker joints."""
    y, x = np.mgrid[0:height, 0:width].astype(np.float32) * texel_m
    row = (y / block_m[1]).astype(int)
    shifted = x + (row % 2) * (block_m[0] / 2 if stagger else 0)
    column = (shifted / block_m[0]).astype(int)
    shades = 1 + spread * rng.standard_normal((row.max() + 1, column.max() + 1))
    factor = shades[row, column].astype(np.float32)
    in_joint = (y - row * block_m[1] < joint_m) | (shifted - column * block_m[0] < joint_m)
    return np.where(in_joint, 0.78, factor)


def minmod(a, b):
    return np.where(a * b > 0, np.sign(a) * np.minimum(np.abs(a), np.abs(b)), 0)


def sharpened(picture, rounds):
    """Shock filter (Osher and Rudin, 1990): makes the soft edges of an enlarged picture crisp. The
    minmod slopes keep it from ringing."""
    for _ in range(rounds):
        wide = np.pad(picture, ((1, 1), (1, 1), (0, 0)), mode="edge")
        up, down = picture - wide[:-2, 1:-1], wide[2:, 1:-1] - picture
        left, right = picture - wide[1:-1, :-2], wide[1:-1, 2:] - picture
        slope = np.hypot(minmod(up, down), minmod(left, right))
        laplacian = (down - up + right - left).mean(axis=-1, keepdims=True)
        picture = picture - 0.4 * np.tanh(60 * laplacian) * slope
    return np.clip(picture, 0, 1)


def facade(rng, source, width_m, height_m, gable_m, texel_m, stone):
    """A wall of width_m x (gable_m + height_m): the picture fills the rectangle below the gable, the
    gable goes on in the picture's wall colour."""
    columns, rows = int(round(width_m / texel_m)), int(round(height_m / texel_m))
    picture = load(source)
    larger = resized_rgb(picture, columns // 2, rows // 2)
    picture = resized_rgb(sharpened(larger, 12), columns, rows)
    gable_rows = int(round(gable_m / texel_m))
    if gable_rows:
        # The wall between the windows is what is common in the picture: its median colour.
        upper = picture[: rows // 2].reshape(-1, 3)
        colour = np.median(upper, axis=0)
        picture = np.concatenate([np.broadcast_to(colour, (gable_rows, columns, 3)), picture])
    height, width = picture.shape[:2]
    detail = 1 + grain(rng, width, height, texel_m)
    detail *= blocks(rng, width, height, texel_m, stone, 0.02, 0.11)
    lit = to_linear(picture) * detail[..., None]
    # Glass and dark parts are not black: they mirror a blotchy sky.
    lit += 0.025 * np.clip(1 + noise(rng, width, height, 0.15 / texel_m), 0, 3)[..., None]
    return lit.astype(np.float32)


def roof(rng, width_m, height_m, colour, texel_m):
    """Rows of overlapping tiles, each tile with a shade of its own and a shadow below its edge."""
    width, height = int(round(width_m / texel_m)), int(round(height_m / texel_m))
    y = (np.arange(height, dtype=np.float32) * texel_m)[:, None]
    shade = blocks(rng, width, height, texel_m, (0.22, 0.34), 0.025, 0.17)
    shade = shade * (0.82 + 0.36 * ((y / 0.34) % 1))
    shade = shade * (1 + grain(rng, width, height, texel_m))
    return (to_linear(np.array(colour)) * shade[..., None]).astype(np.float32)


def tiled(picture, picture_m, width_m, height_m, texel_m):
    """Repeats a picture of size picture_m over an area."""
    tile = resized_rgb(picture, int(picture_m[0] / texel_m), int(picture_m[1] / texel_m))
    height, width = int(round(height_m / texel_m)), int(round(width_m / texel_m))
    repeat = (height // tile.shape[0] + 1, width // tile.shape[1] + 1, 1)
    return np.tile(tile, repeat)[:height, :width]


def ground(rng, folder, size_m, texel_m, terraces):
    """Lawn with bare patches, a street in the south, paved terraces (rectangles given by centre,
    half sizes and yaw) around the houses."""
    folder = pathlib.Path(folder)
    n = int(round(size_m / texel_m))
    lawn_mix = np.clip(0.5 + 0.28 * noise(rng, n, n, 1.3 / texel_m)
                       + 0.25 * noise(rng, n, n, 0.35 / texel_m), 0, 1)[..., None]
    area = lawn_mix * np.array([0.40, 0.47, 0.24]) + (1 - lawn_mix) * np.array([0.50, 0.46, 0.34])
    area = to_linear(area)
    ticks = (np.arange(n, dtype=np.float32) + 0.5) * texel_m - size_m / 2
    x, y = ticks[None, :], -ticks[:, None]
    asphalt = tiled(load(folder / "asphalt.jpg"), (10, 15), size_m, size_m, texel_m)
    street = (y < -19) & (y > -26)
    area = np.where(street[..., None], to_linear(0.12 + 0.55 * asphalt), area)
    paint = (np.abs(y + 22.5) < 0.08) & ((x % 4) < 2.2)
    area = np.where(paint[..., None], np.float32(0.7), area)
    stones = tiled(load(folder / "stonewall.jpg"), (3.2, 3.2), size_m, size_m, texel_m)
    stones = to_linear(0.25 + 0.6 * stones) * blocks(
        rng, n, n, texel_m, (0.6, 0.6), 0.03, 0.15, stagger=False)[..., None]
    for (cx, cy), (half_x, half_y), yaw in terraces:
        c, s = np.cos(yaw), np.sin(yaw)
        inside = ((np.abs(c * (x - cx) + s * (y - cy)) < half_x)
                  & (np.abs(-s * (x - cx) + c * (y - cy)) < half_y))
        area = np.where(inside[..., None], stones, area)
    blades = 0.05 * noise(rng, n, n, 1.7) + 0.8 * grain(rng, n, n, texel_m)
    return (area * np.clip(1 + blades, 0.1, 3)[..., None]).astype(np.float32)


def pyramid(texture, levels=6):
    """Box-filtered halvings of a texture for sampling without aliasing."""
    out = [np.clip(texture, 0, 1)]
    for _ in range(levels - 1):
        t = out[-1]
        if min(t.shape[:2]) < 4:
            break
        t = t[: t.shape[0] // 2 * 2, : t.shape[1] // 2 * 2]
        out.append((t[0::2, 0::2] + t[1::2, 0::2] + t[0::2, 1::2] + t[1::2, 1::2]) / 4)
    return out
