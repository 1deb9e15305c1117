// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planar/view_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "plan/planar/reconstructability.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

constexpr uint32_t kNobody = ~0U;
// Hovers with fewer sightings are not worth a second thread.
constexpr size_t kSightingsPerTask = 256;

// w1 w3 by the square of the chord between two unit rays, which spares the arc cosine.
constexpr int kTableSize = 1 << 13;
constexpr float kTableScale = kTableSize / 4.0F;

std::array<float, kTableSize + 2> MakeTable() {
  std::array<float, kTableSize + 2> out{};
  for (int i = 0; i <= kTableSize; ++i) {
    const double chord_square = std::min(4.0, i / static_cast<double>(kTableScale));
    const double angle = 2 * std::asin(0.5 * std::sqrt(chord_square));
    out[i] = static_cast<float>(ParallaxWeight(angle) * MatchWeight(angle));
  }
  out[kTableSize + 1] = out[kTableSize];
  return out;
}
const std::array<float, kTableSize + 2> kAngleTable = MakeTable();

float AngleWeight(float cosine) {
  const float at = std::clamp((2 - 2 * cosine) * kTableScale, 0.0F, static_cast<float>(kTableSize));
  const int i = static_cast<int>(at);
  return kAngleTable[i] + (at - static_cast<float>(i)) * (kAngleTable[i + 1] - kAngleTable[i]);
}

}  // namespace

ViewGraph::ViewGraph(const SurfaceView& view, double d_max_m, int threads, bool by_scale)
    : view_(view),
      d_max_m_(d_max_m),
      threads_(threads),
      by_scale_(by_scale),
      rays_(view.samples.size()),
      states_(view.samples.size()) {}

std::vector<Sighting> SightingsOf(const SurfaceView& view, const Hover& hover) {
  return SightingsFrom(ViewpointOf(view.field, hover, view.reach_m), view);
}

void ViewGraph::AddAll(std::span<const Hover> hovers) {
  sightings_.resize(hovers.size());
  removed_.assign(hovers.size(), 0);
  for (const Hover& hover : hovers) positions_.push_back(hover.position);
  ParallelFor(hovers.size(), threads_,
              [&](size_t i) { sightings_[i] = SightingsOf(view_, hovers[i]); });
  std::vector<uint32_t> counts(rays_.size());
  for (const auto& list : sightings_) {
    for (const Sighting& sighting : list) ++counts[sighting.sample];
  }
  for (size_t s = 0; s < rays_.size(); ++s) rays_[s].reserve(counts[s]);
  for (uint32_t hover = 0; hover < hovers.size(); ++hover) {
    for (const Sighting& sighting : sightings_[hover]) {
      Ray ray = RayTo(sighting.sample, positions_[hover]);
      ray.hover = hover;
      rays_[sighting.sample].push_back(ray);
      ++states_[sighting.sample].hovers;
      states_[sighting.sample].nadirs += sighting.nadir;
    }
  }
  constexpr size_t kPerTask = 64;
  ParallelFor((rays_.size() + kPerTask - 1) / kPerTask, threads_, [&](size_t task) {
    const size_t end = std::min(rays_.size(), (task + 1) * kPerTask);
    for (size_t s = task * kPerTask; s < end; ++s) Sum(static_cast<uint32_t>(s));
  });
}

ViewGraph::Ray ViewGraph::RayTo(uint32_t sample, const Eigen::Vector3d& position) const {
  const Eigen::Vector3d way = position - view_.samples[sample].position;
  const double distance = way.norm();
  const Eigen::Vector3f unit = (way / distance).cast<float>();
  return {unit.x(), unit.y(), unit.z(), static_cast<float>(distance), 0};
}

double ViewGraph::ShareOf(uint32_t sample, const Ray& ray, uint32_t self) const {
  const Eigen::Vector3f normal = view_.samples[sample].normal.cast<float>();
  const auto facing = [&](const Ray& r) {
    return r.x * normal.x() + r.y * normal.y() + r.z * normal.z();
  };
  const float own = facing(ray);
  double sum = 0;
  for (const Ray& other : rays_[sample]) {
    if (other.hover == self) continue;
    const float cosine = ray.x * other.x + ray.y * other.y + ray.z * other.z;
    const double clear = ResolutionWeight(std::max(ray.distance_m, other.distance_m), d_max_m_) *
                         (by_scale_ ? ScaleWeight(ray.distance_m, other.distance_m) : 1);
    sum += AngleWeight(cosine) * clear * std::min(own, facing(other));
  }
  return sum;
}

void ViewGraph::Sum(uint32_t sample) {
  std::vector<Ray> rays = std::move(rays_[sample]);
  rays_[sample].clear();
  rays_[sample].reserve(rays.size());
  double sum = 0;
  for (const Ray& ray : rays) {
    sum += ShareOf(sample, ray, kNobody);
    rays_[sample].push_back(ray);
  }
  states_[sample].reconstructability = sum;
}

double ViewGraph::Share(uint32_t hover, uint32_t sighting) const {
  const Sighting& s = sightings_[hover][sighting];
  return ShareOf(s.sample, RayTo(s.sample, positions_[hover]), hover);
}

std::vector<double> ViewGraph::Shares(uint32_t hover) const {
  std::vector<double> out(sightings_[hover].size());
  ParallelFor((out.size() + kSightingsPerTask - 1) / kSightingsPerTask, threads_, [&](size_t task) {
    const size_t end = std::min(out.size(), (task + 1) * kSightingsPerTask);
    for (size_t i = task * kSightingsPerTask; i < end; ++i) {
      out[i] = Share(hover, static_cast<uint32_t>(i));
    }
  });
  return out;
}

std::vector<double> ViewGraph::SharesFrom(const Eigen::Vector3d& position,
                                          std::span<const Sighting> sightings) const {
  std::vector<double> out;
  out.reserve(sightings.size());
  for (const Sighting& s : sightings) {
    out.push_back(ShareOf(s.sample, RayTo(s.sample, position), kNobody));
  }
  return out;
}

void ViewGraph::Remove(uint32_t hover, std::span<const double> shares) {
  for (size_t i = 0; i < sightings_[hover].size(); ++i) {
    const Sighting& sighting = sightings_[hover][i];
    std::vector<Ray>& rays = rays_[sighting.sample];
    const auto ray = std::ranges::find(rays, hover, &Ray::hover);
    *ray = rays.back();
    rays.pop_back();
    SampleState& state = states_[sighting.sample];
    state.reconstructability -= shares[i];
    --state.hovers;
    state.nadirs -= sighting.nadir;
  }
  removed_[hover] = 1;
}

void ViewGraph::Insert(uint32_t hover, const Eigen::Vector3d& position,
                       std::vector<Sighting> sightings, std::span<const double> shares) {
  for (size_t i = 0; i < sightings.size(); ++i) {
    Ray ray = RayTo(sightings[i].sample, position);
    ray.hover = hover;
    rays_[sightings[i].sample].push_back(ray);
    SampleState& state = states_[sightings[i].sample];
    state.reconstructability += shares[i];
    ++state.hovers;
    state.nadirs += sightings[i].nadir;
  }
  positions_[hover] = position;
  sightings_[hover] = std::move(sightings);
  removed_[hover] = 0;
}

}  // namespace stucco::plan
