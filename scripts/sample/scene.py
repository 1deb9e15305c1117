# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Geometry of the sample scene: two gabled houses on flat ground, in metres east, north, up."""
import dataclasses

import numpy as np

import textures

WALL_TEXEL_M = 0.0125
GROUND_TEXEL_M = 0.025
GROUND_SIZE_M = 72.0
SUN = np.array([-0.42, -0.62, 0.66]) / np.linalg.norm([-0.42, -0.62, 0.66])


@dataclasses.dataclass
class Surface:
    """A planar convex polygon. Texture column and row are (u, v) / texel_m, where a world point is
    origin + u * u_axis + v * v_axis; v runs downwards in the picture."""
    name: str
    kind: str
    origin: np.ndarray
    u_axis: np.ndarray
    v_axis: np.ndarray
    polygon_uv: np.ndarray
    texel_m: float
    texture: np.ndarray = None
    pyramid: list = None

    @property
    def normal(self):
        return -np.cross(self.u_axis, self.v_axis)

    def world(self, uv):
        uv = np.asarray(uv, float)
        return self.origin + uv[..., :1] * self.u_axis + uv[..., 1:] * self.v_axis

    def contains(self, u, v):
        """Whether points of the plane lie inside the polygon (its corners turn one way)."""
        inside = np.ones(np.shape(u), bool)
        corners = self.polygon_uv
        for (au, av), (bu, bv) in zip(corners, np.roll(corners, -1, axis=0)):
            inside &= (bu - au) * (v - av) - (bv - av) * (u - au) >= 0
        return inside


@dataclasses.dataclass
class House:
    """Rectangular footprint with a gable roof; the ridge runs along the length."""
    name: str
    centre: tuple
    yaw_deg: float
    length: float
    width: float
    eave: float
    ridge: float
    pictures: tuple  # of the four walls, counter-clockwise from the one facing local -y
    stone: tuple  # width and height of a block
    roof_colours: tuple

    def footprint(self):
        c, s = np.cos(np.radians(self.yaw_deg)), np.sin(np.radians(self.yaw_deg))
        corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [self.length / 2, self.width / 2]
        return corners @ np.array([[c, s], [-s, c]]) + np.array(self.centre)


HOUSES = (
    House("B0001", (-8.0, 0.0), 8, 13.0, 9.0, 6.0, 9.6,
          ("salmon_3_story_0_scale.jpg", "US-Town_StoreFront_2st.jpg",
           "US-CityCondo_brick_4st.jpg", "3storystorefronttown.jpg"),
          (0.25, 0.085), ((0.62, 0.34, 0.26), (0.60, 0.35, 0.28))),
    House("B0002", (8.5, 3.0), -24, 10.0, 8.0, 5.4, 8.8,
          ("US-Town_StoreFront2_2st.jpg", "US-Office_Storefront-3st.jpg",
           "US-CityCondo-3st.jpg", "US-Town_StoreFront4_3st.jpg"),
          (0.45, 0.22), ((0.40, 0.42, 0.46), (0.42, 0.43, 0.45))),
)


def house_surfaces(house, rng, folder):
    corners = house.footprint()
    up = np.array([0.0, 0.0, 1.0])
    gable = house.ridge - house.eave
    surfaces = []
    for i in range(4):
        start, end = corners[i], corners[(i + 1) % 4]
        width = np.linalg.norm(end - start)
        u_axis = np.append((end - start) / width, 0.0)
        top = gable if i % 2 else 0.0
        bottom = top + house.eave
        polygon = [(0, top), (width, top), (width, bottom), (0, bottom)]
        if i % 2:
            polygon.insert(1, (width / 2, 0))
        surfaces.append(Surface(
            f"{house.name}/F{i:02d}", "wall", np.append(start, house.eave + top), u_axis, -up,
            np.array(polygon), WALL_TEXEL_M,
            textures.facade(rng, folder / house.pictures[i], width, house.eave, top, WALL_TEXEL_M,
                            house.stone)))
    for side in range(2):
        start, end = corners[2 * side], corners[2 * side + 1]
        inward = (corners[(2 * side + 2) % 4] - end) / 2
        u_axis = np.append((end - start) / house.length, 0.0)
        slope = np.append(-inward, -gable)
        length = np.linalg.norm(slope)
        polygon = [(0, 0), (house.length, 0), (house.length, length), (0, length)]
        surfaces.append(Surface(
            f"{house.name}/R{side}", "roof", np.append(start + inward, house.ridge), u_axis,
            slope / length, np.array(polygon), WALL_TEXEL_M,
            textures.roof(rng, house.length, length, house.roof_colours[side], WALL_TEXEL_M)))
    return surfaces


def ground_surfaces(rng, folder):
    terraces = [(h.centre, (h.length / 2 + 1.6, h.width / 2 + 1.6), np.radians(h.yaw_deg))
                for h in HOUSES]
    half = GROUND_SIZE_M / 2
    square = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
    east, south = np.array([1.0, 0, 0]), np.array([0, -1.0, 0])
    near = Surface("G0", "ground", np.array([-half, half, 0.0]), east, south,
                   square * GROUND_SIZE_M, GROUND_TEXEL_M,
                   textures.ground(rng, folder, GROUND_SIZE_M, GROUND_TEXEL_M, terraces))
    far_m, texel_m = 1200.0, 1.5
    n = int(far_m / texel_m)
    colour = textures.to_linear(np.array([0.46, 0.47, 0.30]))
    fields = colour * (1 + 0.15 * textures.noise(rng, n, n, 12))[..., None]
    far = Surface("far", "far", np.array([-far_m / 2, far_m / 2, -0.05]), east, south,
                  square * far_m, texel_m, fields.astype(np.float32))
    return [near, far]


def blocked(points, surfaces, own):
    """Whether the way from points (n x 3) to the sun meets another surface of a house."""
    hidden = np.zeros(len(points), bool)
    for other in surfaces:
        if other is own or other.kind not in ("wall", "roof"):
            continue
        along = other.normal @ SUN
        if abs(along) < 1e-9:
            continue
        t = ((other.origin - points) @ other.normal) / along
        hit = points + t[:, None] * SUN - other.origin
        hidden |= (t > 1e-3) & other.contains(hit @ other.u_axis, hit @ other.v_axis)
    return hidden


def bake_light(surface, surfaces):
    """Multiplies sun (with cast shadows, a little softened by the grid it is computed on) and sky
    light into the texture."""
    rows, columns = surface.texture.shape[:2]
    step = 6
    v = (np.arange(0, rows + step, step) + 0.5) * surface.texel_m
    u = (np.arange(0, columns + step, step) + 0.5) * surface.texel_m
    grid = np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2)
    facing = max(0.0, float(surface.normal @ SUN))
    sun = np.full(len(grid), facing)
    if facing > 0 and surface.kind != "far":
        sun[blocked(surface.world(grid), surfaces, surface)] = 0
    sun = textures.resized(sun.reshape(len(v), len(u)), len(u) * step, len(v) * step)
    sky = 0.50 + 0.12 * surface.normal[2]
    light = sky + 0.85 * np.clip(sun[:rows, :columns], 0, 1)
    surface.texture = surface.texture * light[..., None].astype(np.float32)


def build(folder):
    """All surfaces, lit and ready for rendering. `folder` holds the source pictures."""
    rng = np.random.default_rng(20260301)
    surfaces = [s for house in HOUSES for s in house_surfaces(house, rng, folder)]
    surfaces += ground_surfaces(rng, folder)
    for surface in surfaces:
        bake_light(surface, surfaces)
        surface.pyramid = textures.pyramid(surface.texture)
        surface.texture = None
    return surfaces
