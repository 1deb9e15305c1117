// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/opensfm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "exchange/brown_lens.h"
#include "exchange/internal/json_file.h"
#include "exchange/opensfm_tracks.h"
#include "survey/error.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// Image coordinates count from the middle of the photo, over its longer side.
Eigen::Vector2d PixelOf(const Camera& camera, const Eigen::Vector2d& normalized) {
  return Eigen::Vector2d(camera.width_px / 2.0, camera.height_px / 2.0) +
         std::max(camera.width_px, camera.height_px) * normalized;
}

struct LensFields {
  const char* type;
  bool one_focal;
  std::vector<const char*> coefficients;
};

// The projection types that are lenses of ours.
const LensFields* FieldsOf(const std::string& type) {
  static const std::vector<LensFields> known = {{"perspective", true, {"k1", "k2"}},
                                                {"simple_radial", false, {"k1"}},
                                                {"radial", false, {"k1", "k2"}},
                                                {"brown", false, {"k1", "k2", "k3", "p1", "p2"}}};
  const auto found = std::find_if(known.begin(), known.end(),
                                  [&](const LensFields& each) { return type == each.type; });
  return found == known.end() ? nullptr : &*found;
}

Camera ReadCamera(const JsonPlace& json) {
  const std::string type = json.At("projection_type").Text();
  const LensFields* fields = FieldsOf(type);
  if (fields == nullptr) {
    json.At("projection_type")
        .Fail(fmt::format("\"{}\" is not supported", type),
              "run OpenSfM with camera_projection_type: BROWN, or take the poses of undistorted "
              "photos (opensfm undistort) and use those in the survey");
  }
  const ImageSize size = {json.At("width").Pixels(), json.At("height").Pixels()};
  const double longer = std::max(size.width_px, size.height_px);
  BrownLens lens;
  lens.fx = longer * json.At(fields->one_focal ? "focal" : "focal_x").Number();
  lens.fy = fields->one_focal ? lens.fx : longer * json.At("focal_y").Number();
  const double x = fields->one_focal ? 0 : json.At("c_x").Number();
  const double y = fields->one_focal ? 0 : json.At("c_y").Number();
  lens.cx = size.width_px / 2.0 + longer * x;
  lens.cy = size.height_px / 2.0 + longer * y;
  const std::map<std::string, double*> places = {
      {"k1", &lens.k1}, {"k2", &lens.k2}, {"k3", &lens.k3}, {"p1", &lens.p1}, {"p2", &lens.p2}};
  for (const char* name : fields->coefficients) *places.at(name) = json.At(name).Number();
  Camera camera = CameraWithLens(lens, size);
  if (const auto problem = FindProblem(camera)) json.Fail(*problem);
  return camera;
}

// The rotation is a vector: its direction the axis, its length the angle.
Pose ReadPose(const JsonPlace& shot) {
  const Eigen::Vector3d turn = shot.At("rotation").Vector();
  Pose pose;
  if (turn.norm() > 0) {
    pose.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  }
  pose.translation = shot.At("translation").Vector();
  return pose;
}

// The element with the most photos.
JsonPlace LargestOf(const JsonPlace& file, std::vector<std::string>& notes) {
  const std::vector<JsonPlace> all = file.Elements();
  const JsonPlace* largest = nullptr;
  size_t most = 0;
  for (const JsonPlace& each : all) {
    const size_t shots = each.At("shots").Members().size();
    if (shots <= most) continue;
    most = shots;
    largest = &each;
  }
  if (largest == nullptr) file.Fail("has no reconstruction with photos", "run OpenSfM again");
  if (all.size() > 1) {
    notes.push_back(fmt::format(
        "of its {} reconstructions the one with the most photos, {}, was taken", all.size(), most));
  }
  return *largest;
}

std::optional<Georef> ReadReference(const JsonPlace& json) {
  Georef georef;
  georef.frame = "enu";
  georef.metric = true;
  georef.up = Eigen::Vector3d::UnitZ();
  georef.source = "file";
  georef.origin_latitude_deg = json.At("latitude").Number();
  georef.origin_longitude_deg = json.At("longitude").Number();
  georef.origin_height_m = json.At("altitude").Number();
  // What it writes when no photo has a position.
  if (georef.origin_latitude_deg == 0 && georef.origin_longitude_deg == 0) return std::nullopt;
  if (!(std::abs(georef.origin_latitude_deg) <= 90)) {
    json.Fail("is no place on the earth", "run OpenSfM again");
  }
  return georef;
}

std::optional<Georef> FindReference(const JsonPlace& reconstruction, const fs::path& file) {
  if (reconstruction.Has("reference_lla")) {
    return ReadReference(reconstruction.At("reference_lla"));
  }
  const fs::path beside = file.parent_path() / "reference_lla.json";
  std::error_code error;
  if (!fs::is_regular_file(beside, error)) return std::nullopt;
  const JsonFile reference(beside);
  return ReadReference(reference.root());
}

using PhotoOfName = std::map<std::string, PhotoId, std::less<>>;

PhotoOfName ReadShots(const JsonPlace& reconstruction, const PhotoIndex& photos,
                      Reconstruction& model) {
  std::map<std::string, CameraId> cameras;
  const auto camera_of = [&](const JsonPlace& shot) {
    const std::string name = shot.At("camera").Text();
    const auto known = cameras.find(name);
    if (known != cameras.end()) return known->second;
    return cameras[name] = SharedCamera(ReadCamera(reconstruction.At("cameras").At(name)), model);
  };
  const auto shots = reconstruction.At("shots").Members();
  std::vector<std::string> names;
  names.reserve(shots.size());
  for (const auto& [name, shot] : shots) names.push_back(name);
  const std::vector<std::string> paths = photos.Require(names);
  PhotoOfName photo_of_name;
  for (size_t i = 0; i < shots.size(); ++i) {
    const JsonPlace& shot = shots[i].second;
    photo_of_name[names[i]] = AddPosedPhoto(camera_of(shot), paths[i], ReadPose(shot), model);
  }
  return photo_of_name;
}

uint8_t ReadColor(double value) {
  return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

// By name of the track, without pixels.
std::map<std::string, ExchangedPoint, std::less<>> ReadPoints(const JsonPlace& reconstruction) {
  std::map<std::string, ExchangedPoint, std::less<>> points;
  if (!reconstruction.Has("points")) return points;
  for (const auto& [name, json] : reconstruction.At("points").Members()) {
    ExchangedPoint& point = points[name];
    point.position = json.At("coordinates").Vector();
    if (!json.Has("color")) continue;
    const Eigen::Vector3d color = json.At("color").Vector();
    for (int i = 0; i < 3; ++i) point.rgb[i] = ReadColor(color[i]);
  }
  return points;
}

void AddPoints(const JsonPlace& reconstruction, const fs::path& tracks,
               const PhotoOfName& photo_of_name, ExchangedModel& result) {
  auto points = ReadPoints(reconstruction);
  std::error_code error;
  if (!fs::is_regular_file(tracks, error)) {
    if (!points.empty()) {
      result.notes.push_back(
          fmt::format("its {} points do not say which photos see them and are left out: {} is not "
                      "beside it",
                      points.size(), tracks.filename().string()));
    }
    return;
  }
  ReadOpenSfmTracks(tracks, [&](const TrackLine& line) {
    const auto point = points.find(line.track);
    const auto photo = photo_of_name.find(line.photo);
    if (point == points.end() || photo == photo_of_name.end()) return;
    const Camera& camera = result.model.cameras.at(result.model.photos.at(photo->second).camera);
    point->second.pixels.emplace_back(photo->second, PixelOf(camera, line.normalized));
  });
  for (const auto& [name, point] : points) AddSeenPoint(point, result.model);
}

}  // namespace

ExchangedModel ReadOpenSfm(const fs::path& file, const PhotoIndex& photos) {
  const JsonFile json(file);
  ExchangedModel result;
  result.format = "OpenSfM";
  const JsonPlace reconstruction = LargestOf(json.root(), result.notes);
  const PhotoOfName photo_of_name = ReadShots(reconstruction, photos, result.model);
  result.georef = FindReference(reconstruction, file);
  AddPoints(reconstruction, file.parent_path() / "tracks.csv", photo_of_name, result);
  return result;
}

}  // namespace stucco
