// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/records.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "survey/attitude.h"
#include "tests/calib/made_records.h"

namespace stucco::test {
namespace {

// Points around and below the photos, each seen by those that have it in their pictures.
void ShowPoints(Scene& scene) {
  Random random(11);
  scene.tracks.clear();
  for (ScenePhoto& photo : scene.photos) photo.keypoints.clear();
  for (int i = 0; i < 600; ++i) {
    const double east = random.Uniform(-60, 150);
    const double north = random.Uniform(-60, 140);
    SceneTrack track{{}, Eigen::Vector3d(east, north, random.Uniform(0, 40))};
    for (int p = 0; p < static_cast<int>(scene.photos.size()); ++p) {
      ScenePhoto& photo = scene.photos[p];
      const auto pixel = scene.CameraOf(p).Project(*photo.pose * *track.position);
      if (!pixel || !scene.CameraOf(p).Contains(*pixel)) continue;
      track.elements.push_back({p, static_cast<int>(photo.keypoints.size()), true});
      photo.keypoints.push_back(*pixel);
    }
    if (track.elements.size() > 1) scene.tracks.push_back(std::move(track));
  }
}

// Photos that look all ways, as those of a flight do: what turns with the camera and what stays
// with the world are told apart by that.
Scene MakeFlight(int num_photos) {
  Scene scene = MakeScene({.num_photos = num_photos, .num_points = 30});
  for (int i = 0; i < num_photos; ++i) {
    const GimbalAngles angles{90.0 * (i % 4), i % 3 == 0 ? -90.0 : -40.0 * (i % 3 - 1), 0};
    const Eigen::Quaterniond rotation = CamFromEnu(angles);
    const Eigen::Vector3d place(8.0 * (i % 12), 9.0 * (i / 12), 30 + 5 * (i % 2));
    scene.photos[i].pose = Pose{rotation, -(rotation * place)};
  }
  ShowPoints(scene);
  return scene;
}

TEST(MeasureRecordErrors, FindsWhatRecordsAreGoodTo) {
  const Scene scene = MakeFlight(96);
  const auto records = MakeRecords(scene, {});
  const RecordErrors errors = MeasureRecordErrors(records, scene);
  ASSERT_EQ(errors.flights.size(), 1U);
  EXPECT_EQ(errors.flights[0].num_photos, 96);
  EXPECT_NEAR(errors.flights[0].sigma_horizontal_m, 0.5, 0.12);
  EXPECT_NEAR(errors.flights[0].sigma_vertical_m, 0.5, 0.15);
  EXPECT_NEAR(errors.sigma_attitude_rad, 0.003, 0.0006);
}

TEST(MeasureRecordErrors, TakesForZeroWhatChanceExplains) {
  const Scene scene = MakeFlight(96);
  const RecordErrors errors = MeasureRecordErrors(MakeRecords(scene, {}), scene);
  EXPECT_EQ(errors.mount_rad, Eigen::Vector3d::Zero());
  EXPECT_EQ(errors.flights[0].yaw_rad, 0);
  EXPECT_EQ(errors.flights[0].shift_m, Eigen::Vector3d::Zero());
  EXPECT_LT(errors.tilt_rad.norm(), 0.05 * kDegree);
}

TEST(MeasureRecordErrors, TellsMountAndCompassApart) {
  const Scene scene = MakeFlight(96);
  const Eigen::Vector3d mount(2 * kDegree, -1 * kDegree, 0.5 * kDegree);
  const auto records =
      MakeRecords(scene, {.mount_rad = mount, .yaw_rad = {25 * kDegree, -4 * kDegree}});
  const RecordErrors errors = MeasureRecordErrors(records, scene);
  ASSERT_EQ(errors.flights.size(), 2U);
  EXPECT_LT((errors.mount_rad - mount).norm(), 0.2 * kDegree);
  EXPECT_NEAR(errors.flights[0].yaw_rad, 25 * kDegree, 0.3 * kDegree);
  EXPECT_NEAR(errors.flights[1].yaw_rad, -4 * kDegree, 0.3 * kDegree);
  EXPECT_LT(errors.tilt_rad.norm(), 0.2 * kDegree);
}

TEST(MeasureRecordErrors, CountsYawAsCompassesDo) {
  const Scene scene = MakeFlight(96);
  auto records = MakeRecords(scene, {});
  for (int i = 0; i < 96; ++i) {
    // As MakeFlight, read off a compass that is 10 degrees short.
    records[i].gimbal =
        CamFromEnu({90.0 * (i % 4) - 10, i % 3 == 0 ? -90.0 : -40.0 * (i % 3 - 1), 0});
  }
  const RecordErrors errors = MeasureRecordErrors(records, scene);
  EXPECT_NEAR(errors.flights[0].yaw_rad, 10 * kDegree, 0.3 * kDegree);
}

// Where all photos look down, a mount turned about the viewing direction and a compass are the
// same.
TEST(MeasureRecordErrors, IsNotLostWhereAllPhotosLookDown) {
  Scene scene = MakeFlight(32);
  for (int i = 0; i < 32; ++i) {
    const Eigen::Vector3d place = scene.photos[i].pose->Center();
    const Eigen::Quaterniond rotation = CamFromEnu({i < 16 ? 107.0 : -73.0, -90, 0});
    scene.photos[i].pose = Pose{rotation, -(rotation * place)};
  }
  auto records = MakeRecords(scene, {.position_sigma_m = 0.01, .yaw_rad = {1.5 * kDegree}});
  const RecordErrors errors = MeasureRecordErrors(records, scene);
  EXPECT_LT(std::abs(errors.flights[0].yaw_rad), 3 * kDegree);
  EXPECT_LT(errors.mount_rad.norm(), 3 * kDegree);
  EXPECT_LT(errors.sigma_attitude_rad, 0.006);
  ApplyRecords(records, errors, scene);
  for (const ScenePhoto& photo : scene.photos) {
    EXPECT_LT(photo.attitude->cam_from_world.angularDistance(photo.pose->rotation), 0.02);
  }
}

TEST(MeasureRecordErrors, KeepsWhatPhotosStateApart) {
  Scene scene = MakeFlight(96);
  Random random(3);
  auto records = MakeRecords(scene, {.position_sigma_m = 0.01});
  for (size_t i = 0; i < records.size(); ++i) {
    const bool fixed = i % 3 != 0;
    records[i].position->sigma_horizontal_m = fixed ? 0.02 : 2;
    records[i].position->sigma_vertical_m = fixed ? 0.02 : 2;
    if (!fixed) records[i].position->position += random.Vector(1.7);
  }
  ApplyRecords(records, MeasureRecordErrors(records, scene), scene);
  EXPECT_LT(scene.photos[1].prior->sigma_horizontal_m, 0.03);
  EXPECT_GT(scene.photos[0].prior->sigma_horizontal_m, 0.5);
}

TEST(MeasureRecordErrors, SeesTheTiltOfTheScene) {
  Scene scene = MakeFlight(96);
  const auto records = MakeRecords(scene, {});
  const Eigen::Vector3d tilt(0.4 * kDegree, -0.3 * kDegree, 0);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(tilt.norm(), tilt.normalized()));
  for (ScenePhoto& photo : scene.photos) {
    const Eigen::Vector3d place = turn.conjugate() * photo.pose->Center();
    photo.pose->rotation = photo.pose->rotation * turn;
    photo.pose->translation = -(photo.pose->rotation * place);
  }
  const RecordErrors errors = MeasureRecordErrors(records, scene);
  EXPECT_LT((errors.tilt_rad - tilt).norm(), 0.06 * kDegree);
  EXPECT_GT(UpSigma_rad(errors), 0.45 * kDegree);
  EXPECT_LT(UpSigma_rad(errors), 0.6 * kDegree);
}

TEST(MeasureRecordErrors, SaysHowSurelyItKnowsUp) {
  const Scene scene = MakeFlight(96);
  auto records = MakeRecords(scene, {});
  EXPECT_LT(UpSigma_rad(MeasureRecordErrors(records, scene)), 0.1 * kDegree);
  for (PoseRecord& record : records) record.gimbal.reset();
  EXPECT_EQ(UpSigma_rad(MeasureRecordErrors(records, scene)), std::nullopt);
}

TEST(MeasureRecordErrors, FindsShiftsBetweenFlights) {
  const Scene scene = MakeFlight(96);
  const auto records = MakeRecords(
      scene, {.yaw_rad = {0, 0}, .shift_m = {Eigen::Vector3d(2, 0, 0), Eigen::Vector3d(0, 0, 4)}});
  const RecordErrors errors = MeasureRecordErrors(records, scene);
  const Eigen::Vector3d between = errors.flights[1].shift_m - errors.flights[0].shift_m;
  EXPECT_LT((between - Eigen::Vector3d(-2, 0, 4)).norm(), 0.5);
  EXPECT_NEAR(errors.flights[0].sigma_horizontal_m, 0.5, 0.15);
}

// Leaves of flight 1 only what one of its photos sees in a narrow part of its picture, at about one
// distance, as of a wall.
void TieByAStrip(const std::vector<PoseRecord>& records, int only, Scene& scene) {
  for (SceneTrack& track : scene.tracks) {
    const Eigen::Vector3d local = *scene.photos[only].pose * *track.position;
    const bool in_strip = local.z() > 40 && local.z() < 60 && std::abs(local.x()) < 2;
    std::erase_if(track.elements, [&](const SceneElement& e) {
      return records[e.photo].flight == 1 && !(e.photo == only && in_strip);
    });
  }
}

TEST(MeasureRecordErrors, DoesNotBendRecordsToAFlightThatHangsOnOnePhoto) {
  Scene scene = MakeFlight(96);
  const auto records = MakeRecords(scene, {.yaw_rad = {0, 0}});
  const Eigen::Quaterniond turn = AboutUp(1 * kDegree);
  const Eigen::Vector3d shift(0.9, -0.5, 0.3);
  for (size_t i = 1; i < records.size(); i += 2) {
    Pose& pose = *scene.photos[i].pose;
    const Eigen::Vector3d place = pose.Center() + shift;
    pose.rotation = pose.rotation * turn;
    pose.translation = -(pose.rotation * place);
  }
  const RecordErrors held = MeasureRecordErrors(records, scene);
  EXPECT_NEAR((held.flights[1].shift_m - held.flights[0].shift_m).norm(), shift.norm(), 0.4);
  EXPECT_NEAR(held.flights[1].yaw_rad - held.flights[0].yaw_rad, 1 * kDegree, 0.2 * kDegree);
  TieByAStrip(records, 1, scene);
  const RecordErrors loose = MeasureRecordErrors(records, scene);
  EXPECT_EQ(loose.flights[1].shift_m, Eigen::Vector3d::Zero());
  EXPECT_EQ(loose.flights[1].yaw_rad, 0);
}

TEST(MeasureRecordErrors, FindsHowStillTheDroneStood) {
  Scene scene = MakeFlight(96);
  Random random(5);
  for (int i = 0; i < 96; ++i) {
    const Eigen::Quaterniond rotation = scene.photos[i].pose->rotation;
    const Eigen::Vector3d drift(random.Gauss(0.08), random.Gauss(0.08), random.Gauss(0.08));
    const Eigen::Vector3d place = scene.photos[i - i % 4].pose->Center() + drift;
    scene.photos[i].pose = Pose{rotation, -(rotation * place)};
  }
  auto records = MakeRecords(scene, {});
  EXPECT_EQ(MeasureRecordErrors(records, scene).sigma_hover_m, 0);  // nothing says where it stood
  for (int i = 0; i < 96; ++i) records[i].hover = i / 4;
  // Of one hover each photo stands beside the one before: a wrong pose, or a drone that moved.
  for (int i = 1; i < 4; ++i) scene.photos[i].pose->translation.x() += 3.0 * i;
  const RecordErrors errors = MeasureRecordErrors(records, scene);
  // The first of each stands beside the drift of the others, by its own.
  EXPECT_NEAR(errors.sigma_hover_m, 0.08, 0.03);
  ApplyRecords(records, errors, scene);
  EXPECT_EQ(scene.hover_sigma_m, errors.sigma_hover_m);
  EXPECT_EQ(scene.photos[9].hover, 2);
}

TEST(MeasureRecordErrors, IsNotMovedByWrongOnes) {
  const Scene scene = MakeFlight(96);
  auto records = MakeRecords(scene, {});
  for (size_t i = 0; i < records.size(); i += 5) {
    records[i].position->position += Eigen::Vector3d(30, -10, 3);
    records[i].gimbal =
        Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX())) * *records[i].gimbal;
  }
  const RecordErrors errors = MeasureRecordErrors(records, scene);
  EXPECT_LT(errors.flights[0].sigma_horizontal_m, 0.9);
  EXPECT_LT(errors.sigma_attitude_rad, 0.006);
  EXPECT_LT(errors.tilt_rad.norm(), 0.1 * kDegree);
}

// Two flights side by side, each over half of the place.
std::vector<PoseRecord> MakeTwoHalves(const Scene& scene, const MadeRecordErrors& errors) {
  auto records = MakeRecords(scene, errors);
  for (size_t i = 0; i < records.size(); ++i) {
    records[i].flight = scene.photos[i].pose->Center().y() > 30 ? 1 : 0;
  }
  return records;
}

// A scene may turn while poses are adjusted to first matches; if all compasses were then said to be
// off by that, records would hold it there.
TEST(MeasureRecordErrors, TakesATurnedSceneForNobodysError) {
  Scene scene = MakeFlight(96);
  const auto records = MakeTwoHalves(scene, {.position_sigma_m = 0.1});
  TurnAboutUp(0.4 * kDegree, scene);
  const RecordErrors errors = MeasureRecordErrors(records, scene);
  for (const FlightErrors& flight : errors.flights) {
    EXPECT_EQ(flight.yaw_rad, 0);
    EXPECT_EQ(flight.shift_m, Eigen::Vector3d::Zero());
    EXPECT_LT(flight.sigma_horizontal_m, 0.14);
  }
}

TEST(MeasureRecordErrors, MeasuresCompassesAgainstPositions) {
  Scene scene = MakeFlight(96);
  auto records = MakeTwoHalves(scene, {.position_sigma_m = 0.1, .yaw_rad = {3 * kDegree}});
  TurnAboutUp(0.4 * kDegree, scene);
  const RecordErrors errors = MeasureRecordErrors(records, scene);
  EXPECT_NEAR(errors.flights[0].yaw_rad, 3 * kDegree, 0.1 * kDegree);
  EXPECT_NEAR(errors.flights[1].yaw_rad, 3 * kDegree, 0.1 * kDegree);
}

TEST(MeasureRecordErrors, LetsControlPointsHoldTheScene) {
  Scene scene = MakeFlight(96);
  const auto records = MakeTwoHalves(scene, {.position_sigma_m = 0.1});
  TurnAboutUp(0.4 * kDegree, scene);
  scene.control.points.resize(3);
  const RecordErrors errors = MeasureRecordErrors(records, scene);
  EXPECT_NEAR(errors.flights[0].yaw_rad, -0.4 * kDegree, 0.1 * kDegree);
  EXPECT_NEAR(errors.flights[1].yaw_rad, -0.4 * kDegree, 0.1 * kDegree);
}

// Most of a flight shows walls that repeat themselves, and hangs together a bay off.
TEST(MeasureRecordErrors, GoesByPhotosThatCannotBeBaysOff) {
  Scene scene = MakeFlight(96);
  auto records = MakeTwoHalves(scene, {.position_sigma_m = 0.1});
  for (size_t i = 0; i < records.size(); ++i) {
    if (records[i].flight == 0 || i % 4 == 0) continue;
    Pose& pose = *scene.photos[i].pose;
    pose.translation = -(pose.rotation * (pose.Center() + Eigen::Vector3d(3, 0, 0)));
    records[i].may_be_bays_off = true;
  }
  const RecordErrors errors = MeasureRecordErrors(records, scene);
  EXPECT_EQ(errors.flights[1].shift_m, Eigen::Vector3d::Zero());
  EXPECT_LT(errors.flights[1].sigma_horizontal_m, 0.15);
  ApplyRecords(records, errors, scene);
  EXPECT_EQ(scene.photos[95].may_be_bays_off, records[95].may_be_bays_off);
  for (PoseRecord& record : records) record.may_be_bays_off = false;
  EXPECT_GT(MeasureRecordErrors(records, scene).flights[1].shift_m.norm(), 1);
}

TEST(ApplyRecords, CorrectsWhatWasMeasured) {
  Scene scene = MakeFlight(96);
  const auto records =
      MakeRecords(scene, {.mount_rad = {0.03, 0, 0},
                          .yaw_rad = {0.3, 0},
                          .shift_m = {Eigen::Vector3d(0, 3, 0), Eigen::Vector3d(0, -3, 0)}});
  ApplyRecords(records, MeasureRecordErrors(records, scene), scene);
  for (const ScenePhoto& photo : scene.photos) {
    EXPECT_LT((photo.prior->position - photo.pose->Center()).norm(), 3);
    EXPECT_LT(photo.attitude->cam_from_world.angularDistance(photo.pose->rotation), 0.02);
    EXPECT_LT(photo.prior->sigma_horizontal_m, 1);
  }
}

TEST(MeasureRecordErrors, SaysNothingOfFewPhotos) {
  Scene scene = MakeFlight(96);
  const auto records = MakeRecords(scene, {});
  for (size_t i = 3; i < scene.photos.size(); ++i) scene.photos[i].pose.reset();
  const RecordErrors errors = MeasureRecordErrors(records, scene);
  EXPECT_EQ(errors.flights[0].num_photos, 3);
  EXPECT_EQ(errors.flights[0].sigma_horizontal_m, FlightErrors().sigma_horizontal_m);
}

TEST(ReadRecords, TellsFlightsByThePlanAndByPauses) {
  Scene scene = MakeFlight(5);
  Plan plan;
  plan.views.resize(2);
  plan.views[0].id = "h1v1";
  plan.views[0].flight = 0;
  plan.views[1].id = "h2v1";
  plan.views[1].flight = 1;
  std::vector<CapturedPhoto> photos(5);
  const std::vector<std::string> seconds = {"00", "10", "20", "30", "40"};
  for (int i = 0; i < 5; ++i) {
    photos[i].camera = 0;
    photos[i].capture_time = "2026:04:30 10:00:" + seconds[i];
  }
  photos[0].view = "h1v1";
  photos[2].view = "h2v1";
  photos[4].capture_time = "2026:04:30 12:00:00";
  std::vector<const CapturedPhoto*> captures;
  for (const CapturedPhoto& photo : photos) captures.push_back(&photo);
  std::vector<int> flights;
  for (const PoseRecord& record : ReadRecords(captures, &plan, scene)) {
    flights.push_back(record.flight);
  }
  EXPECT_EQ(flights, (std::vector{0, 0, 1, 1, 2}));
  plan.views[0].hover = plan.views[1].hover = 5;
  photos[1].view = "h1v1";
  const auto hovers = ReadRecords(captures, &plan, scene);
  EXPECT_GE(hovers[0].hover, 0);
  EXPECT_EQ(hovers[0].hover, hovers[1].hover);
  EXPECT_NE(hovers[0].hover, hovers[2].hover);  // another flight
  EXPECT_EQ(hovers[3].hover, -1);               // as no plan knows
  flights.clear();
  for (const PoseRecord& record : ReadRecords(captures, nullptr, scene)) {
    flights.push_back(record.flight);
  }
  EXPECT_EQ(flights, (std::vector{0, 0, 0, 0, 1}));
}

}  // namespace
}  // namespace stucco::test
