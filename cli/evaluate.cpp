// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/evaluate.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "cli/program.h"
#include "pipeline/engine/engine.h"
#include "survey/numbers.h"

namespace stucco {
namespace {

using evaluate::Evaluation;
using evaluate::PartFigures;
using evaluate::PictureFigures;
using evaluate::SurfaceFigures;

std::string Metres(double value) {
  return std::isfinite(value) ? fmt::format("{:.4f} m", value) : "-";
}

std::string PosesText(const evaluate::PoseFigures& poses) {
  return fmt::format(
      "poses       {} of {}; position mean {}, max {}; rotation mean {} deg, max {} deg\n"
      "            as georeferenced: {}, max {}; rotation mean {} deg\n",
      poses.posed, poses.total, Metres(poses.position_mean_m), Metres(poses.position_max_m),
      Decimal(poses.rotation_mean_deg, 4), Decimal(poses.rotation_max_deg, 4),
      Metres(poses.georeferenced_mean_m), Metres(poses.georeferenced_max_m),
      Decimal(poses.georeferenced_rotation_mean_deg, 4));
}

std::string SurfaceText(const char* name, const SurfaceFigures& figures) {
  return fmt::format("{:<11} {:>12} {:>14} {:>14} {:>14} {:>14}\n", name, Metres(figures.error95_m),
                     Metres(figures.seen95_m), Percent(figures.completeness),
                     Percent(figures.completeness_of_three), Percent(figures.completeness_all));
}

std::string ProxyText(const evaluate::ProxyFigures& proxy) {
  return fmt::format(
      "buildings   {} (truth {}): {} watertight, {} manifold, {} cross themselves\n"
      "facets      {}, {} of them of what stands on roofs (truth {} and none); right facade id on "
      "{} of the walls\n",
      proxy.buildings, proxy.truth_buildings, proxy.watertight, proxy.manifold,
      proxy.self_intersecting, proxy.facets, proxy.superstructure_facets, proxy.truth_facets,
      Percent(proxy.facade_id_rate));
}

std::string PictureText(const char* name, const PictureFigures& figures) {
  return fmt::format("{:<11} {:>7} {:>8} {:>7} {:>7} {:>7} {:>7}\n", name, Decimal(figures.ssim, 3),
                     Decimal(figures.ms_ssim, 3), Decimal(figures.psnr, 2),
                     Decimal(figures.gmsd, 3), Decimal(figures.flip, 3), Decimal(figures.lpips, 3));
}

std::string PlanText(const evaluate::PlanFigures& plan) {
  return fmt::format(
      "plan        {}: {} photos, {} hovers, {:.0f} m, {:.1f} min, {:.0f} % of a battery\n",
      plan.method, plan.photos, plan.hovers, plan.length_m, plan.time_min, plan.battery_percent);
}

// The buildings first: most of what there is near them is ground.
std::string PartsText(const char* name, const PartFigures& figures) {
  if (!figures.all.IsMeasured()) return "";
  return SurfaceText(name, figures.building) + SurfaceText("  walls", figures.wall) +
         SurfaceText("  roofs", figures.roof) + SurfaceText("  ground", figures.ground) +
         SurfaceText("  all", figures.all);
}

// Nothing where nothing was measured: the notes say why.
std::string SurfacesText(const Evaluation& evaluation) {
  std::string rows;
  rows += PartsText("cloud", evaluation.dense) + PartsText("mesh", evaluation.mesh) +
          PartsText("model", evaluation.proxy.surface);
  if (rows.empty()) return "";
  return fmt::format("\n{:<11} {:>12} {:>14} {:>14} {:>14} {:>14}\n", "", "95 % below",
                     "95 % of seen", "complete: seen", "three photos", "of everything") +
         rows +
         fmt::format(
             "(95 % of the result, and of what photos show, lie nearer to the other; "
             "complete: within {:g} m)\n",
             evaluation.tolerance_m) +
         (evaluation.proxy.truth_buildings > 0 ? "\n" + ProxyText(evaluation.proxy) : "");
}

// Beside what one ideal photo of the truth would reach.
std::string CeilingText(const Evaluation& evaluation) {
  if (evaluation.facades.empty()) return "";
  const auto of = [](const auto& result, const auto& ceiling) {
    return fmt::format("{} of {}", Decimal(result, 3), Decimal(ceiling, 3));
  };
  return fmt::format(
      "(SSIM of facades, of what one ideal photo has: {}; on walls' planes {}, on what stands out "
      "or lies back {})\n",
      of(evaluation.texture_mean.ssim, evaluation.ceiling_mean.ssim),
      of(evaluation.plane_mean.result.ssim, evaluation.plane_mean.ceiling.ssim),
      of(evaluation.relief_mean.result.ssim, evaluation.relief_mean.ceiling.ssim));
}

std::string PicturesText(const Evaluation& evaluation) {
  if (evaluation.facades.empty() && evaluation.views.empty()) return "";
  return fmt::format("\n{:<11} {:>7} {:>8} {:>7} {:>7} {:>7} {:>7}\n", "", "SSIM", "MS-SSIM",
                     "PSNR", "GMSD", "FLIP", "LPIPS") +
         PictureText("facades", evaluation.texture_mean) +
         PictureText("held out", evaluation.views_mean) +
         PictureText("  buildings", evaluation.views_buildings_mean) +
         fmt::format(
             "(facades: the {} of their area that are painted; held out: the {} of buildings that "
             "the model has)\n{}misregistration {} px, {}\n",
             Percent(evaluation.painted), Percent(evaluation.views_compared),
             CeilingText(evaluation), Decimal(evaluation.misregistration_px, 2),
             Metres(evaluation.misregistration_m));
}

std::string Text(const Evaluation& evaluation) {
  std::string text = evaluation.has_plan ? PlanText(evaluation.plan) : "";
  text += PosesText(evaluation.poses);
  text += SurfacesText(evaluation) + PicturesText(evaluation);
  for (const std::string& note : evaluation.notes) text += "note: " + note + "\n";
  return text;
}

int EvaluateAndPrint(const Program& program, evaluate::EvaluateRequest request) {
  const CommonOptions& common = program.common;
  request.survey = common.survey;
  request.threads = common.threads > 0 ? common.threads : AvailableCores();
  if (request.output.empty()) request.output = request.survey / "evaluation";
  const Evaluation evaluation = evaluate::Evaluate(request);
  evaluate::WriteEvaluation(evaluation, request.output);
  if (common.json) {
    std::cout << evaluate::EvaluationJson(evaluation) << "\n";
  } else if (!common.quiet) {
    std::cout << Text(evaluation)
              << fmt::format("Page: {}\n", (request.output / "evaluation.html").string());
  }
  return 0;
}

}  // namespace

void AddEvaluate(CLI::App& app, Program& program) {
  CLI::App& verb =
      AddVerb(app, {"evaluate", "Measure a simulated survey against the truth of its scene",
                    "stucco evaluate survey --truth town\n"
                    "stucco evaluate survey --truth town --tolerance 0.2 --json",
                    kEverydayGroup});
  AddSurveyArgument(verb, program);
  auto request = std::make_shared<evaluate::EvaluateRequest>();
  verb.add_option("--truth", request->scene, "Scene folder that the survey was flown in")
      ->type_name("SCENE")
      ->required();
  verb.add_option("--flight", request->flight,
                  "Survey folder with the truth of the flight; default: the survey itself")
      ->type_name("FOLDER");
  verb.add_option("-o,--out", request->output,
                  "Folder for figures, pictures and page; default: SURVEY/evaluation")
      ->type_name("FOLDER");
  verb.add_option("--tolerance", request->tolerance_m,
                  "Truth counts as complete where the result lies within this distance (default "
                  "0.1)")
      ->type_name("METRES")
      ->check(CLI::PositiveNumber.description(""));
  verb.add_option("--lpips", request->lpips_model,
                  "Network for LPIPS (ONNX); without it LPIPS is not measured")
      ->type_name("FILE");
  verb.callback([&program, request] {
    program.action = [&program, request] { return EvaluateAndPrint(program, *request); };
  });
}

}  // namespace stucco
