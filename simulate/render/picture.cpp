// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/render/internal/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "survey/parallel.h"

namespace stucco::simulate::internal {
namespace {

constexpr int kTile_px = 32;
// Neighbours whose colours differ by less than this share need no more rays: nobody sees the edge.
constexpr float kLeastContrast = 1 / 48.0f;
// Within a pane, where curtains and what is mirrored have contrasts of their own.
constexpr float kPaneContrast = 1 / 10.0f;

// What the ray through a pixel's centre met, for the comparison with its neighbours.
constexpr uint32_t kNothing = 0x1fffffffu;
constexpr uint32_t kPane = 0x20000000u;
constexpr uint32_t kInSun = 0x40000000u;
constexpr uint32_t kLeaf = 0x80000000u;

uint32_t TriangleOf(uint32_t mark) {
  return mark & kNothing;
}

// Places in a pixel, one in each row and column of a grid (rooks that do not attack each other).
using Places = std::span<const Eigen::Vector2f>;
const std::array<Eigen::Vector2f, kLanes> kEightPlaces = {{{0.5625f, 0.0625f},
                                                           {0.0625f, 0.1875f},
                                                           {0.8125f, 0.3125f},
                                                           {0.3125f, 0.4375f},
                                                           {0.6875f, 0.5625f},
                                                           {0.1875f, 0.6875f},
                                                           {0.9375f, 0.8125f},
                                                           {0.4375f, 0.9375f}}};
// Foliage is irregular: four do, and two pixels share a pack of rays.
const std::array<Eigen::Vector2f, kLanes / 2> kFourPlaces = {
    {{0.375f, 0.125f}, {0.875f, 0.375f}, {0.125f, 0.625f}, {0.625f, 0.875f}}};

struct PictureTile {
  int left = 0, top = 0, right = 0, bottom = 0;
};

std::vector<PictureTile> TilesOf(const View& view) {
  std::vector<PictureTile> tiles;
  for (int top = 0; top < view.height_px; top += kTile_px) {
    for (int left = 0; left < view.width_px; left += kTile_px) {
      tiles.push_back({left, top, std::min(left + kTile_px, view.width_px),
                       std::min(top + kTile_px, view.height_px)});
    }
  }
  return tiles;
}

// Pixels in blocks of 4 x 2: `visit(pixels, count)`.
template <typename Visit>
void ForEachBlock(const PictureTile& tile, const Visit& visit) {
  std::array<Eigen::Vector2i, kLanes> pixels;
  for (int top = tile.top; top < tile.bottom; top += 2) {
    for (int left = tile.left; left < tile.right; left += 4) {
      int count = 0;
      for (int y = top; y < std::min(top + 2, tile.bottom); ++y) {
        for (int x = left; x < std::min(left + 4, tile.right); ++x) pixels[count++] = {x, y};
      }
      visit(pixels, count);
    }
  }
}

class Drawing {
 public:
  Drawing(const View& view, const Shader& shader)
      : view_(view), shader_(shader), marks_(Pixels(), kNothing), edges_(Pixels(), 0) {
    picture_.width_px = view.width_px;
    picture_.height_px = view.height_px;
    picture_.rgb.assign(3 * Pixels(), 0.0f);
  }

  // One after the other, each over all tiles before the next: edges are found in the colours of
  // the centres.
  void DrawCentres(const PictureTile& tile);
  void FindEdges(const PictureTile& tile);
  void RefineEdges(const PictureTile& tile);
  Radiance Take() { return std::move(picture_); }

 private:
  struct Group {  // rays of one pixel that met the same triangle; each by itself on a pane
    Place sum;
    int rays = 0;
    int lane = -1;  // of its ray, on a pane
  };
  struct Traced {
    std::array<Eigen::Vector2d, kLanes> places;  // in the picture
    RayPack rays;
    std::array<bool, kLanes> valid;
    HitPack hits;
    uint32_t sunlit = 0;  // bit i: ray i met something that the sun shines on
  };

  size_t Pixels() const { return static_cast<size_t>(view_.width_px) * view_.height_px; }
  size_t Index(int x, int y) const { return static_cast<size_t>(y) * view_.width_px + x; }
  Eigen::Array3f Colour(size_t i) const {
    return Eigen::Map<const Eigen::Array3f>(&picture_.rgb[3 * i]);
  }
  void Put(size_t i, const Eigen::Array3f& colour) {
    Eigen::Map<Eigen::Array3f>(&picture_.rgb[3 * i]) = colour;
  }
  // Rays through `count` places of the picture.
  Traced Trace(const std::array<Eigen::Vector2d, kLanes>& places, int count) const;
  uint32_t FindSunlit(const Traced& traced, int count) const;
  bool Differ(size_t a, size_t b, int x, int y) const;
  bool IsEdge(int x, int y) const;
  bool LieOnOneSurface(int a, int b, int x, int y) const;
  ViewRay CentreRay(const Eigen::Vector2i& pixel) const;
  void Refine(std::span<const Eigen::Vector2i> pixels, Places places);
  // The mean over the lanes of one pixel.
  Eigen::Array3f Resolve(const Eigen::Vector2i& pixel, const Traced& traced, int first,
                         int count) const;

  const View& view_;
  const Shader& shader_;
  Radiance picture_;
  std::vector<uint32_t> marks_;
  std::vector<uint8_t> edges_;
};

uint32_t Drawing::FindSunlit(const Traced& traced, int count) const {
  RayPack to_sun;
  std::array<int, kLanes> lanes;
  int asked = 0;
  for (int i = 0; i < count; ++i) {
    const Hit& hit = traced.hits[i];
    const Ray& ray = traced.rays[i];
    if (hit.triangle < 0 || !shader_.FacesSun(hit.triangle, ray.direction)) continue;
    lanes[asked] = i;
    to_sun[asked++] =
        shader_.ToSun(ray.origin + hit.at * ray.direction, hit.triangle, ray.direction);
  }
  if (asked == 0) return 0;
  const uint32_t blocked = shader_.scene->Blocked(to_sun, asked);
  uint32_t sunlit = 0;
  for (int k = 0; k < asked; ++k) {
    if (!(blocked >> k & 1)) sunlit |= 1u << lanes[k];
  }
  return sunlit;
}

Drawing::Traced Drawing::Trace(const std::array<Eigen::Vector2d, kLanes>& places, int count) const {
  Traced traced;
  traced.places = places;
  for (int i = 0; i < count; ++i) {
    traced.valid[i] = RayAt(view_, places[i].x(), places[i].y(), traced.rays[i]);
  }
  traced.hits = shader_.scene->Nearest(traced.rays, count, *shader_.left_out);
  traced.sunlit = FindSunlit(traced, count);
  return traced;
}

ViewRay Drawing::CentreRay(const Eigen::Vector2i& pixel) const {
  const Eigen::Vector2d at = pixel.cast<double>().array() + 0.5;
  Ray ray;
  RayAt(view_, at.x(), at.y(), ray);
  return ViewRayOf(view_, at.x(), at.y(), ray);
}

void Drawing::DrawCentres(const PictureTile& tile) {
  ForEachBlock(tile, [&](const std::array<Eigen::Vector2i, kLanes>& pixels, int count) {
    std::array<Eigen::Vector2d, kLanes> centres;
    for (int i = 0; i < count; ++i) centres[i] = pixels[i].cast<double>().array() + 0.5;
    const Traced traced = Trace(centres, count);
    for (int i = 0; i < count; ++i) {
      const Ray& ray = traced.rays[i];
      if (!traced.valid[i]) continue;
      const size_t at = Index(pixels[i].x(), pixels[i].y());
      const Hit& hit = traced.hits[i];
      if (hit.triangle < 0) {
        Put(at, Background(shader_.lighting, ray.direction.normalized()));
        continue;
      }
      const bool in_sun = traced.sunlit >> i & 1;
      Place place;
      place.triangle = hit.triangle;
      place.point = ray.origin + hit.at * ray.direction;
      place.at = hit.at;
      place.b1 = hit.b1;
      place.b2 = hit.b2;
      place.in_sun = in_sun ? 1.0f : 0.0f;
      Put(at, shader_.Radiance(ViewRayOf(view_, centres[i].x(), centres[i].y(), ray), place));
      const int material = shader_.scene->surface(hit.triangle).material;
      const bool leaf = shader_.scene->scene().materials[material].cut_out;
      marks_[at] = static_cast<uint32_t>(hit.triangle) | (in_sun ? kInSun : 0) |
                   (leaf ? kLeaf : 0) | (shader_.Mirrors(hit.triangle) ? kPane : 0);
    }
  });
}

// Two triangles show one surface where their planes go through each other's place at this pixel,
// with the same texture in the same position.
bool Drawing::LieOnOneSurface(int a, int b, int x, int y) const {
  const Surface& one = shader_.scene->surface(a);
  const Surface& other = shader_.scene->surface(b);
  constexpr float kSameDirection = 0.999f;
  if (one.material != other.material || one.normal.dot(other.normal) < kSameDirection) return false;
  Ray ray;
  RayAt(view_, x + 0.5, y + 0.5, ray);
  const float way = one.normal.dot(one.corner - ray.origin) / one.normal.dot(ray.direction);
  const float other_way =
      other.normal.dot(other.corner - ray.origin) / other.normal.dot(ray.direction);
  constexpr float kSameWay = 1e-4f;
  if (!(std::abs(way - other_way) < kSameWay * way)) return false;
  const Eigen::Vector3f place = ray.origin + way * ray.direction;
  const Eigen::Vector2f jump = shader_.scene->UvAt(a, place) - shader_.scene->UvAt(b, place);
  constexpr float kSameUv = 1e-4f;
  return jump.cwiseAbs().maxCoeff() < kSameUv;
}

bool Drawing::Differ(size_t a, size_t b, int x, int y) const {
  const uint32_t one = marks_[a];
  const uint32_t other = marks_[b];
  if (one == other && !(one & kPane)) return false;
  const Eigen::Array3f first = Colour(a);
  const Eigen::Array3f second = Colour(b);
  const float contrast = ((first - second).abs() / (first + second + 1e-3f)).maxCoeff();
  if (contrast < kLeastContrast) return false;
  if ((one & other & kPane) && contrast > kPaneContrast) return true;
  if (one == other) return false;
  if ((one ^ other) & kInSun) return true;
  const uint32_t t = TriangleOf(one);
  const uint32_t u = TriangleOf(other);
  if (t == kNothing || u == kNothing) return true;
  return !LieOnOneSurface(static_cast<int>(t), static_cast<int>(u), x, y);
}

bool Drawing::IsEdge(int x, int y) const {
  const size_t at = Index(x, y);
  if (marks_[at] & kLeaf) return true;
  return (x > 0 && Differ(at, at - 1, x, y)) ||
         (x + 1 < view_.width_px && Differ(at, at + 1, x, y)) ||
         (y > 0 && Differ(at, at - view_.width_px, x, y)) ||
         (y + 1 < view_.height_px && Differ(at, at + view_.width_px, x, y));
}

Eigen::Array3f Drawing::Resolve(const Eigen::Vector2i& pixel, const Traced& traced, int first,
                                int count) const {
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  std::array<Group, kLanes> groups;
  int group_count = 0;
  for (int i = first; i < first + count; ++i) {
    if (!traced.valid[i]) continue;
    const Ray& ray = traced.rays[i];
    const Hit& hit = traced.hits[i];
    if (hit.triangle < 0) {
      sum += Background(shader_.lighting, ray.direction.normalized());
      continue;
    }
    // What a pane mirrors changes from ray to ray.
    const bool mirrors = shader_.Mirrors(hit.triangle);
    int g = mirrors ? group_count : 0;
    while (g < group_count && groups[g].sum.triangle != hit.triangle) ++g;
    Place& place = groups[g].sum;
    if (g == group_count) {
      ++group_count;
      place.triangle = hit.triangle;
      place.point.setZero();
      if (mirrors) groups[g].lane = i;
    }
    ++groups[g].rays;
    place.point += ray.origin + hit.at * ray.direction;
    place.at += hit.at;
    place.b1 += hit.b1;
    place.b2 += hit.b2;
    place.in_sun += static_cast<float>(traced.sunlit >> i & 1);
  }
  std::optional<ViewRay> centre;
  for (int g = 0; g < group_count; ++g) {
    const auto rays_of = static_cast<float>(groups[g].rays);
    Place place = groups[g].sum;
    place.point /= rays_of;
    place.at /= rays_of;
    place.b1 /= rays_of;
    place.b2 /= rays_of;
    place.in_sun /= rays_of;
    place.pixel_side = std::sqrt(rays_of / static_cast<float>(count));
    if (const int lane = groups[g].lane; lane >= 0) {
      const Eigen::Vector2d& at = traced.places[lane];
      sum += shader_.Radiance(ViewRayOf(view_, at.x(), at.y(), traced.rays[lane]), place);
      continue;
    }
    if (!centre) centre = CentreRay(pixel);
    sum += rays_of * shader_.Radiance(*centre, place);
  }
  return sum / static_cast<float>(count);
}

void Drawing::FindEdges(const PictureTile& tile) {
  for (int y = tile.top; y < tile.bottom; ++y) {
    for (int x = tile.left; x < tile.right; ++x) edges_[Index(x, y)] = IsEdge(x, y);
  }
}

void Drawing::Refine(std::span<const Eigen::Vector2i> pixels, Places places) {
  std::array<Eigen::Vector2d, kLanes> all;
  int count = 0;
  for (const Eigen::Vector2i& pixel : pixels) {
    for (const Eigen::Vector2f& place : places) {
      all[count++] = pixel.cast<double>() + place.cast<double>();
    }
  }
  const Traced traced = Trace(all, count);
  const int each = static_cast<int>(places.size());
  for (size_t i = 0; i < pixels.size(); ++i) {
    Put(Index(pixels[i].x(), pixels[i].y()),
        Resolve(pixels[i], traced, static_cast<int>(i) * each, each));
  }
}

void Drawing::RefineEdges(const PictureTile& tile) {
  std::array<Eigen::Vector2i, 2> leaves;
  size_t waiting = 0;
  for (int y = tile.top; y < tile.bottom; ++y) {
    for (int x = tile.left; x < tile.right; ++x) {
      const size_t at = Index(x, y);
      if (!edges_[at]) continue;
      const Eigen::Vector2i pixel(x, y);
      if (!(marks_[at] & kLeaf)) {
        Refine({&pixel, 1}, kEightPlaces);
        continue;
      }
      leaves[waiting++] = pixel;
      if (waiting == leaves.size()) {
        Refine(leaves, kFourPlaces);
        waiting = 0;
      }
    }
  }
  if (waiting > 0) Refine({leaves.data(), waiting}, kFourPlaces);
}

}  // namespace

Radiance DrawPicture(const View& view, const Shader& shader, int threads) {
  Drawing drawing(view, shader);
  const std::vector<PictureTile> tiles = TilesOf(view);
  ParallelFor(tiles.size(), threads, [&](size_t i) { drawing.DrawCentres(tiles[i]); });
  ParallelFor(tiles.size(), threads, [&](size_t i) { drawing.FindEdges(tiles[i]); });
  ParallelFor(tiles.size(), threads, [&](size_t i) { drawing.RefineEdges(tiles[i]); });
  return drawing.Take();
}

std::vector<float> MeasureWays(const View& view, const RayScene& scene,
                               const RenderOptions& options) {
  std::vector<float> ways(static_cast<size_t>(view.width_px) * view.height_px, 0.0f);
  const std::vector<PictureTile> tiles = TilesOf(view);
  ParallelFor(tiles.size(), options.threads, [&](size_t t) {
    ForEachBlock(tiles[t], [&](const std::array<Eigen::Vector2i, kLanes>& pixels, int count) {
      RayPack pack;
      std::array<bool, kLanes> valid;
      for (int i = 0; i < count; ++i) {
        valid[i] = RayAt(view, pixels[i].x() + 0.5, pixels[i].y() + 0.5, pack[i]);
      }
      const HitPack hits = scene.Nearest(pack, count, options.left_out);
      for (int i = 0; i < count; ++i) {
        if (!valid[i] || hits[i].triangle < 0) continue;
        ways[static_cast<size_t>(pixels[i].y()) * view.width_px + pixels[i].x()] = hits[i].at;
      }
    });
  });
  return ways;
}

}  // namespace stucco::simulate::internal
