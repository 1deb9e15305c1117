// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "report/internal/html_sections.h"
#include "report/photo_trust.h"
#include "survey/escape.h"
#include "survey/numbers.h"

namespace stucco::internal {
namespace {

std::string Picture(const FacetPictures& pictures, const std::string& id) {
  if (pictures.texture.uri.empty()) {
    return fmt::format("<p class=\"no-texture\">{}</p>", pictures.problem.empty()
                                                             ? "No photo paints this facade."
                                                             : EscapeHtml(pictures.problem));
  }
  std::string html = fmt::format(
      "<figure class=\"texture\"><div class=\"stack\"><img loading=\"lazy\" src=\"{}\" "
      "width=\"{}\" height=\"{}\" alt=\"Picture of {}\">",
      pictures.texture.uri, pictures.texture.width_px, pictures.texture.height_px, EscapeHtml(id));
  if (!pictures.labels.uri.empty()) {
    html += fmt::format(
        "<img class=\"labels\" loading=\"lazy\" src=\"{}\" alt=\"Which photo "
        "painted which part\">",
        pictures.labels.uri);
  }
  html += "</div>";
  if (!pictures.labels.uri.empty()) {
    html +=
        "<figcaption><label>Picture <input class=\"blend\" type=\"range\" min=\"0\" "
        "max=\"100\" value=\"0\" aria-label=\"Show which photo painted which part\"> photo "
        "sources</label></figcaption>";
  }
  return html + "</figure>";
}

double PercentOfTrack(double value) {
  return std::isfinite(value) ? 100 * std::clamp(value, 0.0, 1.0) : 0.0;
}

// With a mark and a number for what the plan predicted, where there is one.
std::string QualityBar(const char* name, const char* help, double value,
                       std::optional<double> planned) {
  std::string mark;
  std::string number;
  if (planned) {
    mark = fmt::format("<i style=\"left:{:.1f}%\"></i>", PercentOfTrack(*planned));
    number = fmt::format("<span class=\"num quiet\">{}</span>", Decimal(*planned, 2));
  }
  return fmt::format(
      "<div class=\"quality{}\" title=\"{}\"><span>{}</span><span class=\"track\">"
      "<span style=\"width:{:.1f}%\"></span>{}</span><b>{}</b>{}</div>",
      planned ? " with-plan" : "", help, name, PercentOfTrack(value), mark, Decimal(value, 2),
      number);
}

std::string Qualities(const FacetRow& row) {
  const TexturedFacet& achieved = *row.texture;
  const auto planned = [&](double FacadeQuality::*term) {
    return row.planned ? std::optional(row.planned->predicted.*term) : std::nullopt;
  };
  return fmt::format("<h4>Achieved quality{}, 0 to 1</h4>", row.planned ? " and planned" : "") +
         QualityBar("Frontal", "q_s: how frontal and how alike the views are", achieved.q_s,
                    planned(&FacadeQuality::q_s)) +
         QualityBar("Close", "q_d: how near and at how equal a distance the views are",
                    achieved.q_d, planned(&FacadeQuality::q_d)) +
         QualityBar("Few photos", "q_u: how little the views overlap", achieved.q_u,
                    planned(&FacadeQuality::q_u)) +
         QualityBar("Complete", "q_c: how much of the facade they see", achieved.q_c,
                    planned(&FacadeQuality::q_c));
}

// How surely its photos are placed, on the facade.
std::string PlacedTo(const PageContent& page, const TexturedFacet& texture) {
  const auto placed = PlacementOf(page.data, texture);
  if (!placed) return "";
  return Figure("Its photos are placed to",
                PixelSize(placed->middle_px * texture.gsd_m, page.data.metric),
                fmt::format("on it, the middle one; the worst to {}",
                            PixelSize(placed->worst_px * texture.gsd_m, page.data.metric)));
}

std::string Measures(const PageContent& page, const FacetRow& row) {
  const bool metric = page.data.metric;
  std::string html = "<dl class=\"measures\">";
  if (row.IsPainted()) {
    const TexturedFacet& texture = *row.texture;
    html += Figure("Painted from photos", Percent(row.shares.painted));
    html += Figure("Filled in", Percent(row.shares.inpainted));
    html += Figure("Photo pixel", PixelSize(texture.gsd_m, metric),
                   row.gsd_ratio > 0 ? fmt::format("{:.1f} x the median", row.gsd_ratio) : "");
    html += Figure("Misfit between photos", texture.misregistration_px >= 0
                                                ? Decimal(texture.misregistration_px, 2) + " texels"
                                                : "one photo");
    html += PlacedTo(page, texture);
    html += Figure("Sharpness", Decimal(texture.sharpness, 0));
    html += Figure("Picture", fmt::format("{} x {}", texture.width_px, texture.height_px),
                   "texels of " + PixelSize(texture.metres_per_texel, metric));
  }
  if (row.facet != nullptr) {
    const Facet& facet = *row.facet;
    html += Figure("Area", Area(facet.area, metric));
    if (facet.party > 0) {
      html += Figure("Hidden", Percent(facet.party),
                     "of the area, by a neighbour or the ground; shares here are of the rest");
    }
    html += Figure("Seen by points", Percent(1 - row.shares.inferred),
                   Count(facet.support, "point", "points"));
    html += Figure("Distance of points", Length(facet.rms, metric), "rms from the plane");
    html += Figure("Surface from", EscapeHtml(facet.source));
  }
  return html + "</dl>";
}

std::string PhotoList(const PageContent& page, const FacetRow& row, const FacetPictures& pictures) {
  if (row.texture == nullptr || row.texture->photos.empty()) return "";
  std::string html = "<h4>Photos used</h4><ul class=\"photo-list\">";
  for (size_t i = 0; i < row.texture->photos.size(); ++i) {
    const std::string& path = row.texture->photos[i];
    const auto gain = row.texture->gains.find(path);
    html += fmt::format(
        "<li><span class=\"swatch\" style=\"background:{}\"></span>"
        "<span class=\"name\">{}</span>",
        LabelColor(i), IsolatedHtml(path));
    if (i < pictures.photo_shares.size()) {
      html += fmt::format("<span class=\"num\">{}</span>", Percent(pictures.photo_shares[i]));
    }
    if (IsWeak(page.data, path)) html += "<span class=\"quiet\">weakly placed</span>";
    if (gain != row.texture->gains.end()) {
      html += fmt::format("<span class=\"num quiet\">gain {}</span>", Decimal(gain->second, 2));
    }
    html += "</li>";
  }
  if (row.texture->inpainted > 0) {
    html += fmt::format(
        "<li><span class=\"swatch\" style=\"background:{}\"></span>"
        "<span class=\"name\">filled in without a photo</span></li>",
        kInpaintedColor);
  }
  return html + "</ul>";
}

std::string Links(const FacetRow& row) {
  if (!row.IsPainted()) return "";
  std::string html = fmt::format("<p class=\"links\"><a href=\"../texture/{}\">Full picture</a>",
                                 UrlPath(row.texture->image));
  if (!row.texture->orthophoto.empty()) {
    html += fmt::format(" <a href=\"../texture/{}\">Scaled orthophoto</a>",
                        UrlPath(row.texture->orthophoto));
  }
  return html + "</p>";
}

std::string Findings(const FacetRow& row) {
  if (row.findings.empty() && row.lost_views.empty()) return "";
  std::string html = "<ul class=\"findings\">";
  for (const Finding& finding : row.findings) {
    html +=
        fmt::format("<li class=\"{}\">{}</li>", Name(finding.verdict), EscapeHtml(finding.text));
  }
  if (!row.lost_views.empty()) {
    html += fmt::format("<li class=\"unknown\">{}</li>", EscapeHtml(row.lost_views));
  }
  return html + "</ul>";
}

std::string Dialog(const PageContent& page, size_t index) {
  const FacetRow& row = page.rows[index];
  const FacetPictures& pictures = page.pictures[index];
  return fmt::format(
      "<dialog id=\"facade-{0}\" class=\"facade\" aria-labelledby=\"facade-{0}-name\">"
      "<header><h3 id=\"facade-{0}-name\">{1}</h3>{2}<span class=\"quiet\">{3}{10}</span>"
      "<nav><button type=\"button\" data-step=\"-1\" aria-label=\"Previous facade\">&#8592;"
      "</button><button type=\"button\" data-step=\"1\" aria-label=\"Next facade\">&#8594;</button>"
      "<button type=\"button\" data-close aria-label=\"Close\">&#10005;</button></nav></header>"
      "<div class=\"facade-body\"><div>{4}{5}</div><div>{6}{7}{8}{9}</div></div></dialog>",
      index, IsolatedHtml(row.Name()), VerdictBadge(row.verdict), ClassLabel(row.facet_class),
      Picture(pictures, row.id), Links(row), Findings(row), Measures(page, row),
      row.IsPainted() ? Qualities(row) : "", PhotoList(page, row, pictures),
      row.planned != nullptr ? " " + IsolatedHtml(row.id) : "");
}

}  // namespace

std::string FacadeDialogs(const PageContent& page) {
  std::string html = "<div class=\"facade-details\">";
  for (const size_t index : WorstFirst(page.rows)) html += Dialog(page, index);
  return html + "</div>";
}

}  // namespace stucco::internal
