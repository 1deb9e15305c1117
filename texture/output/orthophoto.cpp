// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/orthophoto.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace stucco {
namespace {

using nlohmann::ordered_json;

constexpr int kVersion = 1;  // of the JSON file
constexpr double kLevelCosine = 0.9999;

// Zero without a sign.
double Plain(double value) {
  return value == 0 ? 0 : value;
}

ordered_json FromVector(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace

std::string WorldFile(const TexturedFacet& texture, const Facet& facet, const Proxy& proxy) {
  const double size = texture.metres_per_texel;
  const Eigen::Vector3d first = texture.origin + 0.5 * size * (texture.u_axis + texture.v_axis);
  const bool is_map = facet.normal.z() > kLevelCosine && proxy.up.z() > kLevelCosine;
  if (is_map) {
    return fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n", size * texture.u_axis.x(),
                       Plain(size * texture.u_axis.y()), Plain(size * texture.v_axis.x()),
                       size * texture.v_axis.y(), first.x(), first.y());
  }
  return fmt::format("{}\n0\n0\n{}\n{}\n{}\n", size, -size, 0.5 * size, -first.dot(texture.v_axis));
}

std::string OrthophotoJson(const TexturedFacet& texture, const Facet& facet, const Proxy& proxy,
                           const Georef& georef) {
  ordered_json frame = {{"name", georef.frame}, {"metric", georef.metric}};
  if (georef.frame == "enu") {
    frame["origin"] = {{"latitude_deg", georef.origin_latitude_deg},
                       {"longitude_deg", georef.origin_longitude_deg},
                       {"height_m", georef.origin_height_m}};
  }
  const ordered_json out = {
      {"version", kVersion},
      {"id", texture.id},
      {"facade", FacadeName(facet)},
      {"class", CityGmlName(facet.facet_class)},
      {"width_px", texture.width_px},
      {"height_px", texture.height_px},
      {"metres_per_pixel", texture.metres_per_texel},
      {"unit", proxy.metric ? "metre" : "world unit (the survey has no scale)"},
      {"origin", FromVector(texture.origin)},
      {"u_axis", FromVector(texture.u_axis)},
      {"v_axis", FromVector(texture.v_axis)},
      {"plane", {{"normal", FromVector(facet.normal)}, {"offset", facet.offset}}},
      {"pixel_centers",
       "origin + (column + 0.5) metres_per_pixel u_axis + (row + 0.5) "
       "metres_per_pixel v_axis"},
      {"frame", frame},
      {"photos", texture.photos},
      {"painted", texture.painted},
      {"inpainted", texture.inpainted}};
  return out.dump(1) + "\n";
}

}  // namespace stucco
