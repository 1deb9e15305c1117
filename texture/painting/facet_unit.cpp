// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/painting/facet_unit.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "survey/error.h"
#include "survey/files.h"
#include "texture/relief/find_relief.h"
#include "texture/views/look.h"
#include "texture/views/plan_prior.h"

namespace stucco {
namespace {

using nlohmann::json;

// Raise when the meaning of a unit or the method behind it changes.
constexpr char kVersion[] = "13";

json FromVector(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Eigen::Vector3d ToVector(const json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

std::string ToBytes(const json& j) {
  std::string bytes;
  json::to_cbor(j, bytes);
  return bytes;
}

json FromBytes(const std::string& bytes) {
  try {
    return json::from_cbor(bytes);
  } catch (const json::exception& problem) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("a checkpoint of the texture stage is damaged: {}", problem.what()),
                "run the stage again with --force");
  }
}

json FromBinary(const std::string& bytes) {
  return json::binary(std::vector<uint8_t>(bytes.begin(), bytes.end()));
}

std::string ToBinary(const json& j) {
  const auto& bytes = j.get_binary();
  return std::string(bytes.begin(), bytes.end());
}

std::string EncodePng(const cv::Mat& picture) {
  std::vector<uint8_t> bytes;
  cv::imencode(".png", picture, bytes, {cv::IMWRITE_PNG_COMPRESSION, 4});
  return std::string(bytes.begin(), bytes.end());
}

std::string EncodeTexture(const PaintedFacet& painted) {
  const cv::Mat rgb(painted.picture.height_px, painted.picture.width_px, CV_8UC3,
                    const_cast<uint8_t*>(painted.picture.data.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  return EncodePng(bgr);
}

std::string EncodeLabels(const PaintedFacet& painted) {
  return EncodePng(cv::Mat(painted.picture.height_px, painted.picture.width_px, CV_8U,
                           const_cast<uint8_t*>(painted.labels.data())));
}

// Transparent where there is nothing.
std::string EncodeOrthophoto(const PaintedFacet& painted) {
  cv::Mat bgra(painted.picture.height_px, painted.picture.width_px, CV_8UC4);
  for (int y = 0; y < bgra.rows; ++y) {
    for (int x = 0; x < bgra.cols; ++x) {
      const uint8_t* rgb = painted.picture.Pixel(x, y);
      const bool there = painted.labels[static_cast<size_t>(y) * bgra.cols + x] != 0;
      bgra.at<cv::Vec4b>(y, x) =
          there ? cv::Vec4b(rgb[2], rgb[1], rgb[0], 255) : cv::Vec4b(0, 0, 0, 0);
    }
  }
  return EncodePng(bgra);
}

json FacetAsJson(const TexturedFacet& facet) {
  return {{"id", facet.id},
          {"size", {facet.width_px, facet.height_px}},
          {"metres_per_texel", {facet.metres_per_texel, facet.wanted_metres_per_texel}},
          {"origin", FromVector(facet.origin)},
          {"u_axis", FromVector(facet.u_axis)},
          {"v_axis", FromVector(facet.v_axis)},
          {"photos", facet.photos},
          {"planned_photos", facet.planned_photos},
          {"shares", {facet.painted, facet.inpainted}},
          {"misregistration_px", facet.misregistration_px},
          {"gsd_m", facet.gsd_m},
          {"sharpness", facet.sharpness},
          {"q", {facet.q_s, facet.q_d, facet.q_u, facet.q_c}},
          {"gains", facet.gains}};
}

TexturedFacet FacetFromJson(const json& j) {
  TexturedFacet facet;
  facet.id = j.at("id");
  facet.width_px = j.at("size").at(0);
  facet.height_px = j.at("size").at(1);
  facet.metres_per_texel = j.at("metres_per_texel").at(0);
  facet.wanted_metres_per_texel = j.at("metres_per_texel").at(1);
  facet.origin = ToVector(j.at("origin"));
  facet.u_axis = ToVector(j.at("u_axis"));
  facet.v_axis = ToVector(j.at("v_axis"));
  facet.photos = j.at("photos").get<std::vector<std::string>>();
  facet.planned_photos = j.at("planned_photos").get<std::vector<std::string>>();
  facet.painted = j.at("shares").at(0);
  facet.inpainted = j.at("shares").at(1);
  facet.misregistration_px = j.at("misregistration_px");
  facet.gsd_m = j.at("gsd_m");
  facet.sharpness = j.at("sharpness");
  facet.q_s = j.at("q").at(0);
  facet.q_d = j.at("q").at(1);
  facet.q_u = j.at("q").at(2);
  facet.q_c = j.at("q").at(3);
  facet.gains = j.at("gains").get<std::map<std::string, double>>();
  return facet;
}

// Options that change pictures; the others must not cost a repaint.
std::string OptionsText(TextureOptions options) {
  const TextureOptions defaults;
  options.ground = defaults.ground;
  options.guided = defaults.guided;  // the keys say which photos are planned
  options.debug = defaults.debug;
  options.glb_max_px = defaults.glb_max_px;
  options.glb_megapixels = defaults.glb_megapixels;
  options.glb_atlas_px = defaults.glb_atlas_px;
  options.glb_quality = defaults.glb_quality;
  options.glb_relief = defaults.glb_relief;
  OptionTable table("texture");
  Describe(table, options);
  return CanonicalText(table);
}

std::string PhotoText(const SurveyPhoto& photo) {
  std::string text =
      fmt::format("{} {} {} {}x{} {}", photo.path(), photo.captured.hash, Name(photo.camera.model),
                  photo.camera.width_px, photo.camera.height_px, photo.relative_sharpness);
  for (double value : photo.camera.params) text += fmt::format(" {}", value);
  const Eigen::Quaterniond& q = photo.cam_from_world.rotation;
  const Eigen::Vector3d& t = photo.cam_from_world.translation;
  return text +
         fmt::format(" {} {} {} {} {} {} {}", q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z());
}

}  // namespace

std::string PackLook(const FacetLook& look) {
  json candidates = json::array();
  for (const Candidate& c : look.candidates) candidates.push_back({c.photo, c.seen, c.merit});
  json ratios = json::array();
  for (const ColourRatio& r : look.ratios) {
    ratios.push_back({r.a, r.b, r.weight, FromVector(r.log_ratio), r.corner_a[0], r.corner_a[1],
                      r.corner_b[0], r.corner_b[1]});
  }
  const json limits = {look.limits.max_angle_deg, look.limits.tolerance, look.limits.clearance};
  return ToBytes(
      {{"candidates", candidates}, {"texel", look.texel}, {"ratios", ratios}, {"limits", limits}});
}

FacetLook UnpackLook(const std::string& bytes) {
  const json j = FromBytes(bytes);
  FacetLook look;
  try {
    look.texel = j.at("texel");
    for (const json& c : j.at("candidates")) {
      look.candidates.push_back({c.at(0), c.at(1), c.at(2)});
    }
    const json& limits = j.at("limits");
    look.limits = {limits.at(0), limits.at(1), limits.at(2)};
    for (const json& r : j.at("ratios")) {
      look.ratios.push_back({r.at(0),
                             r.at(1),
                             ToVector(r.at(3)),
                             r.at(2),
                             {r.at(4).get<double>(), r.at(5).get<double>()},
                             {r.at(6).get<double>(), r.at(7).get<double>()}});
    }
  } catch (const json::exception& problem) {
    throw Error(ErrorKind::kBadInput, fmt::format("not a facet's first look: {}", problem.what()));
  }
  return look;
}

FacetFiles MakeFacetFiles(const Facet& facet, const PaintedFacet& painted,
                          std::span<const SurveyPhoto> photos,
                          std::span<const Eigen::Vector3d> gains, bool orthophoto) {
  FacetFiles files;
  TexturedFacet& textured = files.facet;
  textured.id = facet.id;
  if (painted.photos.empty()) return files;
  textured.width_px = painted.grid.width;
  textured.height_px = painted.grid.height;
  textured.metres_per_texel = painted.grid.texel;
  textured.wanted_metres_per_texel = painted.wanted_texel;
  textured.origin = painted.grid.origin;
  textured.u_axis = painted.grid.u_axis;
  textured.v_axis = painted.grid.v_axis;
  textured.painted = painted.painted;
  textured.inpainted = painted.inpainted;
  textured.misregistration_px = painted.misregistration_px;
  textured.gsd_m = painted.quality.footprint;
  textured.sharpness = painted.sharpness;
  textured.q_s = painted.quality.q_s;
  textured.q_d = painted.quality.q_d;
  textured.q_u = painted.quality.q_u;
  textured.q_c = painted.quality.q_c;
  for (int photo : painted.photos) {
    textured.photos.push_back(photos[photo].path());
    if (IsPlannedFor(facet, photos[photo])) textured.planned_photos.push_back(photos[photo].path());
    textured.gains[photos[photo].path()] = gains[photo].mean();
  }
  files.misregistration_before_px = painted.misregistration_before_px;
  files.texture_png = EncodeTexture(painted);
  files.label_png = EncodeLabels(painted);
  if (painted.grid.relief) files.relief = EncodeRelief(*painted.grid.relief);
  if (orthophoto) files.orthophoto_png = EncodeOrthophoto(painted);
  return files;
}

std::string PackFiles(const FacetFiles& files) {
  return ToBytes({{"facet", FacetAsJson(files.facet)},
                  {"misregistration_before_px", files.misregistration_before_px},
                  {"texture", FromBinary(files.texture_png)},
                  {"labels", FromBinary(files.label_png)},
                  {"orthophoto", FromBinary(files.orthophoto_png)},
                  {"relief", FromBinary(files.relief.png)},
                  {"relief_json", files.relief.json}});
}

FacetFiles UnpackFiles(const std::string& bytes) {
  const json j = FromBytes(bytes);
  FacetFiles files;
  try {
    files.facet = FacetFromJson(j.at("facet"));
    files.misregistration_before_px = j.at("misregistration_before_px");
    files.texture_png = ToBinary(j.at("texture"));
    files.label_png = ToBinary(j.at("labels"));
    files.orthophoto_png = ToBinary(j.at("orthophoto"));
    files.relief = {ToBinary(j.at("relief")), j.at("relief_json")};
  } catch (const json::exception& problem) {
    throw Error(ErrorKind::kBadInput, fmt::format("not a painted facet: {}", problem.what()));
  }
  return files;
}

std::string LookKey(const Facet& facet, const TextureInput& input, const TextureOptions& options) {
  std::vector<std::string> parts = {kVersion, facet.id, input.geometry_hash, OptionsText(options)};
  for (const SurveyPhoto& photo : input.photos) {
    parts.push_back(PhotoText(photo) + (IsPlannedFor(facet, photo) ? " planned" : ""));
  }
  return HashParts(parts);
}

std::string FilesKey(const Facet& facet, const FacetLook& look, const TextureInput& input,
                     const PhotosLight& light, const TextureOptions& options) {
  std::vector<std::string> parts = {
      kVersion, facet.id, input.geometry_hash, OptionsText(options),
      fmt::format("{} {} {}", look.texel, look.limits.tolerance, look.limits.clearance)};
  for (const Candidate& candidate : look.candidates) {
    const Eigen::Vector3d& gain = light.gains[candidate.photo];
    const Eigen::Vector2d& falloff = light.falloffs[candidate.photo].terms;
    const SurveyPhoto& photo = input.photos[candidate.photo];
    parts.push_back(PhotoText(photo) + (IsPlannedFor(facet, photo) ? " planned" : ""));
    parts.push_back(
        fmt::format("{} {} {} {} {}", gain.x(), gain.y(), gain.z(), falloff[0], falloff[1]));
  }
  if (LooksForRelief(facet, look, options, input.proxy.metric)) {
    for (const int i : PhotosThatMaySee(facet, input.photos, look.limits.max_angle_deg)) {
      const Eigen::Vector2d& falloff = light.falloffs[i].terms;
      parts.push_back(fmt::format("{} {} {}", PhotoText(input.photos[i]), falloff[0], falloff[1]));
    }
  }
  return HashParts(parts);
}

}  // namespace stucco
