// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/two_view/panorama.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <optional>

#include "survey/georef.h"

namespace stucco {
namespace {

// A frame at the mean of the recorded positions of a group's photos; nothing without any.
std::optional<Georef> MeanPosition(const std::vector<const CapturedPhoto*>& captures,
                                   const std::vector<int>& group) {
  Georef mean;
  int count = 0;
  for (const int photo : group) {
    const auto& position = captures[photo]->position;
    if (!position || !position->has_height) continue;
    mean.origin_latitude_deg += position->latitude_deg;
    mean.origin_longitude_deg += position->longitude_deg;
    mean.origin_height_m += position->height_m;
    ++count;
  }
  if (count == 0) return std::nullopt;
  mean.origin_latitude_deg /= count;
  mean.origin_longitude_deg /= count;
  mean.origin_height_m /= count;
  return mean;
}

std::vector<std::string> RecordedThere(const Scene& scene,
                                       const std::vector<const CapturedPhoto*>& captures,
                                       const std::vector<int>& lonely,
                                       const std::vector<int>& group) {
  std::vector<std::string> names;
  const std::optional<Georef> mean = MeanPosition(captures, group);
  for (const int photo : lonely) {
    const auto& position = captures[photo]->position;
    if (!mean || !position || !position->has_height) continue;
    const Eigen::Vector3d offset =
        EnuFromGeodetic(*mean, position->latitude_deg, position->longitude_deg, position->height_m);
    if (offset.head<2>().norm() > position->sigma_horizontal_m ||
        std::abs(offset.z()) > position->sigma_vertical_m) {
      continue;
    }
    names.push_back(fmt::format("{} ({:.1f} m away)", scene.photos[photo].name, offset.norm()));
  }
  return names;
}

// Photos that share no verified pair with any other.
std::vector<int> WithoutOverlap(const Scene& scene, const std::vector<VerifiedPair>& pairs) {
  std::vector<uint8_t> matched(scene.photos.size(), 0);
  for (const VerifiedPair& pair : pairs) {
    matched[pair.pair.first] = matched[pair.pair.second] = 1;
  }
  std::vector<int> lonely;
  for (size_t i = 0; i < matched.size(); ++i) {
    if (!matched[i]) lonely.push_back(static_cast<int>(i));
  }
  return lonely;
}

}  // namespace

std::vector<std::string> DescribePanoramas(const Scene& scene,
                                           const std::vector<VerifiedPair>& pairs,
                                           const std::vector<const CapturedPhoto*>& captures) {
  assert(captures.size() == scene.photos.size());
  const std::vector<int> lonely = WithoutOverlap(scene, pairs);
  std::vector<std::string> findings;
  for (const std::vector<int>& group : RotationGroups(scene, pairs)) {
    const std::vector<std::string> more = RecordedThere(scene, captures, lonely, group);
    const bool all_registered =
        std::ranges::all_of(group, [&](int photo) { return scene.photos[photo].pose.has_value(); });
    if (all_registered && more.empty())
      continue;  // others gave them depth, as at a hover of a plan
    std::vector<std::string> names;
    names.reserve(group.size());
    for (const int photo : group) names.push_back(scene.photos[photo].name);
    std::string text = fmt::format(
        "{} of {} photos were taken from one point (rotation only), so that no depth comes "
        "from them among themselves: {}",
        group.size(), scene.photos.size(), fmt::join(names, ", "));
    if (!more.empty()) {
      text += fmt::format("; recorded there too, but overlapping with no other: {}",
                          fmt::join(more, ", "));
    }
    findings.push_back(std::move(text));
  }
  return findings;
}

}  // namespace stucco
