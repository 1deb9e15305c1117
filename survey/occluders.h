// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace stucco {

// Triangles that stand in the way of lines of sight (Embree). Safe to ask from several threads.
class Occluders {
 public:
  // Requires triangles of the vertices. Throws Error (kStageFailed) where Embree cannot run.
  Occluders(std::span<const Eigen::Vector3d> vertices,
            std::span<const std::array<uint32_t, 3>> triangles);
  ~Occluders();
  Occluders(Occluders&&) noexcept;
  Occluders& operator=(Occluders&&) noexcept;

  // Whether any triangle meets the segment that begins at `from` and leads as far as `reach` times
  // `way`. In float, from the middle of all vertices.
  bool Block(const Eigen::Vector3d& from, const Eigen::Vector3d& way, double reach) const;

  // Distance to the first triangle along a ray, in lengths of `way`; nothing where it meets none.
  std::optional<double> FirstHit(const Eigen::Vector3d& from, const Eigen::Vector3d& way) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stucco
