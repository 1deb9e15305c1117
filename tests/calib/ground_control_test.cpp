// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/control/ground_control.h"

#include <gtest/gtest.h>

#include "survey/files.h"
#include "tests/survey/support.h"

namespace stucco::test {
namespace {

// Photos of 4000 x 3000 pixels near Graz.
class GroundControlFile : public testing::Test {
 protected:
  GroundControlFile() {
    context_.survey = folder_.path();
    context_.progress = &SilentProgress();
    for (const char* path : {"east/DJI_0001.JPG", "east/DJI_0002.JPG", "west/DJI_0001.JPG",
                             "west/DJI_0007.JPG", "west/dark.JPG"}) {
      CapturedPhoto photo;
      photo.path = path;
      photo.usable = photo.path != "west/dark.JPG";
      photo.width_px = 4000;
      photo.height_px = 3000;
      photo.position = GeoPosition{47.0767, 15.4371, 520, true, 5, 10, false};
      captures_.photos.push_back(photo);
    }
  }

  GroundControl Read() {
    std::vector<const CapturedPhoto*> usable;
    for (const CapturedPhoto& photo : captures_.photos) {
      if (photo.usable) usable.push_back(&photo);
    }
    return ReadGroundControl(options_, captures_, usable, context_);
  }

  GroundControl Read(const std::string& text) {
    WriteFile(folder_ / "gcp_list.txt", text);
    return Read();
  }

  TemporaryFolder folder_;
  StageContext context_;
  CalibOptions options_;
  Captures captures_;
};

void ExpectProblem(const GroundControl& control, const std::vector<std::string>& parts) {
  ASSERT_EQ(control.problems.size(), 1u);
  for (const std::string& part : parts) {
    EXPECT_NE(control.problems[0].find(part), std::string::npos) << control.problems[0];
  }
}

TEST_F(GroundControlFile, IsNotNeeded) {
  const GroundControl control = Read();
  EXPECT_TRUE(control.file.empty());
  EXPECT_TRUE(control.points.empty());
}

TEST_F(GroundControlFile, FindsPhotosByPathOrName) {
  const GroundControl control = Read(
      "EPSG:32633\n"
      "533181.4 5213755 470 100 200 west/DJI_0001.JPG A\n"
      "533181.4 5213755 470 300 400 DJI_0002.JPG A\n"
      "533191.4 5213755 471 300 400 dji_0007.jpg B check\n");
  EXPECT_TRUE(control.problems.empty());
  EXPECT_EQ(control.file, "gcp_list.txt");
  ASSERT_EQ(control.points.size(), 2u);
  ASSERT_EQ(control.points[0].marks.size(), 2u);
  EXPECT_EQ(control.points[0].marks[0].photo, 2);
  EXPECT_EQ(control.points[0].marks[0].pixel, Eigen::Vector2d(100, 200));
  EXPECT_EQ(control.points[0].marks[1].photo, 1);
  EXPECT_EQ(control.points[1].marks[0].photo, 3);
  EXPECT_EQ(control.points[1].role, PointRole::kCheck);
  EXPECT_NEAR(control.points[0].place.latitude_deg, 47.0767, 1e-3);
}

TEST_F(GroundControlFile, LeavesOutMarksThatCannotBe) {
  const std::string good = "EPSG:32633\n533181.4 5213755 470 100 200 DJI_0002.JPG A\n";
  const std::string point = "533181.4 5213755 470 ";
  ExpectProblem(Read(good + point + "1 2 DJI_0001.JPG A\n"), {"line 3", "several photos"});
  ExpectProblem(Read(good + point + "1 2 DJI_0009.JPG A\n"), {"line 3", "no photo of this survey"});
  ExpectProblem(Read(good + point + "1 2 dark.JPG A\n"), {"line 3", "not usable"});
  ExpectProblem(Read(good + point + "1 3001 DJI_0007.JPG A\n"),
                {"line 3", "outside", "4000 x 3000"});
  ExpectProblem(Read(good + point + "1 2 east/DJI_0002.JPG A\n"), {"line 3", "twice"});
  ExpectProblem(Read(good + "1e12 1e12 470 1 2 DJI_0007.JPG B\n"),
                {"line 3", "point B", "no place"});
}

TEST_F(GroundControlFile, IsTakenFromWhereTheOptionSays) {
  std::filesystem::create_directories(folder_ / "survey points");
  WriteFile(folder_ / "survey points/may.txt",
            "EPSG:32633\n533181.4 5213755 470 1 2 DJI_0002.JPG A\n");
  options_.ground_control = "survey points/may.txt";
  EXPECT_EQ(Read().file, "may.txt");
  options_.ground_control = "june.txt";
  ExpectBadInput([&] { Read(); }, "june.txt");
}

TEST_F(GroundControlFile, RefusesAFileOfAnotherPlace) {
  // Columns the other way round, another zone, another survey's photos.
  ExpectBadInput([&] { Read("EPSG:4326\n47.0767 15.4371 470 1 2 DJI_0002.JPG A\n"); }, "km from");
  ExpectBadInput([&] { Read("EPSG:32632\n533181.4 5213755 470 1 2 DJI_0002.JPG A\n"); }, "km from");
  ExpectBadInput([&] { Read("EPSG:32633\n533181.4 5213755 470 1 2 IMG_1.JPG A\n"); },
                 "no point is marked");
  options_.use_positions = false;
  EXPECT_EQ(Read("EPSG:32632\n533181.4 5213755 470 1 2 DJI_0002.JPG A\n").points.size(), 1u);
}

TEST_F(GroundControlFile, FrameLiesInTheMiddleOfThePoints) {
  const GroundControl control = Read(
      "EPSG:4326\n15.43 47.07 400 1 2 DJI_0002.JPG A\n15.44 47.08 450 1 2 DJI_0002.JPG B\n"
      "15.45 47.06 500 1 2 DJI_0002.JPG C\n");
  const Georef frame = FrameAtPoints(control);
  EXPECT_EQ(frame.source, "gcp");
  EXPECT_NEAR(PositionIn(frame, {47.07, 15.44, 450}).norm(), 0, 1e-6);
}

}  // namespace
}  // namespace stucco::test
