// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/densify.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "dense/fuse.h"
#include "dense/fused_points.h"
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
#include "survey/one_opencv_thread.h"
#include "survey/parallel.h"
#include "survey/ply.h"
#include "survey/survey_folder.h"
#include "survey/survey_photo.h"

namespace stucco {
namespace {

// Raise when the code behind a checkpoint changes what it computes.
constexpr char kDepthVersion[] = "depth-7";
constexpr int kLevels = 3;
constexpr int kSpecklePixels = 60;
constexpr float kSpeckleStep = 0.01f;
// Photos that a photo's depths are held against when they are fused. In surveys by plan a place is
// in about a dozen photos, of which half are sources.
constexpr int kComparedPhotos = 24;

// What the depth map of a photo is made from.
struct DepthJob {
  const SourceChoice* choice = nullptr;
  std::vector<int> sources;     // indices of photos
  std::vector<int> neighbours;  // likewise; what its map is fused with
  std::string content;          // hash of pixels, camera and pose: what a depth map depends on
  std::string first_key;        // of its map of the first pass
};

// What matching one photo holds for each of its pixels besides what is cached: of two levels
// planes, costs and what each source costs, and the map.
uint64_t MatchingBytesPerPixel(int sources) {
  return (12 + 4 + 4 * sources) * 5 / 4 + 8;
}

std::string Bytes(const double* values, size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof(double)};
}

std::string ContentHash(const SurveyPhoto& photo) {
  const Camera& camera = photo.camera;
  const Pose& pose = photo.cam_from_world;
  return HashParts(std::vector<std::string>{photo.captured.hash, std::string(Name(camera.model)),
                                            Bytes(camera.params.data(), camera.params.size()),
                                            Bytes(pose.rotation.coeffs().data(), 4),
                                            Bytes(pose.translation.data(), 3)});
}

class Densifier {
 public:
  Densifier(const DenseOptions& options, const StageContext& context)
      : options_(options),
        context_(context),
        views_(
            context.memory_limit_bytes / 4, [this](int i) { return Load(i); }, ViewBytes),
        maps_(
            std::in_place, context.memory_limit_bytes / 4,
            [this](int i) { return LoadFirstMap(i); }, MapBytes) {
    const Reconstruction model = ReadColmapModel(context.survey / kSparseFolder);
    choices_ = ChooseSources(model, {.sources = options.max_sources,
                                     .neighbours = kComparedPhotos,
                                     .max_image_px = options.max_image_px});
    CollectPhotos(JoinPhotos(model, ReadCaptures(context.survey / kCapturesFile)));
    PrepareJobs();
  }

  // 1. A depth map per photo from its sources' pixels alone.
  void MatchFirst() {
    context_.progress->Begin("matching depths", photos_.size());
    ForEachPhoto([this](int i) {
      ComputeUnit(context_, "depth", jobs_[i].first_key,
                  [&] { return Serialize(MatchDepths(InputOf(i), OptionsOf(i))); });
    });
  }

  // 2. The same again, held against the sources' maps.
  void MatchAgainstMaps() {
    final_maps_.resize(photos_.size());
    context_.progress->Begin("making depths consistent", photos_.size());
    ForEachPhoto([this](int i) {
      std::vector<std::string> parts = {kDepthVersion, jobs_[i].first_key};
      for (const int s : jobs_[i].sources) parts.push_back(jobs_[s].first_key);
      final_maps_[i] = HashParts(parts);
      ComputeUnit(context_, "consistent", final_maps_[i], [&] { return Serialize(Improve(i)); });
    });
  }

  // 3. One cloud.
  void FuseMaps(FusedPointsFile& points) {
    maps_.reset();  // those of the first pass have served
    LruCache<int, DepthMap> maps(
        context_.memory_limit_bytes / 4, [this](int i) { return LoadFinalMap(i); }, MapBytes);
    FuseInput input;
    for (size_t i = 0; i < photos_.size(); ++i) {
      input.ids.push_back(photos_[i].id);
      input.cameras.push_back(CameraOf(photos_[i]));
      input.neighbours.push_back(jobs_[i].neighbours);
    }
    input.map = [&](int i) { return maps.Get(i); };
    input.colors = [this](int i) { return views_.Get(i); };
    FuseOptions fuse;
    fuse.threads = context_.threads;
    fuse.min_consistent = options_.min_consistent;
    if (photos_.size() == 2 && fuse.min_consistent > 1) {
      fuse.min_consistent = 1;
      context_.progress->Note("only two photos: depths that both agree on are kept");
    }
    fuse.max_cost = static_cast<float>(options_.max_cost);
    fuse.max_reprojection_px = static_cast<float>(options_.max_reprojection_px);
    fuse.max_depth_difference = static_cast<float>(options_.max_depth_difference);
    context_.progress->Begin("fusing", photos_.size());
    Fuse(input, fuse, [&](const FusedPoints& of_photo) {
      context_.ThrowIfCancelled();
      for (size_t i = 0; i < of_photo.size(); ++i) points.Add(of_photo.at(i));
      context_.progress->Advance();
    });
    views_.Clear();  // outliers take what they held
  }

  void WriteDepthMaps() {
    for (size_t i = 0; i < photos_.size(); ++i) {
      std::filesystem::path path = context_.out / "depth" / (photos_[i].path() + ".dmap");
      std::filesystem::create_directories(path.parent_path());
      WriteFile(path, Serialize(*LoadFinalMap(static_cast<int>(i))));
    }
  }

  size_t num_photos() const { return photos_.size(); }

 private:
  // Keeps the photos that have others to match with.
  void CollectPhotos(std::vector<SurveyPhoto> photos) {
    for (SurveyPhoto& photo : photos) {
      if (choices_.contains(photo.id)) photos_.push_back(std::move(photo));
    }
  }

  void PrepareJobs() {
    std::map<PhotoId, int> index_of;
    for (const SurveyPhoto& photo : photos_) {
      index_of[photo.id] = static_cast<int>(jobs_.size());
      jobs_.push_back({&choices_.at(photo.id), {}, {}, ContentHash(photo), {}});
    }
    for (DepthJob& job : jobs_) {
      std::vector<std::string> parts = {
          kDepthVersion, job.content,
          fmt::format("{} {} {} {}", options_.max_image_px, options_.iterations,
                      job.choice->min_depth, job.choice->max_depth)};
      const std::vector<DepthSeed>& seeds = job.choice->seeds;
      parts.emplace_back(reinterpret_cast<const char*>(seeds.data()),
                         seeds.size() * sizeof(DepthSeed));
      for (const PhotoId id : job.choice->sources) {
        if (!index_of.contains(id)) continue;
        job.sources.push_back(index_of[id]);
        parts.push_back(jobs_[index_of[id]].content);
      }
      job.first_key = HashParts(parts);
      for (const PhotoId id : job.choice->neighbours) {
        if (index_of.contains(id)) job.neighbours.push_back(index_of[id]);
      }
    }
  }

  PinholeCamera CameraOf(const SurveyPhoto& photo) const {
    return PinholeLevels(photo.camera, photo.cam_from_world, options_.max_image_px, 1)[0];
  }

  // As many as match beside each other in the quarter of the memory limit that the caches of photos
  // and maps leave for it.
  int MatchingThreads() const {
    uint64_t most_px = 1;
    for (const SurveyPhoto& photo : photos_) {
      const ImageSize size =
          ScaledSize({photo.camera.width_px, photo.camera.height_px}, options_.max_image_px);
      most_px = std::max(most_px, uint64_t{1} * size.width_px * size.height_px);
    }
    const uint64_t bytes = most_px * MatchingBytesPerPixel(options_.max_sources);
    return static_cast<int>(
        std::clamp<uint64_t>(context_.memory_limit_bytes / 4 / bytes, 1, context_.threads));
  }

  template <typename Work>
  void ForEachPhoto(const Work& work) {
    ParallelFor(photos_.size(), MatchingThreads(), [&](size_t i) {
      context_.ThrowIfCancelled();
      work(static_cast<int>(i));
      context_.progress->Advance();
    });
  }

  std::shared_ptr<const ViewPyramid> Load(int index) {
    return LoadView(context_.photos, photos_[index], options_.max_image_px, kLevels);
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
    for (const int s : jobs_[index].sources) input.sources.push_back(views_.Get(s));
    input.seeds = jobs_[index].choice->seeds;
    input.check_cancelled = [this] { context_.ThrowIfCancelled(); };
    return input;
  }

  PatchMatchOptions OptionsOf(int index) const {
    PatchMatchOptions options;
    options.iterations = options_.iterations;
    options.min_depth = jobs_[index].choice->min_depth;
    options.max_depth = jobs_[index].choice->max_depth;
    options.seed = 1;
    return options;
  }

  std::shared_ptr<const DepthMap> LoadFirstMap(int index) {
    const std::string bytes = ComputeUnit(context_, "depth", jobs_[index].first_key, [&] {
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
    const auto start = maps_->Get(index);
    input.start = start.get();
    std::vector<std::shared_ptr<const DepthMap>> held;
    for (const int s : jobs_[index].sources) {
      held.push_back(maps_->Get(s));
      input.source_maps.push_back(held.back().get());
    }
    DepthMap map = MatchDepths(input, OptionsOf(index));
    RemoveSpeckles(kSpecklePixels, kSpeckleStep, map);
    return map;
  }

  const DenseOptions& options_;
  const StageContext& context_;
  std::map<PhotoId, SourceChoice> choices_;
  std::vector<SurveyPhoto> photos_;
  std::vector<DepthJob> jobs_;  // by photo
  LruCache<int, ViewPyramid> views_;
  std::optional<LruCache<int, DepthMap>> maps_;  // of the first pass
  std::vector<std::string> final_maps_;          // keys
};

// Returns how many points were kept.
size_t WriteCloud(FusedPointsFile& points, const std::vector<bool>& kept,
                  const std::filesystem::path& path) {
  const auto count = static_cast<size_t>(std::ranges::count(kept, true));
  PlyWriter writer(path, {.points = count, .normals = true, .colors = true, .views = true},
                   kComparedPhotos + 1);
  size_t i = 0;
  points.ForEach([&](const FusedPoint& point) {
    if (kept[i++]) writer.Add(point.point);
  });
  writer.Close();
  return count;
}

}  // namespace

void RunDense(const DenseOptions& options, StageContext& context) {
  const OneOpenCvThread photos_run_side_by_side;
  Densifier densifier(options, context);
  if (densifier.num_photos() == 0) {
    throw Error(
        ErrorKind::kStageFailed,
        "no photo shares enough points with another one under a usable angle",
        "take photos from positions farther apart; calib/calibration.json shows what was posed");
  }
  densifier.MatchFirst();
  densifier.MatchAgainstMaps();
  FusedPointsFile points(context.out);
  densifier.FuseMaps(points);
  if (points.size() == 0) {
    throw Error(ErrorKind::kStageFailed, "no depth was confirmed by enough photos",
                "lower dense.min_consistent to 1, or add photos that overlap by 70 % and more");
  }
  if (options.write_depth_maps) densifier.WriteDepthMaps();
  std::vector<bool> kept(points.size(), true);
  if (options.outlier_sigmas > 0) {
    context.progress->Begin("removing outliers", 1);
    kept = FindInliers(points, {.sigmas = options.outlier_sigmas, .threads = context.threads},
                       context.out);
    context.progress->Advance();
  }
  const size_t count = WriteCloud(points, kept, context.out / "cloud.ply");
  context.progress->Note(fmt::format("{} points from {} photos, {} outliers removed", count,
                                     densifier.num_photos(), points.size() - count));
}

}  // namespace stucco
