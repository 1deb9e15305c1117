// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/report_json.h"

#include <nlohmann/json.hpp>

#include "report/photo_trust.h"
#include "survey/escape.h"

namespace stucco {
namespace {

using Json = nlohmann::ordered_json;

Json OrNull(bool known, double value) {
  return known ? Json(value) : Json(nullptr);
}

// Negative stands for "not known" in the files of the stages.
Json UnlessNegative(double value) {
  return OrNull(value >= 0, value);
}

const char* Unit(const SurveyData& data) {
  return data.metric ? "m" : "units";
}

Json VerdictJson(Verdict verdict) {
  return verdict == Verdict::kUnknown ? Json(nullptr) : Json(Name(verdict));
}

Json CountsJson(const VerdictCounts& counts) {
  return {{"total", counts.Total()}, {"green", counts.green},     {"amber", counts.amber},
          {"red", counts.red},       {"unknown", counts.unknown}, {"exempt", counts.exempt}};
}

Json FindingsJson(const FacetRow& row) {
  Json findings = Json::array();
  for (const Finding& finding : row.findings) {
    findings.push_back({{"verdict", Name(finding.verdict)}, {"text", finding.text}});
  }
  return findings;
}

Json TextsJson(const std::vector<std::string>& texts) {
  Json clean = Json::array();
  for (const std::string& text : texts) clean.push_back(CleanUtf8(text));
  return clean;
}

template <typename Terms>
Json QualityJson(const Terms& terms) {
  return {{"q_s", terms.q_s}, {"q_d", terms.q_d}, {"q_u", terms.q_u}, {"q_c", terms.q_c}};
}

Json FacadeJson(const SurveyData& data, const FacetRow& row) {
  const Facet* facet = row.facet;
  const TexturedFacet* texture = row.texture;
  const bool painted = row.IsPainted();
  Json json = {
      {"id", CleanUtf8(row.id)},
      {"building", CleanUtf8(row.building)},
      {"facade", CleanUtf8(facet != nullptr ? FacadeName(*facet) : row.id)},
      {"class", CityGmlName(row.facet_class)},
      {"verdict", VerdictJson(row.verdict)},
      {"findings", FindingsJson(row)},
      {"lost_views", row.lost_views.empty() ? Json(nullptr) : Json(CleanUtf8(row.lost_views))},
      {"planned", row.planned ? QualityJson(row.planned->predicted) : Json(nullptr)},
      {"achieved", painted ? QualityJson(*texture) : Json(nullptr)}};
  json["gsd_m"] = painted && texture->gsd_m > 0 ? Json(texture->gsd_m) : Json(nullptr);
  json["gsd_ratio"] = row.gsd_ratio > 0 ? Json(row.gsd_ratio) : Json(nullptr);
  json["photos"] = texture != nullptr ? TextsJson(texture->photos) : Json::array();
  json["painted"] = texture != nullptr ? Json(texture->painted) : Json(nullptr);
  json["inpainted"] = texture != nullptr ? Json(texture->inpainted) : Json(nullptr);
  json["misregistration_px"] =
      painted ? UnlessNegative(texture->misregistration_px) : Json(nullptr);
  const auto placed = painted ? PlacementOf(data, *texture) : std::nullopt;
  json["photos_placed_px"] =
      placed ? Json{{"median", placed->middle_px}, {"largest", placed->worst_px}} : Json(nullptr);
  json["sharpness"] = painted ? Json(texture->sharpness) : Json(nullptr);
  json["area"] = facet != nullptr ? Json(facet->area) : Json(nullptr);
  json["plane_rms"] = facet != nullptr ? Json(facet->rms) : Json(nullptr);
  json["support"] = facet != nullptr ? Json(facet->support) : Json(nullptr);
  json["seen"] = facet != nullptr ? Json(facet->seen) : Json(nullptr);
  json["inferred"] = facet != nullptr ? Json(facet->inferred) : Json(nullptr);
  json["party"] = facet != nullptr ? Json(facet->party) : Json(nullptr);
  json["image"] = painted ? Json(CleanUtf8(texture->image)) : Json(nullptr);
  return json;
}

Json AttentionJson(const SurveyData& data) {
  Json list = Json::array();
  for (const Attention& item : FindAttention(data)) {
    list.push_back({{"stage", CleanUtf8(item.stage)},
                    {"state", CleanUtf8(item.state)},
                    {"why", CleanUtf8(item.why)},
                    {"remedy", CleanUtf8(item.remedy)},
                    {"command", CleanUtf8(item.command)}});
  }
  return list;
}

Json PhotosJson(const SurveyData& data) {
  Json json = {{"total", nullptr}, {"usable", nullptr}, {"posed", nullptr}};
  if (data.captures) {
    int usable = 0;
    for (const CapturedPhoto& photo : data.captures->photos) usable += photo.usable ? 1 : 0;
    json["total"] = data.captures->photos.size();
    json["usable"] = usable;
  }
  if (data.calibration) json["posed"] = data.calibration->photos_posed;
  Json left_out = Json::array();
  for (const LeftOutPhoto& photo : LeftOutPhotos(data)) {
    left_out.push_back(
        {{"path", CleanUtf8(photo.path)}, {"what", photo.what}, {"why", CleanUtf8(photo.why)}});
  }
  json["left_out"] = left_out;
  return json;
}

Json PlanJson(const SurveyData& data, const std::vector<FacetRow>& rows) {
  if (!data.plan) return nullptr;
  return {{"method", CleanUtf8(data.plan->method)},
          {"facades", data.plan->facades.size()},
          {"missing", TextsJson(MissingFacades(data, rows))}};
}

Json CameraJson(const CalibratedCamera& camera) {
  return {{"label", CleanUtf8(camera.label)},
          {"model", CleanUtf8(camera.model)},
          {"names", TextsJson(camera.names)},
          {"params", camera.params},
          {"sigma", camera.sigma},
          {"held", TextsJson(camera.held)}};
}

Json PointJson(const CalibratedPoint& point) {
  return {{"name", CleanUtf8(point.name)},
          {"role", point.role},
          {"state", point.state},
          {"why", CleanUtf8(point.why)},
          {"photos", point.photos},
          {"error_m", point.error_m},
          {"reprojection_error_px", UnlessNegative(point.reprojection_error_px)},
          {"verdict", point.verdict}};
}

Json PointSetJson(const std::optional<CalibratedPointSet>& set) {
  if (!set) return nullptr;
  return {{"points", set->points},
          {"horizontal_rms_m", set->horizontal_rms_m},
          {"vertical_rms_m", set->vertical_rms_m},
          {"reprojection_error_px", set->reprojection_error_px},
          {"ground_pixel_m", set->ground_pixel_m},
          {"verdict", set->verdict}};
}

Json GroundControlJson(const Calibration& calibration) {
  if (calibration.ground_control.empty()) return nullptr;
  Json points = Json::array();
  for (const CalibratedPoint& point : calibration.ground_control)
    points.push_back(PointJson(point));
  return {{"control", PointSetJson(calibration.control_rms)},
          {"check", PointSetJson(calibration.check_rms)},
          {"points", points}};
}

Json SigmaJson(const PlacementSigma& sigma) {
  return {{"position", sigma.position},
          {"rotation_deg", sigma.rotation_deg},
          {"picture_px", UnlessNegative(sigma.picture_px)}};
}

Json PlacementJson(const Calibration& calibration) {
  const Placement placement = SummarizePlacement(calibration);
  Json states;
  for (const auto& [state, count] : placement.states) states[std::string(Name(state))] = count;
  Json doubtful = Json::array();
  for (const CalibratedPhoto* photo : PhotosNotToTrust(calibration)) {
    doubtful.push_back({{"path", CleanUtf8(photo->path)},
                        {"state", Name(photo->state)},
                        {"why", CleanUtf8(photo->why)},
                        {"position_sigma", UnlessNegative(photo->position_sigma)},
                        {"rotation_sigma_deg", UnlessNegative(photo->rotation_sigma_deg)},
                        {"picture_sigma_px", UnlessNegative(photo->picture_sigma_px)}});
  }
  Json parts = Json::array();
  for (const CalibratedPart& part : calibration.parts) {
    parts.push_back({{"model", part.model},
                     {"photos", part.photos},
                     {"placed_by", part.placed_by},
                     {"position_sigma_m", UnlessNegative(part.position_sigma_m)},
                     {"rotation_sigma_deg", UnlessNegative(part.rotation_sigma_deg)},
                     {"why", CleanUtf8(part.why)}});
  }
  return {
      {"states", states},
      {"middle", placement.middle ? SigmaJson(*placement.middle) : Json(nullptr)},
      {"nine_in_ten", placement.nine_in_ten ? SigmaJson(*placement.nine_in_ten) : Json(nullptr)},
      {"not_to_trust", doubtful},
      {"parts", parts}};
}

Json CalibrationJson(const SurveyData& data) {
  if (!data.calibration) return nullptr;
  const Calibration& calibration = *data.calibration;
  Json cameras = Json::array();
  for (const CalibratedCamera& camera : calibration.cameras) cameras.push_back(CameraJson(camera));
  return {{"photos_total", calibration.photos_total},
          {"photos_posed", calibration.photos_posed},
          {"reprojection_error_px", calibration.reprojection_error_px},
          {"points", calibration.points},
          {"mean_track_length", calibration.mean_track_length},
          {"prior_rms_m",
           {{"horizontal", UnlessNegative(calibration.prior_rms_horizontal_m)},
            {"vertical", UnlessNegative(calibration.prior_rms_vertical_m)}}},
          {"cameras", cameras},
          {"placement", PlacementJson(calibration)},
          {"ground_control", GroundControlJson(calibration)},
          {"findings", TextsJson(calibration.findings)}};
}

Json GeorefJson(const SurveyData& data) {
  if (!data.georef) return nullptr;
  const Georef& georef = *data.georef;
  Json json = {{"frame", CleanUtf8(georef.frame)},
               {"metric", georef.metric},
               {"source", CleanUtf8(georef.source)},
               {"on_map", georef.on_map}};
  if (georef.frame == "enu") {
    json["origin"] = {{"latitude_deg", georef.origin_latitude_deg},
                      {"longitude_deg", georef.origin_longitude_deg},
                      {"height_m", georef.origin_height_m}};
  }
  return json;
}

Json StagesJson(const SurveyData& data, bool record_times) {
  Json stages = Json::array();
  for (const StageStatus& status : data.statuses) {
    Json stage = {{"stage", CleanUtf8(status.stage)},
                  {"state", CleanUtf8(status.state)},
                  {"why", CleanUtf8(status.why)}};
    if (record_times) {
      stage["wall_s"] = UnlessNegative(status.wall_s);
      stage["cpu_s"] = UnlessNegative(status.cpu_s);
      stage["peak_memory_mb"] = UnlessNegative(status.peak_memory_mb);
    }
    stages.push_back(std::move(stage));
  }
  return stages;
}

Json LimitsJson(const ReportOptions& options) {
  return {{"coverage_amber_below", options.coverage_amber_below},
          {"coverage_red_below", options.coverage_red_below},
          {"gsd_amber_above", options.gsd_amber_above},
          {"gsd_red_above", options.gsd_red_above},
          {"inpainted_amber_above", options.inpainted_amber_above},
          {"inpainted_red_above", options.inpainted_red_above},
          {"inferred_amber_above", options.inferred_amber_above},
          {"inferred_red_above", options.inferred_red_above},
          {"misregistration_amber_above", options.misregistration_amber_above},
          {"misregistration_red_above", options.misregistration_red_above},
          {"least_area_m2", options.least_area_m2}};
}

}  // namespace

std::string ReportJson(const SurveyData& data, const std::vector<FacetRow>& rows,
                       const ReportOptions& options) {
  Json facades = Json::array();
  for (const FacetRow& row : rows) facades.push_back(FacadeJson(data, row));
  const auto median = MedianGsd(data);
  const Json report = {{"version", 1},
                       {"unit", Unit(data)},
                       {"attention", AttentionJson(data)},
                       {"verdicts",
                        {{"walls", CountsJson(CountVerdicts(rows, /*walls_only=*/true))},
                         {"all", CountsJson(CountVerdicts(rows, /*walls_only=*/false))}}},
                       {"limits", LimitsJson(options)},
                       {"median_gsd", median ? Json(*median) : Json(nullptr)},
                       {"plan", PlanJson(data, rows)},
                       {"photos", PhotosJson(data)},
                       {"calibration", CalibrationJson(data)},
                       {"georef", GeorefJson(data)},
                       {"map_findings", data.proxy ? TextsJson(data.proxy->findings) : Json()},
                       {"facades", facades},
                       {"stages", StagesJson(data, options.record_times)}};
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace stucco
