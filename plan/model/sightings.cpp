// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/model/sightings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace stucco::plan {
namespace {

// Small against the reach of a camera, large against the distance between samples.
constexpr double kCell_m = 16;
// A ray that only grazes a surface sees nothing of it.
constexpr double kLeastCosine = 1e-3;

Cell CellAt(const Eigen::Vector3d& position, double size_m) {
  return {static_cast<int32_t>(std::floor(position.y() / size_m)),
          static_cast<int32_t>(std::floor(position.x() / size_m))};
}

}  // namespace

SampleIndex::SampleIndex(std::span<const SurfaceSample> samples, double cell_m)
    : cell_m_(cell_m), order_(samples.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  std::ranges::stable_sort(order_, {},
                           [&](uint32_t i) { return CellAt(samples[i].position, cell_m_); });
  for (uint32_t k = 0; k < order_.size(); ++k) {
    const Eigen::Vector3d& at = samples[order_[k]].position;
    const Cell cell = CellAt(at, cell_m_);
    if (bins_.empty() || bins_.back().cell != cell) bins_.push_back({cell, k, k, at, at});
    Bin& bin = bins_.back();
    bin.last = k + 1;
    bin.low = bin.low.cwiseMin(at);
    bin.high = bin.high.cwiseMax(at);
  }
}

std::vector<uint32_t> SampleIndex::Candidates(std::span<const Frustum> frusta) const {
  std::vector<uint32_t> out;
  if (frusta.empty()) return out;
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(frusta.front().reach_m);
  const Cell low = CellAt(frusta.front().position - reach, cell_m_);
  const Cell high = CellAt(frusta.front().position + reach, cell_m_);
  auto bin = std::ranges::lower_bound(bins_, low, {}, &Bin::cell);
  while (bin != bins_.end() && bin->cell.row <= high.row) {
    if (bin->cell.column > high.column || bin->cell.column < low.column) {
      // On to the next stretch of columns that is in reach.
      const int32_t row = bin->cell.row + (bin->cell.column > high.column ? 1 : 0);
      bin = std::ranges::lower_bound(bin, bins_.end(), Cell{row, low.column}, {}, &Bin::cell);
      continue;
    }
    if (std::ranges::any_of(frusta,
                            [&](const Frustum& f) { return f.MayTouch(bin->low, bin->high); })) {
      out.insert(out.end(), order_.begin() + bin->first, order_.begin() + bin->last);
    }
    ++bin;
  }
  return out;
}

SurfaceView::SurfaceView(const Site& site, const CameraPreset& preset,
                         std::vector<SurfaceSample> points, double d_max_m)
    : camera(preset),
      reach_m(d_max_m),
      samples(std::move(points)),
      model(site),
      index(samples, kCell_m) {}

std::vector<Sighting> SightingsOf(const SurfaceView& view, const Hover& hover) {
  std::vector<Frustum> frusta;
  for (const Shot& shot : hover.shots) {
    frusta.push_back(FrustumOf(view.camera, hover.position, shot, view.reach_m));
  }
  std::vector<Sighting> out;
  for (const uint32_t i : view.index.Candidates(frusta)) {
    const SurfaceSample& sample = view.samples[i];
    const Eigen::Vector3d ray = hover.position - sample.position;
    if (!(ray.dot(sample.normal) > kLeastCosine * ray.norm())) continue;
    int shots = 0;
    bool nadir = false;
    for (size_t k = 0; k < frusta.size(); ++k) {
      if (!frusta[k].Contains(sample.position)) continue;
      ++shots;
      nadir |= hover.shots[k].kind == ViewKind::kNadir;
    }
    if (shots == 0 || !view.model.Sees(hover.position, sample.position)) continue;
    out.push_back({i, static_cast<uint8_t>(std::min(shots, 255)), nadir});
  }
  std::ranges::sort(out, {}, &Sighting::sample);
  return out;
}

}  // namespace stucco::plan
