// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "plan/camera/preset.h"
#include "plan/dipping/dipping_views.h"
#include "plan/match/corridors.h"
#include "plan/match/expected_matches.h"
#include "plan/match/link_candidates.h"
#include "plan/match/link_photos.h"
#include "plan/match/linked_photos.h"
#include "plan/planar/planar_views.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

using Eigen::Vector3d;

// A house of 12 x 10 x 6 m and what a plan without links has of it.
class House : public testing::Test {
 protected:
  explicit House(std::vector<Polygon> no_fly = {})
      : site_(MadeSite({Rectangle(-6, -5, 6, 5)}, {.safe_altitude_m = 28,
                                                   .margin_m = 28,
                                                   .heights_m = {6},
                                                   .no_fly = std::move(no_fly)})),
        obstacles_(site_),
        setting_{site_, camera_, 2} {
    const DippingSetting dipping = MakeSetting(site_, obstacles_, camera_, 80);
    hovers_ = PlanDippingViews(dipping, progress_).hovers;
    dips_ = hovers_.size();
    const auto above = PlanarViews(site_, camera_, {.grid = {}, .d_max_m = 84}, hovers_, progress_);
    hovers_.insert(hovers_.end(), above.begin(), above.end());
  }

  // Photos of facades without two partners near in direction and scale.
  int Loose() const {
    const PhotoGraph photos(setting_, hovers_);
    int loose = 0;
    for (uint32_t i = 0; i < photos.graph.size(); ++i) {
      const Shot& shot = hovers_[photos.places[i].hover].shots[photos.places[i].shot];
      if (shot.kind != ViewKind::kDipping) continue;
      const auto partners = photos.graph.PartnersOf(i);
      loose += std::ranges::count_if(partners, [](const Partner& partner) {
                 return partner.close_walls >= kCloseShare;
               }) < kFewestClose;
    }
    return loose;
  }

  CameraPreset camera_ = FindCamera("mavic-3e");
  Site site_;
  Obstacles obstacles_;
  MatchSetting setting_;
  Progress& progress_ = SilentProgress();
  std::vector<Hover> hovers_;
  size_t dips_ = 0;
};

TEST_F(House, ItsFacadePhotosAreLooseWithoutLinksAndTiedWithThem) {
  ASSERT_GT(Loose(), 0);
  const std::vector<Hover> before = hovers_;
  const LinkReport report = AddLinkPhotos(setting_, obstacles_, hovers_, progress_);
  EXPECT_EQ(Loose(), 0);
  const PhotoGraph photos(setting_, hovers_);
  const Connectivity whole = ConnectivityOf(TiesOf(photos, hovers_, 2));
  EXPECT_EQ(whole.parts, 1);
  EXPECT_TRUE(whole.bridges.empty());
  EXPECT_TRUE(LooseGroups(photos.places, TiesOf(photos, hovers_, 2)).empty());
  int links = 0;
  for (size_t h = 0; h < hovers_.size(); ++h) {
    EXPECT_TRUE(obstacles_.IsFree(hovers_[h].position));
    if (h < before.size()) {
      EXPECT_EQ(hovers_[h].position, before[h].position);
    }
    for (size_t s = 0; s < hovers_[h].shots.size(); ++s) {
      const Shot& shot = hovers_[h].shots[s];
      if (shot.kind != ViewKind::kLink) continue;
      Hover others = hovers_[h];
      others.shots.erase(others.shots.begin() + static_cast<std::ptrdiff_t>(s));
      EXPECT_FALSE(HasLinkLike(others, shot));
      ++links;
      EXPECT_TRUE(shot.targets.empty());
    }
  }
  EXPECT_EQ(links, report.photos);
  EXPECT_LE(links, static_cast<int>(3 * dips_));
}

TEST_F(House, LinksAreTheSameAtAnyNumberOfThreads) {
  std::vector<Hover> one = hovers_, two = hovers_;
  AddLinkPhotos({site_, camera_, 1}, obstacles_, one, progress_);
  AddLinkPhotos({site_, camera_, 2}, obstacles_, two, progress_);
  ASSERT_EQ(one.size(), two.size());
  for (size_t h = 0; h < one.size(); ++h) {
    EXPECT_EQ(one[h].position, two[h].position);
    EXPECT_EQ(one[h].shots.size(), two[h].shots.size());
  }
}

// Photos from above were thinned out counting on the links of facades: these stay, needed or not.
TEST_F(House, LinksStayAndAreAddedOnce) {
  const int links = AddLinkPhotos(setting_, obstacles_, hovers_, progress_).photos;
  EXPECT_EQ(AddLinkPhotos(setting_, obstacles_, hovers_, progress_).photos, links);
  const size_t stops = hovers_.size();
  hovers_.push_back({{0, -22, 14}, {LinkShot({0, 17, -10})}});
  EXPECT_EQ(AddLinkPhotos(setting_, obstacles_, hovers_, progress_).photos, links + 1);
  EXPECT_EQ(hovers_.size(), stops + 1);
  EXPECT_EQ(Loose(), 0);
}

TEST_F(House, GivesUpWhereNoPlaceServes) {
  std::vector<Hover> alone{{{500, 500, 20}, {{.kind = ViewKind::kOblique, .targets = {}}}}};
  EXPECT_EQ(AddLinkPhotos(setting_, obstacles_, alone, progress_).photos, 0);
  EXPECT_EQ(alone.size(), 1u);
  hovers_.resize(1);  // nothing from above that sees what it sees
  EXPECT_LE(AddLinkPhotos(setting_, obstacles_, hovers_, progress_).photos, 8);
}

// What the plan says of its matches, against the graph.
TEST_F(House, SaysWhichPhotosAreLoose) {
  const auto described = [&](const std::vector<Hover>& hovers) {
    struct Plan plan;
    for (size_t h = 0; h < hovers.size(); ++h) {
      for (const Shot& shot : hovers[h].shots) {
        PlannedView view;
        view.id = "v" + std::to_string(plan.views.size());
        view.kind = shot.kind;
        for (const Target& target : shot.targets) {
          view.targets.push_back({site_.facades[target.facade].id, target.along_m, target.z_m});
        }
        plan.views.push_back(std::move(view));
      }
    }
    const MatchStats stats = ExpectMatches(PhotoGraph(setting_, hovers), hovers, 2, plan);
    EXPECT_EQ(std::ranges::count(plan.views, true, &PlannedView::is_loose), stats.loose);
    for (const PlannedView& view : plan.views) {
      EXPECT_LE(view.partners.size(), 12u);
      for (const PlannedPartner& partner : view.partners) {
        EXPECT_GE(partner.strength, kEnoughStrength);
        EXPECT_NE(partner.view, view.id);
      }
      EXPECT_TRUE(
          std::ranges::is_sorted(view.partners, std::ranges::greater{}, &PlannedPartner::strength));
    }
    return stats;
  };
  const MatchStats before = described(hovers_);
  EXPECT_GE(before.loose, Loose());
  EXPECT_TRUE(before.weakest.front().is_loose);
  EXPECT_THAT(MatchWarnings(before, true), testing::Contains(testing::HasSubstr("B0001/F0")));
  EXPECT_THAT(MatchWarnings(before, false),
              testing::Contains(testing::HasSubstr("no link photos")));
  AddLinkPhotos(setting_, obstacles_, hovers_, progress_);
  const MatchStats after = described(hovers_);
  EXPECT_EQ(after.loose, 0);
  EXPECT_EQ(after.parts, 1);
  EXPECT_THAT(MatchWarnings(after, true), testing::IsEmpty());
  EXPECT_GE(after.weakest.size(), 10u);
}

TEST(MatchWarnings, NamePartsAndSingleStops) {
  MatchStats stats{.parts = 1, .bridges = 0, .hanging = 0, .loose = 0, .weakest = {}};
  EXPECT_THAT(MatchWarnings(stats, true), testing::IsEmpty());
  stats.parts = 2;
  stats.apart = 31;
  stats.apart_of = {"B0002", "B0003"};
  stats.hanging = 4;
  EXPECT_THAT(MatchWarnings(stats, true),
              testing::ElementsAre(testing::HasSubstr("2 parts with nothing that ties them: 31 of "
                                                      "them (of B0002, B0003)"),
                                   testing::HasSubstr("single stop tie to the others: 4")));
}

// Two houses with open ground between, and what a plan without links has of them.
struct FarHouses {
  explicit FarHouses(double gap_m)
      : site(MadeSite({Rectangle(-6, -5, 6, 5), Rectangle(6 + gap_m, -5, 18 + gap_m, 5)},
                      {.safe_altitude_m = 28, .margin_m = 28, .heights_m = {6, 6}})),
        obstacles(site) {
    const DippingSetting dipping = MakeSetting(site, obstacles, camera, 80);
    hovers = PlanDippingViews(dipping, SilentProgress()).hovers;
    const auto above =
        PlanarViews(site, camera, {.grid = {}, .d_max_m = 84}, hovers, SilentProgress());
    hovers.insert(hovers.end(), above.begin(), above.end());
    // Those between the houses stand in the gap of the grid's rows.
    std::erase_if(hovers, [&](const Hover& hover) {
      return hover.position.x() > 40 && hover.position.x() < gap_m - 28;
    });
  }
  Connectivity Whole() const {
    const PhotoGraph photos({site, camera, 2}, hovers);
    return ConnectivityOf(TiesOf(photos, hovers, 2));
  }
  size_t Loose() const {
    const PhotoGraph photos({site, camera, 2}, hovers);
    return LooseGroups(photos.places, TiesOf(photos, hovers, 2)).size();
  }

  CameraPreset camera = FindCamera("mavic-3e");
  Site site;
  Obstacles obstacles;
  std::vector<Hover> hovers;
};

TEST(LinkChains, TieWhatOpenGroundParts) {
  FarHouses far(220);
  ASSERT_GT(far.Whole().parts, 1);
  const size_t before = far.hovers.size();
  AddLinkPhotos({far.site, far.camera, 2}, far.obstacles, far.hovers, SilentProgress());
  EXPECT_EQ(far.Whole().parts, 1);
  EXPECT_EQ(far.Loose(), 0u);
  int between = 0;
  for (size_t h = before; h < far.hovers.size(); ++h) {
    const Vector3d& position = far.hovers[h].position;
    EXPECT_TRUE(far.obstacles.IsFree(position));
    if (position.x() < 50 || position.x() > 180) continue;
    ++between;
    EXPECT_LT(std::abs(position.y()), 6);
    EXPECT_EQ(position.z(), far.site.safe_altitude_m);
  }
  EXPECT_GE(between, 5);
  EXPECT_LE(between, 12);  // one each 15 m or so
}

TEST(LinkChains, LeaveOutWhatMayNotBeFlownAndWhatIsTooFar) {
  FarHouses far(220);
  far.site.no_fly = {{{Rectangle(80, -200, 160, 200)}}};
  const Obstacles obstacles(far.site);
  AddLinkPhotos({far.site, far.camera, 2}, obstacles, far.hovers, SilentProgress());
  EXPECT_EQ(far.Whole().parts, 2);
  for (const Hover& hover : far.hovers) EXPECT_TRUE(obstacles.IsFree(hover.position));
  const Site apart = MadeSite({Rectangle(0, 0, 10, 10), Rectangle(700, 0, 710, 10)},
                              {.safe_altitude_m = 28, .heights_m = {6, 6}});
  EXPECT_TRUE(CorridorsOf(apart, 60).empty());
}

TEST(Corridors, AreTheShortestLinesThatJoinAll) {
  // Three groups in a row; the second is two houses 30 m apart.
  const Site site = MadeSite({Rectangle(0, 0, 10, 10), Rectangle(110, 0, 120, 10),
                              Rectangle(150, 0, 160, 10), Rectangle(290, 0, 300, 10)},
                             {.safe_altitude_m = 28, .heights_m = {6, 6, 6, 6}});
  std::vector<double> lengths;
  for (const Segment2d& line : CorridorsOf(site, 60)) lengths.push_back((line.b - line.a).norm());
  std::ranges::sort(lengths);
  ASSERT_EQ(lengths.size(), 2u);
  EXPECT_NEAR(lengths[0], 100, 5);
  EXPECT_NEAR(lengths[1], 130, 5);
  EXPECT_TRUE(CorridorsOf(site, 140).empty());
  EXPECT_TRUE(CorridorsOf(MadeSite({Rectangle(0, 0, 10, 10)}), 60).empty());
}

// Two houses so far apart that no photo shows the ground of both.
TEST(ExpectMatches, SaysWhichPhotosAreAPartOfTheirOwn) {
  const Site site = MadeSite({Rectangle(-6, -5, 6, 5), Rectangle(394, -5, 406, 5)},
                             {.safe_altitude_m = 28, .margin_m = 28, .heights_m = {6, 6}});
  const CameraPreset camera = FindCamera("mavic-3e");
  std::vector<Hover> hovers;
  struct Plan plan;
  for (const double east : {0.0, 400.0}) {
    for (int i = 0; i < (east == 0 ? 4 : 3); ++i) {
      Hover hover;
      hover.position = {east + 3 * i, 0, 28};
      hover.shots.push_back({0, -1.57, ViewKind::kNadir, {}});
      hovers.push_back(hover);
      PlannedView view;
      view.id = "h" + std::to_string(hovers.size());
      if (east > 0) view.targets.push_back({"B0002/F01", {0, 1}, {0, 6}});
      plan.views.push_back(view);
    }
  }
  const MatchSetting setting{site, camera, 2};
  const MatchStats stats = ExpectMatches(PhotoGraph(setting, hovers), hovers, 2, plan);
  EXPECT_EQ(stats.parts, 2);
  EXPECT_EQ(stats.apart, 3);
  EXPECT_THAT(stats.apart_of, testing::ElementsAre("B0002"));
  EXPECT_EQ(stats.hanging, 0);
}

TEST_F(House, CandidatesAreFreeAndNearInDirectionAndScale) {
  const Gaze gaze{{0, -5, 3}, Vector3d(0, -1, 0.2).normalized(), 10.2};
  const auto candidates = LinkCandidates(gaze, obstacles_, hovers_, 0);
  ASSERT_GT(candidates.size(), 5u);
  for (const LinkCandidate& candidate : candidates) {
    const Vector3d ray = candidate.position - gaze.middle;
    EXPECT_TRUE(obstacles_.IsFree(candidate.position));
    EXPECT_LE(ray.norm(), kCloseRatio * gaze.distance_m);
    EXPECT_GE(ray.normalized().dot(gaze.way), std::cos(kCloseAngle_rad));
    EXPECT_GT(candidate.shot.Direction().dot(-ray.normalized()), 0.999);
    EXPECT_LE(candidate.position.z(), site_.CeilingAt(candidate.position.head<2>()));
  }
  EXPECT_TRUE(LinkCandidates({}, obstacles_, hovers_, 0).empty());
}

TEST(LinkShot, LooksNoHigherAndNoSteeperThanGimbalsTilt) {
  constexpr double kDegree = 0.0174533;
  EXPECT_NEAR(LinkShot({0, 3, -1}).pitch_rad, -18.43 * kDegree, 1e-3);
  EXPECT_NEAR(LinkShot({0, 1, 2}).pitch_rad, 20 * kDegree, 1e-6);
  EXPECT_NEAR(LinkShot({0, 0, -1}).pitch_rad, -89 * kDegree, 1e-6);
}

// Above a photo that is taken at the height of flight nothing may be.
TEST_F(House, BesideAPhotoAtTheCeilingAreCandidatesAtItsHeight) {
  const Gaze gaze{{0, 0, 6}, Vector3d::UnitZ(), site_.safe_altitude_m - 6};
  const auto candidates = LinkCandidates(gaze, obstacles_, {}, 0);
  ASSERT_GT(candidates.size(), 5u);
  for (const LinkCandidate& candidate : candidates) {
    EXPECT_EQ(candidate.position.z(), site_.safe_altitude_m);
    EXPECT_GT(candidate.position.head<2>().norm(), 2);
  }
}

// Photos straight down, low over the ground beside the house, that one in between holds to others.
TEST_F(House, TiesWhatHangsOnOneHover) {
  constexpr double kDown = -1.5;
  std::vector<Hover> hovers{
      {{-14, -30, 14}, {{.pitch_rad = kDown, .kind = ViewKind::kNadir, .targets = {}}}}};
  for (const double x : {-38.0, -33.0, -28.0, 0.0, 5.0}) {
    for (const double y : {-36.0, -30.0, -24.0}) {
      hovers.push_back(
          {{x, y, 14}, {{.pitch_rad = kDown, .kind = ViewKind::kNadir, .targets = {}}}});
    }
  }
  const auto loose = [&] {
    const PhotoGraph photos(setting_, hovers);
    return LooseGroups(photos.places, TiesOf(photos, hovers, 2));
  };
  const auto before = loose();
  ASSERT_EQ(before.size(), 1u);
  EXPECT_EQ(before.front().on, 0);
  EXPECT_GT(AddLinkPhotos(setting_, obstacles_, hovers, progress_).photos, 0);
  EXPECT_TRUE(loose().empty());
}

}  // namespace
}  // namespace stucco::plan
