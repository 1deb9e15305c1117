// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>

#include "evaluate/page/internal/sections.h"
#include "survey/escape.h"
#include "survey/numbers.h"

namespace stucco::evaluate::internal {
namespace {

std::string Metres(double metres) {
  return Length(metres, /*metric=*/true);
}

std::string Degrees(double degrees) {
  return std::isfinite(degrees) ? fmt::format("{:.3f}°", degrees) : "-";
}

std::string Group(const char* title, const std::string& figures) {
  return fmt::format("<h3>{}</h3><dl class=\"measures\">{}</dl>", title, figures);
}

std::string Poses(const PoseFigures& poses) {
  if (poses.total == 0) return "";
  return Group(
      "Camera poses",
      FigureHtml("photos with a pose", fmt::format("{} of {}", poses.posed, poses.total)) +
          FigureHtml("position, mean", Metres(poses.position_mean_m), "after the best similarity") +
          FigureHtml("position, largest", Metres(poses.position_max_m)) +
          FigureHtml("direction, mean", Degrees(poses.rotation_mean_deg)) +
          FigureHtml("direction, largest", Degrees(poses.rotation_max_deg)) +
          FigureHtml("georeferenced, mean", Metres(poses.georeferenced_mean_m),
                     "in the frames as they are") +
          FigureHtml("georeferenced direction, mean",
                     Degrees(poses.georeferenced_rotation_mean_deg), "in the frames as they are"));
}

enum class RowOf { kBuildings, kPart };

std::string SurfaceRow(RowOf row, const std::string& name, const SurfaceFigures& figures) {
  if (!figures.IsMeasured()) return "";
  return fmt::format(
      "<tr{}><th scope=\"row\">{}</th><td class=\"num\">{}</td><td class=\"num\">{}</td>"
      "<td class=\"num\">{}</td><td class=\"num\">{}</td><td class=\"num\">{}</td></tr>",
      row == RowOf::kPart ? " class=\"part\"" : "", name, Metres(figures.error95_m),
      Metres(figures.seen95_m), Percent(figures.completeness),
      Percent(figures.completeness_of_three), Percent(figures.completeness_all));
}

// The buildings first: most of what there is near them is ground.
std::string PartRows(const std::string& name, const PartFigures& figures) {
  if (!figures.all.IsMeasured()) return "";
  return SurfaceRow(RowOf::kBuildings, name + ": buildings", figures.building) +
         SurfaceRow(RowOf::kPart, "walls", figures.wall) +
         SurfaceRow(RowOf::kPart, "roofs", figures.roof) +
         SurfaceRow(RowOf::kPart, "ground", figures.ground) +
         SurfaceRow(RowOf::kPart, "everything", figures.all);
}

std::string Surfaces(const Evaluation& evaluation) {
  const std::string rows = PartRows("Dense cloud", evaluation.dense) +
                           PartRows("Mesh", evaluation.mesh) +
                           PartRows("Proxy", evaluation.proxy.surface);
  if (rows.empty()) return "";
  return fmt::format(
      "<h3>Surfaces</h3><div class=\"scroll\"><table class=\"plain surfaces\"><thead><tr><td></td>"
      "<th scope=\"col\" class=\"num\">error<br><span class=\"quiet\">95 % lie nearer</span></th>"
      "<th scope=\"col\" class=\"num\">photos show<br><span class=\"quiet\">95 % lie nearer to "
      "the model</span></th><th scope=\"col\" class=\"num\">complete within {0}<br><span "
      "class=\"quiet\">of what "
      "photos show</span></th><th scope=\"col\" class=\"num\">complete within {0}<br>"
      "<span class=\"quiet\">of what three show</span></th>"
      "<th scope=\"col\" class=\"num\">complete within {0}<br>"
      "<span class=\"quiet\">of everything</span></th>"
      "</tr></thead><tbody>{1}</tbody></table></div>",
      Metres(evaluation.tolerance_m), rows);
}

std::string Solids(const ProxyFigures& proxy) {
  if (proxy.buildings == 0 && proxy.truth_buildings == 0) return "";  // not measured
  const auto of_all = [&](int count) { return fmt::format("{} of {}", count, proxy.buildings); };
  return Group("Buildings",
               FigureHtml("buildings", fmt::format("{}", proxy.buildings),
                          fmt::format("the truth has {}", proxy.truth_buildings)) +
                   FigureHtml("closed", of_all(proxy.watertight)) +
                   FigureHtml("manifold", of_all(proxy.manifold)) +
                   FigureHtml("cutting themselves", of_all(proxy.self_intersecting)) +
                   FigureHtml("facets", fmt::format("{}", proxy.facets),
                              fmt::format("{} of them on roofs; the truth has {} and none there",
                                          proxy.superstructure_facets, proxy.truth_facets)) +
                   FigureHtml("facades with the right id", Percent(proxy.facade_id_rate),
                              "of the truth's wall area"));
}

bool HasAny(const PictureFigures& figures) {
  return std::isfinite(figures.psnr) || std::isfinite(figures.flip);
}

// SSIM beside what ideal photos reach on the same texels.
std::string Ceilings(const Evaluation& evaluation) {
  const auto beside = [](const char* name, double ssim, const Likeness& ceiling, double share) {
    return FigureHtml(name, Decimal(ssim, 3) + " of " + Decimal(ceiling.ssim, 3),
                      std::isfinite(share) ? Percent(share) + " of the painted area" : "");
  };
  return beside("SSIM of its ceiling", evaluation.texture_mean.ssim, evaluation.ceiling_mean,
                kNotMeasured) +
         beside("on the walls' planes", evaluation.plane_mean.result.ssim,
                evaluation.plane_mean.ceiling, evaluation.plane_mean.share) +
         beside("on relief", evaluation.relief_mean.result.ssim, evaluation.relief_mean.ceiling,
                evaluation.relief_mean.share);
}

std::string Textures(const Evaluation& evaluation) {
  std::string html;
  if (HasAny(evaluation.texture_mean)) {
    html += Group(
        "Facade textures, mean by painted area",
        FigureHtml("painted", Percent(evaluation.painted), "of the facades' area") +
            PictureFiguresHtml(evaluation.texture_mean) +
            FigureHtml("shift", Metres(evaluation.misregistration_m),
                       Decimal(evaluation.misregistration_px, 2) + " texels, median of facades") +
            Ceilings(evaluation) +
            FigureHtml("painted through something", Percent(evaluation.occluded.Share()),
                       "of what some photo shows freely"));
  }
  if (HasAny(evaluation.views_mean)) {
    html += Group(
        "Photos held out, mean",
        FigureHtml("compared", Percent(evaluation.views_compared),
                   "of what they show of buildings") +
            PictureFiguresHtml(evaluation.views_mean) +
            FigureHtml("SSIM on buildings", Decimal(evaluation.views_buildings_mean.ssim, 3)));
  }
  return html;
}

std::string Planned(const PlanFigures& plan) {
  return Group("Flight plan",
               FigureHtml("method", plan.method) +
                   FigureHtml("photos", fmt::format("{}", plan.photos)) +
                   FigureHtml("hovers", fmt::format("{}", plan.hovers)) +
                   FigureHtml("path", Decimal(plan.length_m, 0) + " m") +
                   FigureHtml("time", Decimal(plan.time_min, 1) + " min") +
                   FigureHtml("battery", Decimal(plan.battery_percent, 0) + " %") +
                   FigureHtml("Q_s, Q_d, Q_u, Q_c",
                              fmt::format("{} {} {} {}", Decimal(plan.q_s, 2), Decimal(plan.q_d, 2),
                                          Decimal(plan.q_u, 2), Decimal(plan.q_c, 2))));
}

}  // namespace

std::string FigureHtml(std::string_view name, const std::string& value, std::string_view note) {
  const std::string below =
      note.empty() ? "" : fmt::format("<span class=\"note\">{}</span>", EscapeHtml(note));
  return fmt::format("<div class=\"figure\"><dt>{}</dt><dd>{}{}</dd></div>", EscapeHtml(name),
                     IsolatedHtml(value), below);
}

std::string PictureFiguresHtml(const PictureFigures& figures) {
  return FigureHtml("SSIM", Decimal(figures.ssim, 3)) +
         FigureHtml("MS-SSIM", Decimal(figures.ms_ssim, 3)) +
         FigureHtml("PSNR", std::isfinite(figures.psnr) ? Decimal(figures.psnr, 1) + " dB" : "-") +
         FigureHtml("GMSD", Decimal(figures.gmsd, 3)) +
         FigureHtml("FLIP", Decimal(figures.flip, 3)) +
         (std::isfinite(figures.lpips) ? FigureHtml("LPIPS", Decimal(figures.lpips, 3)) : "");
}

std::string HeadlineSection(const Evaluation& evaluation) {
  return fmt::format(
             "<section aria-labelledby=\"headline\"><h2 id=\"headline\">Against the truth"
             "</h2><p class=\"quiet\">Survey <b>{}</b> measured against the scene <b>{}</b>.</p>",
             IsolatedHtml(evaluation.survey), IsolatedHtml(evaluation.scene)) +
         Poses(evaluation.poses) + Surfaces(evaluation) + Solids(evaluation.proxy) +
         Textures(evaluation) + (evaluation.has_plan ? Planned(evaluation.plan) : "") +
         "</section>";
}

}  // namespace stucco::evaluate::internal
