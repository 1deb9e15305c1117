// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/measure_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "evaluate/figures/attempt.h"
#include "evaluate/figures/means.h"
#include "evaluate/geometry/seen.h"
#include "evaluate/geometry/surface.h"
#include "evaluate/picture/compare_textures.h"
#include "evaluate/picture/page_pictures.h"
#include "survey/survey_folder.h"

namespace stucco::evaluate {
namespace {

namespace fs = std::filesystem;

// The scale of the truth's own pictures; that of simulate city where it has none.
double TruthTexel(const fs::path& scene) {
  constexpr double kUsualTexelM = 0.01;
  if (!fs::exists(scene / simulate::kTruthTextures)) return kUsualTexelM;
  double finest = 0;
  for (const TexturedFacet& facet : ReadTextureSet(scene / simulate::kTruthTextures).facets) {
    const double texel = facet.metres_per_texel;
    if (texel > 0 && !(finest > 0 && finest <= texel)) finest = texel;
  }
  return finest > 0 ? finest : kUsualTexelM;
}

simulate::Light MiddleLight(const simulate::Flight& flight) {
  const auto photos = DeliveredPhotos(flight);
  return photos.empty() ? simulate::Light{} : photos[photos.size() / 2]->light;
}

PictureFigures MeanOfViews(std::span<const HeldOutFigures> views,
                           PictureFigures HeldOutFigures::*part) {
  std::vector<WeightedPicture> pictures;
  for (const HeldOutFigures& view : views) pictures.push_back({view.*part, 1});
  return MeanFigures(pictures);
}

double MeanCompared(std::span<const HeldOutFigures> views) {
  double sum = 0;
  int count = 0;
  for (const HeldOutFigures& view : views) {
    if (!std::isfinite(view.compared)) continue;
    sum += view.compared;
    ++count;
  }
  return count > 0 ? sum / count : kNotMeasured;
}

}  // namespace

double PaintedShare(std::span<const FacadeFigures> facades) {
  double area_m2 = 0, painted_m2 = 0;
  for (const FacadeFigures& facade : facades) {
    area_m2 += facade.area_m2;
    painted_m2 += facade.area_m2 * facade.painted;
  }
  return area_m2 > 0 ? painted_m2 / area_m2 : kNotMeasured;
}

PictureFigures MeanOfFacades(std::span<const FacadeFigures> facades) {
  std::vector<WeightedPicture> pictures;
  for (const FacadeFigures& facade : facades) {
    pictures.push_back({facade.picture, facade.area_m2 * facade.painted});
  }
  return MeanFigures(pictures);
}

double MedianShift(std::span<const FacadeFigures> facades,
                   double (*shift_of)(const FacadeFigures&)) {
  std::vector<std::pair<double, double>> values;  // shift, area
  double area = 0;
  for (const FacadeFigures& facade : facades) {
    const double painted_m2 = facade.area_m2 * facade.painted;
    const double shift = shift_of(facade);
    if (!std::isfinite(shift) || !(painted_m2 > 0)) continue;
    values.emplace_back(shift, painted_m2);
    area += painted_m2;
  }
  std::sort(values.begin(), values.end());
  double below = 0;
  for (const auto& [shift, painted_m2] : values) {
    below += painted_m2;
    if (below >= area / 2) return shift;
  }
  return kNotMeasured;
}

namespace {

// Beside PSNR and SSIM, which are means, shifts are medians: a wall of repeated windows may be off
// by a whole one.
void SummariseCeilings(Evaluation& evaluation) {
  const std::span<const FacadeFigures> facades = evaluation.facades;
  std::vector<WeightedLikeness> ceilings;
  std::vector<WeightedPart> planes;
  std::vector<WeightedPart> reliefs;
  for (const FacadeFigures& facade : facades) {
    const double painted_m2 = facade.area_m2 * facade.painted;
    ceilings.push_back({facade.ceiling, painted_m2});
    planes.push_back({facade.plane, painted_m2});
    reliefs.push_back({facade.relief, painted_m2});
  }
  evaluation.ceiling_mean = MeanLikeness(ceilings);
  evaluation.plane_mean = MeanPart(planes);
  evaluation.relief_mean = MeanPart(reliefs);
  for (const FacadeFigures& facade : facades) {
    evaluation.occluded.free_m2 += facade.occluded.free_m2;
    evaluation.occluded.through_m2 += facade.occluded.through_m2;
  }
  const auto median = [&](double (*shift_of)(const FacadeFigures&)) {
    return MedianShift(facades, shift_of);
  };
  evaluation.ceiling_mean.shift_m = median([](const auto& f) { return f.ceiling.shift_m; });
  evaluation.plane_mean.result.shift_m =
      median([](const auto& f) { return f.plane.result.shift_m; });
  evaluation.plane_mean.ceiling.shift_m =
      median([](const auto& f) { return f.plane.ceiling.shift_m; });
  evaluation.relief_mean.result.shift_m =
      median([](const auto& f) { return f.relief.result.shift_m; });
  evaluation.relief_mean.ceiling.shift_m =
      median([](const auto& f) { return f.relief.ceiling.shift_m; });
}

// One note for all pictures of a kind that could not be read.
template <typename Figures>
void NoteProblems(const char* of_what, const std::vector<Figures>& all, Evaluation& evaluation) {
  const auto count = std::ranges::count_if(all, [](const auto& f) { return !f.problem.empty(); });
  if (count == 0) return;
  const auto first = std::ranges::find_if(all, [](const auto& f) { return !f.problem.empty(); });
  evaluation.notes.push_back(
      fmt::format("{} of {} {} cannot be read and are not measured, first: {}", count, all.size(),
                  of_what, first->problem));
}

void MeasureViews(const TextureComparison& comparison, const fs::path& flight_folder,
                  Evaluation& evaluation) {
  if (comparison.textures.model_glb.empty()) {
    evaluation.notes.emplace_back("views are not measured: the textures have no model");
    return;
  }
  evaluation.views = CompareViews(comparison, flight_folder);
  if (evaluation.views.empty()) {
    evaluation.notes.emplace_back("views are not measured: no photo of the flight was held out");
  }
  NoteProblems("photos held out", evaluation.views, evaluation);
  std::erase_if(evaluation.views, [](const HeldOutFigures& view) { return !view.problem.empty(); });
  evaluation.views_mean = MeanOfViews(evaluation.views, &HeldOutFigures::picture);
  evaluation.views_buildings_mean = MeanOfViews(evaluation.views, &HeldOutFigures::buildings);
  evaluation.views_compared = MeanCompared(evaluation.views);
}

}  // namespace

void MeasurePictures(const EvaluateRequest& request, const Truth& truth, simulate::Scene scene,
                     const Similarity& truth_from_world, Evaluation& evaluation) {
  const Proxy proxy = ReadProxy(request.survey / kFacetsFile);
  const TextureSet textures = ReadTextureSet(request.survey / kTexturesFile);
  std::vector<bool> occluders;
  for (const std::string& element : scene.elements)
    occluders.push_back(GroupOf(element) == kStandsAbout);
  const simulate::Renderer renderer(std::move(scene));
  const fs::path flight = request.flight.empty() ? request.survey : request.flight;
  const TextureComparison comparison{
      .texture_folder = (request.survey / kTexturesFile).parent_path(),
      .proxy = proxy,
      .textures = textures,
      .truth = truth.facets,
      .scene = renderer,
      .light = MiddleLight(truth.flight),
      .flight = truth.flight,
      .occluders = std::move(occluders),
      .truth_from_world = truth_from_world,
      .truth_texel_m = TruthTexel(request.scene),
      .output = request.output,
      .lpips_model = request.lpips_model,
      .threads = request.threads};
  if (!request.output.empty()) RemovePagePictures(request.output);
  evaluation.facades = CompareFacades(comparison);
  evaluation.texture_mean = MeanOfFacades(evaluation.facades);
  evaluation.painted = PaintedShare(evaluation.facades);
  SummariseCeilings(evaluation);
  evaluation.misregistration_px =
      MedianShift(evaluation.facades, [](const auto& facade) { return facade.misregistration_px; });
  evaluation.misregistration_m = MedianShift(evaluation.facades, [](const auto& facade) {
    return facade.misregistration_px * facade.texel_m;
  });
  NoteProblems("walls have pictures that", evaluation.facades, evaluation);
  Attempt(
      "views are", [&] { MeasureViews(comparison, flight, evaluation); }, evaluation);
}

}  // namespace stucco::evaluate
