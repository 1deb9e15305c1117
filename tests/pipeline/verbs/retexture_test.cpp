// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/retexture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "pipeline/default_stages.h"
#include "pipeline/verbs/init.h"
#include "pipeline/verbs/run.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/image.h"
#include "survey/pose.h"
#include "survey/proxy.h"
#include "survey/survey_folder.h"
#include "survey/texture_set.h"
#include "tests/survey/temporary_folder.h"
#include "texture/texture.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

const fs::path kSample = SAMPLE_FOLDER;

// Every fifth photo of the sample is of another day.
bool IsNew(const fs::path& photo) {
  return std::stoi(photo.stem().string().substr(4)) % 5 == 3;
}

std::map<std::string, std::string> Contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    if (entry.is_regular_file() && !name.starts_with(kWorkFolder) &&
        !name.starts_with(kEpochsFolder)) {
      files[name] = HashFile(entry.path());
    }
  }
  return files;
}

// The truth of the sample in the world of its calibration, as a model would be found.
void WriteTrueProxy(const fs::path& survey) {
  const Reconstruction truth = ReadColmapModel(kSample / "truth");
  const Reconstruction found = ReadColmapModel(survey / kSparseFolder);
  std::map<std::string, Eigen::Vector3d> true_centres;
  for (const auto& [id, photo] : truth.photos) {
    true_centres[photo.name] = photo.cam_from_world.Center();
  }
  Eigen::Matrix3Xd from(3, found.photos.size());
  Eigen::Matrix3Xd to(3, found.photos.size());
  Eigen::Index i = 0;
  for (const auto& [id, photo] : found.photos) {
    from.col(i) = true_centres.at(photo.name);
    to.col(i++) = photo.cam_from_world.Center();
  }
  const Similarity world_from_truth = AlignPoints(from, to);
  const auto json = nlohmann::json::parse(ReadFile(kSample / "truth/planes.json"));
  const std::map<std::string, FacetClass> classes = {
      {"wall", FacetClass::kWall}, {"roof", FacetClass::kRoof}, {"ground", FacetClass::kGround}};
  Proxy proxy;
  proxy.metric = true;
  for (const auto& plane : json.at("planes")) {
    Facet facet;
    facet.id = plane.at("id");
    facet.facet_class = classes.at(plane.at("class"));
    const auto& n = plane.at("normal");
    facet.normal = (world_from_truth.rotation * Eigen::Vector3d(n[0], n[1], n[2])).normalized();
    for (const auto& p : plane.at("outer")) {
      facet.outer.push_back(world_from_truth * Eigen::Vector3d(p[0], p[1], p[2]));
    }
    facet.offset = facet.normal.dot(facet.outer.front());
    for (Eigen::Vector3d& p : facet.outer) p -= (p.dot(facet.normal) - facet.offset) * facet.normal;
    const std::string building = facet.id.substr(0, facet.id.find('/'));
    if (proxy.buildings.empty() || proxy.buildings.back().id != building) {
      proxy.buildings.emplace_back().id = building;
    }
    proxy.buildings.back().facets.push_back(std::move(facet));
  }
  fs::create_directories(survey / "proxy");
  WriteProxy(proxy, survey / kFacetsFile);
}

// Where a ray meets the inside of a convex facet from outside: how far along.
std::optional<double> Meet(const Facet& facet, const Eigen::Vector3d& from,
                           const Eigen::Vector3d& way) {
  const double against = facet.normal.dot(way);
  if (!(against < 0)) return std::nullopt;
  const double along = (facet.offset - facet.normal.dot(from)) / against;
  const Eigen::Vector3d place = from + along * way;
  for (size_t i = 0; i < facet.outer.size(); ++i) {
    const Eigen::Vector3d& a = facet.outer[i];
    const Eigen::Vector3d& b = facet.outer[(i + 1) % facet.outer.size()];
    if (facet.normal.dot((b - a).cross(place - a)) < 0) return std::nullopt;
  }
  return along > 0 ? std::optional(along) : std::nullopt;
}

// Whether a pixel shows the facet of this id.
bool Shows(const Proxy& proxy, const std::string& id, const EpochPhoto& photo,
           const Eigen::Vector2d& pixel) {
  const auto ray = photo.camera.Unproject(pixel);
  if (!ray) return false;
  const Pose world_from_cam = photo.cam_from_world.Inverse();
  const Eigen::Vector3d way = world_from_cam.rotation * ray->homogeneous();
  std::string nearest_id;
  double nearest = std::numeric_limits<double>::max();
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) {
      const auto along = Meet(facet, world_from_cam.translation, way);
      if (!along || *along > nearest) continue;
      nearest = *along;
      nearest_id = facet.id;
    }
  }
  return nearest_id == id;
}

// The segments with metadata right behind the beginning of a JPEG.
std::string Metadata(const std::string& jpeg) {
  size_t end = 2;
  while (end + 4 < jpeg.size() && static_cast<uint8_t>(jpeg[end]) == 0xFF &&
         static_cast<uint8_t>(jpeg[end + 1]) == 0xE1) {
    end += 2 + 256 * static_cast<uint8_t>(jpeg[end + 2]) + static_cast<uint8_t>(jpeg[end + 3]);
  }
  return jpeg.substr(2, end - 2);
}

// Writes a photo whose pixels `change` has gone over, with the metadata that it had.
void WriteChanged(const fs::path& from, const fs::path& to,
                  const std::function<void(Image&)>& change) {
  Image image = ReadJpeg(from);
  change(image);
  WriteImage(image, to, 95);
  const std::string pixels = ReadFile(to);
  WriteFile(to, pixels.substr(0, 2) + Metadata(ReadFile(from)) + pixels.substr(2));
}

void Mirror(Image& image) {
  for (int y = 0; y < image.height_px; ++y) {
    for (int x = 0; x < image.width_px / 2; ++x) {
      std::swap_ranges(image.Pixel(x, y), image.Pixel(x, y) + 3,
                       image.Pixel(image.width_px - 1 - x, y));
    }
  }
}

// A survey of the sample's other photos with calibration, the true planes and textures, made once.
class RetextureSample : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new test::TemporaryFolder();
    for (const char* name : {"old", "same"}) fs::create_directories(*folder_ / name);
    for (const fs::directory_entry& photo : fs::directory_iterator(kSample / "photos")) {
      fs::copy(photo.path(), *folder_ / (IsNew(photo.path()) ? "same" : "old"));
    }
    InitSurvey(Survey(), *folder_ / "old", DefaultStages());
    RunOptions options;
    options.until = "calib";
    options.set = {"calib.max_features=1200"};
    Console console(log_, false, Verbosity::kQuiet);
    ASSERT_EQ(RunSurvey(Survey(), DefaultStages(), options, console, RealPlatform()).exit_code, 0);
    WriteTrueProxy(Survey());
    StageContext context;
    context.survey = Survey();
    context.photos = *folder_ / "old";
    context.out = Survey() / "texture";
    fs::create_directories(context.out);
    context.threads = 2;
    context.progress = &SilentProgress();
    context.units = &NoUnits();
    TextureOptions texture;
    texture.max_texture_px = 400;  // small enough for a test
    RunTexture(texture, context);
  }
  static void TearDownTestSuite() {
    delete folder_;
    std::fclose(log_);
  }

  static fs::path Survey() { return *folder_ / "survey"; }
  static fs::path Photos(const std::string& set) { return *folder_ / set; }

  static RetextureReport Run(const std::string& set, const std::string& epoch,
                             ReplaceMode replace = ReplaceMode::kAuto) {
    Console console(log_, false, Verbosity::kQuiet);
    RetextureRequest request;
    request.photos = Photos(set);
    request.epoch = epoch;
    request.replace = replace;
    request.command = "retexture";
    Platform platform = RealPlatform();
    platform.interrupted = [] { return interrupted_; };
    return RetextureSurvey(Survey(), request, DefaultStages(), console, platform);
  }

  static Error Refusal(const std::string& set, const std::string& epoch) {
    try {
      Run(set, epoch);
    } catch (const Error& e) {
      return e;
    }
    return Error(ErrorKind::kUsage, "was not refused");
  }

  // Names of pictures and labels of an epoch whose bytes are not the survey's.
  static std::vector<std::string> OtherPictures(const fs::path& epoch) {
    std::vector<std::string> other;
    for (const char* kind : {"textures", "labels", "orthophotos"}) {
      for (const auto& file : fs::directory_iterator(Survey() / "texture" / kind)) {
        const fs::path name = fs::path(kind) / file.path().filename();
        if (!fs::exists(epoch / name) || HashFile(epoch / name) != HashFile(file.path())) {
          other.push_back(name.generic_string());
        }
      }
    }
    return other;
  }

  static test::TemporaryFolder* folder_;
  static std::FILE* log_;
  static bool interrupted_;
};
test::TemporaryFolder* RetextureSample::folder_ = nullptr;
std::FILE* RetextureSample::log_ = std::tmpfile();
bool RetextureSample::interrupted_ = false;

// The story of a survey, in one test because each step needs the one before.
TEST_F(RetextureSample, NamesAndReplacesTheRepaintedFacadeAndNothingElse) {
  const auto survey_before = Contents(Survey());
  const auto photos_before = Contents(Photos("same"));

  // 1. Photos of an unchanged world keep every picture.
  const RetextureReport same = Run("same", "");
  EXPECT_EQ(same.folder, Survey() / "epochs/same");
  EXPECT_THAT(OtherPictures(same.folder), IsEmpty());
  for (const EpochPhoto& photo : same.epoch.photos) {
    EXPECT_TRUE(photo.placed) << photo.path << ": " << photo.why;
  }
  const TextureSet old = ReadTextureSet(Survey() / kTexturesFile);
  ASSERT_EQ(same.epoch.facets.size(), old.facets.size());
  const EpochFacet* wall = nullptr;  // of those that new photos show well
  for (const EpochFacet& facet : same.epoch.facets) {
    EXPECT_EQ(facet.choice, FacetChoice::kKept) << facet.id << ": " << facet.why;
    EXPECT_LT(facet.shift_px, 3) << facet.id;
    if (facet.id.find("/F") == std::string::npos || facet.shown < 0.9) continue;
    if (!wall || facet.shown > wall->shown) wall = &facet;
  }
  ASSERT_NE(wall, nullptr);

  // 2. One facade in another colour; the survey's own photos are not needed.
  const Proxy proxy = ReadProxy(Survey() / kFacetsFile);
  fs::create_directories(Photos("painted"));
  for (const EpochPhoto& photo : same.epoch.photos) {
    WriteChanged(Photos("same") / photo.path, Photos("painted") / photo.path, [&](Image& image) {
      for (int y = 0; y < image.height_px; ++y) {
        for (int x = 0; x < image.width_px; ++x) {
          if (!Shows(proxy, wall->id, photo, {x + 0.5, y + 0.5})) continue;
          uint8_t* rgb = image.Pixel(x, y);
          rgb[0] = static_cast<uint8_t>(0.45 * rgb[0]);
          rgb[2] = static_cast<uint8_t>(128 + 0.5 * rgb[2]);
        }
      }
    });
  }
  fs::rename(Photos("old"), Photos("away"));
  const RetextureReport painted = Run("painted", "blue");
  fs::rename(Photos("away"), Photos("old"));
  std::string file = wall->id;
  std::ranges::replace(file, '/', '_');
  for (const EpochFacet& facet : painted.epoch.facets) {
    EXPECT_EQ(facet.choice, facet.id == wall->id ? FacetChoice::kReplaced : FacetChoice::kKept)
        << facet.id << ": " << facet.why;
    EXPECT_EQ(facet.repainted > 0.7, facet.id == wall->id) << facet.id;
  }
  for (const std::string& name : OtherPictures(painted.folder)) EXPECT_THAT(name, HasSubstr(file));
  const Image blue = ReadImage(painted.folder / "textures" / (file + ".png"));
  const Image before = ReadImage(Survey() / "texture/textures" / (file + ".png"));
  ASSERT_EQ(blue.data.size(), before.data.size());  // the old grid
  EXPECT_EQ(ReadTextureSet(painted.folder / "textures.json").facets.size(), old.facets.size());
  EXPECT_GT(fs::file_size(painted.folder / "model.glb"), 1000u);

  // 3. Photos of another place change nothing.
  fs::create_directories(Photos("foreign"));
  for (const EpochPhoto& photo : same.epoch.photos) {
    WriteChanged(Photos("same") / photo.path, Photos("foreign") / photo.path, Mirror);
  }
  const Error foreign = Refusal("foreign", "elsewhere");
  EXPECT_EQ(foreign.kind(), ErrorKind::kStageFailed);
  EXPECT_THAT(foreign.what(), HasSubstr("none of"));
  EXPECT_FALSE(fs::exists(Survey() / "epochs/elsewhere"));

  // 4. What cannot be asked for.
  EXPECT_THAT(Refusal("same", "blue").what(), HasSubstr("is there already"));
  EXPECT_EQ(Refusal("same", "a/b").kind(), ErrorKind::kUsage);
  EXPECT_EQ(Refusal("same", "..").kind(), ErrorKind::kUsage);
  EXPECT_THAT(Refusal("nowhere", "x").what(), HasSubstr("is not there"));
  fs::create_directories(Photos("empty"));
  EXPECT_THAT(Refusal("empty", "x").what(), HasSubstr("no photos"));
  EXPECT_THAT(Refusal("old", "x").what(), HasSubstr("no new photo"));

  // 5. Stopped, there is no epoch, and the same again makes it.
  interrupted_ = true;
  EXPECT_EQ(Refusal("same", "stopped").kind(), ErrorKind::kInterrupted);
  EXPECT_FALSE(fs::exists(Survey() / "epochs/stopped"));
  interrupted_ = false;
  const RetextureReport filled = Run("same", "stopped", ReplaceMode::kNever);
  for (const EpochFacet& facet : filled.epoch.facets) {
    EXPECT_NE(facet.choice, FacetChoice::kReplaced) << facet.id;
  }
  EXPECT_TRUE(fs::exists(filled.folder / "retexture.json"));

  EXPECT_EQ(Contents(Survey()), survey_before);
  EXPECT_EQ(Contents(Photos("same")), photos_before);
}

TEST(Retexture, NeedsASurveyWithTextures) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "photos");
  fs::create_directories(folder / "new");
  InitSurvey(folder / "survey", folder / "photos", DefaultStages());
  Console console(stderr, false, Verbosity::kQuiet);
  RetextureRequest request;
  request.photos = folder / "new";
  try {
    RetextureSurvey(folder / "survey", request, DefaultStages(), console, RealPlatform());
    FAIL() << "was not refused";
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kBadInput);
    EXPECT_THAT(e.what(), HasSubstr(kTexturesFile));
    EXPECT_THAT(e.remedy(), HasSubstr("stucco run"));
  }
}

}  // namespace
}  // namespace stucco
