// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/facet_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace stucco {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

// Three walls without a fault; the first is the one a test damages.
SurveyData GoodWalls() {
  SurveyData data;
  data.metric = true;
  data.proxy.emplace();
  data.textures.emplace();
  Building building;
  building.id = "B0001";
  for (int i = 0; i < 3; ++i) {
    Facet facet;
    facet.id = "B0001/W0" + std::to_string(i + 1);
    facet.area = 50;
    facet.seen = 0.95;
    facet.inferred = 0.05;
    building.facets.push_back(facet);
    TexturedFacet texture;
    texture.id = facet.id;
    texture.image = "textures/x.png";
    texture.photos = {"a.jpg"};
    texture.painted = 0.99;
    texture.inpainted = 0.01;
    texture.gsd_m = 0.01;
    texture.misregistration_px = 0.5;
    data.textures->facets.push_back(texture);
  }
  data.proxy->buildings.push_back(building);
  return data;
}

FacetRow FirstRow(const SurveyData& data) {
  return MakeFacetRows(data, {}).at(0);
}

TEST(MakeFacetRows, GoodWallsAreGreen) {
  const SurveyData data = GoodWalls();
  const auto rows = MakeFacetRows(data, {});
  ASSERT_EQ(rows.size(), 3U);
  for (const FacetRow& row : rows) {
    EXPECT_EQ(row.verdict, Verdict::kGreen);
    EXPECT_THAT(row.findings, IsEmpty());
    EXPECT_EQ(row.building, "B0001");
  }
}

// The plan has two facades, and the first two walls are parts of one of them.
SurveyData PlannedWalls() {
  SurveyData data = GoodWalls();
  data.plan.emplace();
  for (const char* id : {"B0007/F00", "B0007/F01"}) {
    PlannedFacade facade;
    facade.id = id;
    facade.predicted = {0.9, 0.8, 0.7, 1};
    data.plan->facades.push_back(facade);
  }
  for (int i : {0, 1}) data.proxy->buildings[0].facets[i].planned_facades = {"B0007/F01"};
  return data;
}

TEST(MakeFacetRows, PartsOfAPlannedFacadeKnowIt) {
  const SurveyData data = PlannedWalls();
  const auto rows = MakeFacetRows(data, {});
  ASSERT_EQ(rows.size(), 3U);
  for (int i : {0, 1}) {
    ASSERT_NE(rows[i].planned, nullptr);
    EXPECT_EQ(rows[i].planned->predicted.q_d, 0.8);
    EXPECT_EQ(rows[i].Name(), "B0007/F01");
    EXPECT_EQ(rows[i].verdict, Verdict::kGreen);  // predictions are no verdict
  }
  EXPECT_EQ(rows[2].planned, nullptr);
  EXPECT_EQ(rows[2].Name(), "B0001/W03");
  EXPECT_THAT(MissingFacades(data, rows), testing::ElementsAre("B0007/F00"));
}

// Five views of one facade: taken, not taken, broken, without a pose, known by its record alone.
SurveyData WallsWithLostViews() {
  SurveyData data = PlannedWalls();
  data.plan->facades[1].views = {"h0v0", "h1v0", "h2v0", "h3v0", "h4v0"};
  data.captures.emplace();
  for (const char* id : {"h0v0", "h1v0", "h2v0", "h3v0", "h4v0"}) {
    const bool taken = std::string(id) != "h1v0";
    const std::string path = std::string(id) + ".jpg";
    data.captures->views.push_back({id, taken ? "captured" : "missing", taken ? path : ""});
    if (!taken) continue;
    CapturedPhoto photo;
    photo.path = path;
    photo.usable = true;
    data.captures->photos.push_back(photo);
  }
  data.captures->photos[1].usable = false;
  data.captures->photos[1].why = "is cut off";
  data.calibration.emplace();
  data.calibration->unposed = {{"h3v0.jpg", "3 inliers"}};
  data.calibration->photos.resize(2);
  data.calibration->photos[0].path = "h0v0.jpg";
  data.calibration->photos[1].path = "h4v0.jpg";
  data.calibration->photos[1].state = PhotoState::kRecordOnly;
  return data;
}

TEST(MakeFacetRows, LostPhotosOfThePlanAreNamedAndNoVerdict) {
  SurveyData data = WallsWithLostViews();
  const auto rows = MakeFacetRows(data, {});
  EXPECT_EQ(rows[0].lost_views,
            "4 of its 5 planned photos are lost: h1v0 was not taken; h2v0 cannot be used: is cut "
            "off; h3v0 has no pose: 3 inliers; h4v0 has no sure pose (record-only)");
  EXPECT_EQ(rows[0].verdict, Verdict::kGreen);
  EXPECT_EQ(rows[1].lost_views, rows[0].lost_views);  // parts of one facade
  EXPECT_EQ(rows[2].lost_views, "");
  data.plan->facades[1].views = {"h0v0"};
  EXPECT_EQ(FirstRow(data).lost_views, "");
  data.plan->facades[1].views = {"h1v0"};
  EXPECT_EQ(FirstRow(data).lost_views, "its one planned photo is lost: h1v0 was not taken");
  // Photos that were never held against a plan say nothing about it.
  data.captures->views.clear();
  EXPECT_EQ(FirstRow(data).lost_views, "");
}

TEST(MakeFacetRows, BeforeCalibrationNoPhotoLacksAPose) {
  SurveyData data = WallsWithLostViews();
  data.calibration.reset();
  EXPECT_EQ(FirstRow(data).lost_views,
            "2 of its 5 planned photos are lost: h1v0 was not taken; h2v0 cannot be used: is cut "
            "off");
}

TEST(MakeFacetRows, AFacadeThatAWallSpansBesidesIsNotMissing) {
  SurveyData data = PlannedWalls();
  data.proxy->buildings[0].facets[1].planned_facades.push_back("B0007/F00");
  const auto rows = MakeFacetRows(data, {});
  EXPECT_EQ(rows[1].Name(), "B0007/F01");
  EXPECT_THAT(MissingFacades(data, rows), IsEmpty());
}

TEST(MakeFacetRows, AnOwnIdIsNotThePlansEvenWhereItLooksLikeOne) {
  SurveyData data = PlannedWalls();
  data.plan->facades[0].id = "B0001/W03";
  const auto rows = MakeFacetRows(data, {});
  EXPECT_EQ(rows[2].planned, nullptr);
  // A facade id that no plan explains is kept, and nothing is predicted.
  data.proxy->buildings[0].facets[2].planned_facades = {"B0099/F00"};
  EXPECT_EQ(MakeFacetRows(data, {})[2].planned, nullptr);
  data.plan.reset();
  const auto unplanned = MakeFacetRows(data, {});
  for (const FacetRow& row : unplanned) EXPECT_EQ(row.planned, nullptr);
  EXPECT_THAT(MissingFacades(data, unplanned), IsEmpty());
}

// Every measure makes a facade amber and red by itself, with a text that says which.
TEST(MakeFacetRows, EachMeasureCountsByItself) {
  struct Case {
    const char* text;
    std::function<void(SurveyData&, bool)> damage;  // the flag: badly
  };
  const Case cases[] = {
      {"painted from photos",
       [](SurveyData& d, bool bad) { d.textures->facets[0].painted = bad ? 0.5 : 0.8; }},
      {"photo pixels",
       [](SurveyData& d, bool bad) { d.textures->facets[0].gsd_m = bad ? 0.04 : 0.02; }},
      {"filled in",
       [](SurveyData& d, bool bad) { d.textures->facets[0].inpainted = bad ? 0.3 : 0.1; }},
      {"measured points",
       [](SurveyData& d, bool bad) { d.proxy->buildings[0].facets[0].inferred = bad ? 0.9 : 0.5; }},
      {"disagree",
       [](SurveyData& d, bool bad) { d.textures->facets[0].misregistration_px = bad ? 6 : 3; }}};
  for (const Case& c : cases) {
    for (const bool bad : {false, true}) {
      SurveyData data = GoodWalls();
      c.damage(data, bad);
      const FacetRow row = FirstRow(data);
      EXPECT_EQ(row.verdict, bad ? Verdict::kRed : Verdict::kAmber) << c.text;
      ASSERT_EQ(row.findings.size(), 1U) << c.text;
      EXPECT_THAT(row.findings[0].text, HasSubstr(c.text));
      EXPECT_EQ(MakeFacetRows(data, {})[1].verdict, Verdict::kGreen) << c.text;
    }
  }
}

TEST(MakeFacetRows, ExactlyAtTheLimitIsGood) {
  SurveyData data = GoodWalls();
  const ReportOptions options;
  data.textures->facets[0].painted = options.coverage_amber_below;
  data.textures->facets[0].inpainted = options.inpainted_amber_above;
  data.proxy->buildings[0].facets[0].inferred = options.inferred_amber_above;
  EXPECT_EQ(FirstRow(data).verdict, Verdict::kGreen);
}

TEST(MakeFacetRows, IsJudgedByWhatCanBeSeen) {
  SurveyData data = GoodWalls();
  Facet& facet = data.proxy->buildings[0].facets[0];
  TexturedFacet& texture = data.textures->facets[0];
  facet.party = 0.6;  // a lower neighbour
  facet.seen = 0.38;
  facet.inferred = 0.62;
  texture.painted = 0.4;
  texture.inpainted = 0.6;
  EXPECT_EQ(FirstRow(data).verdict, Verdict::kGreen);
  EXPECT_NEAR(FirstRow(data).shares.inferred, 0.05, 1e-9);
  texture.painted = 0.2;  // half of what can be seen
  texture.inpainted = 0.8;
  EXPECT_EQ(FirstRow(data).verdict, Verdict::kRed);
  facet.party = 0;
  texture.painted = 0.4;
  EXPECT_EQ(FirstRow(data).verdict, Verdict::kRed);
}

TEST(MakeFacetRows, PartyWallsAndSmallPiecesHaveNoVerdict) {
  SurveyData data = GoodWalls();
  std::vector<Facet>& facets = data.proxy->buildings[0].facets;
  facets[0].party = 0.97;
  facets[0].seen = 0;
  facets[0].inferred = 1;
  facets[1].area = 1.9;
  facets[1].inferred = 1;
  for (const size_t i : {0, 1}) {
    const FacetRow row = MakeFacetRows(data, {})[i];
    EXPECT_TRUE(row.exempt);
    EXPECT_EQ(row.verdict, Verdict::kUnknown);
    ASSERT_EQ(row.findings.size(), 1U);
    EXPECT_THAT(row.findings[0].text, HasSubstr("not rated"));
  }
  const VerdictCounts counts = CountVerdicts(MakeFacetRows(data, {}), /*walls_only=*/true);
  EXPECT_EQ(counts.exempt, 2);
  EXPECT_EQ(counts.Total(), 1);
  // A size in the units of a survey without scale says nothing.
  data.metric = false;
  EXPECT_FALSE(MakeFacetRows(data, {})[1].exempt);
  // A facade of the plan was asked for, however small.
  data.metric = true;
  data.plan.emplace();
  data.plan->facades.emplace_back().id = "B0007/F00";
  facets[1].planned_facades = {"B0007/F00"};
  EXPECT_EQ(MakeFacetRows(data, {})[1].verdict, Verdict::kRed);
}

TEST(MakeFacetRows, LimitsAreOptions) {
  SurveyData data = GoodWalls();
  data.textures->facets[0].painted = 0.8;
  ReportOptions options;
  options.coverage_amber_below = 0.7;
  EXPECT_EQ(MakeFacetRows(data, options)[0].verdict, Verdict::kGreen);
  options.coverage_amber_below = options.coverage_red_below = 0.85;
  EXPECT_EQ(MakeFacetRows(data, options)[0].verdict, Verdict::kRed);
}

TEST(MakeFacetRows, NotANumberIsRed) {
  SurveyData data = GoodWalls();
  data.textures->facets[0].painted = NAN;
  EXPECT_EQ(FirstRow(data).verdict, Verdict::kRed);
}

TEST(MakeFacetRows, PicturesCoarserThanTheirPhotosAreAmber) {
  SurveyData data = GoodWalls();
  TexturedFacet& texture = data.textures->facets[0];
  texture.metres_per_texel = 0.024;
  texture.wanted_metres_per_texel = 0.01;
  EXPECT_EQ(FirstRow(data).verdict, Verdict::kAmber);
  ASSERT_EQ(FirstRow(data).findings.size(), 1U);
  EXPECT_EQ(FirstRow(data).findings[0].text,
            "picture 2.4 times coarser than the photos: raise texture.max_texture_px");
  texture.metres_per_texel = 0.011;
  EXPECT_EQ(FirstRow(data).verdict, Verdict::kGreen);
  texture.wanted_metres_per_texel = 0;  // written by an older version
  EXPECT_EQ(FirstRow(data).verdict, Verdict::kGreen);
}

TEST(MakeFacetRows, OnePhotoHasNoMisfit) {
  SurveyData data = GoodWalls();
  data.textures->facets[0].misregistration_px = -1;
  EXPECT_EQ(FirstRow(data).verdict, Verdict::kGreen);
}

TEST(MakeFacetRows, UnpaintedIsRed) {
  SurveyData data = GoodWalls();
  data.textures->facets[0].image.clear();
  data.textures->facets[0].painted = 0;
  EXPECT_EQ(FirstRow(data).verdict, Verdict::kRed);
  EXPECT_EQ(FirstRow(data).findings[0].text, "no photo paints it");
  data.textures->facets.erase(data.textures->facets.begin());
  EXPECT_EQ(FirstRow(data).verdict, Verdict::kRed);
  EXPECT_EQ(FirstRow(data).texture, nullptr);
}

TEST(MakeFacetRows, WithoutTexturesNothingIsRated) {
  SurveyData data = GoodWalls();
  data.textures.reset();
  EXPECT_EQ(FirstRow(data).verdict, Verdict::kUnknown);
  EXPECT_THAT(FirstRow(data).findings, IsEmpty());
  EXPECT_EQ(MedianGsd(data), std::nullopt);
}

TEST(MakeFacetRows, TexturesWithoutProxyAreRated) {
  SurveyData data = GoodWalls();
  data.proxy.reset();
  const auto rows = MakeFacetRows(data, {});
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].verdict, Verdict::kGreen);
  EXPECT_EQ(rows[0].building, "B0001");
  EXPECT_EQ(rows[0].facet, nullptr);
}

// Walls with an outline and with pictures that fit.
SurveyData WallsInPlace() {
  SurveyData data = GoodWalls();
  for (int i = 0; i < 3; ++i) {
    Facet& facet = data.proxy->buildings[0].facets[i];
    facet.normal = -Eigen::Vector3d::UnitY();
    facet.offset = -10.0 * i;
    facet.outer = {{0, 10.0 * i, 0}, {4, 10.0 * i, 0}, {4, 10.0 * i, 3}, {0, 10.0 * i, 3}};
    TexturedFacet& texture = data.textures->facets[i];
    texture.origin = {0, 10.0 * i, 3};
    texture.v_axis = -Eigen::Vector3d::UnitZ();
    texture.metres_per_texel = 0.01;
    texture.width_px = 400;
    texture.height_px = 300;
  }
  return data;
}

void SetTextureState(SurveyData& data, const char* state) {
  StageStatus status;
  status.stage = "texture";
  status.state = state;
  data.statuses = {status};
}

// After a new proxy and a failed texture stage the old pictures are still there, under ids that
// may now be other walls'.
TEST(MakeFacetRows, OldPicturesAreJoinedOnlyWhereTheyFit) {
  const std::function<void(SurveyData&)> changes[] = {
      [](SurveyData& d) { d.proxy->buildings[0].facets[0].offset += 0.1; },
      [](SurveyData& d) { d.proxy->buildings[0].facets[0].normal *= -1; },
      [](SurveyData& d) { d.proxy->buildings[0].facets[0].outer[1].x() += 1; },
      [](SurveyData& d) { d.textures->facets[0].image.clear(); }};
  for (const auto& change : changes) {
    SurveyData data = WallsInPlace();
    SetTextureState(data, "failed");
    EXPECT_EQ(FirstRow(data).verdict, Verdict::kGreen);
    change(data);
    const auto rows = MakeFacetRows(data, {});
    EXPECT_EQ(rows[0].texture, nullptr);
    EXPECT_EQ(rows[0].verdict, Verdict::kUnknown);
    ASSERT_EQ(rows[0].findings.size(), 1U);
    EXPECT_THAT(rows[0].findings[0].text, HasSubstr("older model"));
    EXPECT_EQ(rows[1].verdict, Verdict::kGreen);
    SetTextureState(data, "done");
    EXPECT_NE(FirstRow(data).texture, nullptr);
  }
}

TEST(MakeFacetRows, OldPicturesOfFacetsThatAreGoneAreNotListed) {
  SurveyData data = WallsInPlace();
  SetTextureState(data, "stale");
  data.proxy->buildings[0].facets.pop_back();
  EXPECT_EQ(MakeFacetRows(data, {}).size(), 2U);
  data.proxy->buildings[0].facets.push_back(data.proxy->buildings[0].facets[0]);
  data.proxy->buildings[0].facets.back().id = "B0001/W09";  // never textured
  EXPECT_EQ(MakeFacetRows(data, {}).back().verdict, Verdict::kUnknown);
}

TEST(MakeFacetRows, NothingFromNothing) {
  EXPECT_THAT(MakeFacetRows({}, {}), IsEmpty());
  EXPECT_EQ(CountVerdicts({}, true).Total(), 0);
}

TEST(RowsForPage, LeavesOutSmallPiecesOfGround) {
  SurveyData data = GoodWalls();
  Building& ground = data.proxy->buildings.emplace_back();
  ground.id = "G0";
  for (int i = 0; i < 40; ++i) {
    Facet& facet = ground.facets.emplace_back();
    facet.id = "G" + std::to_string(i);
    facet.facet_class = FacetClass::kGround;
    facet.area = 100 - i;
  }
  const auto rows = MakeFacetRows(data, {});
  ASSERT_EQ(rows.size(), 43U);
  const auto shown = RowsForPage(rows);
  ASSERT_EQ(shown.size(), 15U);
  EXPECT_EQ(shown.back().id, "G11");
  ground.facets.resize(5);
  EXPECT_EQ(RowsForPage(MakeFacetRows(data, {})).size(), 8U);
}

TEST(CountVerdicts, CountsWallsApart) {
  SurveyData data = GoodWalls();
  data.textures->facets[0].painted = 0.1;
  data.proxy->buildings[0].facets[2].facet_class = FacetClass::kRoof;
  const auto rows = MakeFacetRows(data, {});
  EXPECT_EQ(CountVerdicts(rows, true).Total(), 2);
  EXPECT_EQ(CountVerdicts(rows, true).red, 1);
  EXPECT_EQ(CountVerdicts(rows, false).green, 2);
}

TEST(MedianGsd, IsThatOfPaintedFacets) {
  SurveyData data = GoodWalls();
  data.textures->facets[0].gsd_m = 0.03;
  data.textures->facets[1].image.clear();
  data.textures->facets[1].gsd_m = 9;
  data.textures->facets[2].gsd_m = 0.03;
  EXPECT_DOUBLE_EQ(MedianGsd(data).value(), 0.03);
}

}  // namespace
}  // namespace stucco
