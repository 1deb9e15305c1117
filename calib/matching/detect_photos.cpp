// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/detect_photos.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "calib/features/same_place.h"
#include "calib/scene/camera_key.h"
#include "survey/files.h"
#include "survey/image.h"
#include "survey/parallel.h"
#include "survey/release.h"

namespace stucco {
namespace {

// Raise when the code behind a checkpoint changes what it computes.
constexpr char kFeaturesVersion[] = "features-1";
constexpr char kWallVersion[] = "wall-2";
// A rectified wall gets at most this part of the features of a photo.
constexpr int kWallShare = 4;
// Descriptors that are kept for matching take at most this part of the memory.
constexpr int kDescriptorShare = 4;
// Keypoints this near to each other show the same, pixels of the picture they were detected in: as
// far as one is off.
constexpr double kSamePlace_px = 1;

// SIFT keeps 11 float images of the doubled size while it works, and as many of each half of it: of
// 6.3 megapixels 1.5 GiB as measured.
int ThreadsWithinMemory(const CalibOptions& options,
                        const std::vector<const CapturedPhoto*>& photos,
                        const StageContext& context) {
  double largest = 1;
  for (const CapturedPhoto* photo : photos) {
    const ImageSize size = ScaledSize({photo->width_px, photo->height_px}, options.max_image_px);
    largest = std::max(largest, static_cast<double>(size.width_px) * size.height_px);
  }
  const double bytes_each = largest * 4 * 4 * 15;
  const double fitting = 0.8 * static_cast<double>(context.memory_limit_bytes) / bytes_each;
  return std::clamp(static_cast<int>(fitting), 1, context.threads);
}

// A photo that is decoded when something is to be found in it.
class LazyPhoto {
 public:
  LazyPhoto(const CalibOptions& options, const CapturedPhoto& photo, const StageContext& context)
      : options_(options), photo_(photo), context_(context) {}

  const Image& Pixels() {
    if (!image_) image_ = ReadJpeg(context_.photos / photo_.path, 3, options_.max_image_px);
    return *image_;
  }
  Features Detect() {
    return DetectFeatures(Pixels(), {photo_.width_px, photo_.height_px},
                          {options_.max_image_px, options_.max_features});
  }

 private:
  const CalibOptions& options_;
  const CapturedPhoto& photo_;
  const StageContext& context_;
  std::optional<Image> image_;
};

// All that features on a rectified wall depend on beside the photo and the options.
std::string KeyOf(const WallView& view, const Camera& camera) {
  const Eigen::Vector4d q = view.cam_from_plan.rotation.coeffs();
  const Eigen::Vector3d& t = view.cam_from_plan.translation;
  return fmt::format("{} {} {} {} | {} {} {} {} | {} | {} {} {} | {}", view.wall.a_m.x(),
                     view.wall.a_m.y(), view.wall.b_m.x(), view.wall.b_m.y(), view.along_m.from_m,
                     view.along_m.to_m, view.z_m.from_m, view.z_m.to_m,
                     fmt::join(std::array{q[0], q[1], q[2], q[3]}, " "), t.x(), t.y(), t.z(),
                     KeyOf(camera));
}

std::string PlainUnit(const DetectInput& input, int photo, LazyPhoto& pixels) {
  return ComputeUnit(input.context, "features",
                     FeaturesKey(input.options, *input.set.photos[photo]),
                     [&] { return Serialize(pixels.Detect()); });
}

std::string WallUnit(const DetectInput& input, int photo, int wall, LazyPhoto& pixels) {
  const Camera& camera = input.set.captures.cameras[input.set.photos[photo]->camera].intrinsics;
  const WallView& view = input.set.guidance.walls.at({photo, wall});
  return ComputeUnit(
      input.context, "features", WallKey(input.options, input.set, photo, wall), [&] {
        return Serialize(
            DetectOnWall(pixels.Pixels(), camera, view, input.options.max_features / kWallShare));
      });
}

// How much of the memory descriptors may take as long as pairs are matched.
class Budget {
 public:
  explicit Budget(uint64_t bytes) : bytes_(static_cast<int64_t>(bytes)) {}

  void Keep(Features& features) {
    const auto bytes = static_cast<int64_t>(features.size() * sizeof(features.descriptors[0]));
    if (bytes_.fetch_sub(bytes) < bytes) Release(features.descriptors);
  }

 private:
  std::atomic<int64_t> bytes_;
};

// Fills the photo's runs in `detected`, which must be there already.
void DetectOnWalls(const DetectInput& input, int photo, LazyPhoto& pixels, Budget& budget,
                   DetectedFeatures& detected) {
  const Camera& camera = input.set.captures.cameras[input.set.photos[photo]->camera].intrinsics;
  size_t begin = detected.plain[photo].size();
  for (auto run = detected.walls.lower_bound({photo, 0});
       run != detected.walls.end() && run->first.first == photo; ++run) {
    Features features = DeserializeFeatures(WallUnit(input, photo, run->first.second, pixels));
    const WallView& view = input.set.guidance.walls.at(run->first);
    std::vector<OnWall> places = PlacesOnWall(features, camera, view);
    budget.Keep(features);
    run->second = {begin, std::move(features), std::move(places)};
    begin += run->second.places.size();
  }
}

bool HasDescriptors(const Features& features) {
  return features.descriptors.size() == features.size();
}

}  // namespace

std::string FeaturesKey(const CalibOptions& options, const CapturedPhoto& photo) {
  return HashParts(std::array<std::string, 4>{kFeaturesVersion, photo.hash,
                                              std::to_string(options.max_image_px),
                                              std::to_string(options.max_features)});
}

std::string WallKey(const CalibOptions& options, const PhotoSet& set, int photo, int wall) {
  const Camera& camera = set.captures.cameras[set.photos[photo]->camera].intrinsics;
  return HashParts(std::array<std::string, 3>{kWallVersion,
                                              FeaturesKey(options, *set.photos[photo]),
                                              KeyOf(set.guidance.walls.at({photo, wall}), camera)});
}

double DetectionScale(const CalibOptions& options, const CapturedPhoto& photo) {
  const ImageSize scaled = ScaledSize({photo.width_px, photo.height_px}, options.max_image_px);
  return static_cast<double>(photo.width_px) / scaled.width_px;
}

double SamePlace_px(const CalibOptions& options, const CapturedPhoto& photo) {
  return kSamePlace_px * DetectionScale(options, photo);
}

std::vector<std::vector<int32_t>> PlacesOfAll(const CalibOptions& options, const PhotoSet& set,
                                              const DetectedFeatures& detected) {
  std::vector<std::vector<int32_t>> places(set.photos.size());
  for (size_t i = 0; i < places.size(); ++i) {
    const Features all = detected.AllOf(static_cast<int>(i));
    places[i] =
        FindPlaces(all.keypoints, detected.plain[i].size(), SamePlace_px(options, *set.photos[i]));
  }
  return places;
}

Features DetectedFeatures::AllOf(int photo) const {
  Features all{plain[photo].keypoints, plain[photo].colors, {}};
  for (auto run = walls.lower_bound({photo, 0}); run != walls.end() && run->first.first == photo;
       ++run) {
    const Features& more = run->second.features;
    all.keypoints.insert(all.keypoints.end(), more.keypoints.begin(), more.keypoints.end());
    all.colors.insert(all.colors.end(), more.colors.begin(), more.colors.end());
  }
  return all;
}

DetectedFeatures DetectAll(const CalibOptions& options, const PhotoSet& set,
                           const StageContext& context) {
  const size_t count = set.photos.size();
  const DetectInput input{options, set, context};
  DetectedFeatures detected;
  detected.plain.resize(count);
  for (const auto& [photo_and_wall, expected] : set.guidance.walls) detected.walls[photo_and_wall];
  Budget budget(context.memory_limit_bytes / kDescriptorShare);
  context.progress->Begin("detecting features", count);
  ParallelFor(count, ThreadsWithinMemory(options, set.photos, context), [&](size_t i) {
    context.ThrowIfCancelled();
    const int photo = static_cast<int>(i);
    LazyPhoto pixels(options, *set.photos[i], context);
    detected.plain[i] = DeserializeFeatures(PlainUnit(input, photo, pixels));
    budget.Keep(detected.plain[i]);
    DetectOnWalls(input, photo, pixels, budget, detected);
    context.progress->Advance();
  });
  return detected;
}

void DropDescriptors(DetectedFeatures& detected) {
  for (Features& features : detected.plain) Release(features.descriptors);
  for (auto& [photo_and_wall, run] : detected.walls) Release(run.features.descriptors);
}

Features FeaturesOfPhoto(const DetectInput& input, const DetectedFeatures& detected, int photo) {
  if (HasDescriptors(detected.plain[photo])) return detected.plain[photo];
  LazyPhoto pixels(input.options, *input.set.photos[photo], input.context);
  return DeserializeFeatures(PlainUnit(input, photo, pixels));
}

Features FeaturesOnWall(const DetectInput& input, const DetectedFeatures& detected, int photo,
                        int wall) {
  const Features& kept = detected.walls.at({photo, wall}).features;
  if (HasDescriptors(kept)) return kept;
  LazyPhoto pixels(input.options, *input.set.photos[photo], input.context);
  return DeserializeFeatures(WallUnit(input, photo, wall, pixels));
}

}  // namespace stucco
