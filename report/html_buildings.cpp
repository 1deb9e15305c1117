// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "report/internal/html_sections.h"
#include "survey/escape.h"
#include "survey/numbers.h"
#include "survey/survey_folder.h"

namespace stucco::internal {
namespace {

// What a building's model holds, in words.
std::string FormOf(const Building& building) {
  if (building.source == "file") return building.watertight ? "as imported, closed" : "as imported";
  if (!building.watertight) return "open: only facets that photos showed; the rest was not seen";
  if (building.detail == "full") return "every roof plane that was found";
  if (building.detail == "coarse") return "only its large roof planes: all of them did not close";
  if (building.detail == "LoD1.2") return "a level top at the height that points show";
  if (building.detail == "extrusion") return "the map's outline and height: nothing showed better";
  return "closed from what photos showed";
}

struct Surface {
  int facets = 0;
  double area = 0;  // that can be seen: neither a neighbour nor the ground hides it
  double seen = 0;  // of the area
};

Surface SurfaceOf(const Building& building) {
  Surface out;
  for (const Facet& facet : building.facets) {
    if (facet.facet_class == FacetClass::kGround) continue;  // the floor that closes a solid
    ++out.facets;
    out.area += facet.area * (1 - facet.party);
    out.seen += facet.area * facet.seen;
  }
  return out;
}

// A link to its elevation, where there is one.
std::string ElevationLink(const Building& building, const SurveyData& data) {
  if (!data.elevations.contains(building.id)) return "";
  return fmt::format("<a href=\"../{}/{}\">elevation</a>", kElevationsFolder,
                     UrlPath(ElevationFile(building)));
}

std::string Row(const Building& building, const SurveyData& data) {
  const Surface surface = SurfaceOf(building);
  return fmt::format(
      "<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td><td class=\"num\">{}</td>"
      "<td>{}</td><td>{}</td><td>{}</td></tr>",
      IsolatedHtml(building.id), surface.facets,
      surface.area > 0 ? Percent(surface.seen / surface.area) : "-",
      building.source == "map"    ? "on the map"
      : building.source == "file" ? "of another program"
                                  : "found in the photos",
      FormOf(building), ElevationLink(building, data));
}

std::string MapFindings(const Proxy& proxy) {
  if (proxy.findings.empty()) return "";
  std::string items;
  for (const std::string& finding : proxy.findings) {
    items += fmt::format("<li>{}</li>", EscapeHtml(finding));
  }
  const bool imported = std::ranges::any_of(
      proxy.buildings, [](const Building& building) { return building.source == "file"; });
  return fmt::format(
      "<h3>{}</h3><ul class=\"findings\">{}</ul>",
      imported ? "Where the model is from" : "Where the model, the map and photos differ", items);
}

}  // namespace

std::string BuildingsSection(const PageContent& page) {
  if (!page.data.proxy) return "";
  std::string rows;
  int buildings = 0;
  int closed = 0;
  for (const Building& building : page.data.proxy->buildings) {
    if (building.id == "G0") continue;
    ++buildings;
    closed += building.watertight ? 1 : 0;
    rows += Row(building, page.data);
  }
  if (buildings == 0) return "";
  return fmt::format(
      "<section aria-labelledby=\"buildings\"><h2 id=\"buildings\">Buildings</h2>"
      "<p>{} of {} closed.</p><details{}><summary>All of them</summary><div class=\"scroll\">"
      "<table class=\"plain\"><thead><tr><th scope=\"col\">Building</th>"
      "<th scope=\"col\" class=\"num\">Facets</th><th scope=\"col\" class=\"num\">Surface with "
      "points</th><th scope=\"col\"></th><th scope=\"col\">Model</th>"
      "<th scope=\"col\" title=\"points before and behind its planes\"></th></tr></thead><tbody>{}"
      "</tbody></table></div></details>{}</section>",
      closed, Count(buildings, "building", "buildings"), buildings <= 12 ? " open" : "", rows,
      MapFindings(*page.data.proxy));
}

}  // namespace stucco::internal
