// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "survey/colmap_io.h"
#include "survey/files.h"
#include "tests/survey/support.h"

namespace stucco {
namespace {

using test::ExpectBadInput;
using test::MakeReconstruction;
using test::TemporaryFolder;

void ExpectSame(const Reconstruction& a, const Reconstruction& b) {
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (const auto& [id, camera] : a.cameras) {
    const Camera& other = b.cameras.at(id);
    EXPECT_EQ(camera.model, other.model);
    EXPECT_EQ(camera.width_px, other.width_px);
    EXPECT_EQ(camera.height_px, other.height_px);
    EXPECT_EQ(camera.params, other.params);
  }
  ASSERT_EQ(a.photos.size(), b.photos.size());
  for (const auto& [id, photo] : a.photos) {
    const RegisteredImage& other = b.photos.at(id);
    EXPECT_EQ(photo.name, other.name);
    EXPECT_EQ(photo.camera, other.camera);
    EXPECT_EQ(photo.cam_from_world.rotation.coeffs(), other.cam_from_world.rotation.coeffs());
    EXPECT_EQ(photo.cam_from_world.translation, other.cam_from_world.translation);
    ASSERT_EQ(photo.observations.size(), other.observations.size());
    for (size_t i = 0; i < photo.observations.size(); ++i) {
      EXPECT_EQ(photo.observations[i].pixel, other.observations[i].pixel);
      EXPECT_EQ(photo.observations[i].point, other.observations[i].point);
    }
  }
  ASSERT_EQ(a.points.size(), b.points.size());
  for (const auto& [id, point] : a.points) {
    const TrackPoint& other = b.points.at(id);
    EXPECT_EQ(point.position, other.position);
    EXPECT_EQ(point.rgb, other.rgb);
    EXPECT_EQ(point.error_px, other.error_px);
    EXPECT_EQ(point.track, other.track);
  }
}

TEST(Colmap, TextReadsBackExactly) {
  const TemporaryFolder folder;
  const Reconstruction written = MakeReconstruction();
  WriteColmapText(written, folder / "new/model");
  ExpectSame(ReadColmapModel(folder / "new/model"), written);
}

TEST(Colmap, BinaryReadsBackExactly) {
  const TemporaryFolder folder;
  const Reconstruction written = MakeReconstruction();
  WriteColmapBinary(written, folder / "new/model");
  ExpectSame(ReadColmapModel(folder / "new/model"), written);
}

TEST(Colmap, EmptyModelReadsBack) {
  const TemporaryFolder folder;
  WriteColmapText({}, folder / "text");
  WriteColmapBinary({}, folder / "binary");
  EXPECT_TRUE(ReadColmapModel(folder / "text").photos.empty());
  EXPECT_TRUE(ReadColmapModel(folder / "binary").photos.empty());
}

TEST(Colmap, PrefersBinary) {
  const TemporaryFolder folder;
  WriteColmapText({}, folder.path());
  WriteColmapBinary(MakeReconstruction(), folder.path());
  EXPECT_EQ(ReadColmapModel(folder.path()).photos.size(), 3u);
  std::filesystem::remove(folder / "points3D.bin");
  EXPECT_EQ(ReadColmapModel(folder.path()).photos.size(), 0u);
}

TEST(Colmap, BinaryHasTheDocumentedBytes) {
  const TemporaryFolder folder;
  Reconstruction r;
  r.cameras[CameraId{3}] = {CameraId{3}, CameraModel::kSimplePinhole, 4, 2, {1, 2, 0.5}};
  WriteColmapBinary(r, folder.path());
  const std::string expected(
      "\1\0\0\0\0\0\0\0"  // cameras
      "\3\0\0\0"
      "\0\0\0\0"  // id, model
      "\4\0\0\0\0\0\0\0"
      "\2\0\0\0\0\0\0\0"  // width, height
      "\0\0\0\0\0\0\xf0\x3f"
      "\0\0\0\0\0\0\0\x40"
      "\0\0\0\0\0\0\xe0\x3f",  // 1, 2, 0.5
      56);
  EXPECT_EQ(ReadFile(folder / "cameras.bin"), expected);
}

// A model as COLMAP writes it: comments, a photo without observations, "-1" for no point.
constexpr char kCameras[] = "# Camera list\n1 OPENCV 640 480 500 501 320 240 -0.1 0.01 0 0\r\n";
constexpr char kImages[] =
    "# Image list\n#   POINTS2D[] as (X, Y, POINT3D_ID)\n"
    "1 2 0 0 0 0.5 -1e-3 3 1 a b.jpg\n"
    "10.5 20.25 63 1 2 -1\n"
    "2 1 0 0 0 0 0 0 1 c.jpg\n"
    "\n"
    "4 1 0 0 0 0 0 0 1 d.jpg\n"
    "7 8 63\n";
constexpr char kPoints[] = "# 3D point list\n63 1.5 -2 3 255 0 7 -1 1 0 4 0\n\n";

void WriteText(const TemporaryFolder& folder, const std::string& cameras, const std::string& images,
               const std::string& points) {
  WriteFile(folder / "cameras.txt", cameras);
  WriteFile(folder / "images.txt", images);
  WriteFile(folder / "points3D.txt", points);
}

TEST(Colmap, ReadsForeignText) {
  const TemporaryFolder folder;
  WriteText(folder, kCameras, kImages, kPoints);
  const Reconstruction r = ReadColmapModel(folder.path());
  ASSERT_EQ(r.photos.size(), 3u);
  const RegisteredImage& photo = r.photos.at(PhotoId{1});
  EXPECT_EQ(photo.name, "a b.jpg");
  EXPECT_EQ(photo.cam_from_world.rotation.w(), 1);  // 2 0 0 0 means the same rotation
  EXPECT_EQ(photo.cam_from_world.translation, Eigen::Vector3d(0.5, -1e-3, 3));
  ASSERT_EQ(photo.observations.size(), 2u);
  EXPECT_EQ(photo.observations[0].point.value, 63u);
  EXPECT_FALSE(photo.observations[1].point.IsValid());
  EXPECT_TRUE(r.photos.at(PhotoId{2}).observations.empty());
  EXPECT_EQ(r.points.at(PointId{63}).rgb, (std::array<uint8_t, 3>{255, 0, 7}));
  EXPECT_EQ(r.cameras.at(CameraId{1}).params[7], 0);
}

TEST(Colmap, NamesFileLineAndReasonOfBadText) {
  const auto expect = [](const std::string& cameras, const std::string& images,
                         const std::string& points, const std::string& part) {
    const TemporaryFolder folder;
    WriteText(folder, cameras, images, points);
    ExpectBadInput([&] { ReadColmapModel(folder.path()); }, part);
  };
  const std::string cameras = kCameras, images = kImages, points = kPoints;
  expect("1 OPENCV_FISHEYE 6 4 5 5 3 2 0 0 0 0\n", images, points,
         "cameras.txt:1: camera model OPENCV_FISHEYE is not supported");
  expect("1 PINHOLE 640 480 500 320 240\n", images, points,
         "cameras.txt:1: camera 1: PINHOLE has 4 parameters, not 3");
  expect("1 PINHOLE 640 4x0 500 500 320 240\n", images, points, "height \"4x0\" is not a number");
  expect("1 PINHOLE 640\n", images, points, "height is missing");
  expect("-1 PINHOLE 640 480 500 500 320 240\n", images, points, "camera id \"-1\"");
  expect(cameras + cameras, images, points, "cameras.txt:4: camera id 1 is invalid or there twice");
  expect(cameras, "1 0 0 0 0 1 2 3 1 a.jpg\n\n", "", "images.txt:1: the rotation is not valid");
  expect(cameras, "1 nan 0 0 0 1 2 3 1 a.jpg\n\n", "", "images.txt:1: the rotation is not valid");
  expect(cameras, "1 1 0 0 0 1 2 3 1\n\n", "", "images.txt:1: image 1 has no name");
  expect(cameras, "1 1 0 0 0 1 2 3 1 a.jpg\n5 6\n", "", "images.txt:2: point id is missing");
  expect(cameras, "1 1 0 0 0 1 2 3 1 a.jpg\n5 6 -2\n", "", "point id \"-2\" is not a number");
  expect(cameras, "1 1 0 0 0 1 2 3 9 a.jpg\n\n", "", "uses camera 9, which is missing");
  expect(cameras, images, "", "is of point 63, which is missing");
  expect(cameras, images, "63 1 2 3 256 0 7 -1 1 0 4 0\n", "points3D.txt:1: colour \"256\"");
  expect(cameras, images, "63 1 2 3 25 0 7 -1 1 0 4\n", "points3D.txt:1: observation is missing");
  expect(cameras, images, "63 1 2 3 25 0 7 -1 1 0 4 9\n", "is observation 9 of photo 4");
}

TEST(Colmap, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  ExpectBadInput([&] { ReadColmapModel(folder.path()); }, "no COLMAP model");
  WriteText(folder, kCameras, kImages, kPoints);
  std::filesystem::remove(folder / "images.txt");
  ExpectBadInput([&] { ReadColmapModel(folder.path()); }, "images.txt are missing");
}

TEST(Colmap, RefusesNamesThatTextCannotHold) {
  const TemporaryFolder folder;
  for (const char* name : {"a\nb.jpg", " a.jpg", ""}) {
    Reconstruction r = MakeReconstruction();
    r.photos.at(PhotoId{1}).name = name;
    if (*name == '\0') {
      WriteColmapText(r, folder.path());
      ExpectBadInput([&] { ReadColmapModel(folder.path()); }, "has no name");
    } else {
      ExpectBadInput([&] { WriteColmapText(r, folder.path()); }, "cannot be written");
    }
  }
}

// One camera, two photos and one point: few enough bytes to try each.
Reconstruction MakeTinyReconstruction() {
  Reconstruction r = MakeReconstruction();
  r.cameras.erase(CameraId{7});
  r.photos.erase(PhotoId{3});
  r.points = {{PointId{10}, r.points.at(PointId{10})}};
  r.points.at(PointId{10}).track.resize(2);
  for (auto& [id, photo] : r.photos) photo.observations.resize(1);
  return r;
}

TEST(Colmap, RefusesBinaryCutAtAnyByte) {
  const TemporaryFolder folder;
  WriteColmapBinary(MakeTinyReconstruction(), folder.path());
  for (const char* name : {"cameras.bin", "images.bin", "points3D.bin"}) {
    const std::string bytes = ReadFile(folder / name);
    ASSERT_LT(bytes.size(), 300u);
    for (size_t size = 0; size < bytes.size(); ++size) {
      WriteFile(folder / name, bytes.substr(0, size));
      EXPECT_FALSE(test::Accepts([&] { ReadColmapModel(folder.path()); })) << name << " " << size;
    }
    WriteFile(folder / name, bytes + '\0');
    ExpectBadInput([&] { ReadColmapModel(folder.path()); }, "1 bytes too many");
    WriteFile(folder / name, bytes);
  }
  EXPECT_NO_THROW(ReadColmapModel(folder.path()));
}

TEST(Colmap, SurvivesAnyByteBeingWrong) {
  const TemporaryFolder folder;
  WriteColmapBinary(MakeTinyReconstruction(), folder.path());
  int refused = 0;
  for (const char* name : {"cameras.bin", "images.bin", "points3D.bin"}) {
    const std::string bytes = ReadFile(folder / name);
    for (size_t at = 0; at < bytes.size(); ++at) {
      std::string wrong = bytes;
      wrong[at] = static_cast<char>(~wrong[at]);
      WriteFile(folder / name, wrong);
      // Wrong digits of a number go unseen; ids and counts do not, and no count may take the
      // memory.
      if (!test::Accepts([&] { ReadColmapModel(folder.path()); })) ++refused;
    }
    WriteFile(folder / name, bytes);
  }
  EXPECT_GT(refused, 100);
}

TEST(Colmap, RefusesForeignModelsInBinary) {
  const TemporaryFolder folder;
  WriteColmapBinary(MakeReconstruction(), folder.path());
  std::string bytes = ReadFile(folder / "cameras.bin");
  bytes[12] = 5;  // OPENCV_FISHEYE
  WriteFile(folder / "cameras.bin", bytes);
  ExpectBadInput([&] { ReadColmapModel(folder.path()); }, "camera model number 5 is not supported");
}

}  // namespace
}  // namespace stucco
