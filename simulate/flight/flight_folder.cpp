// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/flight_folder.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/reconstruction.h"

namespace stucco::simulate {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr char kHeldOut[] = "held_out/";

template <typename Vector>
Json ListOf(const Vector& vector) {
  Json list = Json::array();
  for (const auto value : vector) list.push_back(static_cast<double>(value));
  return list;
}

template <typename Vector>
void Take(const Json& list, Vector& vector) {
  if (!list.is_array() || list.size() != static_cast<size_t>(vector.size())) {
    throw Error(ErrorKind::kBadInput, fmt::format("must be a list of {} numbers", vector.size()));
  }
  for (Eigen::Index i = 0; i < vector.size(); ++i) {
    vector[i] = list[static_cast<size_t>(i)].get<typename Vector::Scalar>();
  }
}

Json ToJson(const Light& light) {
  return {{"lit", light.lit},
          {"to_sun", ListOf(light.to_sun)},
          {"sun", ListOf(light.sun)},
          {"sky", ListOf(light.sky)},
          {"haze_m", light.haze_m}};
}

Light LightFrom(const Json& json) {
  Light light;
  light.lit = json.at("lit").get<bool>();
  Take(json.at("to_sun"), light.to_sun);
  Take(json.at("sun"), light.sun);
  Take(json.at("sky"), light.sky);
  light.haze_m = json.at("haze_m").get<double>();
  return light;
}

Json ToJson(const Georef& georef) {
  return {{"origin_latitude_deg", georef.origin_latitude_deg},
          {"origin_longitude_deg", georef.origin_longitude_deg},
          {"origin_height_m", georef.origin_height_m}};
}

Georef GeorefFrom(const Json& json) {
  Georef georef;
  georef.frame = "enu";
  georef.origin_latitude_deg = json.at("origin_latitude_deg").get<double>();
  georef.origin_longitude_deg = json.at("origin_longitude_deg").get<double>();
  georef.origin_height_m = json.at("origin_height_m").get<double>();
  georef.up = Eigen::Vector3d::UnitZ();
  georef.metric = true;
  georef.source = "simulated";
  return georef;
}

Json ToJson(const Camera& camera) {
  return {{"id", camera.id.value},
          {"model", std::string(Name(camera.model))},
          {"width_px", camera.width_px},
          {"height_px", camera.height_px},
          {"params", camera.params}};
}

Camera CameraFrom(const Json& json) {
  Camera camera;
  camera.id = CameraId{json.at("id").get<uint32_t>()};
  const auto model = CameraModelFromName(json.at("model").get<std::string>());
  if (!model) throw Error(ErrorKind::kBadInput, "names an unknown camera model");
  camera.model = *model;
  camera.width_px = json.at("width_px").get<int>();
  camera.height_px = json.at("height_px").get<int>();
  camera.params = json.at("params").get<std::vector<double>>();
  if (const auto problem = FindProblem(camera)) throw Error(ErrorKind::kBadInput, *problem);
  return camera;
}

// Flights have one camera or a few; photos name them by position in the list.
int IndexOf(const Camera& camera, std::vector<Camera>& cameras) {
  for (size_t i = 0; i < cameras.size(); ++i) {
    if (cameras[i].id == camera.id) return static_cast<int>(i);
  }
  cameras.push_back(camera);
  return static_cast<int>(cameras.size()) - 1;
}

Json ToJson(const FlownPhoto& photo, std::vector<Camera>& cameras) {
  const Eigen::Quaterniond& q = photo.cam_from_world.rotation;
  Json json = {{"path", photo.path},
               {"view", photo.view},
               {"camera", IndexOf(photo.camera, cameras)},
               {"rotation", ListOf(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()))},
               {"translation", ListOf(photo.cam_from_world.translation)},
               {"light", ToJson(photo.light)},
               {"time_s", photo.time_s},
               {"exposure", photo.exposure},
               {"white_balance", ListOf(photo.white_balance)},
               {"held_out", photo.held_out},
               {"lost", photo.lost}};
  if (!photo.duplicate_of.empty()) json["duplicate_of"] = photo.duplicate_of;
  return json;
}

// Photos are removed by these paths: they must not lead out of the flight's own folders.
void RequireOwnPath(const FlownPhoto& photo) {
  std::string_view name = photo.path;
  const bool is_in_place = !photo.held_out || name.starts_with(kHeldOut);
  if (photo.held_out && is_in_place) name.remove_prefix(std::size(kHeldOut) - 1);
  const bool is_plain = !name.empty() && name != "." && name != ".." &&
                        name.find_first_of(std::string_view("/\\\0", 3)) == name.npos;
  if (is_in_place && is_plain) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("has a photo \"{}\" that is not in the folder for it", photo.path));
}

FlownPhoto PhotoFrom(const Json& json, const std::vector<Camera>& cameras) {
  FlownPhoto photo;
  photo.path = json.at("path").get<std::string>();
  photo.view = json.at("view").get<std::string>();
  photo.camera = cameras.at(json.at("camera").get<size_t>());
  Eigen::Vector4d q;
  Take(json.at("rotation"), q);
  // As written: normalising would change the last digit.
  photo.cam_from_world.rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  if (!(std::abs(q.norm() - 1) < 1e-6)) throw Error(ErrorKind::kBadInput, "has no unit rotation");
  Take(json.at("translation"), photo.cam_from_world.translation);
  photo.light = LightFrom(json.at("light"));
  photo.time_s = json.at("time_s").get<double>();
  photo.exposure = json.at("exposure").get<double>();
  Take(json.at("white_balance"), photo.white_balance);
  photo.held_out = json.at("held_out").get<bool>();
  photo.lost = json.at("lost").get<bool>();
  RequireOwnPath(photo);
  photo.duplicate_of = json.value("duplicate_of", std::string());
  return photo;
}

Json ToJson(const PictureFaults& faults) {
  return {{"motion_blur_px", faults.motion_blur_px},
          {"focus_blur_px", faults.focus_blur_px},
          {"noise", faults.noise},
          {"sharpening", faults.sharpening},
          {"jpeg_quality", faults.jpeg_quality}};
}

PictureFaults FaultsFrom(const Json& json) {
  PictureFaults faults;
  faults.motion_blur_px = json.at("motion_blur_px").get<double>();
  faults.focus_blur_px = json.at("focus_blur_px").get<double>();
  faults.noise = json.at("noise").get<double>();
  faults.sharpening = json.at("sharpening").get<double>();
  faults.jpeg_quality = json.at("jpeg_quality").get<int>();
  return faults;
}

Flight FlightFrom(const Json& json) {
  if (json.at("version").get<int>() != kVersion) {
    throw Error(ErrorKind::kBadInput, fmt::format("is not of version {}", kVersion));
  }
  Flight flight;
  flight.scene = json.at("scene").get<std::string>();
  flight.scene_hash = json.value("scene_hash", std::string());
  flight.seed = json.at("seed").get<uint64_t>();
  flight.made_from = json.at("made_from").get<std::string>();
  flight.georef = GeorefFrom(json.at("georef"));
  if (json.contains("faults")) flight.faults = FaultsFrom(json.at("faults"));
  std::vector<Camera> cameras;
  for (const Json& camera : json.at("cameras")) cameras.push_back(CameraFrom(camera));
  for (const Json& photo : json.at("photos")) flight.photos.push_back(PhotoFrom(photo, cameras));
  return flight;
}

Reconstruction ModelOf(const Flight& flight) {
  Reconstruction model;
  uint32_t next = 1;
  for (const FlownPhoto& photo : flight.photos) {
    if (photo.held_out || photo.lost) continue;
    model.cameras.emplace(photo.camera.id, photo.camera);
    const PhotoId id{next++};
    model.photos[id] = RegisteredImage{id, photo.camera.id, photo.path, photo.cam_from_world, {}};
  }
  return model;
}

}  // namespace

Flight ReadFlight(const std::filesystem::path& survey) {
  const std::filesystem::path path = survey / kFlightFile;
  const std::string text = ReadFile(path);
  std::string reason;
  try {
    return FlightFrom(Json::parse(text));
  } catch (const Error& error) {
    reason = error.what();
  } catch (const std::exception& error) {  // of the JSON library, or a camera out of range
    reason = error.what();
  }
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", path.string(), reason),
              "simulate into a new survey");
}

void WriteFlight(const Flight& flight, const std::filesystem::path& survey) {
  std::vector<Camera> cameras;
  Json photos = Json::array();
  for (const FlownPhoto& photo : flight.photos) photos.push_back(ToJson(photo, cameras));
  Json json = {{"version", kVersion},
               {"scene", flight.scene},
               {"scene_hash", flight.scene_hash},
               {"seed", flight.seed},
               {"made_from", flight.made_from},
               {"georef", ToJson(flight.georef)},
               {"faults", ToJson(flight.faults)}};
  json["cameras"] = Json::array();
  for (const Camera& camera : cameras) json["cameras"].push_back(ToJson(camera));
  json["photos"] = std::move(photos);
  const auto handler = Json::error_handler_t::replace;  // paths need not be UTF-8
  // First: by this file the next call knows that the others are its own.
  WriteFileAtomically(survey / kFlightFile, json.dump(1, ' ', false, handler) + "\n");
  WriteColmapText(ModelOf(flight), survey / kTruthFolder / "sparse");
}

}  // namespace stucco::simulate
