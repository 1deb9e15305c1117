// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/picture_part.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace stucco {
namespace {

struct Vertex {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;
  Eigen::Vector2d uv;
};

Vertex Between(const Vertex& a, const Vertex& b, double share) {
  const auto s = static_cast<float>(share);
  return {a.position + s * (b.position - a.position), a.normal + s * (b.normal - a.normal),
          a.uv + share * (b.uv - a.uv)};
}

// The side of a polygon where uv[axis] is at least `limit`, or at most.
std::vector<Vertex> Clipped(const std::vector<Vertex>& polygon, int axis, double limit,
                            bool at_least) {
  const auto inside = [&](const Vertex& v) {
    return at_least ? v.uv[axis] >= limit : v.uv[axis] <= limit;
  };
  std::vector<Vertex> out;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vertex& a = polygon[i];
    const Vertex& b = polygon[(i + 1) % polygon.size()];
    if (inside(a)) out.push_back(a);
    if (inside(a) == inside(b)) continue;
    out.push_back(Between(a, b, (limit - a.uv[axis]) / (b.uv[axis] - a.uv[axis])));
  }
  return out;
}

void AddFan(const std::vector<Vertex>& polygon, const PicturePart& part, bool has_normals,
            GlbPrimitive& out) {
  if (polygon.size() < 3) return;
  const auto first = static_cast<uint32_t>(out.positions.size());
  for (const Vertex& v : polygon) {
    out.positions.push_back(v.position);
    if (has_normals) out.normals.push_back(v.normal);
    out.uv.emplace_back(((v.uv - part.min()).array() / part.sizes().array()).cast<float>());
  }
  for (uint32_t i = 1; i + 1 < polygon.size(); ++i) {
    out.indices.insert(out.indices.end(), {first, first + i, first + i + 1});
  }
}

}  // namespace

std::pair<PicturePart, PicturePart> Halved(const PicturePart& part, const ImageSize& picture) {
  const ImageSize size = SizeOf(part, picture);
  const int axis = size.width_px >= size.height_px ? 0 : 1;
  const double whole = axis == 0 ? picture.width_px : picture.height_px;
  const double cut = std::round((part.min()[axis] + part.max()[axis]) / 2 * whole) / whole;
  std::pair<PicturePart, PicturePart> halves{part, part};
  halves.first.max()[axis] = cut;
  halves.second.min()[axis] = cut;
  return halves;
}

ImageSize SizeOf(const PicturePart& part, const ImageSize& picture) {
  return {std::max(1, static_cast<int>(std::lround(part.sizes().x() * picture.width_px))),
          std::max(1, static_cast<int>(std::lround(part.sizes().y() * picture.height_px)))};
}

Image Cut(const Image& picture, const PicturePart& part, const ImageSize& size) {
  assert(size.width_px <= picture.width_px && size.height_px <= picture.height_px);
  const int left = std::min(static_cast<int>(std::lround(part.min().x() * picture.width_px)),
                            picture.width_px - size.width_px);
  const int top = std::min(static_cast<int>(std::lround(part.min().y() * picture.height_px)),
                           picture.height_px - size.height_px);
  Image out{size.width_px, size.height_px, picture.channels, {}};
  out.data.resize(static_cast<size_t>(size.width_px) * size.height_px * picture.channels);
  for (int y = 0; y < size.height_px; ++y) {
    std::copy_n(picture.Pixel(left, top + y), static_cast<size_t>(size.width_px) * out.channels,
                out.Pixel(0, y));
  }
  return out;
}

Eigen::AlignedBox3d BoxOf(const PicturePart& part, const TexturedFacet& texture,
                          const Eigen::Isometry3d& frame_from_world) {
  const Eigen::Vector3d across = texture.width_px * texture.metres_per_texel * texture.u_axis;
  const Eigen::Vector3d down = texture.height_px * texture.metres_per_texel * texture.v_axis;
  Eigen::AlignedBox3d box;
  for (const double u : {part.min().x(), part.max().x()}) {
    for (const double v : {part.min().y(), part.max().y()}) {
      box.extend(frame_from_world * Eigen::Vector3d(texture.origin + u * across + v * down));
    }
  }
  return box;
}

GlbPrimitive ClippedTo(const PicturePart& part, const GlbPrimitive& whole) {
  assert(whole.uv.size() == whole.positions.size());
  const bool has_normals = !whole.normals.empty();
  GlbPrimitive out;
  out.material = whole.material;
  for (size_t t = 0; t + 2 < whole.indices.size(); t += 3) {
    std::vector<Vertex> polygon;
    for (size_t k = t; k < t + 3; ++k) {
      const uint32_t i = whole.indices[k];
      polygon.push_back({whole.positions[i],
                         has_normals ? whole.normals[i] : Eigen::Vector3f::Zero().eval(),
                         whole.uv[i].cast<double>()});
    }
    for (int axis = 0; axis < 2; ++axis) {
      polygon = Clipped(polygon, axis, part.min()[axis], true);
      polygon = Clipped(polygon, axis, part.max()[axis], false);
    }
    AddFan(polygon, part, has_normals, out);
  }
  return out;
}

}  // namespace stucco
