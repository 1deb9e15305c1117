// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "evaluate/figures/attempt.h"
#include "evaluate/figures/means.h"
#include "evaluate/geometry/match_facets.h"
#include "evaluate/geometry/moved.h"
#include "evaluate/picture/compare_textures.h"
#include "evaluate/picture/facade_picture.h"
#include "evaluate/picture/ideal_photo.h"
#include "evaluate/picture/likeness.h"
#include "evaluate/picture/lpips.h"
#include "evaluate/picture/measure.h"
#include "evaluate/picture/misregistration.h"
#include "evaluate/picture/page_pictures.h"
#include "evaluate/picture/painted_through.h"
#include "evaluate/picture/tone.h"
#include "survey/parallel.h"

namespace stucco::evaluate {
namespace {

using simulate::Radiance;

// Spots of this size tell the gains: content and small shifts are averaged away. The middle of each
// facade has enough of them.
constexpr double kGainTexel_m = 0.16;
constexpr int kGainSide_px = 640;
// Pictures with more texels are compared coarser; FLIP needs some hundred bytes for each.
constexpr double kMostTexels = 8e6;

// A facet with a picture that lies on a wall of the truth.
struct Pairing {
  const Facet* truth = nullptr;
  const Facet* result = nullptr;
  const TexturedFacet* texture = nullptr;
};

std::string BuildingOf(const std::string& id) {
  return id.substr(0, id.find('/'));
}

// Elements that rays to a building's wall pass: occluders, and other buildings, which may be nearer
// than the rays begin.
std::vector<bool> LeftOut(const TextureComparison& comparison, const std::string& building) {
  const std::vector<std::string>& elements = comparison.scene.scene().elements;
  std::set<std::string> others;
  for (const Building& other : comparison.truth.buildings) others.insert(other.id);
  others.erase(building);
  std::vector<bool> left_out(elements.size(), false);
  for (size_t i = 0; i < elements.size(); ++i) {
    left_out[i] = (i < comparison.occluders.size() && comparison.occluders[i]) ||
                  others.contains(BuildingOf(elements[i]));
  }
  return left_out;
}

simulate::RenderOptions DrawingOf(const TextureComparison& comparison, const Facet& truth) {
  return {.threads = 1, .left_out = LeftOut(comparison, BuildingOf(truth.id))};
}

simulate::Light ClearLight(const TextureComparison& comparison) {
  simulate::Light light = comparison.light;
  light.haze_m = 0;
  return light;
}

Radiance DrawTruth(const TextureComparison& comparison, const Facet& truth,
                   const simulate::PicturePlane& plane) {
  return comparison.scene.Flatten(plane, ClearLight(comparison), DrawingOf(comparison, truth));
}

// How far before the wall's own plane, which is not quite the picture's, what texels show lies.
std::vector<float> HeightsOf(const TextureComparison& comparison, const Facet& truth,
                             const simulate::PicturePlane& plane) {
  std::vector<float> heights = comparison.scene.Heights(plane, DrawingOf(comparison, truth));
  const Eigen::Vector3d towards_us = plane.v_axis.cross(plane.u_axis).normalized();
  for (size_t i = 0; i < heights.size(); ++i) {
    const size_t column = i % plane.width_px, row = i / plane.width_px;
    const double x = static_cast<double>(column) + 0.5;
    const double y = static_cast<double>(row) + 0.5;
    const Eigen::Vector3d place = plane.origin +
                                  plane.metres_per_texel * (x * plane.u_axis + y * plane.v_axis) +
                                  heights[i] * towards_us;
    heights[i] = static_cast<float>(truth.normal.dot(place) - truth.offset);
  }
  return heights;
}

// The result's picture on the overlap of both outlines, with texels of at least `texel_m`.
FacadePicture ReadOverlap(const TextureComparison& comparison, const Pairing& pairing,
                          double texel_m) {
  FacadePicture picture =
      ReadFacadePicture(*pairing.texture, comparison.texture_folder, comparison.truth_from_world);
  KeepInside(*pairing.truth, picture);
  KeepInside(Moved(*pairing.result, comparison.truth_from_world), picture);
  picture = Cropped(picture);
  return Coarsened(picture, texel_m / picture.plane.metres_per_texel);
}

double ComparedTexel_m(const TextureComparison& comparison, const TexturedFacet& texture) {
  const double own = comparison.truth_from_world.scale * texture.metres_per_texel;
  const double texels = static_cast<double>(texture.width_px) * texture.height_px;
  return std::max({own, comparison.truth_texel_m, own * std::sqrt(texels / kMostTexels)});
}

LightPairs PairsOfLight(const TextureComparison& comparison, const Pairing& pairing) {
  LightPairs pairs;
  const double texel_m = ComparedTexel_m(comparison, *pairing.texture);
  FacadePicture result = Middle(ReadOverlap(comparison, pairing, texel_m), kGainSide_px);
  if (CountKnown(result) == 0) return pairs;
  // Drawn with the texels that are compared, for coarser ones have a light of their own: edges.
  FacadePicture truth = result;
  truth.rgb = DrawTruth(comparison, *pairing.truth, truth.plane).rgb;
  const double factor = kGainTexel_m / result.plane.metres_per_texel;
  result = Coarsened(result, factor);
  truth = Coarsened(truth, factor);
  for (size_t i = 0; i < result.known.size(); ++i) {
    if (result.known[i] != 0) pairs.Add(&truth.rgb[3 * i], &result.rgb[3 * i]);
  }
  return pairs;
}

std::array<double, 3> GainsOf(const TextureComparison& comparison,
                              const std::vector<std::vector<Pairing>>& walls) {
  std::vector<LightPairs> of_walls(walls.size());
  ParallelFor(walls.size(), comparison.threads, [&](size_t i) {
    for (const Pairing& pairing : walls[i]) {
      // What cannot be read is said where it is compared.
      ProblemIn([&] { of_walls[i].Append(PairsOfLight(comparison, pairing)); });
    }
  });
  LightPairs all;
  for (const LightPairs& pairs : of_walls) all.Append(pairs);
  return FitGains(std::move(all));
}

struct ComparedFacade {
  double area_m2 = 0;  // painted and in both outlines
  simulate::PicturePlane plane;
  PicturePair pictures;

  double texel_m() const { return plane.metres_per_texel; }
};

std::optional<ComparedFacade> Compare(const TextureComparison& comparison, const Pairing& pairing,
                                      const std::array<double, 3>& gains) {
  const FacadePicture result =
      ReadOverlap(comparison, pairing, ComparedTexel_m(comparison, *pairing.texture));
  const size_t known = CountKnown(result);
  if (known == 0) return std::nullopt;
  const ImageSize size{result.plane.width_px, result.plane.height_px};
  const Radiance truth = DrawTruth(comparison, *pairing.truth, result.plane);
  const double texel_m = result.plane.metres_per_texel;
  return ComparedFacade{
      static_cast<double>(known) * texel_m * texel_m,
      result.plane,
      {Developed(truth.rgb, size, gains), Developed(result.rgb, size, {1, 1, 1}), result.known}};
}

// Everything that a wall is measured with.
struct Measuring {
  const TextureComparison& comparison;
  std::array<double, 3> gains = {1, 1, 1};
  const Lpips* lpips = nullptr;
};

// What is measured of one facet on a wall.
struct MeasuredFacade {
  double area_m2 = 0;
  double texel_m = 0;
  PictureFigures picture;
  double shift_px = kNotMeasured;
  Likeness ceiling;
  LikenessOfPart plane;
  LikenessOfPart relief;
};

// Ideal photos of the compared texels against the truth. Texels that they do not show are out.
std::optional<PicturePair> IdealPair(const Measuring& measuring, const Pairing& pairing,
                                     const ComparedFacade& compared, double distance_m) {
  const TextureComparison& comparison = measuring.comparison;
  if (!(distance_m > 0) || comparison.flight.photos.empty()) return std::nullopt;
  IdealPicture ideal =
      TakeIdealPhotos({.scene = comparison.scene,
                       .light = ClearLight(comparison),
                       .left_out = LeftOut(comparison, BuildingOf(pairing.truth->id)),
                       .lens = comparison.flight.photos.front().camera,
                       .faults = comparison.flight.faults,
                       .distance_m = distance_m,
                       .gains = measuring.gains},
                      compared.plane);
  std::vector<uint8_t>& shown = ideal.shown;
  for (size_t i = 0; i < shown.size(); ++i) shown[i] &= compared.pictures.mask[i];
  return PicturePair{compared.pictures.truth, std::move(ideal.picture), std::move(shown)};
}

LikenessOfPart MeasurePart(const ComparedFacade& compared, const std::optional<PicturePair>& ideal,
                           const std::vector<uint8_t>& part, double share) {
  LikenessOfPart out{.share = share, .result = {}, .ceiling = {}};
  out.result =
      LikenessOf({compared.pictures.truth, compared.pictures.result, part}, compared.texel_m());
  if (!ideal) return out;
  std::vector<uint8_t> shown = part;
  for (size_t i = 0; i < shown.size(); ++i) shown[i] &= ideal->mask[i];
  out.ceiling = LikenessOf({ideal->truth, ideal->result, std::move(shown)}, compared.texel_m());
  return out;
}

// `page_stem` names the pictures of the page; empty: none are written.
MeasuredFacade Measure(const Measuring& measuring, const Pairing& pairing,
                       const ComparedFacade& compared, FacadeFigures& figures,
                       const std::string& page_stem) {
  MeasuredFacade out;
  out.area_m2 = compared.area_m2;
  out.texel_m = compared.texel_m();
  const MeasuredPair measured = MeasurePair(compared.pictures, measuring.lpips);
  out.picture = measured.figures;
  out.shift_px = Misregistration(compared.pictures);
  const auto ideal = IdealPair(measuring, pairing, compared, figures.ideal_distance_m);
  if (ideal) out.ceiling = LikenessOf(*ideal, out.texel_m);
  const WallParts parts =
      PartsOfWall(HeightsOf(measuring.comparison, *pairing.truth, compared.plane),
                  compared.pictures.mask, {compared.plane.width_px, compared.plane.height_px});
  out.plane = MeasurePart(compared, ideal, parts.plane, parts.plane_share);
  out.relief = MeasurePart(compared, ideal, parts.relief, 1 - parts.plane_share);
  if (page_stem.empty()) return out;
  const PagePictures names =
      WritePagePictures(compared.pictures, measured.flip, measuring.comparison.output, page_stem);
  figures.truth_picture = names.truth;
  figures.result_picture = names.result;
  figures.error_picture = names.error;
  return out;
}

// What the facets on one wall say together, by their painted area.
void Summarise(std::span<const MeasuredFacade> facets, FacadeFigures& figures) {
  double painted_m2 = 0;
  double texel_sum = 0;
  double shift_sum = 0;
  double shift_m2 = 0;
  std::vector<WeightedPicture> pictures;
  std::vector<WeightedLikeness> ceilings;
  std::vector<WeightedPart> planes;
  std::vector<WeightedPart> reliefs;
  for (const MeasuredFacade& facet : facets) {
    painted_m2 += facet.area_m2;
    texel_sum += facet.area_m2 * facet.texel_m;
    if (!std::isnan(facet.shift_px)) {
      shift_sum += facet.area_m2 * facet.shift_px;
      shift_m2 += facet.area_m2;
    }
    pictures.push_back({facet.picture, facet.area_m2});
    ceilings.push_back({facet.ceiling, facet.area_m2});
    planes.push_back({facet.plane, facet.area_m2});
    reliefs.push_back({facet.relief, facet.area_m2});
  }
  figures.painted = figures.area_m2 > 0 ? std::min(1.0, painted_m2 / figures.area_m2) : 0;
  figures.picture = MeanFigures(pictures);
  figures.ceiling = MeanLikeness(ceilings);
  figures.plane = MeanPart(planes);
  figures.relief = MeanPart(reliefs);
  if (painted_m2 > 0) figures.texel_m = texel_sum / painted_m2;
  if (shift_m2 > 0) figures.misregistration_px = shift_sum / shift_m2;
}

// The page shows the facet with the largest overlap.
FacadeFigures MeasureWall(const Measuring& measuring, const TruthFacet& wall,
                          const std::vector<Pairing>& pairings, size_t number) {
  const TextureComparison& comparison = measuring.comparison;
  FacadeFigures figures;
  figures.id = wall.truth->id;
  figures.area_m2 = wall.truth->seen * wall.area_m2;  // the rest is below the ground
  if (!wall.matches.empty()) figures.facet = wall.matches.front().result->id;
  if (!pairings.empty()) {
    figures.ideal_distance_m =
        IdealDistance(*wall.truth, comparison.flight.photos, comparison.scene);
  }
  std::vector<MeasuredFacade> facets;
  const std::vector<bool> not_of_building = LeftOut(comparison, BuildingOf(wall.truth->id));
  for (const Pairing& pairing : pairings) {
    std::optional<ComparedFacade> compared;
    const std::string problem =
        ProblemIn([&] { compared = Compare(comparison, pairing, measuring.gains); });
    if (figures.problem.empty()) figures.problem = problem;
    if (!compared) continue;
    facets.push_back(Measure(measuring, pairing, *compared, figures,
                             facets.empty() ? PictureStem(number, figures.id) : ""));
    const auto [free_m2, through_m2] = PaintedThrough(
        comparison, {*pairing.truth, *pairing.result, *pairing.texture, not_of_building});
    figures.occluded.free_m2 += free_m2;
    figures.occluded.through_m2 += through_m2;
  }
  Summarise(facets, figures);
  return figures;
}

std::vector<Pairing> PairingsOf(const TruthFacet& wall,
                                const std::map<std::string, const TexturedFacet*>& textures) {
  std::vector<Pairing> pairings;
  for (const FacetMatch& match : wall.matches) {
    const auto texture = textures.find(match.result->id);
    if (texture == textures.end() || texture->second->image.empty()) continue;
    pairings.push_back({wall.truth, match.result, texture->second});
  }
  return pairings;
}

}  // namespace

std::vector<FacadeFigures> CompareFacades(const TextureComparison& comparison) {
  std::map<std::string, const TexturedFacet*> textures;
  for (const TexturedFacet& facet : comparison.textures.facets) textures[facet.id] = &facet;
  std::vector<TruthFacet> walls;
  std::vector<std::vector<Pairing>> pairings;
  for (TruthFacet& facet :
       MatchFacets(comparison.proxy, comparison.truth, comparison.truth_from_world)) {
    if (!IsFacade(*facet.truth)) continue;
    pairings.push_back(PairingsOf(facet, textures));
    walls.push_back(std::move(facet));
  }
  std::optional<Lpips> lpips;
  if (!comparison.lpips_model.empty()) lpips.emplace(comparison.lpips_model);
  const Measuring measuring{comparison, GainsOf(comparison, pairings), lpips ? &*lpips : nullptr};
  std::vector<FacadeFigures> figures(walls.size());
  ParallelFor(walls.size(), comparison.threads,
              [&](size_t i) { figures[i] = MeasureWall(measuring, walls[i], pairings[i], i); });
  return figures;
}

}  // namespace stucco::evaluate
