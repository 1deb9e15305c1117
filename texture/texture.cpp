// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/texture.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "survey/error.h"
#include "survey/survey_folder.h"
#include "survey/texture_set.h"
#include "texture/light/facet_light.h"
#include "texture/output/explain.h"
#include "texture/output/file_names.h"
#include "texture/painting/facet_unit.h"
#include "texture/painting/paint.h"
#include "texture/steps.h"
#include "texture/views/input.h"

namespace stucco {
namespace {

// A picture this much coarser than its photos is worth a note.
constexpr double kNotedCoarseness = 1.1;

// All there is to paint.
struct Painting {
  std::vector<const Facet*> facets;
  std::vector<FacetLook> looks;  // by facet
  PhotosLight light;
};

// What painting needs, by facet.
std::vector<uint64_t> BytesOf(const Painting& painting, const PaintScene& scene,
                              const TextureOptions& options) {
  std::vector<uint64_t> bytes;
  for (size_t i = 0; i < painting.facets.size(); ++i) {
    bytes.push_back(PaintingBytes(*painting.facets[i], painting.looks[i], scene, options));
  }
  return bytes;
}

std::vector<TexturedFacet> PaintAll(const Painting& painting, const TextureInput& input,
                                    const PaintScene& scene, const TextureOptions& options,
                                    const StageContext& context) {
  const std::vector<const Facet*>& facets = painting.facets;
  std::vector<std::string> ids;
  ids.reserve(facets.size());
  for (const Facet* facet : facets) ids.push_back(facet->id);
  const std::vector<std::string> names = FileNames(ids);
  std::vector<TexturedFacet> textured(facets.size());
  context.progress->Begin("painting facets", facets.size());
  ForEachFacet(BytesOf(painting, scene, options), context, [&](size_t i) {
    context.ThrowIfCancelled();
    const PhotosLight light = LightOnFacet(painting.light, painting.looks[i].ratios);
    const std::string key = FilesKey(*facets[i], painting.looks[i], input, light, options);
    const auto paint = [&](PaintRecord* record) {
      return PaintFacet({*facets[i], painting.looks[i], light.gains, scene, options}, record);
    };
    FacetFiles files = UnpackFiles(ComputeUnit(context, "texture_facet", key, [&] {
      const PaintedFacet painted = paint(nullptr);
      return PackFiles(
          MakeFacetFiles(*facets[i], painted, input.photos, light.gains, options.orthophotos));
    }));
    if (options.debug) {
      PaintRecord record;
      const PaintedFacet painted = paint(&record);
      WriteExplanation(record, painted, input.photos, context.out / "debug" / names[i]);
    }
    textured[i] = StoreFacet(std::move(files), *facets[i], names[i], input, context.out);
    context.progress->Advance();
  });
  return textured;
}

void NoteLimited(const std::vector<TexturedFacet>& facets, int max_texture_px, Progress& progress) {
  for (const TexturedFacet& facet : facets) {
    const double ratio = facet.metres_per_texel / facet.wanted_metres_per_texel;
    if (facet.image.empty() || !(ratio > kNotedCoarseness)) continue;
    progress.Note(fmt::format(
        "{}: the picture is {:.1f} times coarser than the photos: raise texture.max_texture_px "
        "(now {})",
        facet.id, ratio, max_texture_px));
  }
}

void ReportFindings(const std::vector<TexturedFacet>& facets, Progress& progress) {
  size_t painted = 0;
  std::set<std::string> photos;
  double uses = 0;
  size_t planned_uses = 0;
  for (const TexturedFacet& facet : facets) {
    if (facet.image.empty()) continue;
    ++painted;
    uses += static_cast<double>(facet.photos.size());
    planned_uses += facet.planned_photos.size();
    photos.insert(facet.photos.begin(), facet.photos.end());
  }
  if (painted == 0) {
    throw Error(ErrorKind::kStageFailed,
                fmt::format("none of the {} facets is seen by any photo", facets.size()),
                "check that the proxy and the camera poses are of the same survey; a wider "
                "texture.max_angle_deg admits more oblique photos");
  }
  progress.Note(fmt::format("painted {} of {} facets with {} photos, {:.1f} per facet", painted,
                            facets.size(), photos.size(), uses / static_cast<double>(painted)));
  if (planned_uses > 0) {
    progress.Note(fmt::format("{} of these {:.0f} uses are of photos planned for the facade",
                              planned_uses, uses));
  }
  if (painted < facets.size()) {
    progress.Note(fmt::format("{} facets are seen by no photo and stay without a picture",
                              facets.size() - painted));
  }
}

}  // namespace

void RunTexture(const TextureOptions& options, StageContext& context) {
  // 1. What there is.
  const TextureInput input = ReadTextureInput(context, options);
  Painting painting;
  painting.facets = FacetsToPaint(input.proxy, options.ground);
  for (const char* folder : {"textures", "labels"}) {
    std::filesystem::create_directories(context.out / folder);
  }
  if (options.orthophotos) std::filesystem::create_directories(context.out / "orthophotos");

  // 2. What hides what.
  const OcclusionScene occlusion(input.proxy);
  const std::vector<NearestPoints> nearest = SplatAll(input, context);
  PaintScene scene{{input.photos, &occlusion, nearest, input.cloud.positions},
                   nullptr,
                   input.proxy.up.normalized(),
                   input.proxy.metric};

  // 3. Who sees each facet, how finely and how brightly.
  {
    PhotoCache as_taken(context.photos, context.memory_limit_bytes / 3);
    scene.cache = &as_taken;
    painting.looks = LookAtAll(painting.facets, input, scene, options, context);
  }
  painting.light = LightFrom(painting.looks, input.photos, *context.progress);
  PhotoCache even = EvenPhotos(input.photos, painting.light, context);
  scene.cache = &even;

  // 4. Paint.
  TextureSet textures;
  textures.facets = PaintAll(painting, input, scene, options, context);
  ReportFindings(textures.facets, *context.progress);
  NoteLimited(textures.facets, options.max_texture_px, *context.progress);

  // 5. The model and its table of contents.
  context.ThrowIfCancelled();
  WriteModels(input.proxy, options, context, textures);
  WriteTextureSet(textures, context.out / "textures.json");
}

}  // namespace stucco
