// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/wall_features.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "calib/expect/project_inside.h"
#include "calib/features/best_two.h"
#include "calib/features/chance.h"
#include "calib/features/descriptors.h"

namespace stucco {
namespace {

constexpr int kLongestSide_px = 30000;  // remap takes no more than 32767
constexpr double kLikeScale = 2.5;
// What is as similar within this multiple of the reach makes a match doubtful: windows repeat, and
// the record may be off by more than the reach.
constexpr double kRivals = 2.5;
constexpr double kLonelyAngle_rad = 0.6;
// Shifts that differ by less are one.
constexpr double kSameShift_m = 0.7;
// Votes for a shift over those for any other, and the logarithm of how often chance may give them.
constexpr double kAhead = 1.5;
const double kLogSure = std::log(1e-3);
// Matches are looked for so near to where the common shift puts them.
constexpr double kGuided_m = 1;
// A keypoint's descriptor reaches this many standard deviations of its blob in each direction.
constexpr double kSupport = 6;

// A picture of a part of the wall: columns along it, rows downwards.
struct WallRaster {
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();  // top left
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  double pixel_m = 1;
  int width_px = 0;
  int height_px = 0;

  Eigen::Vector3d Place(double x, double y) const {
    return corner + pixel_m * (x * along - y * Eigen::Vector3d::UnitZ());
  }
};

Eigen::Vector3d Level(const Eigen::Vector2d& way) {
  return {way.x(), way.y(), 0};
}

// As fine as the photo is where the wall is nearest, so that nothing is lost, but with no more
// pixels than the photo has.
WallRaster RasterOf(const WallView& view, const Camera& camera) {
  WallRaster raster;
  raster.along = Level(view.wall.along());
  const Eigen::Vector3d foot(view.wall.a_m.x(), view.wall.a_m.y(), 0);
  raster.corner =
      foot + view.along_m.from_m * raster.along + view.z_m.to_m * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d center = view.cam_from_plan.Center();
  const double u =
      std::clamp((center - foot).dot(raster.along), view.along_m.from_m, view.along_m.to_m);
  const double z = std::clamp(center.z(), view.z_m.from_m, view.z_m.to_m);
  const double nearest = (foot + u * raster.along + z * Eigen::Vector3d::UnitZ() - center).norm();
  const double most_px = static_cast<double>(camera.width_px) * camera.height_px;
  const double finest = std::sqrt(view.along_m.length_m() * view.z_m.length_m() / most_px);
  const double longest_m = std::max(view.along_m.length_m(), view.z_m.length_m());
  raster.pixel_m = std::max({nearest / camera.FocalX(), finest, longest_m / kLongestSide_px, 1e-4});
  raster.width_px = std::max(1, static_cast<int>(view.along_m.length_m() / raster.pixel_m));
  raster.height_px = std::max(1, static_cast<int>(view.z_m.length_m() / raster.pixel_m));
  return raster;
}

Image Rectify(const Image& image, const Camera& camera, const Pose& pose,
              const WallRaster& raster) {
  cv::Mat at(raster.height_px, raster.width_px, CV_32FC2);
  for (int y = 0; y < raster.height_px; ++y) {
    for (int x = 0; x < raster.width_px; ++x) {
      const auto pixel = ProjectInside(camera, pose * raster.Place(x + 0.5, y + 0.5));
      at.at<cv::Point2f>(y, x) = pixel ? cv::Point2f(static_cast<float>(pixel->x() - 0.5),
                                                     static_cast<float>(pixel->y() - 0.5))
                                       : cv::Point2f(-10, -10);
    }
  }
  const cv::Mat photo(image.height_px, image.width_px, CV_8UC3,
                      const_cast<uint8_t*>(image.data.data()));
  Image rectified{raster.width_px, raster.height_px, 3, {}};
  rectified.data.resize(static_cast<size_t>(raster.width_px) * raster.height_px * 3);
  cv::Mat target(raster.height_px, raster.width_px, CV_8UC3, rectified.data.data());
  cv::remap(photo, target, at, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return rectified;
}

// Whether the photo shows all of a square around the place.
bool Shows(const Camera& camera, const Pose& pose, const WallRaster& raster, const Keypoint& k) {
  const double reach = kSupport * k.scale;
  for (const double dx : {-reach, reach}) {
    for (const double dy : {-reach, reach}) {
      if (!ProjectInside(camera, pose * raster.Place(k.x + dx, k.y + dy))) return false;
    }
  }
  return true;
}

// The larger of the distances along the wall and in height.
double Apart(const OnWall& a, const OnWall& b) {
  return std::max(std::abs(a.along_m - b.along_m), std::abs(a.z_m - b.z_m));
}

bool IsOfLikeSize(const OnWall& a, const OnWall& b) {
  return a.scale_m <= kLikeScale * b.scale_m && b.scale_m <= kLikeScale * a.scale_m;
}

// Without a rival to compare with, a match must be good by itself.
bool IsSure(const BestTwo& match) {
  return match.second >= 0 || DescriptorAngle(match.best) < kLonelyAngle_rad;
}

[[maybe_unused]] bool IsWhole(const WallKeypoints& keypoints) {
  return keypoints.descriptors.size() == keypoints.places.size() * kDescriptorSize;
}

// Where keypoints of the second photo may lie for those of the first: shifted on the wall and about
// there within `reach_m`; what is as similar within `rivals_m` makes a match doubtful.
struct Window {
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();  // along, up
  double reach_m = 4;
  double rivals_m = 10;
};

struct NearestOnWall {
  std::vector<BestTwo> of_first;
  std::vector<BestTwo> of_second;
};

NearestOnWall FindNearest(const WallKeypoints& first, const WallKeypoints& second,
                          const AlongOrder& columns, const Window& window) {
  NearestOnWall nearest{std::vector<BestTwo>(first.places.size()),
                        std::vector<BestTwo>(second.places.size())};
  std::vector<int32_t> products(second.places.size());
  for (size_t row = 0; row < first.places.size(); ++row) {
    OnWall place = first.places[row];
    place.along_m += static_cast<float>(window.shift_m.x());
    place.z_m += static_cast<float>(window.shift_m.y());
    const auto near = [&](double along) {
      return std::lower_bound(columns.along_m.begin(), columns.along_m.end(), along) -
             columns.along_m.begin();
    };
    const auto begin = near(place.along_m - window.rivals_m);
    const auto end = near(place.along_m + window.rivals_m);
    DotProducts(first.descriptors.data() + row * kDescriptorSize,
                columns.descriptors.data() + begin * kDescriptorSize, static_cast<int>(end - begin),
                products.data());
    for (auto c = begin; c < end; ++c) {
      const int other = columns.index[c];
      const double apart = Apart(place, second.places[other]);
      if (apart > window.rivals_m || !IsOfLikeSize(place, second.places[other])) continue;
      const int32_t product = products[c - begin];
      if (apart <= window.reach_m) {
        nearest.of_first[row].Offer(product, other);
        nearest.of_second[other].Offer(product, static_cast<int>(row));
      } else {
        nearest.of_first[row].Rival(product);
        nearest.of_second[other].Rival(product);
      }
    }
  }
  return nearest;
}

std::vector<Match> SureMatches(const NearestOnWall& nearest, double ratio) {
  std::vector<Match> matches = MutualMatches(nearest.of_first, nearest.of_second, ratio);
  std::erase_if(matches, [&](const Match& match) {
    return !IsSure(nearest.of_first[match.first]) || !IsSure(nearest.of_second[match.second]);
  });
  return matches;
}

// The shift on the wall that most nearest neighbours have in common: nothing where that may be
// chance, or where another shift has nearly as many, as on what repeats.
std::optional<Eigen::Vector2d> CommonShift(const WallKeypoints& first, const WallKeypoints& second,
                                           const std::vector<Match>& neighbours, double reach_m) {
  const int count = static_cast<int>(neighbours.size());
  std::vector<Eigen::Vector2d> shifts;
  shifts.reserve(neighbours.size());
  for (const Match& match : neighbours) {
    const OnWall& from = first.places[match.first];
    const OnWall& to = second.places[match.second];
    shifts.emplace_back(to.along_m - from.along_m, to.z_m - from.z_m);
  }
  std::vector<int> votes(shifts.size(), 0);
  for (size_t i = 0; i < shifts.size(); ++i) {
    for (size_t k = 0; k < shifts.size(); ++k) {
      votes[i] += i != k && (shifts[i] - shifts[k]).norm() < kSameShift_m;
    }
  }
  const auto most = std::ranges::max_element(votes);
  if (most == votes.end()) return std::nullopt;
  const Eigen::Vector2d best = shifts[most - votes.begin()];
  int rival = 0;
  for (size_t i = 0; i < shifts.size(); ++i) {
    if ((shifts[i] - best).norm() > 2 * kSameShift_m) rival = std::max(rival, votes[i]);
  }
  const double chance = std::min(1.0, std::pow(kSameShift_m / reach_m, 2));
  if (std::log(count) + LogBinomialTail(count - 1, *most, chance) > kLogSure) return std::nullopt;
  if (*most < kAhead * rival) return std::nullopt;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int near = 0;
  for (const Eigen::Vector2d& shift : shifts) {
    if ((shift - best).norm() >= kSameShift_m) continue;
    sum += shift;
    ++near;
  }
  return sum / near;
}

}  // namespace

AlongOrder SortAlong(const WallKeypoints& keypoints) {
  AlongOrder order;
  order.index.resize(keypoints.places.size());
  std::iota(order.index.begin(), order.index.end(), 0);
  std::stable_sort(order.index.begin(), order.index.end(), [&](int a, int b) {
    return keypoints.places[a].along_m < keypoints.places[b].along_m;
  });
  for (const int i : order.index) {
    order.along_m.push_back(keypoints.places[i].along_m);
    const auto row =
        keypoints.descriptors.begin() + static_cast<std::ptrdiff_t>(i) * kDescriptorSize;
    order.descriptors.insert(order.descriptors.end(), row, row + kDescriptorSize);
  }
  return order;
}

Features DetectOnWall(const Image& image, const Camera& camera, const WallView& view,
                      int max_features) {
  const Camera scaled = Resized(camera, image.width_px, image.height_px);
  const WallRaster raster = RasterOf(view, scaled);
  const ImageSize size{raster.width_px, raster.height_px};
  const Features on_raster =
      DetectFeatures(Rectify(image, scaled, view.cam_from_plan, raster), size, {0, max_features});
  Features features;
  for (size_t i = 0; i < on_raster.size(); ++i) {
    const Keypoint& k = on_raster.keypoints[i];
    if (!Shows(camera, view.cam_from_plan, raster, k)) continue;
    const Eigen::Vector3d in_cam = view.cam_from_plan * raster.Place(k.x, k.y);
    const auto pixel = ProjectInside(camera, in_cam);
    if (!pixel) continue;
    const double scale_px = k.scale * raster.pixel_m / in_cam.norm() * camera.FocalX();
    features.keypoints.push_back({static_cast<float>(pixel->x()), static_cast<float>(pixel->y()),
                                  static_cast<float>(scale_px)});
    features.colors.push_back(on_raster.colors[i]);
    features.descriptors.push_back(on_raster.descriptors[i]);
  }
  return features;
}

std::optional<OnWall> PlaceOnWall(const Keypoint& keypoint, const Camera& camera,
                                  const WallView& view) {
  const auto ray = camera.Unproject({keypoint.x, keypoint.y});
  if (!ray) return std::nullopt;
  const Eigen::Vector3d along = Level(view.wall.along());
  const Eigen::Vector3d normal = Level(view.wall.outwards());
  const Eigen::Vector3d foot(view.wall.a_m.x(), view.wall.a_m.y(), 0);
  const Pose plan_from_cam = view.cam_from_plan.Inverse();
  const Eigen::Vector3d& center = plan_from_cam.translation;
  const Eigen::Vector3d way = plan_from_cam.rotation * ray->homogeneous();
  const double reach = -(center - foot).dot(normal) / way.dot(normal);  // in lengths of `way`
  if (!(reach > 0) || !std::isfinite(reach)) return std::nullopt;
  const Eigen::Vector3d in_plan = center + reach * way;
  const double scale = keypoint.scale / camera.FocalX() * (in_plan - center).norm();
  return OnWall{static_cast<float>((in_plan - foot).dot(along)), static_cast<float>(in_plan.z()),
                static_cast<float>(scale)};
}

std::vector<OnWall> PlacesOnWall(const Features& features, const Camera& camera,
                                 const WallView& view) {
  std::vector<OnWall> places;
  places.reserve(features.size());
  for (const Keypoint& k : features.keypoints) {
    places.push_back(PlaceOnWall(k, camera, view).value_or(OnWall{}));
  }
  return places;
}

std::vector<Match> MatchWithin(const WallKeypoints& first, const WallKeypoints& second,
                               double reach_m, double ratio) {
  assert(IsWhole(first) && IsWhole(second));
  return SureMatches(FindNearest(first, second, SortAlong(second), {{0, 0}, reach_m, reach_m}),
                     ratio);
}

std::vector<Match> MatchOnWall(const WallKeypoints& first, const WallKeypoints& second,
                               double reach_m, double ratio) {
  assert(IsWhole(first) && IsWhole(second));
  const AlongOrder columns = SortAlong(second);
  const double far_m = kRivals * reach_m;
  std::vector<Match> matches =
      SureMatches(FindNearest(first, second, columns, {{0, 0}, reach_m, far_m}), ratio);
  // Whatever the records are off by, they are so for the whole wall.
  const NearestOnWall anywhere = FindNearest(first, second, columns, {{0, 0}, far_m, far_m});
  const auto shift =
      CommonShift(first, second, MutualMatches(anywhere.of_first, anywhere.of_second, 1), far_m);
  if (!shift) return matches;
  std::vector<Match> guided = SureMatches(
      FindNearest(first, second, columns, {*shift, kGuided_m, kRivals * kGuided_m}), ratio);
  return guided.size() > matches.size() ? guided : matches;
}

}  // namespace stucco
