// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <condition_variable>
#include <map>
#include <mutex>
#include <numeric>
#include <tuple>

#include "survey/files.h"
#include "survey/parallel.h"
#include "texture/light/colour.h"
#include "texture/output/orthophoto.h"
#include "texture/output/write_glb.h"
#include "texture/output/write_model.h"

namespace stucco {
namespace {

// Widest rasters in which points of the cloud in front of facets are looked up.
constexpr int kNearestWidth = 640;
uint64_t BytesBesideCache(const StageContext& context) {
  return context.memory_limit_bytes / 2;
}

// Facets that wait for a thread and for memory.
class FacetQueue {
 public:
  // `bytes`, by facet, outlives it.
  FacetQueue(std::span<const uint64_t> bytes, uint64_t limit)
      : bytes_(bytes), limit_(limit), waiting_(bytes.size()) {
    std::iota(waiting_.begin(), waiting_.end(), size_t{0});
    std::ranges::stable_sort(waiting_, std::greater{}, [&](size_t i) { return bytes[i]; });
  }

  // The one with most bytes that fits beside those being worked on, any where none is. Waits for
  // it. Requires that some are left.
  size_t Take() {
    std::unique_lock lock(mutex_);
    assert(!waiting_.empty());
    for (;;) {
      const auto fits = std::ranges::find_if(
          waiting_, [&](size_t i) { return taken_ == 0 || taken_ + bytes_[i] <= limit_; });
      if (fits != waiting_.end()) {
        const size_t facet = *fits;
        waiting_.erase(fits);
        taken_ += bytes_[facet];
        return facet;
      }
      freed_.wait(lock);
    }
  }

  void GiveBack(size_t facet) {
    {
      const std::lock_guard lock(mutex_);
      taken_ -= bytes_[facet];
    }
    freed_.notify_all();
  }

 private:
  const std::span<const uint64_t> bytes_;
  const uint64_t limit_;
  std::mutex mutex_;
  std::condition_variable freed_;
  std::vector<size_t> waiting_;  // by falling bytes
  uint64_t taken_ = 0;
};

constexpr double kGamma = 2.2;  // of codes, about: light is their power

// A facet of a queue as long as somebody works on it.
class Taken {
 public:
  explicit Taken(FacetQueue& queue) : queue_(queue), facet_(queue.Take()) {}
  ~Taken() { queue_.GiveBack(facet_); }
  Taken(const Taken&) = delete;
  Taken& operator=(const Taken&) = delete;

  size_t facet() const { return facet_; }

 private:
  FacetQueue& queue_;
  const size_t facet_;
};

}  // namespace

std::vector<const Facet*> FacetsToPaint(const Proxy& proxy, bool ground) {
  std::vector<const Facet*> facets;
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) {
      if (facet.outer.size() < 3) continue;
      if (facet.facet_class == FacetClass::kGround && !ground) continue;
      facets.push_back(&facet);
    }
  }
  return facets;
}

std::vector<NearestPoints> SplatAll(const TextureInput& input, const StageContext& context) {
  std::vector<NearestPoints> nearest(input.cloud.positions.empty() ? 0 : input.photos.size());
  if (nearest.empty()) return nearest;
  context.progress->Begin("foreground", nearest.size());
  ParallelFor(nearest.size(), context.threads, [&](size_t i) {
    context.ThrowIfCancelled();
    nearest[i] = SplatNearest(input.photos[i], input.cloud, kNearestWidth);
    context.progress->Advance();
  });
  return nearest;
}

std::vector<FacetLook> LookAtAll(const std::vector<const Facet*>& facets, const TextureInput& input,
                                 const PaintScene& scene, const TextureOptions& options,
                                 const StageContext& context) {
  std::vector<FacetLook> looks(facets.size());
  context.progress->Begin("choosing candidate photos", facets.size());
  ParallelFor(facets.size(), context.threads, [&](size_t i) {
    context.ThrowIfCancelled();
    looks[i] =
        UnpackLook(ComputeUnit(context, "texture_look", LookKey(*facets[i], input, options),
                               [&] { return PackLook(LookAtFacet(*facets[i], scene, options)); }));
    context.progress->Advance();
  });
  return looks;
}

PhotosLight LightFrom(const std::vector<FacetLook>& looks, std::span<const SurveyPhoto> photos,
                      Progress& progress) {
  std::vector<ColourRatio> ratios;
  for (const FacetLook& look : looks) {
    ratios.insert(ratios.end(), look.ratios.begin(), look.ratios.end());
  }
  // Photos of an epoch have cameras of their own that are the same.
  std::map<std::tuple<CameraModel, int, int, std::vector<double>>, int> lenses;
  std::vector<TakenPhoto> taken;
  for (const SurveyPhoto& photo : photos) {
    const Camera& camera = photo.camera;
    const auto next = static_cast<int>(lenses.size());
    const auto [lens, added] =
        lenses.try_emplace({camera.model, camera.width_px, camera.height_px, camera.params}, next);
    taken.push_back({lens->second, {}, {}});
    const auto& exposure_s = photo.captured.exposure_s;
    if (exposure_s) taken.back().log_exposure = std::log(*exposure_s) / kGamma;
    if (const auto time_s = CaptureTime_s(photo.captured)) taken.back().time_h = *time_s / 3600;
  }
  PhotosLight light = SolveLight(ratios, taken);
  for (const auto& [camera, lens] : lenses) {
    const auto photo = std::ranges::find(taken, lens, &TakenPhoto::lens) - taken.begin();
    const Falloff& falloff = light.falloffs[photo];
    if (falloff.IsNone()) continue;
    progress.Note(
        fmt::format("the corners of photos get {:.0f} % of the light of their middle: evened out",
                    100 * std::exp(kGamma * falloff.LogAt(1))));
  }
  return light;
}

PhotoCache EvenPhotos(std::span<const SurveyPhoto> photos, const PhotosLight& light,
                      const StageContext& context) {
  std::map<std::string, std::pair<Falloff, Camera>> lens_of;
  for (size_t i = 0; i < photos.size(); ++i) {
    lens_of[photos[i].path()] = {light.falloffs[i], photos[i].camera};
  }
  return {context.photos, context.memory_limit_bytes / 3,
          [lens_of = std::move(lens_of)](const std::string& name, Image& photo) {
            const auto& [falloff, camera] = lens_of.at(name);
            EvenOut(falloff, camera, photo);
          }};
}

void ForEachFacet(std::span<const uint64_t> bytes, const StageContext& context,
                  const std::function<void(size_t)>& work) {
  FacetQueue queue(bytes, BytesBesideCache(context));
  ParallelFor(bytes.size(), context.threads, [&](size_t) {
    const Taken taken(queue);
    work(taken.facet());
  });
}

TexturedFacet StoreFacet(FacetFiles files, const Facet& facet, const std::string& name,
                         const TextureInput& input, const std::filesystem::path& out) {
  TexturedFacet& textured = files.facet;
  if (files.texture_png.empty()) return textured;
  textured.image = fmt::format("textures/{}.png", name);
  textured.label_image = fmt::format("labels/{}.png", name);
  WriteFile(out / textured.image, files.texture_png);
  WriteFile(out / textured.label_image, files.label_png);
  if (!files.relief.json.empty()) {
    std::filesystem::create_directories(out / kReliefFolder);
    WriteFile(out / kReliefFolder / (name + ".png"), files.relief.png);
    WriteFile(out / kReliefFolder / (name + ".json"), files.relief.json);
  }
  if (!files.orthophoto_png.empty()) {
    textured.orthophoto = fmt::format("orthophotos/{}.png", name);
    WriteFile(out / textured.orthophoto, files.orthophoto_png);
    WriteFile(out / fmt::format("orthophotos/{}.pgw", name),
              WorldFile(textured, facet, input.proxy));
    WriteFile(out / fmt::format("orthophotos/{}.json", name),
              OrthophotoJson(textured, facet, input.proxy, input.georef));
  }
  return textured;
}

void WriteModels(const Proxy& proxy, const TextureOptions& options, const StageContext& context,
                 TextureSet& textures) {
  context.progress->Begin("writing the model", 2);
  textures.model_offset = ModelOffset(proxy);
  WriteObj(proxy, textures, context.out);
  context.progress->Advance();
  const ModelLook look{kOwnLook, textures, context.out};
  const GlbOptions glb{.max_px = options.glb_max_px,
                       .jpeg_quality = options.glb_quality,
                       .threads = EncodingThreads({&look, 1}, options.glb_atlas_px,
                                                  BytesBesideCache(context), context.threads),
                       .most_texels = 1e6 * options.glb_megapixels,
                       .atlas_px = options.glb_atlas_px,
                       .relief = options.glb_relief};
  WriteFile(context.out / "model.glb", GlbOfLooks(proxy, {&look, 1}, glb));
  context.progress->Advance();
  textures.model_obj = "model.obj";
  textures.model_glb = "model.glb";
}

}  // namespace stucco
