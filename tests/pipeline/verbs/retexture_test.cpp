// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/retexture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "pipeline/default_stages.h"
#include "pipeline/verbs/init.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/image.h"
#include "survey/proxy.h"
#include "survey/survey_folder.h"
#include "survey/texture_set.h"
#include "tests/pipeline/verbs/retexture_sample.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

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
  const Pose world_from_cam = photo.cam_from_world->Inverse();
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

// The story of a survey, in one test because each step needs the one before.
TEST_F(RetextureSample, NamesAndReplacesTheRepaintedFacadeAndNothingElse) {
  const auto survey_before = Contents(Survey());
  const auto photos_before = Contents(Photos("same"));

  // 1. Photos of an unchanged world keep every picture.
  const RetextureReport same = Run("same", "");
  EXPECT_EQ(same.folder, Survey() / "epochs/same");
  EXPECT_THAT(OtherPictures(same.folder), IsEmpty());
  for (const EpochPhoto& photo : same.epoch.photos) {
    EXPECT_TRUE(photo.is_placed()) << photo.path << ": " << photo.why;
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
    if (facet.id != wall->id) continue;
    ASSERT_FALSE(facet.places.empty());
    EXPECT_EQ(facet.places[0].what, "colour");
    EXPECT_GT(facet.places[0].along_m[1] - facet.places[0].along_m[0], 3);
    for (const std::string& picture : {facet.places[0].before, facet.places[0].after}) {
      EXPECT_GT(ReadImage(painted.folder / picture).width_px, 32);
    }
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

  // 6. An epoch is made again in its place, from the photos and by the choice of before.
  const RetextureRequest as_stopped = SameAgain(Survey(), "stopped");
  EXPECT_EQ(as_stopped.replace, ReplaceMode::kNever);
  EXPECT_EQ(as_stopped.photos, Photos("same"));
  const auto blue_before = Contents(painted.folder);
  WriteFile(painted.folder / "textures" / (file + ".png"), "torn");
  const RetextureReport again = Run(SameAgain(Survey(), "blue"));
  EXPECT_EQ(again.folder, painted.folder);
  EXPECT_EQ(again.moved, std::nullopt);
  EXPECT_EQ(Contents(again.folder), blue_before);
  fs::rename(Photos("painted"), Photos("lost"));
  const Error lost = Refusal(SameAgain(Survey(), "blue"));
  fs::rename(Photos("lost"), Photos("painted"));
  EXPECT_EQ(lost.kind(), ErrorKind::kBadInput);
  EXPECT_THAT(lost.remedy(), HasSubstr("epoch blue is of its photos"));
  EXPECT_EQ(Contents(again.folder), blue_before);
  EXPECT_THROW(SameAgain(Survey(), "never-made"), Error);

  // 7. Pictures of an earlier model, whose facets had the same ids, are not compared with.
  EXPECT_EQ(Refusal("same", "blue.old-1").kind(), ErrorKind::kUsage);  // as what is moved aside
  const fs::path moved = Photos("moved");
  fs::copy(Survey(), moved, fs::copy_options::recursive);
  Proxy model = proxy;
  for (Building& building : model.buildings) {
    for (Facet& facet : building.facets) {
      for (Eigen::Vector3d& corner : facet.outer) corner += 0.5 * facet.normal;
      facet.offset += 0.5;
    }
  }
  WriteProxy(model, moved / kFacetsFile);
  const Error outdated = RefusalOf(moved, "same", "outdated");
  EXPECT_EQ(outdated.kind(), ErrorKind::kBadInput);
  EXPECT_THAT(outdated.what(), HasSubstr("another model"));
  EXPECT_FALSE(fs::exists(moved / "epochs/outdated"));

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
