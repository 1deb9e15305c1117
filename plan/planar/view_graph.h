// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "plan/camera/hover.h"
#include "site/sightings.h"

namespace stucco::plan {

// What a hover sees, in any of its shots.
std::vector<Sighting> SightingsOf(const SurfaceView& view, const Hover& hover);

// What one sample has from all hovers of a graph.
struct SampleState {
  double reconstructability = 0;  // h(s, V)
  int hovers = 0;                 // that see it
  int nadirs = 0;                 // of these, with their photo straight down
};

// Which hover sees which samples, with every sample's reconstructability kept up to date as hovers
// come and go. A hover counts once for each sample, in however many of its photos that is: these
// have no parallax, and a pair of hovers tells the same by one pair of photos or by four. The
// weights of the angle come from a table: every term of h is within 1e-4 of
// plan/planar/reconstructability.h. Without `by_scale` pairs are as Smith et al. have them, without
// w4.
class ViewGraph {
 public:
  ViewGraph(const SurfaceView& view, double d_max_m, int threads, bool by_scale = true);

  const SurfaceView& view() const { return view_; }

  // Takes all hovers at once, in parallel; their numbers are their indices. Call it first, on an
  // empty graph.
  void AddAll(std::span<const Hover> hovers);

  size_t size() const { return positions_.size(); }
  const Eigen::Vector3d& position(uint32_t hover) const { return positions_[hover]; }
  bool removed(uint32_t hover) const { return removed_[hover]; }
  std::span<const Sighting> sightings(uint32_t hover) const { return sightings_[hover]; }
  const SampleState& state(uint32_t sample) const { return states_[sample]; }
  std::span<const SampleState> states() const { return states_; }

  // What each of the sightings of a hover that is in the graph adds to its sample: h(s, V) less
  // that without the hover.
  std::vector<double> Shares(uint32_t hover) const;
  // The same for one of them.
  double Share(uint32_t hover, uint32_t sighting) const;
  // What sightings from a new position would add, by one thread.
  std::vector<double> SharesFrom(const Eigen::Vector3d& position,
                                 std::span<const Sighting> sightings) const;

  // Takes the hover out; `shares` are its Shares().
  void Remove(uint32_t hover, std::span<const double> shares);
  // Puts a hover that was taken out back in, at any position.
  void Insert(uint32_t hover, const Eigen::Vector3d& position, std::vector<Sighting> sightings,
              std::span<const double> shares);

 private:
  // One hover as a sample has it.
  struct Ray {
    float x, y, z;  // unit, from the sample to the hover
    float distance_m;
    uint32_t hover;
  };
  Ray RayTo(uint32_t sample, const Eigen::Vector3d& position) const;
  double ShareOf(uint32_t sample, const Ray& ray, uint32_t self) const;
  void Sum(uint32_t sample);

  const SurfaceView& view_;
  double d_max_m_;
  int threads_;
  bool by_scale_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<uint8_t> removed_;
  std::vector<std::vector<Sighting>> sightings_;  // by hover
  std::vector<std::vector<Ray>> rays_;            // by sample
  std::vector<SampleState> states_;               // by sample
};

}  // namespace stucco::plan
