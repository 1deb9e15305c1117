// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/sightings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace stucco {
namespace {

// Small against the reach of a camera, large against the distance between samples.
constexpr double kCell_m = 16;
// A ray that only grazes a surface sees nothing of it.
constexpr double kLeastCosine = 1e-3;
constexpr double kStraightDown = -1 + 1e-9;  // z of a viewing direction, against rounding

GridCell CellAt(const Eigen::Vector2d& position, double size_m) {
  return {static_cast<int32_t>(std::floor(position.y() / size_m)),
          static_cast<int32_t>(std::floor(position.x() / size_m))};
}

}  // namespace

SampleIndex::SampleIndex(std::span<const SurfaceSample> samples, double cell_m)
    : cell_m_(cell_m), order_(samples.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  std::ranges::stable_sort(
      order_, {}, [&](uint32_t i) { return CellAt(samples[i].position.head<2>(), cell_m_); });
  for (uint32_t k = 0; k < order_.size(); ++k) {
    const Eigen::Vector3d& at = samples[order_[k]].position;
    const GridCell cell = CellAt(at.head<2>(), cell_m_);
    if (bins_.empty() || bins_.back().cell != cell) bins_.push_back({cell, k, k, at, at});
    Bin& bin = bins_.back();
    bin.last = k + 1;
    bin.low = bin.low.cwiseMin(at);
    bin.high = bin.high.cwiseMax(at);
  }
}

template <typename Visit>
void SampleIndex::ForBins(const GridCell& low, const GridCell& high, const Visit& visit) const {
  auto bin = std::ranges::lower_bound(bins_, low, {}, &Bin::cell);
  while (bin != bins_.end() && bin->cell.row <= high.row) {
    if (bin->cell.column > high.column || bin->cell.column < low.column) {
      // On to the next stretch of columns.
      const int32_t row = bin->cell.row + (bin->cell.column > high.column ? 1 : 0);
      bin = std::ranges::lower_bound(bin, bins_.end(), GridCell{row, low.column}, {}, &Bin::cell);
      continue;
    }
    visit(*bin);
    ++bin;
  }
}

std::vector<uint32_t> SampleIndex::Candidates(std::span<const Frustum> frusta) const {
  std::vector<uint32_t> out;
  if (frusta.empty()) return out;
  const Eigen::Vector2d place = frusta.front().position.head<2>();
  const double reach = frusta.front().reach_m;
  ForBins(CellAt(place.array() - reach, cell_m_), CellAt(place.array() + reach, cell_m_),
          [&](const Bin& bin) {
            if (std::ranges::any_of(
                    frusta, [&](const Frustum& f) { return f.MayTouch(bin.low, bin.high); })) {
              out.insert(out.end(), order_.begin() + bin.first, order_.begin() + bin.last);
            }
          });
  return out;
}

std::vector<uint32_t> SampleIndex::Near(const Eigen::Vector2d& place, double half_width_m) const {
  std::vector<uint32_t> out;
  ForBins(CellAt(place.array() - half_width_m, cell_m_),
          CellAt(place.array() + half_width_m, cell_m_), [&](const Bin& bin) {
            out.insert(out.end(), order_.begin() + bin.first, order_.begin() + bin.last);
          });
  return out;
}

SurfaceView::SurfaceView(const Site& site, const FieldOfView& field_of_view,
                         std::vector<SurfaceSample> points, double farthest_m)
    : field(field_of_view),
      reach_m(farthest_m),
      samples(std::move(points)),
      model(site),
      index(samples, kCell_m) {}

std::vector<Sighting> SightingsFrom(const Viewpoint& place, const SurfaceView& view) {
  std::vector<Sighting> out;
  for (const uint32_t i : view.index.Candidates(place.pictures)) {
    const SurfaceSample& sample = view.samples[i];
    const Eigen::Vector3d ray = place.position - sample.position;
    if (!(ray.dot(sample.normal) > kLeastCosine * ray.norm())) continue;
    bool shown = false, nadir = false;
    for (const Frustum& picture : place.pictures) {
      if (!picture.Contains(sample.position)) continue;
      shown = true;
      nadir |= picture.forward.z() < kStraightDown;
    }
    if (shown && view.model.Sees(place.position, sample.position)) out.push_back({i, nadir});
  }
  std::ranges::sort(out, {}, &Sighting::sample);
  return out;
}

}  // namespace stucco
