// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "report/internal/html_sections.h"
#include "survey/escape.h"
#include "survey/numbers.h"

namespace stucco::internal {
namespace {

std::string Thumbnail(const PageContent& page, size_t index) {
  const EmbeddedPicture& picture = page.pictures[index].thumbnail;
  if (picture.uri.empty()) {
    return "<span class=\"no-picture\" role=\"img\" aria-label=\"no picture\"></span>";
  }
  return fmt::format("<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"Picture of {}\">",
                     picture.uri, picture.width_px, picture.height_px,
                     EscapeHtml(page.rows[index].id));
}

// A cell whose column sorts by `value`; one that is not known sorts last.
std::string NumberCell(const char* label, bool known, double value, const std::string& text) {
  return fmt::format("<td class=\"num\" data-label=\"{}\" data-sort=\"{}\">{}</td>", label,
                     known ? fmt::format("{}", value) : "",
                     known ? EscapeHtml(text) : "<span class=\"quiet\">-</span>");
}

std::string VerdictCell(const FacetRow& row, size_t rank) {
  std::string html =
      fmt::format("<td class=\"verdict-cell\" data-label=\"Verdict\" data-sort=\"{}\">{}", rank,
                  VerdictBadge(row.verdict));
  if (!row.findings.empty()) {
    // A lost photo explains what is worse than asked; why it is lost stands with the details.
    const bool explains = !row.exempt && !row.lost_views.empty();
    html +=
        fmt::format(" <span class=\"reason\">{}{}</span>", EscapeHtml(row.findings.front().text),
                    explains ? "; planned photos are lost" : "");
  }
  return html + "</td>";
}

// "Wall", and which part of the facade it is where the name is the plan's.
std::string Kind(const FacetRow& row) {
  if (row.planned == nullptr) return ClassLabel(row.facet_class);
  return fmt::format("{} {}", ClassLabel(row.facet_class), IsolatedHtml(row.id));
}

std::string TableRow(const PageContent& page, size_t index, size_t rank) {
  const FacetRow& row = page.rows[index];
  const bool has_facet = row.facet != nullptr;
  const bool painted = row.IsPainted();
  const TexturedFacet nothing;
  const TexturedFacet& texture = painted ? *row.texture : nothing;
  const bool metric = page.data.metric;
  std::string html = fmt::format(
      "<tr data-index=\"{0}\" data-verdict=\"{1}\" data-class=\"{2}\"><td class=\"pic\">"
      "<button type=\"button\" data-open=\"{0}\" tabindex=\"-1\" aria-hidden=\"true\">{3}</button>"
      "</td><th scope=\"row\"><button type=\"button\" class=\"link\" data-open=\"{0}\">{4}</button>"
      "<span class=\"quiet\">{5}</span></th>",
      index, Name(row.verdict), ClassLabel(row.facet_class), Thumbnail(page, index),
      IsolatedHtml(row.Name()), Kind(row));
  html += VerdictCell(row, rank);
  html += NumberCell("Area", has_facet, has_facet ? row.facet->area : 0,
                     has_facet ? Area(row.facet->area, metric) : "");
  html += NumberCell("Painted", painted, row.shares.painted, Percent(row.shares.painted));
  html += NumberCell("Photo pixel", painted && texture.gsd_m > 0, texture.gsd_m,
                     PixelSize(texture.gsd_m, metric));
  html += NumberCell("Filled in", painted, row.shares.inpainted, Percent(row.shares.inpainted));
  html += NumberCell("Inferred", has_facet, row.shares.inferred, Percent(row.shares.inferred));
  html += NumberCell("Misfit", painted && texture.misregistration_px >= 0,
                     texture.misregistration_px, Decimal(texture.misregistration_px, 1) + " tx");
  html += NumberCell("Photos", painted, static_cast<double>(texture.photos.size()),
                     fmt::format("{}", texture.photos.size()));
  return html + "</tr>";
}

std::string Head() {
  struct Column {
    const char* name;
    const char* help;
    bool numeric;
  };
  const Column columns[] = {
      {"Facade", "", false},
      {"Verdict", "the worst of its measures", false},
      {"Area", "", true},
      {"Painted", "share of the area that can be seen, painted from photos", true},
      {"Photo pixel", "median size of a photo pixel on the facade", true},
      {"Filled in", "share of the area that can be seen, painted without a photo", true},
      {"Inferred", "share of the area that can be seen, without measured points", true},
      {"Misfit", "median shift between overlapping photos, in texels (tx)", true},
      {"Photos", "photos that paint it", true}};
  std::string html = "<thead><tr><td class=\"pic\"></td>";
  for (const Column& column : columns) {
    html += fmt::format(
        "<th scope=\"col\"{}><button type=\"button\" class=\"sort\" title=\"{}\">{}</button></th>",
        column.numeric ? " class=\"num\"" : "", column.help, column.name);
  }
  return html + "</tr></thead>";
}

std::string ClassFilter(const PageContent& page) {
  std::set<FacetClass> classes;
  for (const FacetRow& row : page.rows) classes.insert(row.facet_class);
  if (classes.size() < 2) return "";
  // The headline counts walls, so the table begins with them.
  const bool has_walls = classes.count(FacetClass::kWall) > 0;
  std::string html =
      fmt::format("<label>Surfaces <select id=\"class-filter\"><option value=\"\"{}>all</option>",
                  has_walls ? "" : " selected");
  for (const FacetClass facet_class : classes) {
    html += fmt::format("<option value=\"{0}\"{1}>{0}</option>", ClassLabel(facet_class),
                        facet_class == FacetClass::kWall ? " selected" : "");
  }
  return html + "</select></label>";
}

// Facades that were planned for and are not in the model.
std::string Missing(const PageContent& page) {
  constexpr size_t kMost = 12;
  const std::vector<std::string> missing = MissingFacades(page.data, page.rows);
  if (missing.empty()) return "";
  std::string names;
  for (size_t i = 0; i < std::min(kMost, missing.size()); ++i) {
    names += (i > 0 ? ", " : "") + IsolatedHtml(missing[i]);
  }
  if (missing.size() > kMost) names += fmt::format(" and {} more", missing.size() - kMost);
  return fmt::format(
      "<p class=\"quiet\">Of the {} facades of the plan {} not found in the model: {}.</p>",
      page.data.plan->facades.size(), missing.size() == 1 ? "one was" : "these were", names);
}

// Pieces of ground that the table leaves out.
std::string SmallGround(const PageContent& page) {
  if (!page.data.proxy) return "";
  size_t pieces = 0;
  for (const Building& building : page.data.proxy->buildings) {
    if (building.id == "G0") pieces += building.facets.size();
  }
  const auto shown = static_cast<size_t>(std::ranges::count(
      page.rows, FacetClass::kGround, [](const FacetRow& row) { return row.facet_class; }));
  if (pieces <= shown) return "";
  return fmt::format(
      "<p class=\"quiet\">Of the {} pieces of ground the {} largest are listed; all are in "
      "<a href=\"facades.csv\">facades.csv</a>.</p>",
      pieces, shown);
}

}  // namespace

std::string FacadeTableSection(const PageContent& page) {
  if (page.rows.empty()) return "";
  std::string html =
      "<section aria-labelledby=\"facades\"><div class=\"section-head\"><h2 id=\"facades\">Facades"
      "</h2><div class=\"filters\"><label>Find <input id=\"search\" type=\"search\" "
      "placeholder=\"id\" autocomplete=\"off\"></label>" +
      ClassFilter(page) +
      "<span id=\"shown\" class=\"quiet\" role=\"status\"></span></div></div>"
      "<table id=\"facade-table\" class=\"facade-table\">" +
      Head() + "<tbody>";
  size_t rank = 0;
  for (const size_t index : WorstFirst(page.rows)) html += TableRow(page, index, rank++);
  return html +
         "</tbody></table><p id=\"none-shown\" class=\"quiet\" hidden>No facade matches. "
         "<button type=\"button\" class=\"link\" id=\"show-all\">Show all</button></p>" +
         Missing(page) + SmallGround(page) + "</section>";
}

}  // namespace stucco::internal
