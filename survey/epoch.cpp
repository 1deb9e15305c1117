// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/epoch.h"

#include <array>
#include <utility>

#include "survey/internal/json.h"

namespace stucco {
namespace {

using internal::Json;

constexpr std::array<std::pair<ReplaceMode, std::string_view>, 3> kModes = {{
    {ReplaceMode::kAuto, "auto"},
    {ReplaceMode::kAlways, "always"},
    {ReplaceMode::kNever, "never"},
}};

constexpr std::array<std::pair<FacetChoice, std::string_view>, 4> kChoices = {{
    {FacetChoice::kKept, "kept"},
    {FacetChoice::kReplaced, "replaced"},
    {FacetChoice::kFilled, "filled"},
    {FacetChoice::kPainted, "painted"},
}};

// Null where a figure is not known, which is stated as a value that it cannot have.
Json Known(bool known, double value) {
  return known ? Json(value) : Json();
}

Json ToJson(const EpochPhoto& photo) {
  Json json = {{"path", photo.path},
               {"hash", photo.hash},
               {"placed", photo.is_placed()},
               {"why", photo.why},
               {"matched_photos", photo.matched_photos},
               {"points", photo.points},
               {"inliers", photo.inliers},
               {"position_sigma", Known(photo.position_sigma >= 0, photo.position_sigma)},
               {"picture_sigma_px", Known(photo.picture_sigma_px >= 0, photo.picture_sigma_px)},
               {"pose", nullptr},
               {"camera", nullptr}};
  if (!photo.is_placed()) return json;
  const Eigen::Quaterniond& q = photo.cam_from_world->rotation;
  const Eigen::Vector3d& t = photo.cam_from_world->translation;
  json["pose"] = {{"rotation", {q.w(), q.x(), q.y(), q.z()}},
                  {"translation", {t.x(), t.y(), t.z()}}};
  json["camera"] = {{"model", Name(photo.camera.model)},
                    {"width_px", photo.camera.width_px},
                    {"height_px", photo.camera.height_px},
                    {"params", photo.camera.params}};
  return json;
}

Json ToJson(const EpochPlace& place) {
  return {{"what", place.what},       {"along_m", place.along_m}, {"up_m", place.up_m},
          {"area_m2", place.area_m2}, {"before", place.before},   {"after", place.after}};
}

Json PlacesOf(const EpochFacet& facet) {
  Json places = Json::array();
  for (const EpochPlace& place : facet.places) places.push_back(ToJson(place));
  return places;
}

Json ToJson(const EpochFacet& facet) {
  return {{"id", facet.id},
          {"choice", Name(facet.choice)},
          {"why", facet.why},
          {"shown", facet.shown},
          {"taken", facet.taken},
          {"both", facet.both},
          {"compared", facet.compared},
          {"changed",
           {{"repainted", Known(facet.both > 0, facet.repainted)},
            {"other", Known(facet.compared > 0, facet.other)},
            {"shaded", Known(facet.compared > 0, facet.shaded)}}},
          {"places", PlacesOf(facet)},
          {"gsd_before_m", Known(facet.gsd_before_m > 0, facet.gsd_before_m)},
          {"gsd_after_m", Known(facet.gsd_after_m > 0, facet.gsd_after_m)},
          {"shift_px", Known(facet.shift_px >= 0, facet.shift_px)}};
}

}  // namespace

std::string_view Name(ReplaceMode mode) {
  for (const auto& [known, name] : kModes) {
    if (known == mode) return name;
  }
  return "";
}

std::optional<ReplaceMode> ReplaceModeFromName(std::string_view name) {
  for (const auto& [mode, known] : kModes) {
    if (known == name) return mode;
  }
  return std::nullopt;
}

std::string_view Name(FacetChoice choice) {
  for (const auto& [known, name] : kChoices) {
    if (known == choice) return name;
  }
  return "";
}

void WriteEpoch(const Epoch& epoch, const std::filesystem::path& path) {
  Json json = {{"version", internal::kJsonVersion}, {"name", epoch.name},
               {"replace", Name(epoch.replace)},    {"photo_folder", epoch.photo_folder},
               {"photos", Json::array()},           {"facets", Json::array()}};
  for (const EpochPhoto& photo : epoch.photos) json["photos"].push_back(ToJson(photo));
  for (const EpochFacet& facet : epoch.facets) json["facets"].push_back(ToJson(facet));
  internal::SaveJson(json, path);
}

Epoch ReadEpochRequest(const std::filesystem::path& path) {
  const Json json = internal::LoadJson(path);
  const std::string file = path.string();
  const internal::JsonReader reader(json, file, "");
  Epoch epoch;
  std::string mode;
  reader.Required("name", epoch.name);
  reader.Required("replace", mode);
  const auto replace = ReplaceModeFromName(mode);
  if (!replace) reader.Fail("replace", R"(must be "auto", "always" or "never")");
  epoch.replace = *replace;
  reader.Required("photo_folder", epoch.photo_folder);
  return epoch;
}

}  // namespace stucco
