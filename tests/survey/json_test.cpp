// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "survey/calibration.h"
#include "survey/captures.h"
#include "survey/files.h"
#include "survey/texture_set.h"
#include "tests/survey/support.h"

namespace stucco {
namespace {

using test::ErrorOf;
using test::ExpectBadInput;
using test::TemporaryFolder;

Captures MakeCaptures() {
  Captures captures;
  CapturedCamera camera;
  camera.key = "DJI|FC6360|1600x1300|5.7";
  camera.label = "DJI FC6360, 1600 x 1300, 5.7 mm";
  camera.intrinsics = {CameraId{1}, CameraModel::kRadial, 1600, 1300, {1.0 / 3, 800, 650, -0.1, 0}};
  camera.focal_source = "exif_35mm";
  camera.fixed = true;
  captures.cameras.push_back(camera);
  CapturedPhoto photo;
  photo.path = "a/Fassade Süd.JPG";
  photo.hash = "0123";
  photo.usable = true;
  photo.width_px = 1600;
  photo.height_px = 1300;
  photo.camera = 0;
  photo.capture_time = "2025:03:01 12:00:00";
  photo.exposure_s = 0.00125;
  photo.position = GeoPosition{47.1, 8.2, 430.3, true, 0.014, 0.025, true};
  photo.gimbal = GimbalAngles{-170.5, -45.25, 0.5};
  photo.view = "f012v03";
  photo.sharpness = 123.456;
  captures.photos.push_back(photo);
  CapturedPhoto broken;
  broken.path = "b.JPG";
  broken.why = "same as a";
  broken.duplicate_of = "a.JPG";
  captures.photos.push_back(broken);
  return captures;
}

TEST(CaptureTime, CountsSeconds) {
  CapturedPhoto photo;
  EXPECT_EQ(CaptureTime_s(photo), std::nullopt);
  photo.capture_time = "2025:03:01 12:00:00";
  const double noon_s = CaptureTime_s(photo).value_or(0);
  photo.capture_time = "2025:03:02 12:01:30";
  EXPECT_EQ(CaptureTime_s(photo), noon_s + 86400 + 90);
  photo.capture_time = "yesterday";
  EXPECT_EQ(CaptureTime_s(photo), std::nullopt);
}

TEST(Captures, ReadBackAsWritten) {
  const TemporaryFolder folder;
  WriteCaptures(MakeCaptures(), folder / "captures.json");
  const Captures read = ReadCaptures(folder / "captures.json");
  ASSERT_EQ(read.cameras.size(), 1u);
  EXPECT_EQ(read.cameras[0].key, "DJI|FC6360|1600x1300|5.7");
  EXPECT_EQ(read.cameras[0].label, "DJI FC6360, 1600 x 1300, 5.7 mm");
  EXPECT_EQ(read.cameras[0].intrinsics.id, CameraId{1});
  EXPECT_EQ(read.cameras[0].intrinsics.model, CameraModel::kRadial);
  EXPECT_EQ(read.cameras[0].intrinsics.width_px, 1600);
  EXPECT_EQ(read.cameras[0].intrinsics.height_px, 1300);
  EXPECT_EQ(read.cameras[0].intrinsics.params, (std::vector<double>{1.0 / 3, 800, 650, -0.1, 0}));
  EXPECT_EQ(read.cameras[0].focal_source, "exif_35mm");
  EXPECT_TRUE(read.cameras[0].fixed);
  ASSERT_EQ(read.photos.size(), 2u);
  const CapturedPhoto& photo = read.photos[0];
  EXPECT_EQ(photo.path, "a/Fassade Süd.JPG");
  EXPECT_EQ(photo.hash, "0123");
  EXPECT_TRUE(photo.usable);
  EXPECT_EQ(photo.width_px, 1600);
  EXPECT_EQ(photo.height_px, 1300);
  EXPECT_EQ(photo.camera, 0);
  EXPECT_EQ(photo.capture_time, "2025:03:01 12:00:00");
  EXPECT_EQ(photo.exposure_s, 0.00125);
  EXPECT_EQ(read.photos[1].exposure_s, std::nullopt);
  ASSERT_TRUE(photo.position);
  EXPECT_EQ(photo.position->latitude_deg, 47.1);
  EXPECT_EQ(photo.position->longitude_deg, 8.2);
  EXPECT_EQ(photo.position->height_m, 430.3);
  EXPECT_TRUE(photo.position->has_height);
  EXPECT_EQ(photo.position->sigma_horizontal_m, 0.014);
  EXPECT_EQ(photo.position->sigma_vertical_m, 0.025);
  EXPECT_TRUE(photo.position->rtk_fixed);
  ASSERT_TRUE(photo.gimbal);
  EXPECT_EQ(photo.gimbal->yaw_deg, -170.5);
  EXPECT_EQ(photo.gimbal->pitch_deg, -45.25);
  EXPECT_EQ(photo.gimbal->roll_deg, 0.5);
  EXPECT_EQ(photo.view, "f012v03");
  EXPECT_EQ(photo.sharpness, 123.456);
  EXPECT_FALSE(read.photos[1].usable);
  EXPECT_FALSE(read.photos[1].position);
  EXPECT_FALSE(read.photos[1].gimbal);
  EXPECT_EQ(read.photos[1].camera, -1);
  EXPECT_EQ(read.photos[1].why, "same as a");
  EXPECT_EQ(read.photos[1].duplicate_of, "a.JPG");
}

TEST(Captures, UseTheFixedNames) {
  const TemporaryFolder folder;
  WriteCaptures(MakeCaptures(), folder / "captures.json");
  const std::string text = ReadFile(folder / "captures.json");
  for (const char* part :
       {"\"version\": 1", "\"views\": []", "\"photos\": [", "\"path\": \"b.JPG\"",
        "\"view\": \"f012v03\"", "\"usable\": false", "\"why\": \"same as a\""}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

TEST(Captures, RefuseNonsense) {
  const TemporaryFolder folder;
  const std::string photo = R"({"path": "a.jpg", "usable": false})";
  const auto expect = [&](const std::string& text, const std::string& part) {
    WriteFile(folder / "c.json", text);
    ExpectBadInput([&] { ReadCaptures(folder / "c.json"); }, part);
  };
  const auto with_photo = [](const std::string& fields) {
    return R"({"version": 1, "cameras": [], "photos": [{)" + fields + "}]}";
  };
  expect("", "c.json: is not valid JSON");
  expect("{\"version\": 1,\n\"cameras\": oops", "is not valid JSON: parse error at line 2, column");
  expect("[]", "c.json: must be an object");
  expect("{}", "\"version\" is missing");
  expect(R"({"version": 2, "cameras": [], "photos": []})", "\"version\" is 2");
  expect(R"({"version": 1, "photos": []})", "\"cameras\" is missing");
  expect(R"({"version": 1, "cameras": {}, "photos": []})", "\"cameras\" must be a list");
  expect(with_photo(R"("usable": true)"), "\"photos[0].path\" is missing");
  expect(with_photo(R"("path": 3, "usable": true)"), "\"photos[0].path\" must be a text");
  expect(with_photo(R"("path": "a", "usable": 1)"), "\"photos[0].usable\" must be true or false");
  expect(with_photo(R"("path": "a", "usable": false, "camera": 1.5)"), "must be a whole number");
  expect(with_photo(R"("path": "a", "usable": false, "camera": 4294967296)"), "is out of range");
  expect(with_photo(R"("path": "a", "usable": false, "camera": 18446744073709551615)"),
         "is out of range");
  expect(with_photo(R"("path": "a", "usable": false, "sharpness": null)"), "must be a number");
  expect(with_photo(R"("path": "a", "usable": false, "sharpness": 1e999)"), "is not valid JSON");
  expect(with_photo(R"("path": "a", "usable": false, "position": {"latitude_deg": 1})"),
         "\"photos[0].position.longitude_deg\" is missing");
  expect(with_photo(R"("path": "a", "usable": true)"), "photo a has camera -1, but there are 0");
  expect(with_photo(R"("path": "a", "usable": true, "camera": 0)"), "photo a has camera 0");
  expect(with_photo(R"("path": "a", "usable": false, "camera": -2)"), "photo a has camera -2");
  expect(R"({"version": 1, "photos": [], "cameras": [{"key": "k", "intrinsics": {"id": 1, "model":
      "FISHEYE", "width_px": 1, "height_px": 1, "params": []}}]})",
         "\"cameras[0].intrinsics.model\" is \"FISHEYE\"");
  expect(R"({"version": 1, "photos": [], "cameras": [{"key": "k", "intrinsics": {"id": 1, "model":
      "PINHOLE", "width_px": 1, "height_px": 1, "params": [1, 2]}}]})",
         "PINHOLE has 4 parameters, not 2");
  expect(R"({"version": 1, "photos": [], "cameras": [{"key": "k", "intrinsics": {"id": -1, "model":
      "PINHOLE", "width_px": 1, "height_px": 1, "params": [1, 1, 1, 1]}}]})",
         "\"cameras[0].intrinsics.id\" is out of range");
  expect(std::string(100000, '['), "is not valid JSON");
  ExpectBadInput([&] { ReadCaptures(folder / "none.json"); }, "none.json: cannot be read");
}

TEST(Captures, RefuseToWriteWhatJsonCannotHold) {
  const TemporaryFolder folder;
  Captures captures = MakeCaptures();
  captures.photos[0].sharpness = std::nan("");
  const Error nan = ErrorOf([&] { WriteCaptures(captures, folder / "c.json"); });
  EXPECT_EQ(nan.kind(), ErrorKind::kStageFailed);
  EXPECT_NE(std::string(nan.what()).find("\"sharpness\" would be nan"), std::string::npos);
  captures = MakeCaptures();
  captures.photos[0].path =
      "S\xfc"
      "d.jpg";  // Latin-1
  ExpectBadInput([&] { WriteCaptures(captures, folder / "c.json"); }, "invalid UTF-8");
  EXPECT_FALSE(std::filesystem::exists(folder / "c.json"));
}

TEST(Captures, TakeUnknownFieldsAndNull) {
  const TemporaryFolder folder;
  WriteFile(folder / "c.json", R"({"version": 1, "cameras": [], "new": [1], "views": [{"id": "v"}],
      "photos": [{"path": "a", "usable": false, "position": null, "gimbal": null, "x": 1}]})");
  const Captures captures = ReadCaptures(folder / "c.json");
  ASSERT_EQ(captures.photos.size(), 1u);
  EXPECT_FALSE(captures.photos[0].position);
  ASSERT_EQ(captures.views.size(), 1u);
  EXPECT_EQ(captures.views[0].status, "missing");
}

TEST(Captures, KeepWhatBecameOfPlannedViews) {
  const TemporaryFolder folder;
  Captures written;
  written.views = {{"h0001v1", "captured", "a.jpg"}, {"h0001v2", "missing", ""}};
  WriteCaptures(written, folder / "c.json");
  const Captures read = ReadCaptures(folder / "c.json");
  ASSERT_EQ(read.views.size(), 2u);
  EXPECT_EQ(read.views[0].photo, "a.jpg");
  EXPECT_EQ(read.views[1].status, "missing");
}

TEST(Calibration, ReadsBackAsWritten) {
  const TemporaryFolder folder;
  Calibration written;
  written.photos_total = 12;
  written.photos_posed = 11;
  written.reprojection_error_px = 0.4375;
  written.points = 4321;
  written.mean_track_length = 3.75;
  written.prior_rms_horizontal_m = 1.25;
  written.prior_rms_vertical_m = 2.5;
  written.photos.push_back({"a.jpg", 0.5, 321, 1.5, true, 0.91});
  written.unposed.push_back({"b.jpg", "too few matches"});
  written.cameras.push_back({1, "DJI", "PINHOLE", {"fx"}, {1000.5}, {0.25}, {"cx"}});
  written.findings = {"6 photos were taken from one point"};
  WriteCalibration(written, folder / "calibration.json");
  const Calibration read = ReadCalibration(folder / "calibration.json");
  EXPECT_EQ(read.photos_total, 12);
  EXPECT_EQ(read.photos_posed, 11);
  EXPECT_EQ(read.reprojection_error_px, 0.4375);
  EXPECT_EQ(read.points, 4321);
  EXPECT_EQ(read.mean_track_length, 3.75);
  EXPECT_EQ(read.prior_rms_horizontal_m, 1.25);
  EXPECT_EQ(read.prior_rms_vertical_m, 2.5);
  ASSERT_EQ(read.photos.size(), 1u);
  EXPECT_EQ(read.photos[0].path, "a.jpg");
  EXPECT_EQ(read.photos[0].reprojection_error_px, 0.5);
  EXPECT_EQ(read.photos[0].observations, 321);
  EXPECT_EQ(read.photos[0].prior_residual_m, 1.5);
  EXPECT_TRUE(read.photos[0].prior_outlier);
  EXPECT_EQ(read.photos[0].coverage, 0.91);
  ASSERT_EQ(read.unposed.size(), 1u);
  EXPECT_EQ(read.unposed[0].path, "b.jpg");
  EXPECT_EQ(read.unposed[0].why, "too few matches");
  ASSERT_EQ(read.cameras.size(), 1u);
  EXPECT_EQ(read.cameras[0].id, 1);
  EXPECT_EQ(read.cameras[0].label, "DJI");
  EXPECT_EQ(read.cameras[0].model, "PINHOLE");
  EXPECT_EQ(read.cameras[0].names, std::vector<std::string>{"fx"});
  EXPECT_EQ(read.cameras[0].params, std::vector<double>{1000.5});
  EXPECT_EQ(read.cameras[0].sigma, std::vector<double>{0.25});
  EXPECT_EQ(read.cameras[0].held, std::vector<std::string>{"cx"});
  EXPECT_EQ(read.findings, written.findings);
}

TEST(Calibration, KeepsHowSurelyPhotosArePlaced) {
  const TemporaryFolder folder;
  Calibration written;
  for (const PhotoState state :
       {PhotoState::kTied, PhotoState::kWeak, PhotoState::kAmbiguous, PhotoState::kRecordOnly}) {
    CalibratedPhoto& photo = written.photos.emplace_back();
    photo.path = Name(state);
    photo.state = state;
  }
  CalibratedPhoto& last = written.photos.back();
  last.why = "it overlaps with no other photo";
  last.part = -1;
  last.picture_sigma_px = 1.25;
  last.center = {1, 2, 3};
  last.rotation = {1, 0, 0, 0};
  written.parts.push_back({"sparse/1", 20, 3000, "records", 0.25, 0.125, 0.5, "far away"});
  WriteCalibration(written, folder / "calibration.json");
  const Calibration read = ReadCalibration(folder / "calibration.json");
  ASSERT_EQ(read.photos.size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(read.photos[i].state, written.photos[i].state);
    EXPECT_EQ(IsInModel(read.photos[i].state), i < 2);
    EXPECT_EQ(read.photos[i].part, i < 3 ? 0 : -1);
  }
  EXPECT_EQ(read.photos[3].why, last.why);
  EXPECT_EQ(read.photos[3].picture_sigma_px, 1.25);
  EXPECT_EQ(read.photos[3].center, last.center);
  EXPECT_EQ(read.photos[3].rotation, last.rotation);
  ASSERT_EQ(read.parts.size(), 1u);
  EXPECT_EQ(read.parts[0].model, "sparse/1");
  EXPECT_EQ(read.parts[0].photos, 20);
  EXPECT_EQ(read.parts[0].points, 3000);
  EXPECT_EQ(read.parts[0].placed_by, "records");
  EXPECT_EQ(read.parts[0].position_sigma_m, 0.25);
  EXPECT_EQ(read.parts[0].rotation_sigma_deg, 0.125);
  EXPECT_EQ(read.parts[0].shared_surface, 0.5);
  EXPECT_EQ(read.parts[0].why, "far away");
  std::string wrong = ReadFile(folder / "calibration.json");
  EXPECT_NE(wrong.find("\"record-only\""), std::string::npos);
  wrong.replace(wrong.find("\"state\": \"weak\""), 15, "\"state\": \"fine\"");
  WriteFile(folder / "calibration.json", wrong);
  ExpectBadInput([&] { ReadCalibration(folder / "calibration.json"); },
                 "\"photos[1].state\" is \"fine\", which is no known state");
}

TEST(Calibration, UsesTheFixedNames) {
  const TemporaryFolder folder;
  WriteCalibration({}, folder / "calibration.json");
  const std::string text = ReadFile(folder / "calibration.json");
  for (const char* part :
       {"\"version\": 1", "\"photos_total\": 0", "\"photos_posed\": 0", "\"points\": 0",
        "\"reprojection_error_px\": 0.0", "\"mean_track_length\": 0.0", "\"unposed\": []",
        "\"prior_rms_m\": {\n    \"horizontal\": -1.0,\n    \"vertical\": -1.0\n  }"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
  std::string wrong = text;
  wrong.replace(wrong.find("\"horizontal\""), 12, "\"elsewhere\"");
  WriteFile(folder / "calibration.json", wrong);
  ExpectBadInput([&] { ReadCalibration(folder / "calibration.json"); },
                 "\"prior_rms_m.horizontal\" is missing");
}

TEST(CalibrationDeathTest, RequiresListsThatFitEachOther) {
  const TemporaryFolder folder;
  Calibration calibration;
  calibration.cameras.push_back({1, "DJI", "PINHOLE", {"fx", "fy"}, {1000.5}, {}, {}});
  EXPECT_DEATH(WriteCalibration(calibration, folder / "calibration.json"), "FitsTogether");
}

TexturedFacet MakeTexturedFacet() {
  TexturedFacet facet;
  facet.id = "B0001/W03";
  facet.image = "textures/B0001_W03.png";
  facet.label_image = "labels/B0001_W03.png";
  facet.orthophoto = "orthophotos/B0001_W03.png";
  facet.width_px = 640;
  facet.height_px = 480;
  facet.metres_per_texel = 0.0125;
  facet.origin = {1, 2, 3};
  facet.u_axis = {0, 1, 0};
  facet.v_axis = {0, 0, -1};
  facet.photos = {"a.jpg", "b.jpg"};
  facet.painted = 0.875;
  facet.inpainted = 0.125;
  facet.misregistration_px = 0.75;
  facet.gsd_m = 0.015;
  facet.sharpness = 99.5;
  facet.q_s = 0.1;
  facet.q_d = 0.2;
  facet.q_u = 0.3;
  facet.q_c = 0.4;
  facet.gains = {{"a.jpg", 1.1}, {"b.jpg", 0.9}};
  return facet;
}

TEST(TextureSet, ReadsBackAsWritten) {
  const TemporaryFolder folder;
  const TexturedFacet expected = MakeTexturedFacet();
  WriteTextureSet({{expected}, "model.glb", "model.obj"}, folder / "textures.json");
  const TextureSet read = ReadTextureSet(folder / "textures.json");
  EXPECT_EQ(read.model_glb, "model.glb");
  EXPECT_EQ(read.model_obj, "model.obj");
  ASSERT_EQ(read.facets.size(), 1u);
  const TexturedFacet& facet = read.facets[0];
  EXPECT_EQ(facet.id, expected.id);
  EXPECT_EQ(facet.image, expected.image);
  EXPECT_EQ(facet.label_image, expected.label_image);
  EXPECT_EQ(facet.orthophoto, expected.orthophoto);
  EXPECT_EQ(facet.width_px, 640);
  EXPECT_EQ(facet.height_px, 480);
  EXPECT_EQ(facet.metres_per_texel, 0.0125);
  EXPECT_EQ(facet.origin, expected.origin);
  EXPECT_EQ(facet.u_axis, expected.u_axis);
  EXPECT_EQ(facet.v_axis, expected.v_axis);
  EXPECT_EQ(facet.photos, expected.photos);
  EXPECT_EQ(facet.painted, 0.875);
  EXPECT_EQ(facet.inpainted, 0.125);
  EXPECT_EQ(facet.misregistration_px, 0.75);
  EXPECT_EQ(facet.gsd_m, 0.015);
  EXPECT_EQ(facet.sharpness, 99.5);
  EXPECT_EQ(facet.q_s, 0.1);
  EXPECT_EQ(facet.q_d, 0.2);
  EXPECT_EQ(facet.q_u, 0.3);
  EXPECT_EQ(facet.q_c, 0.4);
  EXPECT_EQ(facet.gains, expected.gains);
}

TEST(TextureSet, UsesTheFixedNamesAndRefusesNonsense) {
  const TemporaryFolder folder;
  TexturedFacet facet = MakeTexturedFacet();
  WriteTextureSet({{facet}, "", ""}, folder / "textures.json");
  const std::string text = ReadFile(folder / "textures.json");
  for (const char* part : {"\"facets\": [", "\"id\": \"B0001/W03\"", "\"image\": ",
                           "\"metres_per_texel\": 0.0125", "\"photos\": [", "\"painted\": 0.875",
                           "\"inpainted\": 0.125", "\"misregistration_px\": 0.75"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  facet.width_px = -1;
  WriteTextureSet({{facet}, "", ""}, folder / "textures.json");
  ExpectBadInput([&] { ReadTextureSet(folder / "textures.json"); },
                 "B0001/W03 has a negative size");
}

TEST(TextureSetDeathTest, RequiresFacetsWithIds) {
  const TemporaryFolder folder;
  EXPECT_DEATH(WriteTextureSet({{TexturedFacet()}, "", ""}, folder / "textures.json"), "id.empty");
}

}  // namespace
}  // namespace stucco
