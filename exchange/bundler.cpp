// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/bundler.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "exchange/brown_lens.h"
#include "exchange/rotation.h"
#include "exchange/word_reader.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/image.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

struct BundlerCamera {
  double focal_px = 0;  // 0: has no pose
  double k1 = 0, k2 = 0;
  Pose cam_from_world;
};

// Bundler's camera frame is ours turned by half a circle about x.
BundlerCamera ReadCamera(WordReader& words) {
  BundlerCamera camera;
  camera.focal_px = words.Next<double>("focal length");
  camera.k1 = words.Next<double>("k1");
  camera.k2 = words.Next<double>("k2");
  const std::string where = words.Where();
  Eigen::Matrix3d rotation;
  for (int row = 0; row < 3; ++row) rotation.row(row) = words.NextVector("rotation").transpose();
  const Eigen::Vector3d translation = words.NextVector("translation");
  if (camera.focal_px == 0) return camera;
  if (!(camera.focal_px > 0)) words.Fail("the focal length is not positive");
  const Eigen::DiagonalMatrix<double, 3> ours_from_bundler(1, -1, -1);
  camera.cam_from_world.rotation = RotationOfMatrix(ours_from_bundler * rotation, where);
  camera.cam_from_world.translation = ours_from_bundler * translation;
  return camera;
}

// "name", or "name 0 focal" as Bundler's own scripts write it; names may hold blanks.
std::string NameOfEntry(std::string_view line) {
  std::string_view name = Trim(line);
  const size_t last = name.find_last_of(" \t");
  if (last == std::string_view::npos || !ParseNumber<double>(name.substr(last + 1))) {
    return std::string(name);
  }
  const std::string_view before = Trim(name.substr(0, last));
  if (before.size() > 2 && before.ends_with('0') && IsBlank(before[before.size() - 2])) {
    name = Trim(before.substr(0, before.size() - 1));
  }
  return std::string(name);
}

fs::path ListBeside(const fs::path& file) {
  const fs::path folder = file.parent_path();
  fs::path stem = file;
  for (const fs::path& list :
       {fs::path(file) += ".list.txt", stem.replace_extension() += ".list.txt", folder / "list.txt",
        folder / ".." / "list.txt"}) {
    std::error_code error;
    if (fs::is_regular_file(list, error)) return list;
  }
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("{}: the list of its photos is not there: neither {} nor {}", file.string(),
                  (folder / "list.txt").string(), file.string() + ".list.txt"),
      "put the list that was written with it beside it: one photo a line, in the order of its "
      "cameras");
}

std::vector<std::string> ReadList(const fs::path& path) {
  const std::string text = ReadFile(path);
  std::string_view rest = text;
  std::vector<std::string> names;
  while (const auto line = TakeLine(rest)) {
    if (!Trim(*line).empty()) names.push_back(NameOfEntry(*line));
  }
  return names;
}

// Of the picture that the list names, where it is still there, else of the survey's photo.
ImageSize SizeOfPicture(const fs::path& list, const std::string& name, const std::string& photo,
                        const PhotoIndex& photos) {
  const fs::path beside = list.parent_path() / name;
  std::error_code error;
  return fs::is_regular_file(beside, error) ? ReadJpegSize(beside) : photos.SizeOf(photo);
}

using PhotoOfCamera = std::map<size_t, PhotoId>;  // by the place of the camera in the file

PhotoOfCamera AddCameras(const std::vector<BundlerCamera>& cameras, const fs::path& list,
                         const PhotoIndex& photos, Reconstruction& model) {
  const std::vector<std::string> names = ReadList(list);
  if (names.size() != cameras.size()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: lists {} photos, and the model has {} cameras", list.string(),
                            names.size(), cameras.size()),
                "use the list that was written together with the model");
  }
  std::vector<std::string> posed;
  for (size_t i = 0; i < cameras.size(); ++i) {
    if (cameras[i].focal_px > 0) posed.push_back(names[i]);
  }
  const std::vector<std::string> paths = photos.Require(posed);
  PhotoOfCamera photo_of_camera;
  for (size_t i = 0; i < cameras.size(); ++i) {
    const BundlerCamera& camera = cameras[i];
    if (camera.focal_px == 0) continue;
    const std::string& path = paths[photo_of_camera.size()];
    const ImageSize size = SizeOfPicture(list, names[i], path, photos);
    const BrownLens lens = {.fx = camera.focal_px,
                            .fy = camera.focal_px,
                            .cx = size.width_px / 2.0,
                            .cy = size.height_px / 2.0,
                            .k1 = camera.k1,
                            .k2 = camera.k2};
    photo_of_camera[i] = AddPosedPhoto(SharedCamera(CameraWithLens(lens, size), model), path,
                                       camera.cam_from_world, model);
  }
  return photo_of_camera;
}

uint8_t ReadColor(WordReader& words) {
  return static_cast<uint8_t>(std::clamp(words.Next<double>("colour"), 0.0, 255.0));
}

void ReadPoint(size_t cameras, const PhotoOfCamera& photo_of_camera, WordReader& words,
               Reconstruction& model) {
  ExchangedPoint point;
  point.position = words.NextVector("position of a point");
  for (uint8_t& byte : point.rgb) byte = ReadColor(words);
  const auto views = words.Next<uint32_t>("number of views");
  for (uint32_t i = 0; i < views; ++i) {
    const auto camera = words.Next<uint32_t>("camera of a view");
    words.Next<int64_t>("key of a view");
    const auto x = words.Next<double>("x of a view");
    const auto y = words.Next<double>("y of a view");
    if (camera >= cameras) words.Fail(fmt::format("there is no camera {}", camera));
    const auto photo = photo_of_camera.find(camera);
    if (photo == photo_of_camera.end()) continue;
    const Camera& lens = model.cameras.at(model.photos.at(photo->second).camera);
    point.pixels.emplace_back(photo->second,
                              Eigen::Vector2d(lens.width_px / 2.0 + x, lens.height_px / 2.0 - y));
  }
  AddSeenPoint(point, model);
}

// The largest share of the way from the middle of a picture to its edge that a point has.
double Reach(const Reconstruction& model) {
  double reach = 0;
  for (const auto& [id, photo] : model.photos) {
    const Camera& camera = model.cameras.at(photo.camera);
    const Eigen::Array2d half(camera.width_px / 2.0, camera.height_px / 2.0);
    for (const Observation& observation : photo.observations) {
      reach = std::max(reach, ((observation.pixel.array() - half) / half).abs().maxCoeff());
    }
  }
  return reach;
}

// Focal lengths are in pixels of pictures whose size the file does not say; points betray it.
void RequireItsPictures(const fs::path& file, const Reconstruction& model) {
  constexpr size_t kManyPoints = 100;
  constexpr double kLeastReach = 0.6, kLargestReach = 1.01;
  const double reach = Reach(model);
  const bool is_reduced = model.points.size() >= kManyPoints && reach < kLeastReach;
  if (!is_reduced && reach <= kLargestReach) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: its points reach {:.0f} % of the way from the middle of the photos "
                          "to their edges; it was made from {} pictures",
                          file.string(), 100 * reach, is_reduced ? "smaller" : "larger"),
              "put the pictures that it was made from where its list says, so that their size is "
              "known");
}

}  // namespace

ExchangedModel ReadBundler(const fs::path& file, const PhotoIndex& photos) {
  WordReader words(file);
  const std::string version(Trim(words.Line()));
  if (!version.starts_with("# Bundle file v0.3")) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: begins with \"{}\", not with \"# Bundle file v0.3\"",
                            file.string(), version.substr(0, 40)),
                "export the model as Bundler v0.3");
  }
  ExchangedModel result;
  result.format = "Bundler v0.3";
  const auto camera_count = words.Next<uint32_t>("number of cameras");
  const auto point_count = words.Next<uint32_t>("number of points");
  std::vector<BundlerCamera> cameras;
  for (uint32_t i = 0; i < camera_count; ++i) cameras.push_back(ReadCamera(words));
  const PhotoOfCamera photo_of_camera = AddCameras(cameras, ListBeside(file), photos, result.model);
  for (uint32_t i = 0; i < point_count; ++i) {
    ReadPoint(cameras.size(), photo_of_camera, words, result.model);
  }
  RequireItsPictures(file, result.model);
  const size_t left_out = cameras.size() - photo_of_camera.size();
  if (left_out > 0) {
    result.notes.push_back(fmt::format("{} photos of its list have no pose in it", left_out));
  }
  return result;
}

}  // namespace stucco
