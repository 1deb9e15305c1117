// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stucco {

// Points in world coordinates. `normals`, `colors` and `views` are either empty or of the same
// length as `positions`. `views` are the PhotoId values that see the point, ascending.
struct PointCloud {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Vector3f> normals;  // unit length, towards the cameras that see the point
  std::vector<std::array<uint8_t, 3>> colors;
  std::vector<std::vector<uint32_t>> views;

  size_t size() const { return positions.size(); }
};

std::optional<std::string> FindProblem(const PointCloud& cloud);

// PLY: reads ascii, binary little and big endian; x y z, optional nx ny nz, red green blue and the
// list property `view_indices` (the name OpenMVS uses); other vertex properties and elements are
// skipped. Throws Error (kBadInput) naming file and reason.
PointCloud ReadPly(const std::filesystem::path& path);

// Binary little endian, positions as double.
void WritePly(const PointCloud& cloud, const std::filesystem::path& path);

}  // namespace stucco
