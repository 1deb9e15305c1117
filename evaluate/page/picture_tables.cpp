// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "evaluate/page/internal/sections.h"
#include "survey/escape.h"
#include "survey/numbers.h"

namespace stucco::evaluate::internal {
namespace {

struct Pictures {
  const std::string& name;
  const std::string& truth;
  const std::string& result;
  const std::string& error;
  const std::string& problem;
};

std::string Thumbnail(const std::string& path, const char* what, const std::string& name) {
  if (path.empty()) return "";
  return fmt::format(
      "<figure><a href=\"{0}\"><img src=\"{0}\" loading=\"lazy\" alt=\"{1} of {2}\">"
      "</a><figcaption>{1}</figcaption></figure>",
      UrlPath(path), what, EscapeHtml(name));
}

// Truth, result and error side by side; a script opens them large.
std::string Triple(const Pictures& pictures) {
  if (pictures.truth.empty()) {
    const char* why = pictures.problem.empty() ? "nothing painted" : "a picture cannot be read";
    return fmt::format("<td class=\"triple quiet\">{}</td>", why);
  }
  return fmt::format(
      "<td class=\"triple\"><div class=\"side-by-side\" data-name=\"{}\">{}{}{}</div>"
      "</td>",
      EscapeHtml(pictures.name), Thumbnail(pictures.truth, "truth", pictures.name),
      Thumbnail(pictures.result, "result", pictures.name),
      Thumbnail(pictures.error, "FLIP error", pictures.name));
}

struct Column {
  const char* name;
  const char* help;
};

std::string NumberCell(const char* label, double value, const std::string& text) {
  const bool known = std::isfinite(value);
  return fmt::format("<td class=\"num\" data-label=\"{}\" data-sort=\"{}\">{}</td>", label,
                     known ? fmt::format("{}", value) : "", known ? EscapeHtml(text) : "-");
}

std::string MeasureCells(const PictureFigures& figures, bool with_lpips) {
  return NumberCell("SSIM", figures.ssim, Decimal(figures.ssim, 3)) +
         NumberCell("MS-SSIM", figures.ms_ssim, Decimal(figures.ms_ssim, 3)) +
         NumberCell("PSNR", figures.psnr, Decimal(figures.psnr, 1)) +
         NumberCell("GMSD", figures.gmsd, Decimal(figures.gmsd, 3)) +
         NumberCell("FLIP", figures.flip, Decimal(figures.flip, 3)) +
         (with_lpips ? NumberCell("LPIPS", figures.lpips, Decimal(figures.lpips, 3)) : "");
}

std::vector<Column> MeasureColumns(bool with_lpips) {
  std::vector<Column> columns = {{"SSIM", "structural similarity, 1 is equal"},
                                 {"MS-SSIM", "the same on five scales"},
                                 {"PSNR", "peak signal-to-noise ratio in dB"},
                                 {"GMSD", "deviation of gradient similarity, 0 is equal"},
                                 {"FLIP", "visible error from 0 to 1"}};
  if (with_lpips) columns.push_back({"LPIPS", "learned perceptual distance, 0 is equal"});
  return columns;
}

std::string Head(const char* first, const std::vector<Column>& columns) {
  std::string html = fmt::format(
      "<thead><tr><th scope=\"col\"><button type=\"button\" class=\"sort\">{}</button></th>"
      "<td>truth, result, FLIP error</td>",
      first);
  for (const Column& column : columns) {
    html += fmt::format(
        "<th scope=\"col\" class=\"num\"><button type=\"button\" class=\"sort\" "
        "title=\"{}\">{}</button></th>",
        column.help, column.name);
  }
  return html + "</tr></thead>";
}

std::string FacadeRow(const FacadeFigures& facade, bool with_lpips) {
  const std::string facet = facade.facet.empty() ? "no facet of the result lies here"
                                                 : "result: " + IsolatedHtml(facade.facet);
  return fmt::format("<tr><th scope=\"row\">{}<span class=\"quiet\">{}</span></th>",
                     IsolatedHtml(facade.id), facet) +
         Triple({facade.id, facade.truth_picture, facade.result_picture, facade.error_picture,
                 facade.problem}) +
         NumberCell("Area", facade.area_m2, Area(facade.area_m2, /*metric=*/true)) +
         NumberCell("Painted", facade.painted, Percent(facade.painted)) +
         MeasureCells(facade.picture, with_lpips) +
         NumberCell("Ceiling", facade.ceiling.ssim, Decimal(facade.ceiling.ssim, 3)) +
         NumberCell("On the plane", facade.plane.result.ssim,
                    Decimal(facade.plane.result.ssim, 3)) +
         NumberCell("Its ceiling", facade.plane.ceiling.ssim,
                    Decimal(facade.plane.ceiling.ssim, 3)) +
         NumberCell("Shift", facade.misregistration_px * facade.texel_m,
                    Length(facade.misregistration_px * facade.texel_m, /*metric=*/true)) +
         "</tr>";
}

template <typename Rows>
bool HasLpips(const Rows& rows) {
  return std::any_of(rows.begin(), rows.end(),
                     [](const auto& row) { return std::isfinite(row.picture.lpips); });
}

std::string Table(const std::string& head, const std::string& rows) {
  return "<div class=\"scroll\"><table class=\"facade-table picture-table\">" + head + "<tbody>" +
         rows + "</tbody></table></div>";
}

}  // namespace

std::string FacadesSection(const Evaluation& evaluation) {
  if (evaluation.facades.empty()) return "";
  const bool with_lpips = HasLpips(evaluation.facades);
  std::vector<Column> columns = {{"Area", "of the truth's wall"},
                                 {"Painted", "share of it that the result paints from photos"}};
  for (const Column& column : MeasureColumns(with_lpips)) columns.push_back(column);
  columns.push_back({"Ceiling", "SSIM of ideal photos of the same wall"});
  columns.push_back({"On the plane", "SSIM where the wall is flat"});
  columns.push_back({"Its ceiling", "SSIM of ideal photos where the wall is flat"});
  columns.push_back({"Shift", "median shift of the content"});
  std::string rows;
  for (const FacadeFigures& facade : evaluation.facades) rows += FacadeRow(facade, with_lpips);
  return "<section aria-labelledby=\"facades\"><h2 id=\"facades\">Facades</h2>" +
         Table(Head("Facade", columns), rows) + "</section>";
}

std::string ViewsSection(const Evaluation& evaluation) {
  if (evaluation.views.empty()) return "";
  const bool with_lpips = HasLpips(evaluation.views);
  std::vector<Column> columns = {{"Compared", "share of the buildings in it that the model has"}};
  for (const Column& column : MeasureColumns(with_lpips)) columns.push_back(column);
  columns.push_back({"On buildings", "SSIM where the photo shows a building"});
  std::string rows;
  for (const HeldOutFigures& view : evaluation.views) {
    rows += "<tr><th scope=\"row\">" + IsolatedHtml(view.photo) + "</th>" +
            Triple({view.photo, view.truth_picture, view.result_picture, view.error_picture,
                    view.problem}) +
            NumberCell("Compared", view.compared, Percent(view.compared)) +
            MeasureCells(view.picture, with_lpips) +
            NumberCell("On buildings", view.buildings.ssim, Decimal(view.buildings.ssim, 3)) +
            "</tr>";
  }
  return "<section aria-labelledby=\"views\"><h2 id=\"views\">Photos held out</h2><p "
         "class=\"quiet\">"
         "Photos that the survey has not seen, beside pictures of its model from the same places."
         "</p>" +
         Table(Head("Photo", columns), rows) + "</section>";
}

}  // namespace stucco::evaluate::internal
