// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/epoch_report.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "survey/error.h"
#include "survey/files.h"
#include "survey/survey_folder.h"
#include "tests/report/made_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// A made survey and an epoch with the pictures of its textures, of which all are kept.
class EpochReport : public testing::Test {
 protected:
  EpochReport() {
    const MadeSurvey made = MakeSurvey();
    WriteSurvey(made, folder_.path());
    fs::copy(folder_ / "texture", folder_ / "out", fs::copy_options::recursive);
    epoch_.name = "spring";
    for (const TexturedFacet& facet : made.textures.facets) {
      EpochFacet& found = epoch_.facets.emplace_back();
      found.id = facet.id;
      found.why = "it has not changed";
    }
    EpochPhoto& photo = epoch_.photos.emplace_back();
    photo.path = "new.jpg";
    photo.cam_from_world = Pose{};
    photo.inliers = 321;
    photo.picture_sigma_px = 0.25;
  }

  std::string Page(int threads = 2) {
    StageContext context;
    context.survey = folder_.path();
    context.out = folder_ / "out";
    context.threads = threads;
    context.progress = &SilentProgress();
    context.units = &NoUnits();
    WriteEpochReport(epoch_, context);
    return ReadFile(context.out / "report.html");
  }

  EpochFacet& Replace(size_t index) {
    EpochFacet& found = epoch_.facets[index];
    found.choice = FacetChoice::kReplaced;
    found.why = "43 % of what both show changed";
    found.shown = found.taken = found.both = found.compared = 0.9;
    found.repainted = 0.39;
    return found;
  }

  test::TemporaryFolder folder_;
  Epoch epoch_;
};

TEST_F(EpochReport, SaysThatNothingChanged) {
  const std::string page = Page();
  EXPECT_TRUE(Has(page, "Nothing that these photos show has changed"));
  EXPECT_FALSE(Has(page, "What changed in the world"));
  EXPECT_FALSE(Has(page, "class=\"then-now\""));
  EXPECT_TRUE(Has(page, "it has not changed"));
  EXPECT_TRUE(Has(page, "0.25 px"));
}

TEST_F(EpochReport, ShowsWhatIsAnotherBeforeAndNow) {
  const std::string id = Replace(0).id;
  const std::string page = Page();
  EXPECT_TRUE(Has(page, "1 surface has changed"));
  EXPECT_TRUE(Has(page, "39 % of it in another colour"));
  EXPECT_TRUE(Has(page, "43 % of what both show changed"));
  EXPECT_TRUE(Has(page, "alt=\"" + id + " before\""));
  EXPECT_TRUE(Has(page, "alt=\"" + id + " now\""));
}

TEST_F(EpochReport, ShowsPlacesThatChangedAlsoOnPicturesThatStay) {
  EpochFacet& found = epoch_.facets[0];
  found.both = found.compared = 0.9;
  found.other = 0.05;
  found.places = {{"pattern", {1, 2.25}, {0.5, 1.5}, 0.75, "changes/a.png", "changes/gone.png"}};
  fs::create_directories(folder_ / "out/changes");
  fs::copy_file(folder_ / "out" / ReadTextureSet(folder_ / kTexturesFile).facets[0].image,
                folder_ / "out/changes/a.png");
  const std::string page = Page();
  EXPECT_TRUE(Has(page, "another pattern on"));
  EXPECT_TRUE(Has(page, "1.0 to 2.25 m from its left and 0.5 to 1.50 m above its lower edge"));
  EXPECT_TRUE(Has(page, "alt=\"" + found.id + ", place 1, before\""));
  EXPECT_TRUE(Has(page, "No picture"));
}

// One mirrored window is not worth naming.
TEST_F(EpochReport, LeavesSmallChangesOut) {
  epoch_.facets[1].both = epoch_.facets[1].compared = 1;
  epoch_.facets[1].other = 0.004;
  EXPECT_FALSE(Has(Page(), "What changed in the world"));
}

TEST_F(EpochReport, EscapesWhatFilesAndPhotosAreCalled) {
  epoch_.photos[0].path = "<script>alert(1)</script>.jpg";
  epoch_.photos[0].why = "<b>why</b>";
  epoch_.facets[0].why = "\"><img src=x>";
  const std::string page = Page();
  EXPECT_FALSE(Has(page, "<script>alert"));
  EXPECT_FALSE(Has(page, "<b>why"));
  EXPECT_FALSE(Has(page, "<img src=x>"));
}

TEST_F(EpochReport, SaysWhichPictureIsDamaged) {
  Replace(0);
  WriteFile(folder_ / "out" / "textures.json", ReadFile(folder_ / kTexturesFile));
  fs::remove_all(folder_ / "out/textures");
  EXPECT_TRUE(Has(Page(), " is missing"));
  WriteFile(folder_ / kTexturesFile, "{");
  EXPECT_THROW(Page(), Error);
}

TEST_F(EpochReport, HasTheSameBytesAtAnyNumberOfThreads) {
  Replace(2);
  EXPECT_EQ(Page(1), Page(3));
}

}  // namespace
}  // namespace stucco
