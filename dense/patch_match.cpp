// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/patch_match.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "dense/internal/pixel_random.h"
#include "dense/internal/source_geometry.h"
#include "dense/patch.h"

namespace stucco {
namespace {

constexpr int kMaxSources = 16;
constexpr size_t kMostOffers = 13;         // of a pixel: its own plane, eight arms, four changes
constexpr float kGeometricWeight = 0.15f;  // per pixel of disagreement
constexpr float kGeometricLimit = 3;       // pixels
// Grey levels squared, within two pixels. What photos of full size reduced to some megapixels have
// of noise is a tenth to four tenths of it; walls in the shade and slates have two to four times as
// much.
constexpr float kLeastOwnVariance = 1;
constexpr float kSteepest = 0.1f;  // cosine between a plane's normal and the ray, at least
constexpr float kUnknown = -1;     // a matching cost that was not asked for yet
constexpr float kSamePx = 0.02f;  // planes that take no pixel of a window further apart match alike
// Of Gauss-Newton steps, of the diagonal: a window says little about its plane's slopes, and full
// steps follow its noise.
constexpr float kDamping = 1;
constexpr int kCoarsestRounds = 4;
// A plane that costs less than this, geometry included, in the second pass is kept as it is. With
// plain pixels left alone that saves a fifth of the pass; the cloud loses two thousandths of its
// roofs at most. With 0.25 it loses a hundredth.
constexpr float kSettled = 0.12f;
constexpr float kLongestStep = 0.1f;  // change of the inverse depth, relative

// Candidates are taken from where a red pixel has black neighbours: offsets with an odd sum.
constexpr std::array<std::array<int, 2>, 4> kNear[4] = {
    {{{0, -1}, {-1, -2}, {1, -2}, {0, -3}}},
    {{{0, 1}, {-1, 2}, {1, 2}, {0, 3}}},
    {{{-1, 0}, {-2, -1}, {-2, 1}, {-3, 0}}},
    {{{1, 0}, {2, -1}, {2, 1}, {3, 0}}},
};
constexpr std::array<std::array<int, 2>, 4> kFar[4] = {
    {{{0, -5}, {0, -9}, {0, -15}, {0, -21}}},
    {{{0, 5}, {0, 9}, {0, 15}, {0, 21}}},
    {{{-5, 0}, {-9, 0}, {-15, 0}, {-21, 0}}},
    {{{5, 0}, {9, 0}, {15, 0}, {21, 0}}},
};

struct Pixel {
  int x = 0;
  int y = 0;
};

class LevelMatcher {
 public:
  LevelMatcher(const PatchMatchInput& input, const PatchMatchOptions& options, int level)
      : input_(input),
        options_(options),
        level_(level),
        view_(input.reference->cameras[level]),
        image_(input.reference->images[level]) {
    for (const auto& source : input.sources) geometry_.emplace_back(view_, source->cameras[level]);
    float widest = 0;
    for (const SourceGeometry& source : geometry_) {
      widest = std::max(widest, view_.fx * source.translation.norm());
    }
    same_ = kSamePx / std::max(widest, 1e-9f);
    planes_.resize(image_.gray.size());
    costs_.assign(image_.gray.size(), kNoMatch);
    matching_.assign(image_.gray.size() * geometry_.size(), kUnknown);
    for (size_t s = 0; s < input.source_maps.size(); ++s) {
      back_.emplace_back(input.sources[s]->cameras[level], view_);
    }
  }

  void StartFromSeeds() {
    for (int y = 0; y < view_.height; ++y) {
      for (int x = 0; x < view_.width; ++x) {
        PixelRandom random(options_.seed, static_cast<uint32_t>(Index(x, y)), 0);
        planes_[Index(x, y)] = RandomPlane(random, x, y);
      }
    }
    // Every seed colours a disc; later and nearer seeds do not matter, propagation sorts them out.
    const float scale = static_cast<float>(view_.width) / input_.reference->cameras[0].width;
    constexpr int kRadius = 6;
    for (const DepthSeed& seed : input_.seeds) {
      const int x0 = static_cast<int>(seed.x * scale);
      const int y0 = static_cast<int>(seed.y * scale);
      for (int y = std::max(0, y0 - kRadius); y <= std::min(view_.height - 1, y0 + kRadius); ++y) {
        for (int x = std::max(0, x0 - kRadius); x <= std::min(view_.width - 1, x0 + kRadius); ++x) {
          if ((x + y) % 3 == 0) continue;  // keep some random ones in between
          DepthPlane& plane = planes_[Index(x, y)];
          plane = plane.MovedTo(1 / seed.depth);
        }
      }
    }
  }

  void StartFrom(const LevelMatcher& coarser) {
    const float scale_x = static_cast<float>(coarser.view_.width) / view_.width;
    const float scale_y = static_cast<float>(coarser.view_.height) / view_.height;
    for (int y = 0; y < view_.height; ++y) {
      for (int x = 0; x < view_.width; ++x) {
        const float there_x = (x + 0.5f) * scale_x;
        const float there_y = (y + 0.5f) * scale_y;
        const int cx = std::min(static_cast<int>(there_x), coarser.view_.width - 1);
        const int cy = std::min(static_cast<int>(there_y), coarser.view_.height - 1);
        DepthPlane plane = coarser.planes_[coarser.Index(cx, cy)];
        plane.inverse_depth = Bounded(plane.inverse_depth + plane.right * (there_x - 0.5f - cx) +
                                      plane.down * (there_y - 0.5f - cy));
        plane.right *= scale_x;
        plane.down *= scale_y;
        planes_[Index(x, y)] = plane;
      }
    }
  }

  void StartFrom(const DepthMap& map) {
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        const size_t i = Index(x, y);
        if (map.depths[i] > 0) {
          planes_[i] = PlaneAcross(view_, x, y, map.depths[i], Facing(map.Normal(i), x, y));
        } else {
          planes_[i] = {1 / options_.max_depth, 0, 0};
        }
      }
    }
  }

  // What the planes cost that a level begins with, so that the best spread from the first round on.
  void Rate() {
    for (int y = 0; y < view_.height; ++y) {
      if (y % 64 == 0) input_.check_cancelled();
      for (int x = 0; x < view_.width; ++x) {
        if (IsIdle(Index(x, y))) continue;
        const ReferencePatch patch = MakeReferencePatch(image_, x, y);
        costs_[Index(x, y)] = SelectViews(patch, planes_[Index(x, y)], {x, y}).cost;
      }
    }
  }

  void Run(int iterations, bool far) {
    for (int iteration = 0; iteration < iterations; ++iteration) {
      for (int color = 0; color < 2; ++color) {
        for (int y = 0; y < view_.height; ++y) {
          if (y % 64 == 0) input_.check_cancelled();
          for (int x = (y + color) % 2; x < view_.width; x += 2) Improve(x, y, iteration, far);
        }
      }
    }
  }

  // The costs are those of matching alone: that other maps contradict a depth, or have none there,
  // is for those to judge who hold maps against each other.
  DepthMap Result() {
    DepthMap map = EmptyDepthMap(view_.width, view_.height);
    for (size_t i = 0; i < planes_.size(); ++i) {
      if (costs_[i] >= kNoMatch || !HasOwnTexture(i)) continue;
      const auto x = static_cast<int>(i % view_.width);
      const auto y = static_cast<int>(i / view_.width);
      const float cost = KnownMatching({x, y});
      map.depths[i] = planes_[i].depth();
      const Eigen::Vector3f normal = -AwayNormal(view_, x, y, planes_[i]).normalized();
      for (int k = 0; k < 3; ++k) {
        map.normals[i][k] = static_cast<int8_t>(std::lround(normal[k] * 127));
      }
      map.costs[i] = static_cast<uint8_t>(std::min(254.0f, cost * 127));
    }
    return map;
  }

 private:
  size_t Index(int x, int y) const { return static_cast<size_t>(y) * view_.width + x; }

  Eigen::Vector3f Ray(int x, int y) const {
    return view_.Ray(static_cast<float>(x), static_cast<float>(y));
  }

  float Bounded(float inverse_depth) const {
    return std::clamp(inverse_depth, 1 / options_.max_depth,
                      1 / std::max(options_.min_depth, 1e-9f));
  }

  // Whether the pixel's near surroundings vary. Where only the rim of the window does, the match
  // says where that rim lies, not the pixel: sky next to a roof would be glued to the roof.
  bool HasOwnTexture(size_t index) const {
    const int x = static_cast<int>(index % view_.width);
    const int y = static_cast<int>(index / view_.width);
    constexpr int kRadius = 2;
    float sum = 0;
    float squares = 0;
    for (int dy = -kRadius; dy <= kRadius; ++dy) {
      for (int dx = -kRadius; dx <= kRadius; ++dx) {
        const int px = std::clamp(x + dx, 0, view_.width - 1);
        const int py = std::clamp(y + dy, 0, view_.height - 1);
        const float value = image_.gray[Index(px, py)];
        sum += value;
        squares += value * value;
      }
    }
    constexpr float kCount = (2 * kRadius + 1) * (2 * kRadius + 1);
    return squares / kCount - (sum / kCount) * (sum / kCount) > kLeastOwnVariance;
  }

  // Turns a normal towards the camera and away from grazing planes.
  Eigen::Vector3f Facing(Eigen::Vector3f normal, int x, int y) const {
    const Eigen::Vector3f ray = Ray(x, y).normalized();
    normal.normalize();
    if (normal.dot(ray) > 0) normal = -normal;
    if (normal.dot(ray) > -kSteepest)
      normal = (normal - (normal.dot(ray) + kSteepest) * ray).normalized();
    return normal;
  }

  bool IsTooSteep(const DepthPlane& plane, Pixel at) const {
    const float along_ray = plane.inverse_depth / Ray(at.x, at.y).norm();
    return along_ray < kSteepest * AwayNormal(view_, at.x, at.y, plane).norm();
  }

  DepthPlane RandomPlane(PixelRandom& random, int x, int y) const {
    // Uniform in inverse depth: as many planes per pixel of disparity everywhere.
    const float inverse_depth =
        random.Uniform(1 / options_.max_depth, 1 / std::max(options_.min_depth, 1e-9f));
    const Eigen::Vector3f normal(random.Uniform(-1, 1), random.Uniform(-1, 1),
                                 -random.Uniform(0.4f, 1.6f));
    return PlaneAcross(view_, x, y, 1 / inverse_depth, Facing(normal, x, y));
  }

  // The matching cost in a source alone.
  float Matching(const ReferencePatch& patch, const DepthPlane& plane, Pixel at, int source) const {
    return PatchCost(patch, input_.sources[source]->images[level_],
                     geometry_[source].Warp(plane, at.x, at.y));
  }

  // What the source's map holds against the plane; together with the matching cost kNoMatch at
  // most.
  float Penalty(const DepthPlane& plane, Pixel at, int source) const {
    if (input_.source_maps.empty()) return 0;
    return kGeometricWeight * Disagreement(Ray(at.x, at.y) * plane.depth(), at, source);
  }

  // Forward-backward reprojection error in pixels against the source's own depth, limited.
  float Disagreement(const Eigen::Vector3f& point, Pixel at, int source) const {
    const SourceGeometry& to_source = geometry_[source];
    const DepthMap& map = *input_.source_maps[source];
    const PinholeCamera& other = input_.sources[source]->cameras[level_];
    const Eigen::Vector3f p = to_source.source_from_reference * point + to_source.translation;
    if (p.z() <= 0) return kGeometricLimit;
    const int u = static_cast<int>(std::lround(other.fx * p.x() / p.z() + other.cx));
    const int v = static_cast<int>(std::lround(other.fy * p.y() / p.z() + other.cy));
    if (u < 0 || v < 0 || u >= map.width || v >= map.height) return kGeometricLimit;
    const size_t pixel = map.Index(u, v);
    const float depth = map.depths[pixel];
    if (depth <= 0) return kGeometricLimit;
    // Where the source's surface at that pixel meets its ray to the point.
    const Eigen::Vector3f on_surface =
        other.Ray(static_cast<float>(u), static_cast<float>(v)) * depth;
    const Eigen::Vector3f normal = map.Normal(pixel);
    const float along = normal.dot(p);
    const float stretch = along < -0.1f * p.z() ? normal.dot(on_surface) / along : depth / p.z();
    const Eigen::Vector3f there = p * stretch;
    const SourceGeometry& back = back_[source];
    const Eigen::Vector3f q = back.source_from_reference * there + back.translation;
    if (q.z() <= 0) return kGeometricLimit;
    const float dx = view_.fx * q.x() / q.z() + view_.cx - static_cast<float>(at.x);
    const float dy = view_.fy * q.y() / q.z() + view_.cy - static_cast<float>(at.y);
    return std::min(kGeometricLimit, std::sqrt(dx * dx + dy * dy));
  }

  // The sources that see this pixel best under its present plane; others are hidden or too oblique.
  struct Selection {
    std::array<int, kMaxSources> sources{};
    int count = 0;
    float cost = kNoMatch;      // mean
    float matching = kNoMatch;  // mean
  };

  // Matching costs of the pixel's present plane in each source, where they are known.
  std::span<float> MatchingOf(Pixel at) {
    return std::span(matching_).subspan(Index(at.x, at.y) * geometry_.size(), geometry_.size());
  }

  Selection SelectViews(const ReferencePatch& patch, const DepthPlane& plane, Pixel at) {
    std::array<std::pair<float, int>, kMaxSources> costs;
    const std::span<float> matching = MatchingOf(at);
    const int total = static_cast<int>(matching.size());
    for (int s = 0; s < total; ++s) {
      if (matching[s] == kUnknown) matching[s] = Matching(patch, plane, at, s);
      costs[s] = {std::min(matching[s] + Penalty(plane, at, s), kNoMatch), s};
    }
    Selection selection;
    selection.count = std::min(options_.views_per_pixel, total);
    std::partial_sort(costs.begin(), costs.begin() + selection.count, costs.begin() + total);
    float sum = 0;
    float matching_sum = 0;
    for (int i = 0; i < selection.count; ++i) {
      selection.sources[i] = costs[i].second;
      sum += costs[i].first;
      matching_sum += matching[costs[i].second];
    }
    selection.cost = sum / static_cast<float>(selection.count);
    selection.matching = matching_sum / static_cast<float>(selection.count);
    return selection;
  }

  // The mean matching cost in the best of the sources that the pixel's plane was tried in.
  float KnownMatching(Pixel at) {
    std::array<float, kMaxSources> known;
    const std::span<float> matching = MatchingOf(at);
    const auto end = std::copy_if(matching.begin(), matching.end(), known.begin(),
                                  [](float cost) { return cost != kUnknown; });
    const auto count = std::min<std::ptrdiff_t>(options_.views_per_pixel, end - known.begin());
    if (count == 0) return kNoMatch;
    std::partial_sort(known.begin(), known.begin() + count, end);
    return std::accumulate(known.begin(), known.begin() + count, 0.0f) / static_cast<float>(count);
  }

  // Whether the pixel need not be looked at: at the level of the map what has no texture of its own
  // gets no depth, however well its window matches.
  bool IsIdle(size_t index) const { return level_ == 0 && !HasOwnTexture(index); }

  // Whether the other maps agree with the pixel's plane as it is, and it matches.
  bool IsSettled(size_t index) const {
    return !input_.source_maps.empty() && costs_[index] < kSettled;
  }

  // A pixel while better planes are looked for.
  struct Search {
    Pixel at;
    const ReferencePatch& patch;
    Selection selection;
    DepthPlane best;
    float best_cost = kNoMatch;
    std::array<DepthPlane, kMostOffers> offered{};
    size_t num_offered = 0;
  };

  bool IsSame(const DepthPlane& a, const DepthPlane& b) const {
    const float slopes = std::abs(a.right - b.right) + std::abs(a.down - b.down);
    return std::abs(a.inverse_depth - b.inverse_depth) + kPatchRadius * slopes <= same_;
  }

  void Offer(const DepthPlane& plane, Search& search) {
    const auto same = [&](const DepthPlane& other) { return IsSame(plane, other); };
    const auto end = search.offered.begin() + static_cast<std::ptrdiff_t>(search.num_offered);
    if (std::any_of(search.offered.begin(), end, same)) return;
    search.offered[search.num_offered++] = plane;
    const Selection& selection = search.selection;
    const float stop = search.best_cost * static_cast<float>(selection.count);
    std::array<float, kMaxSources> matching;
    std::array<float, kMaxSources> penalties;
    // What other maps hold against the plane is cheap to know, and often enough to refuse it.
    float sum = 0;
    for (int i = 0; i < selection.count; ++i) {
      penalties[i] = Penalty(plane, search.at, selection.sources[i]);
      sum += penalties[i];
    }
    for (int i = 0; i < selection.count; ++i) {
      if (sum >= stop) return;
      matching[i] = Matching(search.patch, plane, search.at, selection.sources[i]);
      sum += std::min(matching[i], kNoMatch - penalties[i]);
    }
    if (sum >= stop) return;
    search.best = plane;
    search.best_cost = sum / static_cast<float>(selection.count);
    const std::span<float> known = MatchingOf(search.at);
    std::ranges::fill(known, kUnknown);
    for (int i = 0; i < selection.count; ++i) known[selection.sources[i]] = matching[i];
  }

  void Improve(int x, int y, int iteration, bool far) {
    const size_t index = Index(x, y);
    if (IsIdle(index) || IsSettled(index)) return;
    const ReferencePatch patch = MakeReferencePatch(image_, x, y);
    Search search{{x, y}, patch, SelectViews(patch, planes_[index], {x, y}), planes_[index]};
    search.best_cost = search.selection.cost;
    search.offered[search.num_offered++] = search.best;
    for (const auto& arm : kNear) OfferBestOf(arm, search);
    for (const auto& arm : kFar) {
      if (far) OfferBestOf(arm, search);
    }
    Refine(iteration, far, search);
    planes_[index] = search.best;
    costs_[index] = search.best_cost;
  }

  template <typename Arm>
  void OfferBestOf(const Arm& arm, Search& search) {
    const auto [x, y] = search.at;
    size_t best = planes_.size();
    int bx = 0;
    int by = 0;
    for (const auto& [dx, dy] : arm) {
      if (x + dx < 0 || y + dy < 0 || x + dx >= view_.width || y + dy >= view_.height) continue;
      const size_t other = Index(x + dx, y + dy);
      if (best != planes_.size() && costs_[other] >= costs_[best]) continue;
      best = other;
      bx = x + dx;
      by = y + dy;
    }
    if (best == planes_.size()) return;
    DepthPlane plane = planes_[best];
    plane.inverse_depth = Bounded(plane.At(x - bx, y - by));
    Offer(plane, search);
  }

  // A Gauss-Newton step of the plane in the sources that see the pixel best; at the coarse levels
  // also random changes.
  void Refine(int iteration, bool anew, Search& search) {
    Step(search);
    if (!anew) return;
    const auto [x, y] = search.at;
    PixelRandom random(options_.seed, static_cast<uint32_t>(Index(x, y)),
                       static_cast<uint32_t>(1 + iteration + 100 * level_));
    const DepthPlane other = RandomPlane(random, x, y);
    Offer(other, search);
    Offer(other.MovedTo(search.best.inverse_depth), search);
    Step(search);
  }

  void Step(Search& search) {
    const auto [x, y] = search.at;
    StepSums sums;
    for (int i = 0; i < search.selection.count; ++i) {
      const int source = search.selection.sources[i];
      AddStep(search.patch, input_.sources[source]->images[level_],
              geometry_[source].Warp(search.best, x, y), sums);
    }
    Eigen::Matrix3f square;
    square << sums.square[0], sums.square[1], sums.square[2],  //
        sums.square[1], sums.square[3], sums.square[4],        //
        sums.square[2], sums.square[4], sums.square[5];
    square.diagonal() *= 1 + kDamping;
    const Eigen::Vector3f step =
        square.ldlt().solve(Eigen::Vector3f(sums.slope[0], sums.slope[1], sums.slope[2]));
    // Not a number where nothing shows a change.
    if (!(std::abs(step[0]) < kLongestStep * search.best.inverse_depth)) return;
    const DepthPlane better = {Bounded(search.best.inverse_depth - step[0]),
                               search.best.right - step[1], search.best.down - step[2]};
    if (!IsTooSteep(better, search.at)) Offer(better, search);
  }

  const PatchMatchInput& input_;
  const PatchMatchOptions& options_;
  int level_;
  const PinholeCamera& view_;
  const PackedImage& image_;
  float same_ = 0;  // inverse depths within a window that match alike
  std::vector<SourceGeometry> geometry_;
  std::vector<SourceGeometry> back_;  // reference from source, in the second pass
  std::vector<DepthPlane> planes_;
  std::vector<float> costs_;     // of the planes, geometry included
  std::vector<float> matching_;  // source by source; kUnknown where the plane was not tried
};

}  // namespace

DepthMap MatchDepths(const PatchMatchInput& input, const PatchMatchOptions& options) {
  if (input.start != nullptr) {
    LevelMatcher matcher(input, options, 0);
    matcher.StartFrom(*input.start);
    matcher.Rate();
    matcher.Run(options.iterations, false);
    return matcher.Result();
  }
  const int coarsest = static_cast<int>(input.reference->cameras.size()) - 1;
  std::unique_ptr<LevelMatcher> matcher;
  for (int level = coarsest; level >= 0; --level) {
    auto finer = std::make_unique<LevelMatcher>(input, options, level);
    if (level == coarsest) {
      finer->StartFromSeeds();
    } else {
      finer->StartFrom(*matcher);
    }
    finer->Rate();
    const int rounds = options.iterations;
    finer->Run(level == coarsest ? std::max(kCoarsestRounds, rounds) : rounds, level > 0);
    matcher = std::move(finer);
  }
  return matcher->Result();
}

}  // namespace stucco
