// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/repaint.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "survey/error.h"
#include "survey/facet_picture.h"
#include "survey/files.h"
#include "survey/image.h"
#include "survey/survey_folder.h"
#include "survey/texture_set.h"
#include "texture/epoch/epoch_facet.h"
#include "texture/light/colour.h"
#include "texture/light/facet_light.h"
#include "texture/output/file_names.h"
#include "texture/painting/paint.h"
#include "texture/steps.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// Bytes per texel that comparing and joining two pictures needs, files included.
constexpr uint64_t kBytesPerTexel = 48;
constexpr uint64_t kBytesPerReadTexel = 13;  // of a picture and its labels, while they are read

uint64_t NumTexels(const TexturedFacet& facet) {
  return static_cast<uint64_t>(facet.width_px) * static_cast<uint64_t>(facet.height_px);
}

// All that repainting works with.
struct Work {
  const TextureOptions& options;
  const RepaintRequest& request;
  const TextureInput& input;  // with the new photos
  PaintScene scene;
  const StageContext& context;
  const TextureSet& old;
  std::span<const SurveyPhoto> of_survey;           // those that the pictures of `old` are from
  std::vector<const Facet*> facets = {};            // by facet of `old`
  std::vector<FacetLook> looks = {};                // likewise
  PhotosLight light = {};                           // of the new photos, against each other
  Eigen::Vector3d level = Eigen::Vector3d::Ones();  // of all new photos, against the old pictures
  std::vector<uint64_t> texels = {};                // of the larger picture, by facet of `old`

  fs::path OldFolder() const { return (context.survey / kTexturesFile).parent_path(); }
};

std::vector<const Facet*> FacetsOf(const TextureSet& textures, const Proxy& proxy) {
  std::map<std::string, const Facet*> by_id;
  for (const Facet* facet : FacetsToPaint(proxy, true)) by_id[facet->id] = facet;
  std::vector<const Facet*> facets;
  for (const TexturedFacet& textured : textures.facets) {
    const auto facet = by_id.find(textured.id);
    if (facet == by_id.end()) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}: facet {} is not in {}", kTexturesFile, textured.id, kFacetsFile),
                  "make the survey's textures again first: stucco texture SURVEY");
    }
    if (!textured.image.empty() && !FitsFacet(textured, *facet->second)) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}: the picture of {} was painted on another model than that of {}",
                              kTexturesFile, textured.id, kFacetsFile),
                  "make the survey's textures again first: stucco texture SURVEY");
    }
    facets.push_back(facet->second);
  }
  return facets;
}

// Looks at every facet, to be painted on the grid that it has.
void LookAtFacets(Work& work) {
  work.looks = LookAtAll(work.facets, work.input, work.scene, work.options, work.context);
  for (size_t i = 0; i < work.facets.size(); ++i) {
    const TexturedFacet& old = work.old.facets[i];
    if (old.image.empty()) continue;
    work.looks[i].grid = GridOf(old, *work.facets[i]);
    work.looks[i].grid->relief = ReadRelief(work.OldFolder(), fs::path(old.image).stem().string());
  }
  if (std::ranges::all_of(work.looks, [](const FacetLook& l) { return l.candidates.empty(); })) {
    throw Error(ErrorKind::kStageFailed, "the new photos show no facet of the model",
                "check that they show the buildings of the survey; a wider texture.max_angle_deg "
                "admits more oblique photos");
  }
  work.light = LightFrom(work.looks, work.input.photos, *work.context.progress);
  // Nothing may become too bright before the new pictures are brought to the level of the old ones.
  double largest = 1;
  for (const Eigen::Vector3d& gain : work.light.gains) largest = std::max(largest, gain.maxCoeff());
  for (Eigen::Vector3d& gain : work.light.gains) gain /= largest;
}

// The facet from new photos alone, not levelled; checkpointed.
FacetFiles PaintNew(const Work& work, size_t i) {
  const Facet& facet = *work.facets[i];
  const FacetLook& look = work.looks[i];
  const PhotosLight light = LightOnFacet(work.light, look.ratios);
  std::vector<std::string> key = {FilesKey(facet, look, work.input, light, work.options)};
  if (look.grid) {
    const Eigen::Vector3d& origin = look.grid->origin;
    key.push_back(fmt::format("{} {} {} {} {} {}", origin.x(), origin.y(), origin.z(),
                              look.grid->texel, look.grid->width, look.grid->height));
    if (look.grid->relief) key.push_back(EncodeRelief(*look.grid->relief).png);
  }
  return UnpackFiles(ComputeUnit(work.context, "facet", HashParts(key), [&] {
    PaintedFacet painted = PaintFacet({facet, look, light.gains, work.scene, work.options});
    // What stands before the facet is not the facet, neither to be compared nor to be taken.
    for (size_t texel = 0; texel < painted.in_front.size(); ++texel) {
      if (painted.in_front[texel]) painted.labels[texel] = 255;
    }
    return PackFiles(MakeFacetFiles(facet, painted, work.input.photos, light.gains, false));
  }));
}

// Paints all from new photos and measures how much brighter they are than the old pictures.
void PaintAllNew(Work& work) {
  std::vector<uint64_t> bytes;
  for (size_t i = 0; i < work.facets.size(); ++i) {
    work.texels.push_back(NumTexels(work.old.facets[i]));
    bytes.push_back(PaintingBytes(*work.facets[i], work.looks[i], work.scene, work.options));
    if (!work.looks[i].candidates.empty()) bytes[i] += kBytesPerReadTexel * work.texels[i];
  }
  std::vector<std::optional<ColourRatio>> ratios(work.facets.size());
  work.context.progress->Begin("painting facets", work.facets.size());
  ForEachFacet(bytes, work.context, [&](size_t i) {
    work.context.ThrowIfCancelled();
    const FacetFiles files = PaintNew(work, i);
    if (const std::optional<FacetPicture> after = PictureOf(files)) {
      work.texels[i] = std::max(work.texels[i], NumTexels(files.facet));
      const auto before = ReadPicture(work.old.facets[i], work.OldFolder());
      if (before) ratios[i] = BrightnessRatio(*before, *after);
    }
    work.context.progress->Advance();
  });
  std::vector<ColourRatio> measured;
  for (const std::optional<ColourRatio>& ratio : ratios) {
    if (ratio) measured.push_back(*ratio);
  }
  if (work.options.colour) work.level = CommonGain(measured);
}

// Copies the files of a picture that stays.
void CopyFiles(const TexturedFacet& facet, const fs::path& from, const fs::path& out) {
  std::vector<std::string> files = {facet.image, facet.label_image, facet.orthophoto};
  if (!facet.orthophoto.empty()) {
    for (const char* extension : {".pgw", ".json"}) {
      files.push_back(fs::path(facet.orthophoto).replace_extension(extension).generic_string());
    }
  }
  for (const char* extension : {".png", ".json"}) {
    const fs::path relief =
        kReliefFolder / fs::path(facet.image).filename().replace_extension(extension);
    if (fs::exists(from / relief)) files.push_back(relief.generic_string());
  }
  for (const std::string& file : files) {
    if (!file.empty()) WriteFile(out / file, ReadFile(from / file));
  }
}

// Writes the pictures of what changed on a facet and names them in it.
void WritePlaces(const EpochPicture& made, const std::string& name, const fs::path& out,
                 EpochFacet& found) {
  for (size_t p = 0; p < made.places.size(); ++p) {
    EpochPlace& place = found.places[p];
    place.before = fmt::format("changes/{}.{}.before.png", name, p + 1);
    place.after = fmt::format("changes/{}.{}.after.png", name, p + 1);
    WriteImage(made.places[p].before, out / place.before);
    WriteImage(made.places[p].after, out / place.after);
  }
}

// Decides facet by facet, and writes what the epoch has of each.
std::vector<EpochFacet> WritePictures(const Work& work, TextureSet& textures) {
  std::vector<std::string> ids;
  std::vector<uint64_t> bytes;
  for (size_t i = 0; i < work.facets.size(); ++i) {
    ids.push_back(work.facets[i]->id);
    bytes.push_back(kBytesPerTexel * work.texels[i]);
  }
  const std::vector<std::string> names = FileNames(ids);
  EpochStyle style{work.request.epoch, work.request.replace, work.input.photos, {}, work.options};
  for (const SurveyPhoto& photo : work.of_survey) {
    style.taken_at[photo.path()] = photo.cam_from_world.Center();
  }
  std::vector<EpochFacet> found(ids.size());
  textures.facets.resize(ids.size());
  work.context.progress->Begin("comparing pictures", ids.size());
  ForEachFacet(bytes, work.context, [&](size_t i) {
    work.context.ThrowIfCancelled();
    const TexturedFacet& old = work.old.facets[i];
    const FacetFiles painted = PaintNew(work, i);
    const auto& grid = work.looks[i].grid;
    EpochPicture made = MakeEpochPicture({*work.facets[i], old, ReadPicture(old, work.OldFolder()),
                                          painted, work.level, grid ? grid->relief : nullptr},
                                         style);
    found[i] = made.found;
    WritePlaces(made, names[i], work.context.out, found[i]);
    if (made.files) {
      textures.facets[i] = StoreFacet(std::move(*made.files), *work.facets[i], names[i], work.input,
                                      work.context.out);
    } else {
      CopyFiles(old, work.OldFolder(), work.context.out);
      textures.facets[i] = old;
    }
    work.context.progress->Advance();
  });
  return found;
}

}  // namespace

std::vector<EpochFacet> RepaintSurvey(const TextureOptions& options, const RepaintRequest& request,
                                      StageContext& context) {
  const TextureSet old = ReadTextureSet(context.survey / kTexturesFile);
  TextureInput input = ReadSurfaces(context, options);
  input.photos = request.photos;
  const std::vector<SurveyPhoto> of_survey = ReadSurveyPhotos(context.survey);
  input.cloud = SightedByOthers(std::move(input.cloud), of_survey, input.photos);
  for (const char* folder : {"textures", "labels", "orthophotos", "changes", kReliefFolder}) {
    fs::create_directories(context.out / folder);
  }
  const OcclusionScene occlusion(input.proxy);
  const std::vector<NearestPoints> nearest = SplatAll(input, context);
  Work work{options,
            request,
            input,
            PaintScene{{input.photos, &occlusion, nearest, input.cloud.positions},
                       nullptr,
                       input.proxy.up.normalized(),
                       input.proxy.metric},
            context,
            old,
            of_survey};
  work.facets = FacetsOf(old, input.proxy);
  {
    PhotoCache as_taken(context.photos, context.memory_limit_bytes / 3);
    work.scene.cache = &as_taken;
    LookAtFacets(work);
  }
  PhotoCache even = EvenPhotos(input.photos, work.light, context);
  work.scene.cache = &even;
  PaintAllNew(work);
  TextureSet textures;
  std::vector<EpochFacet> found = WritePictures(work, textures);
  context.ThrowIfCancelled();
  WriteModels(input.proxy, options, context, textures);
  WriteTextureSet(textures, context.out / fs::path(kTexturesFile).filename());
  return found;
}

}  // namespace stucco
