// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>

#include "report/report_json.h"
#include "survey/escape.h"

namespace stucco {
namespace {

constexpr char kHeader[] =
    "id,building,facade,class,verdict,findings,unit,area,painted,inpainted,seen,inferred,gsd,"
    "misregistration_px,sharpness,photos,q_s,q_d,q_u,q_c,plane_rms,"
    "planned_q_s,planned_q_d,planned_q_u,planned_q_c,party";

// Empty where the value is not known.
std::string Number(bool known, double value) {
  return known && std::isfinite(value) ? fmt::format("{}", value) : "";
}

std::string Findings(const FacetRow& row) {
  std::string text;
  for (const Finding& finding : row.findings) text += (text.empty() ? "" : "; ") + finding.text;
  if (!row.lost_views.empty()) text += (text.empty() ? "" : "; ") + row.lost_views;
  return text;
}

}  // namespace

std::string FacadesCsv(const SurveyData& data, const std::vector<FacetRow>& rows) {
  static const Facet kNoFacet;
  static const TexturedFacet kNoTexture;
  std::string csv = std::string(kHeader) + "\r\n";
  for (const FacetRow& row : rows) {
    const bool has_facet = row.facet != nullptr;
    const bool has_texture = row.texture != nullptr;
    const bool painted = row.IsPainted();
    const bool planned = row.planned != nullptr;
    const FacadeQuality predicted = planned ? row.planned->predicted : FacadeQuality{};
    const Facet& facet = has_facet ? *row.facet : kNoFacet;
    const TexturedFacet& texture = has_texture ? *row.texture : kNoTexture;
    const std::string fields[] = {
        row.id,
        row.building,
        has_facet ? FacadeName(facet) : row.id,
        CityGmlName(row.facet_class),
        row.verdict == Verdict::kUnknown ? "" : Name(row.verdict),
        Findings(row),
        data.metric ? "m" : "units",
        Number(has_facet, facet.area),
        Number(has_texture, texture.painted),
        Number(has_texture, texture.inpainted),
        Number(has_facet, facet.seen),
        Number(has_facet, facet.inferred),
        Number(painted && texture.gsd_m > 0, texture.gsd_m),
        Number(painted && texture.misregistration_px >= 0, texture.misregistration_px),
        Number(painted, texture.sharpness),
        has_texture ? fmt::format("{}", texture.photos.size()) : "",
        Number(painted, texture.q_s),
        Number(painted, texture.q_d),
        Number(painted, texture.q_u),
        Number(painted, texture.q_c),
        Number(has_facet, facet.rms),
        Number(planned, predicted.q_s),
        Number(planned, predicted.q_d),
        Number(planned, predicted.q_u),
        Number(planned, predicted.q_c),
        Number(has_facet, facet.party)};
    bool first = true;
    for (const std::string& field : fields) {
      csv += (first ? "" : ",") + CsvField(field);
      first = false;
    }
    csv += "\r\n";
  }
  return csv;
}

}  // namespace stucco
