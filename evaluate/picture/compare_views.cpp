// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <limits>
#include <optional>

#include "evaluate/figures/attempt.h"
#include "evaluate/geometry/surface.h"
#include "evaluate/picture/compare_textures.h"
#include "evaluate/picture/lpips.h"
#include "evaluate/picture/measure.h"
#include "evaluate/picture/page_pictures.h"
#include "evaluate/picture/photo_light.h"
#include "evaluate/picture/tone.h"
#include "simulate/scene/scene_folder.h"
#include "survey/srgb.h"

namespace stucco::evaluate {
namespace {

using simulate::FlownPhoto;
using simulate::Renderer;

// Photos are compared at most this large: models hold pictures of limited size anyway.
constexpr int kViewSide_px = 1600;
// ... and the gains are fitted on pictures of this size, where small shifts are averaged away.
constexpr int kViewGainSide_px = 200;
// What stands nearer than the scene without occluders does, is one.
constexpr float kInFront_m = 0.05f;

// model.glb has the world's coordinates, turned so that up is z, less an offset (texture_set.h).
Similarity ModelFromScene(const TextureComparison& comparison) {
  const Similarity world_from_scene = comparison.truth_from_world.Inverse();
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(comparison.proxy.up, Eigen::Vector3d::UnitZ());
  return {world_from_scene.scale, (turn * world_from_scene.rotation).normalized(),
          turn * (world_from_scene.translation - comparison.textures.model_offset)};
}

struct View {
  Camera camera;
  Image photo;
  Image model;                     // codes of the textures
  std::vector<uint8_t> mask;       // by pixel: the model has what the photo shows
  std::vector<uint8_t> buildings;  // by pixel: the photo shows a building
};

std::vector<uint8_t> MaskOf(const DepthMap& model, const DepthMap& scene,
                            const DepthMap& scene_without) {
  std::vector<uint8_t> mask(model.depths.size(), 0);
  for (size_t i = 0; i < mask.size(); ++i) {
    const bool occluded =
        scene.depths[i] > 0 &&
        (!(scene_without.depths[i] > 0) || scene.depths[i] < scene_without.depths[i] - kInFront_m);
    mask[i] = model.depths[i] > 0 && !occluded ? 1 : 0;
  }
  return mask;
}

std::vector<uint8_t> ShowsBuildings(const DepthMap& scene, const DepthMap& buildings) {
  std::vector<uint8_t> shows(scene.depths.size());
  for (size_t i = 0; i < shows.size(); ++i) {
    const bool is_hidden = scene.depths[i] < buildings.depths[i] - kInFront_m;
    shows[i] = buildings.depths[i] > 0 && !is_hidden ? 1 : 0;
  }
  return shows;
}

// Of the photo's pixels that show a building, those that are in the mask.
std::vector<uint8_t> ComparedBuildings(const View& view) {
  std::vector<uint8_t> both = view.mask;
  for (size_t i = 0; i < both.size(); ++i) both[i] &= view.buildings[i];
  return both;
}

// How much of the buildings is compared, and how like they are; not measured where there are none.
void MeasureBuildings(const View& view, PicturePair pair, const Lpips* lpips,
                      HeldOutFigures& figures) {
  pair.mask = ComparedBuildings(view);
  const auto shown = std::ranges::count(view.buildings, 1);
  const auto compared = std::ranges::count(pair.mask, 1);
  if (shown > 0) figures.compared = static_cast<double>(compared) / static_cast<double>(shown);
  if (compared > 0) figures.buildings = MeasurePair(pair, lpips).figures;
}

// Elements of the scene that are no buildings.
std::vector<bool> NoBuildings(const Renderer& scene) {
  std::vector<bool> others;
  for (const std::string& element : scene.scene().elements) {
    others.push_back(!IsOfBuilding(GroupOf(element)));
  }
  return others;
}

// Textures carry their light; the model's colours are their codes.
Image Codes(const simulate::Radiance& radiance) {
  Image image{radiance.width_px, radiance.height_px, 3, {}};
  image.data.reserve(radiance.rgb.size());
  for (const float light : radiance.rgb) image.data.push_back(SrgbCode(light));
  return image;
}

View MakeView(const TextureComparison& comparison, const Renderer& model, const FlownPhoto& flown,
              const std::filesystem::path& flight_folder, int side_px) {
  View view;
  view.photo = ReadJpeg(flight_folder / simulate::kTruthFolder / flown.path, 3, side_px);
  view.camera = Resized(flown.camera, view.photo.width_px, view.photo.height_px);
  const Pose cam_from_model = Transformed(flown.cam_from_world, ModelFromScene(comparison));
  const simulate::RenderOptions all{.threads = comparison.threads, .left_out = {}};
  view.model = Codes(model.Photograph(view.camera, cam_from_model, {.lit = false}, all));
  const auto depth_without = [&](const std::vector<bool>& left_out) {
    return comparison.scene.Depth(view.camera, flown.cam_from_world,
                                  {.threads = comparison.threads, .left_out = left_out});
  };
  const DepthMap scene = depth_without({});
  view.mask = MaskOf(model.Depth(view.camera, cam_from_model, all), scene,
                     depth_without(comparison.occluders));
  view.buildings = ShowsBuildings(scene, depth_without(NoBuildings(comparison.scene)));
  return view;
}

double RadiusAt(const View& view, size_t pixel) {
  const size_t width = view.photo.width_px;
  const size_t row = pixel / width;
  const size_t column = pixel % width;
  return RadiusSquared(view.camera, static_cast<double>(column) + 0.5,
                       static_cast<double>(row) + 0.5);
}

std::vector<float> LightOf(const Image& image) {
  std::vector<float> light;
  light.reserve(image.data.size());
  for (const uint8_t code : image.data) light.push_back(LightOfCode(code));
  return light;
}

std::vector<LightSample> SamplesOf(const View& view) {
  std::vector<LightSample> samples;
  const std::vector<float> photo = LightOf(view.photo);
  const std::vector<float> model = LightOf(view.model);
  for (size_t i = 0; i < view.mask.size(); ++i) {
    if (view.mask[i] == 0) continue;
    const auto ratios = LogRatios(&model[3 * i], &photo[3 * i]);
    if (ratios) samples.push_back({*ratios, RadiusAt(view, i)});
  }
  return samples;
}

// What the model would look like to the photo's camera.
PicturePair Pair(const View& view, const std::array<double, 3>& gains, const Falloff& falloff) {
  std::vector<float> light = LightOf(view.model);
  for (size_t i = 0; i < view.mask.size(); ++i) {
    const double arriving = falloff.At(RadiusAt(view, i));
    for (size_t c = 0; c < 3; ++c) light[3 * i + c] *= static_cast<float>(arriving);
  }
  const ImageSize size{view.photo.width_px, view.photo.height_px};
  return {view.photo, Developed(light, size, gains), view.mask};
}

}  // namespace

std::vector<HeldOutFigures> CompareViews(const TextureComparison& comparison,
                                         const std::filesystem::path& flight_folder) {
  std::vector<const FlownPhoto*> held_out;
  for (const FlownPhoto& photo : comparison.flight.photos) {
    if (photo.held_out && !photo.lost) held_out.push_back(&photo);
  }
  if (held_out.empty()) return {};
  const Renderer model(
      simulate::ReadScene(comparison.texture_folder / comparison.textures.model_glb));
  std::vector<HeldOutFigures> figures(held_out.size());
  std::vector<std::vector<LightSample>> samples(held_out.size());
  for (size_t i = 0; i < held_out.size(); ++i) {
    figures[i].photo = held_out[i]->path;
    figures[i].problem = ProblemIn([&] {
      samples[i] =
          SamplesOf(MakeView(comparison, model, *held_out[i], flight_folder, kViewGainSide_px));
    });
  }
  const PhotoLight fitted = FitPhotoLight(samples);
  std::optional<Lpips> lpips;
  if (!comparison.lpips_model.empty()) lpips.emplace(comparison.lpips_model);
  for (size_t i = 0; i < held_out.size(); ++i) {
    if (!figures[i].problem.empty()) continue;
    const FlownPhoto& photo = *held_out[i];
    const View view = MakeView(comparison, model, photo, flight_folder, kViewSide_px);
    const PicturePair pair = Pair(view, fitted.gains[i], fitted.falloff);
    const MeasuredPair measured = MeasurePair(pair, lpips ? &*lpips : nullptr);
    const PagePictures names = WritePagePictures(pair, measured.flip, comparison.output,
                                                 PictureStem(i, "view-" + photo.path));
    figures[i].picture = measured.figures;
    MeasureBuildings(view, pair, lpips ? &*lpips : nullptr, figures[i]);
    figures[i].truth_picture = names.truth;
    figures[i].result_picture = names.result;
    figures[i].error_picture = names.error;
  }
  return figures;
}

}  // namespace stucco::evaluate
