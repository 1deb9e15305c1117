// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "evaluate/evaluate.h"
#include "evaluate/page/evaluation_page.h"
#include "survey/error.h"
#include "survey/escape.h"
#include "survey/files.h"

namespace stucco::evaluate {
namespace {

using Json = nlohmann::ordered_json;  // keeps the order in which fields were written

constexpr int kVersion = 1;
constexpr char kEvaluationFile[] = "evaluation.json";
constexpr char kFacadesFile[] = "facades.csv";

// JSON has no word for what was not measured but null.
Json Number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

// The measures of a picture; `suffix` is "_mean" where they are means over several.
void AddPicture(const PictureFigures& figures, const std::string& suffix, Json& json) {
  json["ssim" + suffix] = Number(figures.ssim);
  json["ms_ssim" + suffix] = Number(figures.ms_ssim);
  json["psnr" + suffix] = Number(figures.psnr);
  json["gmsd" + suffix] = Number(figures.gmsd);
  json["flip" + suffix] = Number(figures.flip);
  json["lpips" + suffix] = Number(figures.lpips);
}

Json PictureJson(const PictureFigures& figures) {
  Json json = Json::object();
  AddPicture(figures, "", json);
  return json;
}

void AddSurface(const SurfaceFigures& figures, const std::string& prefix, Json& json) {
  json[prefix + "error95_m"] = Number(figures.error95_m);
  json[prefix + "seen95_m"] = Number(figures.seen95_m);
  json[prefix + "completeness"] = Number(figures.completeness);
  json[prefix + "completeness_of_three"] = Number(figures.completeness_of_three);
  json[prefix + "completeness_all"] = Number(figures.completeness_all);
}

Json PosesJson(const PoseFigures& poses) {
  return {{"posed", poses.posed},
          {"total", poses.total},
          {"position_mean_m", Number(poses.position_mean_m)},
          {"position_max_m", Number(poses.position_max_m)},
          {"rotation_mean_deg", Number(poses.rotation_mean_deg)},
          {"rotation_max_deg", Number(poses.rotation_max_deg)},
          {"georeferenced_mean_m", Number(poses.georeferenced_mean_m)},
          {"georeferenced_max_m", Number(poses.georeferenced_max_m)},
          {"georeferenced_rotation_mean_deg", Number(poses.georeferenced_rotation_mean_deg)},
          {"georeferenced_rotation_max_deg", Number(poses.georeferenced_rotation_max_deg)}};
}

void AddParts(const PartFigures& figures, Json& json) {
  AddSurface(figures.all, "", json);
  AddSurface(figures.building, "building_", json);
  AddSurface(figures.wall, "wall_", json);
  AddSurface(figures.roof, "roof_", json);
  AddSurface(figures.ground, "ground_", json);
}

Json PartsJson(const PartFigures& figures) {
  Json json = Json::object();
  AddParts(figures, json);
  return json;
}

Json ProxyJson(const ProxyFigures& proxy) {
  Json json = {{"buildings", proxy.buildings},
               {"truth_buildings", proxy.truth_buildings},
               {"watertight", proxy.watertight},
               {"manifold", proxy.manifold},
               {"self_intersecting", proxy.self_intersecting},
               {"facets", proxy.facets},
               {"superstructure_facets", proxy.superstructure_facets},
               {"truth_facets", proxy.truth_facets}};
  AddParts(proxy.surface, json);
  json["facade_id_rate"] = Number(proxy.facade_id_rate);
  return json;
}

Json LikenessJson(const Likeness& figures) {
  return {{"ssim", Number(figures.ssim)},
          {"psnr", Number(figures.psnr)},
          {"shift_m", Number(figures.shift_m)}};
}

Json PartJson(const LikenessOfPart& part) {
  Json json = {{"share", Number(part.share)}};
  json.update(LikenessJson(part.result));
  json["ceiling"] = LikenessJson(part.ceiling);
  return json;
}

Json FacadeJson(const FacadeFigures& facade) {
  Json json = {{"id", facade.id},
               {"facet", facade.facet},
               {"area_m2", facade.area_m2},
               {"painted", facade.painted}};
  AddPicture(facade.picture, "", json);
  json["texel_m"] = Number(facade.texel_m);
  json["misregistration_px"] = Number(facade.misregistration_px);
  json["ideal_distance_m"] = Number(facade.ideal_distance_m);
  json["ceiling"] = LikenessJson(facade.ceiling);
  json["plane"] = PartJson(facade.plane);
  json["relief"] = PartJson(facade.relief);
  json["occluded"] = Number(facade.occluded.Share());
  json["truth_picture"] = facade.truth_picture;
  json["result_picture"] = facade.result_picture;
  json["error_picture"] = facade.error_picture;
  return json;
}

Json TextureJson(const Evaluation& evaluation) {
  Json json = {{"painted", Number(evaluation.painted)}};
  AddPicture(evaluation.texture_mean, "_mean", json);
  json["misregistration_px"] = Number(evaluation.misregistration_px);
  json["misregistration_m"] = Number(evaluation.misregistration_m);
  json["ceiling"] = LikenessJson(evaluation.ceiling_mean);
  json["plane"] = PartJson(evaluation.plane_mean);
  json["relief"] = PartJson(evaluation.relief_mean);
  json["occluded"] = Number(evaluation.occluded.Share());
  json["facades"] = Json::array();
  for (const FacadeFigures& facade : evaluation.facades) {
    json["facades"].push_back(FacadeJson(facade));
  }
  return json;
}

Json ViewsJson(const Evaluation& evaluation) {
  Json json = {{"compared", Number(evaluation.views_compared)}};
  AddPicture(evaluation.views_mean, "_mean", json);
  json["buildings"] = PictureJson(evaluation.views_buildings_mean);
  json["photos"] = Json::array();
  for (const HeldOutFigures& view : evaluation.views) {
    Json photo = {{"photo", view.photo}, {"compared", Number(view.compared)}};
    AddPicture(view.picture, "", photo);
    photo["buildings"] = PictureJson(view.buildings);
    photo["truth_picture"] = view.truth_picture;
    photo["result_picture"] = view.result_picture;
    photo["error_picture"] = view.error_picture;
    json["photos"].push_back(photo);
  }
  return json;
}

Json PlanJson(const PlanFigures& plan) {
  return {{"method", plan.method},
          {"photos", plan.photos},
          {"hovers", plan.hovers},
          {"length_m", Number(plan.length_m)},
          {"time_min", Number(plan.time_min)},
          {"battery_percent", Number(plan.battery_percent)},
          {"q_s", Number(plan.q_s)},
          {"q_d", Number(plan.q_d)},
          {"q_u", Number(plan.q_u)},
          {"q_c", Number(plan.q_c)}};
}

std::string Cell(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : "";
}

std::string FacadesCsv(const Evaluation& evaluation) {
  std::string csv =
      "id,facet,area_m2,painted,ssim,ms_ssim,psnr,gmsd,flip,lpips,texel_m,misregistration_px,"
      "ceiling_ssim,plane_share,plane_ssim,plane_ceiling_ssim,plane_shift_m,relief_ssim,"
      "relief_ceiling_ssim,occluded\r\n";
  for (const FacadeFigures& facade : evaluation.facades) {
    const PictureFigures& picture = facade.picture;
    csv += CsvField(facade.id) + "," + CsvField(facade.facet);
    for (const double value :
         {facade.area_m2, facade.painted, picture.ssim, picture.ms_ssim, picture.psnr, picture.gmsd,
          picture.flip, picture.lpips, facade.texel_m, facade.misregistration_px,
          facade.ceiling.ssim, facade.plane.share, facade.plane.result.ssim,
          facade.plane.ceiling.ssim, facade.plane.result.shift_m, facade.relief.result.ssim,
          facade.relief.ceiling.ssim, facade.occluded.Share()}) {
      csv += "," + Cell(value);
    }
    csv += "\r\n";
  }
  return csv;
}

}  // namespace

std::string EvaluationJson(const Evaluation& evaluation) {
  Json json = {{"version", kVersion},
               {"survey", evaluation.survey},
               {"scene", evaluation.scene},
               {"tolerance_m", evaluation.tolerance_m},
               {"poses", PosesJson(evaluation.poses)},
               {"dense", PartsJson(evaluation.dense)},
               {"mesh", PartsJson(evaluation.mesh)},
               {"proxy", ProxyJson(evaluation.proxy)},
               {"texture", TextureJson(evaluation)},
               {"views", ViewsJson(evaluation)}};
  json["plan"] = evaluation.has_plan ? PlanJson(evaluation.plan) : Json(nullptr);
  json["notes"] = evaluation.notes;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

void MakeOutputFolder(const std::filesystem::path& output) {
  std::error_code failure;
  std::filesystem::create_directories(output, failure);
  if (failure) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: cannot be created: {}", output.string(), failure.message()),
                "give another folder with --out");
  }
  const std::filesystem::path table = output / kFacadesFile;
  if (std::filesystem::exists(table) && !std::filesystem::exists(output / kEvaluationFile)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: is of no evaluation", table.string()),
                "give another folder with --out: this one's files would be replaced");
  }
}

void WriteEvaluation(const Evaluation& evaluation, const std::filesystem::path& output) {
  MakeOutputFolder(output);
  WriteFileAtomically(output / kEvaluationFile, EvaluationJson(evaluation) + "\n");
  WriteFileAtomically(output / kFacadesFile, FacadesCsv(evaluation));
  WriteEvaluationPage(evaluation, output);
}

}  // namespace stucco::evaluate
