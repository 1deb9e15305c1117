// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// evaluate_page_maker FOLDER: writes a made evaluation's page with its pictures, for the browser
// test and for looking at the page.
#include <cstdlib>
#include <filesystem>
#include <string>

#include "evaluate/page/evaluation_page.h"
#include "evaluate/picture/measure.h"
#include "evaluate/picture/misregistration.h"
#include "evaluate/picture/page_pictures.h"
#include "tests/evaluate/made_pictures.h"

namespace {

using stucco::evaluate::Evaluation;
using stucco::evaluate::FacadeFigures;
using stucco::evaluate::PicturePair;

FacadeFigures MadeFacade(const std::string& id, const PicturePair& pair, size_t number,
                         const std::filesystem::path& folder) {
  const auto measured = stucco::evaluate::MeasurePair(pair);
  const auto names = stucco::evaluate::WritePagePictures(pair, measured.flip, folder,
                                                         stucco::evaluate::PictureStem(number, id));
  return {.id = id,
          .facet = id,
          .area_m2 = pair.truth.width_px * pair.truth.height_px * 1e-4,
          .painted = 0.9,
          .picture = measured.figures,
          .texel_m = 0.01,
          .misregistration_px = stucco::evaluate::Misregistration(pair),
          .truth_picture = names.truth,
          .result_picture = names.result,
          .error_picture = names.error};
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  std::filesystem::create_directories(folder);
  Evaluation evaluation;
  const std::string hostile = "\"><img src=x onerror=document.title='owned'>";
  evaluation.survey = hostile;
  evaluation.scene = "<script>document.title='owned'</script>";
  evaluation.notes = {hostile, "nothing of the mesh is measured: there is no dense/mesh.ply"};
  evaluation.poses = {.posed = 41, .total = 42, .position_mean_m = 0.012};
  evaluation.dense.all = {.error95_m = 0.031, .completeness = 0.87, .completeness_all = 0.7};
  const stucco::Image truth = stucco::evaluate::Waves(420, 240);
  const stucco::Image moved = stucco::evaluate::Waves(420, 240, 1.5);
  evaluation.facades = {
      MadeFacade("B0001/F00", {truth, stucco::evaluate::Smoothed(truth, 2), {}}, 0, folder),
      MadeFacade("B0001/F10", {truth, moved, {}}, 1, folder),
      MadeFacade("B0001/F9" + hostile, {truth, stucco::evaluate::Noisy(truth, 9), {}}, 2, folder),
      FacadeFigures{}};
  evaluation.facades.back().id = "B0002/F00";
  evaluation.texture_mean = evaluation.facades[0].picture;
  const FacadeFigures& first = evaluation.facades[0];
  evaluation.views = {{hostile, 0.8, first.picture, first.truth_picture, first.result_picture,
                       first.error_picture}};
  evaluation.views_mean = first.picture;
  stucco::evaluate::WriteEvaluationPage(evaluation, folder);
  return 0;
}
