// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/roof_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace stucco {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

constexpr double kDetail = 0.2;
constexpr int kRoof = 0, kUpper = 1, kNone = 2;

CutLine LevelAt(double y) {
  return {.point = {0, y}, .direction = {1, 0}};
}
CutLine UpAt(double x) {
  return {.point = {x, 0}, .direction = {0, 1}};
}
AlignedBox2d Box(double x0, double y0, double x1, double y1) {
  return {Vector2d(x0, y0), Vector2d(x1, y1)};
}

// A roof of 20 by 10 m at 10 m, and one above it that some cells have.
class TidyPatchesTest : public testing::Test {
 protected:
  TidyPatchesTest() {
    lines_ = {LevelAt(0), LevelAt(10), UpAt(0), UpAt(20)};
    roofs_ = {{.height = 10}, {.height = 12.5}};
  }

  void Cut(const std::vector<double>& xs, const std::vector<double>& ys) {
    for (const double x : xs) lines_.push_back(UpAt(x));
    for (const double y : ys) lines_.push_back(LevelAt(y));
    arrangement_ = Arrange(Box(-1, -1, 21, 11), lines_);
    for (size_t f = 0; f < arrangement_.faces.size(); ++f) {
      const bool inside = Box(0, 0, 20, 10).contains(Middle(f));
      cell_of_face_.push_back(inside ? static_cast<int>(face_of_cell_.size()) : -1);
      if (inside) face_of_cell_.push_back(static_cast<int>(f));
    }
    labels_.assign(face_of_cell_.size(), kRoof);
  }

  Vector2d Middle(size_t face) const {
    Vector2d sum = Vector2d::Zero();
    for (const int v : arrangement_.faces[face]) sum += arrangement_.vertices[v];
    return sum / static_cast<double>(arrangement_.faces[face].size());
  }

  // Labels the cells of a box.
  void Put(int label, const AlignedBox2d& box) {
    for (size_t c = 0; c < labels_.size(); ++c) {
      if (box.contains(Middle(face_of_cell_[c]))) labels_[c] = label;
    }
  }

  // What the labels are now is what the cloud shows, but for a share of this: what it says of a
  // square metre there.
  void Tidy(const std::function<double(const Vector2d&)>& trust = [](const Vector2d&) {
    return 1.0;
  }) {
    CellProblem problem;
    problem.labels = 3;
    for (size_t c = 0; c < labels_.size(); ++c) {
      const int face = face_of_cell_[c];
      std::vector<double> costs(3, SignedArea(RingOf(arrangement_, face)) * trust(Middle(face)));
      costs[labels_[c]] = 0;
      problem.data.push_back(costs);
    }
    std::vector<double> lengths;
    for (const Arrangement::Edge& edge : arrangement_.edges) {
      if (edge.left < 0 || edge.right < 0) continue;
      const int a = cell_of_face_[edge.left], b = cell_of_face_[edge.right];
      if (a < 0 || b < 0) continue;
      problem.links.push_back({a, b});
      lengths.push_back((arrangement_.vertices[edge.to] - arrangement_.vertices[edge.from]).norm());
    }
    problem.border = [&](size_t link, int a, int b) {
      return a == b ? 0 : 0.6 * kDetail * lengths[link];
    };
    TidyPatches({.arrangement = arrangement_,
                 .lines = lines_,
                 .face_of_cell = face_of_cell_,
                 .cell_of_face = cell_of_face_,
                 .problem = problem,
                 .roofs = roofs_,
                 .level_of_detail = kDetail,
                 .forbidden = forbidden_},
                labels_);
  }

  // Likewise, of a box hardly anything.
  void TidyUnseen(const AlignedBox2d& box) {
    Tidy([&](const Vector2d& p) { return box.contains(p) ? 0.2 : 1; });
  }

  double AreaOf(int label) const {
    double area = 0;
    for (size_t c = 0; c < labels_.size(); ++c) {
      if (labels_[c] == label) area += SignedArea(RingOf(arrangement_, face_of_cell_[c]));
    }
    return area;
  }

  std::vector<RoofPlane> roofs_;
  std::vector<int> labels_;
  double forbidden_ = 1000;

 private:
  std::vector<CutLine> lines_;
  Arrangement arrangement_;
  std::vector<int> face_of_cell_;
  std::vector<int> cell_of_face_;
};

// The head of a staircase, 3 by 4 m, of which nobody saw one corner.
TEST_F(TidyPatchesTest, AJogThatHardlyAnythingSaysGoes) {
  Cut({8, 8.5, 11}, {3, 3.5, 7});
  Put(kUpper, Box(8, 3, 11, 7));
  Put(kRoof, Box(8, 3, 8.5, 3.5));
  TidyUnseen(Box(8, 3, 8.5, 3.5));
  EXPECT_NEAR(AreaOf(kUpper), 12, 1e-9);
}

TEST_F(TidyPatchesTest, ACornerThatTheCloudShowsStays) {
  Cut({8, 9.5, 11}, {3, 5, 7});
  Put(kUpper, Box(8, 3, 11, 7));
  Put(kRoof, Box(8, 3, 9.5, 5));
  Tidy();
  EXPECT_NEAR(AreaOf(kUpper), 9, 1e-9);
}

TEST_F(TidyPatchesTest, AtTheBorderOfTheFootprintNothingIsSquared) {
  Cut({0.5, 3}, {3, 3.5, 7});
  Put(kUpper, Box(0, 3, 3, 7));
  Put(kRoof, Box(0, 3, 0.5, 3.5));
  TidyUnseen(Box(0, 3, 0.5, 3.5));
  EXPECT_NEAR(AreaOf(kUpper), 11.75, 1e-9);
}

TEST_F(TidyPatchesTest, LowBoxesGoAndWideOrHighOnesStay) {
  Cut({8, 10}, {3, 5});
  Put(kUpper, Box(8, 3, 10, 5));
  const std::vector<int> found = labels_;
  Tidy();
  EXPECT_NEAR(AreaOf(kUpper), 4, 1e-9);  // two and a half metres high
  roofs_[kUpper].height = 10.4;
  Tidy();
  EXPECT_EQ(AreaOf(kUpper), 0);
  // One that rises to more than that on one side is none.
  labels_ = found;
  roofs_[kUpper] = {.slope = {0.2, 0}, .height = 8.8};
  Tidy();
  EXPECT_NEAR(AreaOf(kUpper), 4, 1e-9);
}

TEST_F(TidyPatchesTest, ALowTerraceStays) {
  Cut({8, 12}, {3, 5});
  roofs_[kUpper].height = 10.4;
  Put(kUpper, Box(8, 3, 12, 5));
  Tidy();
  EXPECT_NEAR(AreaOf(kUpper), 8, 1e-9);
}

TEST_F(TidyPatchesTest, SmallPatchesGoHoweverHigh) {
  Cut({8, 8.7}, {3, 3.7});
  Put(kUpper, Box(8, 3, 8.7, 3.7));  // below four levels of detail each way
  Tidy();
  EXPECT_EQ(AreaOf(kUpper), 0);
}

TEST_F(TidyPatchesTest, NothingGoesBelowWhatItMay) {
  Cut({8, 8.7}, {3, 3.7});
  Put(kUpper, Box(8, 3, 8.7, 3.7));
  forbidden_ = 0.4;  // of the 0.49 that the lower roof costs there
  Tidy();
  EXPECT_NEAR(AreaOf(kUpper), 0.49, 1e-9);
}

TEST_F(TidyPatchesTest, StripsThatRiseToTheBorderAreParapets) {
  Cut({4, 16}, {6, 8.5});
  const std::vector<int> none = labels_;
  const auto area_after = [&](const AlignedBox2d& strip, const RoofPlane& roof) {
    labels_ = none;
    roofs_[kUpper] = roof;
    Put(kUpper, strip);
    Tidy();
    return AreaOf(kUpper);
  };
  const auto rising = [](double slope) {  // from the roof's height at 8.5 m
    return RoofPlane{.slope = {0, slope}, .height = 10 - 8.5 * slope};
  };
  const AlignedBox2d narrow = Box(0, 8.5, 20, 10), wide = Box(0, 6, 20, 10);
  EXPECT_EQ(area_after(narrow, rising(0.5)), 0);
  EXPECT_EQ(area_after(Box(4, 8.5, 16, 10), rising(0.5)), 0);
  EXPECT_NEAR(area_after(narrow, rising(1)), 30, 1e-9);     // a metre and a half high
  EXPECT_NEAR(area_after(narrow, rising(-0.5)), 30, 1e-9);  // falls to the eaves
  EXPECT_NEAR(area_after(wide, {.slope = {0, 0.2}, .height = 8.8}), 80, 1e-9);
  EXPECT_NEAR(area_after(narrow, {.height = 10.5}), 30, 1e-9);
  // Below a roof that is pitched itself such a strip is another roof.
  roofs_[kRoof].slope = {0, -0.2};
  EXPECT_NEAR(area_after(narrow, rising(0.3)), 30, 1e-9);
}

TEST_F(TidyPatchesTest, NarrowStripsAlongTheBorderAreParapets) {
  Cut({4, 16}, {9.2});
  roofs_[kUpper].height = 10.6;
  Put(kUpper, Box(4, 9.2, 16, 10));
  const std::vector<int> found = labels_;
  Tidy();
  EXPECT_EQ(AreaOf(kUpper), 0);
  labels_ = found;
  roofs_[kUpper].height = 9.5;  // a balcony
  Tidy();
  EXPECT_NEAR(AreaOf(kUpper), 9.6, 1e-9);
}

// A fringe of ten corners at the border of the footprint, 7 m², of which the cloud says next to
// nothing; and the same where it says two fifths of what it says elsewhere.
TEST_F(TidyPatchesTest, CornersThatExplainNextToNothingGo) {
  Cut({5, 6, 7, 9, 10}, {8, 9});
  Put(kUpper, Box(5, 9, 10, 10));
  Put(kUpper, Box(6, 8, 7, 9));
  Put(kUpper, Box(9, 8, 10, 9));
  ASSERT_NEAR(AreaOf(kUpper), 7, 1e-9);
  const std::vector<int> found = labels_;
  Tidy([](const Vector2d& p) { return Box(5, 8, 10, 10).contains(p) ? 0.01 : 1; });
  EXPECT_EQ(AreaOf(kUpper), 0);
  labels_ = found;
  Tidy([](const Vector2d& p) { return Box(5, 8, 10, 10).contains(p) ? 0.4 : 1; });
  EXPECT_NEAR(AreaOf(kUpper), 7, 1e-9);
}

TEST_F(TidyPatchesTest, YardsStayAsTheyAre) {
  Cut({8, 8.5, 11}, {3, 3.5, 7});
  Put(kNone, Box(8, 3, 11, 7));
  Put(kRoof, Box(8, 3, 8.5, 3.5));
  TidyUnseen(Box(8, 3, 8.5, 3.5));
  EXPECT_NEAR(AreaOf(kNone), 11.75, 1e-9);
}

}  // namespace
}  // namespace stucco
