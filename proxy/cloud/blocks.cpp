// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/cloud/blocks.h"

#include <utility>

namespace stucco {

CloudBlocks::CloudBlocks(PointStream cloud) : cloud_(std::move(cloud)) {
  constexpr uint64_t kPoints = 1 << 15;  // about a megabyte of a file
  if (!cloud_.for_some) return;
  for (PlyPlace at; at.point < cloud_.count;) {
    Block& block = blocks_.emplace_back(Block{.box = {}, .begin = at});
    at = cloud_.for_some(at, kPoints, [&](const CloudPoint& point) {
      if (point.position.allFinite()) block.box.extend(point.position);
    });
    block.count = at.point - block.begin.point;
  }
}

PointStream CloudBlocks::Near(const Eigen::AlignedBox3d& box) const {
  if (!cloud_.for_some) return cloud_;
  std::vector<Block> near;  // what follows each other as one
  PointStream stream;
  for (const Block& block : blocks_) {
    if (!block.box.intersects(box)) continue;
    stream.count += block.count;
    const bool goes_on =
        !near.empty() && near.back().begin.point + near.back().count == block.begin.point;
    if (goes_on) {
      near.back().count += block.count;
    } else {
      near.push_back(block);
    }
  }
  stream.for_each = [near = std::move(near), for_some = cloud_.for_some](const PointVisit& visit) {
    for (const Block& run : near) for_some(run.begin, run.count, visit);
  };
  return stream;
}

}  // namespace stucco
