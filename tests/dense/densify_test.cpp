// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/densify.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "survey/captures.h"
#include "survey/colmap_io.h"
#include "survey/depth_map.h"
#include "survey/files.h"
#include "survey/point_cloud.h"
#include "survey/survey_folder.h"
#include "tests/dense/made_views.h"
#include "tests/survey/stage_support.h"
#include "tests/survey/support.h"

namespace stucco::test {
namespace {

namespace fs = std::filesystem;

constexpr int kPhotos = 4;

Reconstruction SparseModel() {
  Reconstruction r;
  const Camera camera = SmallCamera();
  r.cameras[camera.id] = camera;
  const std::vector<Pose> poses = PosesAround(kPhotos);
  for (uint32_t i = 0; i < kPhotos; ++i) {
    RegisteredImage& photo = r.photos[PhotoId{i + 1}];
    photo.id = PhotoId{i + 1};
    photo.camera = camera.id;
    photo.name = "flight/" + std::to_string(i) + ".jpg";
    photo.cam_from_world = poses[i];
  }
  const std::vector<MadePlane> walls = TwoWalls();
  for (int k = 0; k < 120; ++k) {
    const MadePlane& wall = walls[k % 2];
    TrackPoint point;
    point.id = PointId{static_cast<uint64_t>(k) + 1};
    point.position = wall.center + ((k * 37 % 100) * 0.04 - 2.3) * wall.u +
                     ((k * 53 % 100) * 0.03 - 1.5) * wall.v;
    for (auto& [id, photo] : r.photos) {
      const auto pixel = camera.Project(photo.cam_from_world * point.position);
      if (!pixel || !camera.Contains(*pixel)) continue;
      point.track.push_back({id, static_cast<uint32_t>(photo.observations.size())});
      photo.observations.push_back({*pixel, point.id});
    }
    if (point.track.size() >= 2) {
      r.points[point.id] = point;
    } else {
      for (const TrackElement& e : point.track) r.photos.at(e.photo).observations.pop_back();
    }
  }
  return r;
}

class Densify : public testing::Test {
 protected:
  Densify() {
    const Reconstruction r = SparseModel();
    Captures captures;
    captures.cameras.push_back({"key", "Small", SmallCamera(), "option"});
    fs::create_directories(folder_ / "photos" / "flight");
    fs::create_directories(folder_ / "survey" / "ingest");
    for (const auto& [id, posed] : r.photos) {
      const PinholeCamera view = PinholeLevels(SmallCamera(), posed.cam_from_world, 0, 1)[0];
      WriteImage(Render(view, TwoWalls()), folder_ / "photos" / posed.name, 97);
      CapturedPhoto photo;
      photo.path = posed.name;
      photo.hash = HashFile(folder_ / "photos" / posed.name);
      photo.usable = true;
      photo.camera = 0;
      photo.width_px = 200;
      photo.height_px = 150;
      captures.photos.push_back(photo);
    }
    WriteCaptures(captures, folder_ / "survey" / kCapturesFile);
    WriteColmapBinary(r, folder_ / "survey" / kSparseFolder);
  }

  StageContext Context(const std::string& out, int threads = 1) {
    StageContext context;
    context.survey = folder_ / "survey";
    context.photos = folder_ / "photos";
    context.out = folder_ / out;
    fs::create_directories(context.out);
    context.threads = threads;
    context.progress = &SilentProgress();
    context.units = &units_;
    return context;
  }

  static DenseOptions Options(int iterations) {
    DenseOptions options;
    options.max_image_px = 200;
    options.iterations = iterations;
    return options;
  }

  static std::string Cloud(const DenseOptions& options, StageContext context) {
    RunDense(options, context);
    return ReadFile(context.out / "cloud.ply");
  }

  TemporaryFolder folder_;
  MemoryUnits units_;
};

TEST_F(Densify, MakesTheSameCloudWithAnyNumberOfThreads) {
  const std::string one = Cloud(Options(2), Context("one", 1));
  EXPECT_EQ(units_.saved.at("depth"), kPhotos);  // each once, not once per use
  EXPECT_EQ(units_.saved.at("consistent"), kPhotos);
  MemoryUnits others;
  StageContext context = Context("two", 2);
  context.units = &others;
  EXPECT_EQ(Cloud(Options(2), context), one);

  const PointCloud cloud = ReadPly(folder_ / "one" / "cloud.ply");
  EXPECT_FALSE(FindProblem(cloud));
  EXPECT_GT(cloud.size(), 15000u);
  EXPECT_EQ(cloud.normals.size(), cloud.size());
  EXPECT_EQ(cloud.views.size(), cloud.size());
  const std::vector<MadePlane> walls = TwoWalls();
  size_t near = 0;
  for (const Eigen::Vector3d& p : cloud.positions) {
    near += std::min(walls[0].Distance(p), walls[1].Distance(p)) < 0.03;
  }
  EXPECT_GT(near, 0.97 * cloud.size());
}

TEST_F(Densify, ReusesCheckpoints) {
  const std::string first = Cloud(Options(1), Context("again"));
  const auto before = units_.saved;
  EXPECT_EQ(Cloud(Options(1), Context("again")), first);
  EXPECT_EQ(units_.saved, before);

  DenseOptions options = Options(1);  // concerns only what comes after the maps
  options.max_cost = 0.05;
  options.outlier_sigmas = 0;
  EXPECT_FALSE(fs::exists(folder_ / "again" / "depth"));
  options.write_depth_maps = true;
  EXPECT_LT(Cloud(options, Context("again")).size(), first.size());
  EXPECT_EQ(units_.saved, before);
  const DepthMap map =
      DeserializeDepthMap(ReadFile(folder_ / "again" / "depth" / "flight" / "0.jpg.dmap"));
  EXPECT_EQ(map.width, 200);
  EXPECT_EQ(map.height, 150);
  EXPECT_GT(std::count_if(map.depths.begin(), map.depths.end(), [](float d) { return d > 0; }),
            15000);

  options.min_consistent = 9;  // there are four photos
  StageContext context = Context("unconfirmed");
  const Error error = ErrorOf([&] { RunDense(options, context); });
  EXPECT_EQ(error.kind(), ErrorKind::kStageFailed);
  EXPECT_NE(error.remedy().find("min_consistent"), std::string::npos);
  EXPECT_FALSE(fs::exists(context.out / "cloud.ply"));
  EXPECT_EQ(units_.saved, before);

  // Other sparse points are other seeds.
  Reconstruction r = SparseModel();
  for (auto& [id, point] : r.points) point.position *= 1 + 1e-4 * (id.value % 3);
  WriteColmapBinary(r, folder_ / "survey" / kSparseFolder);
  Cloud(Options(1), Context("again"));
  EXPECT_EQ(units_.saved.at("depth"), before.at("depth") + kPhotos);
}

TEST_F(Densify, SaysWhenNoPhotoHasAPartner) {
  Reconstruction r = SparseModel();
  for (auto& [id, photo] : r.photos) photo.observations.clear();
  r.points.clear();
  WriteColmapBinary(r, folder_ / "survey" / kSparseFolder);
  StageContext context = Context("alone");
  const Error error = ErrorOf([&] { RunDense(Options(1), context); });
  EXPECT_EQ(error.kind(), ErrorKind::kStageFailed);
  EXPECT_NE(std::string(error.what()).find("no photo shares enough points"), std::string::npos)
      << error.what();
  EXPECT_FALSE(error.remedy().empty());
}

TEST_F(Densify, NamesAPhotoThatIsGone) {
  fs::remove(folder_ / "photos" / "flight" / "2.jpg");
  StageContext context = Context("gone");
  ExpectBadInput([&] { RunDense(Options(1), context); }, "2.jpg");
}

TEST_F(Densify, NeedsACalibration) {
  StageContext context = Context("nothing");
  context.survey = folder_ / "elsewhere";
  const Error error = ErrorOf([&] { RunDense(Options(1), context); });
  EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
}

TEST(DenseOptions, AreAllInTheTable) {
  DenseOptions options;
  OptionTable table("dense");
  Describe(table, options);
  EXPECT_EQ(table.options().size(), 9u);
  EXPECT_EQ(SetOption(table, "max_sources", OptionValue(int64_t{3})), "");
  EXPECT_EQ(options.max_sources, 3);
  EXPECT_NE(SetOption(table, "max_sources", OptionValue(int64_t{17})), "");
}

// Only one other photo can confirm a depth then, whatever the option's default asks for.
TEST_F(Densify, TwoPhotosConfirmEachOther) {
  Reconstruction r = SparseModel();
  std::erase_if(r.photos, [](const auto& photo) { return photo.first.value > 2; });
  for (auto& [id, point] : r.points) {
    std::erase_if(point.track, [](const TrackElement& e) { return e.photo.value > 2; });
  }
  for (auto& [id, photo] : r.photos) {
    std::erase_if(photo.observations,
                  [&](const Observation& o) { return r.points.at(o.point).track.size() < 2; });
  }
  std::erase_if(r.points, [](const auto& point) { return point.second.track.size() < 2; });
  for (auto& [id, point] : r.points) point.track.clear();
  for (auto& [id, photo] : r.photos) {
    for (size_t i = 0; i < photo.observations.size(); ++i) {
      r.points.at(photo.observations[i].point).track.push_back({id, static_cast<uint32_t>(i)});
    }
  }
  WriteColmapBinary(r, folder_ / "survey" / kSparseFolder);
  StageContext context = Context("two");
  RunDense(Options(2), context);
  EXPECT_GT(ReadPly(context.out / "cloud.ply").size(), 3000u);
}

}  // namespace
}  // namespace stucco::test
