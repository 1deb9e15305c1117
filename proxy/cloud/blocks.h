// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "proxy/cloud/samples.h"

namespace stucco {

// Where a cloud's points lie, by blocks of some ten thousand of them that follow each other: clouds
// are written by tiles or flight lines, so that what lies in a small place is read without most of
// the others.
class CloudBlocks {
 public:
  // Reads the cloud once. Must not outlive what the stream refers to.
  explicit CloudBlocks(PointStream cloud);

  // The points of all blocks that reach into the box, in the cloud's order: all that lie in it, and
  // others.
  PointStream Near(const Eigen::AlignedBox3d& box) const;

 private:
  struct Block {
    Eigen::AlignedBox3d box;
    PlyPlace begin;
    uint64_t count = 0;
  };

  PointStream cloud_;
  std::vector<Block> blocks_;  // none: a cloud that is only read as a whole
};

}  // namespace stucco
