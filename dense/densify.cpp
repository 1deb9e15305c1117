// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/densify.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <opencv2/core/utility.hpp>
#include <vector>

#include "dense/fuse.h"
#include "dense/outliers.h"
#include "dense/patch_match.h"
#include "dense/sources.h"
#include "dense/speckles.h"
#include "dense/view.h"
#include "survey/captures.h"
#include "survey/colmap_io.h"
#include "survey/depth_map.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/lru_cache.h"
#include "survey/parallel.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

// Raise when the code behind a checkpoint changes what it computes.
constexpr char kDepthVersion[] = "depth-1";
constexpr int kLevels = 3;
constexpr int kSpecklePixels = 60;
constexpr float kSpeckleStep = 0.01f;

struct Photo {
  const PosedPhoto* posed = nullptr;
  const Camera* camera = nullptr;
  const SourceChoice* choice = nullptr;
  std::vector<int> sources;  // indices of photos
  std::string content;       // hash of pixels, camera and pose: what a depth map depends on
  std::string first_key;     // of its map of the first pass
};

std::string Bytes(const double* values, size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof(double)};
}

std::string ContentHash(const PosedPhoto& photo, const Camera& camera,
                        const std::string& file_hash) {
  const Pose& pose = photo.cam_from_world;
  return HashParts(std::vector<std::string>{
      file_hash, std::string(Name(camera.model)), Bytes(camera.params.data(), camera.params.size()),
      Bytes(pose.rotation.coeffs().data(), 4), Bytes(pose.translation.data(), 3)});
}

class Densifier {
 public:
  Densifier(const DenseOptions& options, const StageContext& context)
      : options_(options),
        context_(context),
        reconstruction_(ReadColmapModel(context.survey / kSparseFolder)),
        choices_(ChooseSources(reconstruction_, options.max_sources, options.max_image_px)),
        views_(
            context.memory_limit_bytes / 4, [this](int i) { return Load(i); }, ViewBytes),
        maps_(
            context.memory_limit_bytes / 4, [this](int i) { return LoadFirstMap(i); }, MapBytes) {
    CollectPhotos();
  }

  // 1. A depth map per photo from its sources' pixels alone.
  void MatchFirst() {
    context_.progress->Begin("matching depths", photos_.size());
    ForEachPhoto([this](int i) {
      ComputeUnit(context_, "depth", photos_[i].first_key,
                  [&] { return Serialize(MatchDepths(InputOf(i), OptionsOf(i))); });
    });
  }

  // 2. The same again, held against the sources' maps.
  void MatchAgainstMaps() {
    final_maps_.resize(photos_.size());
    context_.progress->Begin("making depths consistent", photos_.size());
    ForEachPhoto([this](int i) {
      std::vector<std::string> parts = {kDepthVersion, photos_[i].first_key};
      for (const int s : photos_[i].sources) parts.push_back(photos_[s].first_key);
      final_maps_[i] = HashParts(parts);
      ComputeUnit(context_, "consistent", final_maps_[i], [&] { return Serialize(Improve(i)); });
    });
  }

  // 3. One cloud.
  PointCloud FuseMaps() {
    std::vector<FusePhoto> fuse_photos;
    for (const Photo& photo : photos_) {
      fuse_photos.push_back(
          {photo.posed->id.value,
           PinholeLevels(*photo.camera, photo.posed->cam_from_world, options_.max_image_px, 1)[0],
           photo.sources});
    }
    LruCache<int, DepthMap> maps(
        context_.memory_limit_bytes / 4, [this](int i) { return LoadFinalMap(i); }, MapBytes);
    FuseOptions fuse;
    fuse.min_consistent = options_.min_consistent;
    if (photos_.size() == 2 && fuse.min_consistent > 1) {
      fuse.min_consistent = 1;
      context_.progress->Note("only two photos: depths that both agree on are kept");
    }
    fuse.max_cost = static_cast<float>(options_.max_cost);
    fuse.max_reprojection_px = static_cast<float>(options_.max_reprojection_px);
    fuse.max_depth_difference = static_cast<float>(options_.max_depth_difference);
    context_.progress->Begin("fusing", photos_.size());
    return Fuse(fuse_photos,
                {[&](int i) { return maps.Get(i); }, [this](int i) { return views_.Get(i); }}, fuse,
                [this] {
                  context_.ThrowIfCancelled();
                  context_.progress->Advance();
                });
  }

  // Distance between neighbouring pixels of the depth maps on the surface at each point, in the
  // photo that saw it closest.
  std::vector<float> Spacing(const PointCloud& cloud) const {
    std::map<uint32_t, std::pair<Eigen::Vector3d, double>> photos;  // centre, pixels per radian
    for (const Photo& photo : photos_) {
      const PinholeView view =
          PinholeLevels(*photo.camera, photo.posed->cam_from_world, options_.max_image_px, 1)[0];
      photos[photo.posed->id.value] = {photo.posed->cam_from_world.Center(), view.fx};
    }
    std::vector<float> spacing(cloud.size(), std::numeric_limits<float>::max());
    for (size_t i = 0; i < cloud.size(); ++i) {
      for (const uint32_t id : cloud.views[i]) {
        const auto& [center, focal_px] = photos.at(id);
        const double distance = (cloud.positions[i] - center).norm();
        spacing[i] = std::min(spacing[i], static_cast<float>(distance / focal_px));
      }
    }
    return spacing;
  }

  void WriteDepthMaps() {
    for (size_t i = 0; i < photos_.size(); ++i) {
      std::filesystem::path path = context_.out / "depth" / (photos_[i].posed->name + ".dmap");
      std::filesystem::create_directories(path.parent_path());
      WriteFile(path, Serialize(*LoadFinalMap(static_cast<int>(i))));
    }
  }

  size_t num_photos() const { return photos_.size(); }

 private:
  void CollectPhotos() {
    std::map<std::string, std::string> hashes;
    for (const CapturedPhoto& photo : ReadCaptures(context_.survey / kCapturesFile).photos) {
      hashes[photo.path] = photo.hash;
    }
    std::map<PhotoId, int> index_of;
    for (const auto& [id, choice] : choices_) {
      Photo photo;
      photo.posed = &reconstruction_.photos.at(id);
      photo.camera = &reconstruction_.cameras.at(photo.posed->camera);
      photo.choice = &choice;
      photo.content = ContentHash(*photo.posed, *photo.camera, hashes[photo.posed->name]);
      index_of[id] = static_cast<int>(photos_.size());
      photos_.push_back(std::move(photo));
    }
    for (Photo& photo : photos_) {
      std::vector<std::string> parts = {
          kDepthVersion, photo.content,
          fmt::format("{} {} {} {}", options_.max_image_px, options_.iterations,
                      photo.choice->min_depth, photo.choice->max_depth)};
      const std::vector<DepthSeed>& seeds = photo.choice->seeds;
      parts.emplace_back(reinterpret_cast<const char*>(seeds.data()),
                         seeds.size() * sizeof(DepthSeed));
      for (const PhotoId id : photo.choice->sources) {
        if (!index_of.contains(id)) continue;
        photo.sources.push_back(index_of[id]);
        parts.push_back(photos_[index_of[id]].content);
      }
      photo.first_key = HashParts(parts);
    }
  }

  template <typename Work>
  void ForEachPhoto(const Work& work) {
    ParallelFor(photos_.size(), context_.threads, [&](size_t i) {
      context_.ThrowIfCancelled();
      work(static_cast<int>(i));
      context_.progress->Advance();
    });
  }

  std::shared_ptr<const ViewPyramid> Load(int index) {
    const Photo& photo = photos_[index];
    return LoadView(context_.photos / photo.posed->name, *photo.camera, photo.posed->cam_from_world,
                    options_.max_image_px, kLevels);
  }

  static size_t ViewBytes(const ViewPyramid& view) {
    size_t bytes = view.color.data.size();
    for (const PackedImage& image : view.images) bytes += image.quads.size() * 5;
    return bytes;
  }

  static size_t MapBytes(const DepthMap& map) { return map.depths.size() * 8; }

  PatchMatchInput InputOf(int index) {
    PatchMatchInput input;
    input.reference = views_.Get(index);
    for (const int s : photos_[index].sources) input.sources.push_back(views_.Get(s));
    input.seeds = photos_[index].choice->seeds;
    input.check_cancelled = [this] { context_.ThrowIfCancelled(); };
    return input;
  }

  PatchMatchOptions OptionsOf(int index) const {
    PatchMatchOptions options;
    options.iterations = options_.iterations;
    options.min_depth = photos_[index].choice->min_depth;
    options.max_depth = photos_[index].choice->max_depth;
    options.seed = 1;
    return options;
  }

  std::shared_ptr<const DepthMap> LoadFirstMap(int index) {
    const std::string bytes = ComputeUnit(context_, "depth", photos_[index].first_key, [&] {
      return Serialize(MatchDepths(InputOf(index), OptionsOf(index)));
    });
    return std::make_shared<const DepthMap>(DeserializeDepthMap(bytes));
  }

  std::shared_ptr<const DepthMap> LoadFinalMap(int index) {
    const std::string bytes = ComputeUnit(context_, "consistent", final_maps_[index],
                                          [&] { return Serialize(Improve(index)); });
    return std::make_shared<const DepthMap>(DeserializeDepthMap(bytes));
  }

  DepthMap Improve(int index) {
    PatchMatchInput input = InputOf(index);
    const auto start = maps_.Get(index);
    input.start = start.get();
    std::vector<std::shared_ptr<const DepthMap>> held;
    for (const int s : photos_[index].sources) {
      held.push_back(maps_.Get(s));
      input.source_maps.push_back(held.back().get());
    }
    DepthMap map = MatchDepths(input, OptionsOf(index));
    RemoveSpeckles(kSpecklePixels, kSpeckleStep, map);
    return map;
  }

  const DenseOptions& options_;
  const StageContext& context_;
  Reconstruction reconstruction_;
  std::map<PhotoId, SourceChoice> choices_;
  std::vector<Photo> photos_;
  LruCache<int, ViewPyramid> views_;
  LruCache<int, DepthMap> maps_;
  std::vector<std::string> final_maps_;  // keys
};

}  // namespace

void Describe(OptionTable& table, DenseOptions& options) {
  table.Add("max_image_px", options.max_image_px, 200, 20000,
            "Photos are reduced to this many pixels on the longer side before depths are matched.");
  table.Add("max_sources", options.max_sources, 1, 16, "Photos that each photo is matched with.");
  table.Add("min_consistent", options.min_consistent, 1, 10,
            "Other photos that must confirm a depth; one in a survey of two photos.");
  table.Add("max_cost", options.max_cost, 0.05, 2,
            "Depths with a worse matching cost (1 - correlation) are dropped.");
  table.Add(
      "max_reprojection_px", options.max_reprojection_px, 0.1, 20,
      "Depths of two photos agree when they are at most this far apart in the picture, pixels.");
  table.Add("max_depth_difference", options.max_depth_difference, 0.0001, 0.5,
            "Depths of two photos agree when they differ by at most this share.");
  table.Add("iterations", options.iterations, 1, 10, "Rounds of matching at full size.");
  table.Add("outlier_sigmas", options.outlier_sigmas, 0, 100,
            "Points farther from their neighbours than this many standard deviations are dropped; "
            "0 keeps all.");
  table.Add("write_depth_maps", options.write_depth_maps,
            "Also write dense/depth/*.dmap, eight bytes a pixel.");
}

void RunDense(const DenseOptions& options, StageContext& context) {
  cv::setNumThreads(1);  // photos run side by side instead
  Densifier densifier(options, context);
  if (densifier.num_photos() == 0) {
    throw Error(
        ErrorKind::kStageFailed,
        "no photo shares enough points with another one under a usable angle",
        "take photos from positions farther apart; calib/calibration.json shows what was posed");
  }
  densifier.MatchFirst();
  densifier.MatchAgainstMaps();
  PointCloud cloud = densifier.FuseMaps();
  if (cloud.size() == 0) {
    throw Error(ErrorKind::kStageFailed, "no depth was confirmed by enough photos",
                "lower dense.min_consistent to 1, or add photos that overlap by 70 % and more");
  }
  if (options.write_depth_maps) densifier.WriteDepthMaps();
  const size_t fused = cloud.size();
  size_t removed = 0;
  if (options.outlier_sigmas > 0) {
    context.progress->Begin("removing outliers", 1);
    removed =
        RemoveOutliers(options.outlier_sigmas, densifier.Spacing(cloud), context.threads, cloud);
    context.progress->Advance();
  }
  WritePly(cloud, context.out / "cloud.ply");
  context.progress->Note(fmt::format("{} points from {} photos, {} outliers removed",
                                     fused - removed, densifier.num_photos(), removed));
}

}  // namespace stucco
