// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/take_photos.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <mutex>

#include "simulate/flight/photo_store.h"
#include "survey/encode_image.h"
#include "survey/files.h"
#include "survey/parallel.h"

namespace stucco::simulate {
namespace {

namespace fs = std::filesystem;

// Radiance twice, the picture, and what drawing and encoding take.
constexpr double kBytesPerPixel = 60;
constexpr double kMemory_bytes = 3e9;

struct Threads {
  int photos = 1;  // at a time
  int inside = 1;  // each
};

// Whole photos in parallel are faster than threads inside one, which encoding leaves idle.
Threads Split(int threads, const Camera& camera) {
  const double bytes = kBytesPerPixel * camera.width_px * camera.height_px;
  const int fit = static_cast<int>(std::clamp(kMemory_bytes / bytes, 1.0, 1024.0));
  Threads split;
  split.photos = std::min(threads, fit);
  split.inside = (threads + split.photos - 1) / split.photos;
  return split;
}

Image TakePhoto(const PreparedFlight& prepared, size_t index, const Photographer& photographer,
                const FlightOptions& options, int threads) {
  const FlownPhoto& photo = prepared.flight.photos[index];
  Radiance light =
      photographer.photograph(photo.camera, photo.cam_from_world, photo.light, threads);
  return Develop(std::move(light), photo.camera, EffectsOf(prepared, index, options), threads);
}

void WritePhoto(const Image& image, const PreparedFlight& prepared, size_t index,
                const FlightOptions& options, const fs::path& path) {
  const std::string jpeg = EncodeImage(image, path, options.jpeg_quality);
  WriteFileAtomically(path, WithMetadata(jpeg, MetadataOf(prepared, index, options)));
}

void TakeDepth(const FlownPhoto& photo, const Photographer& photographer, const fs::path& path,
               int threads) {
  std::error_code error;
  if (fs::exists(path, error)) return;
  fs::create_directories(path.parent_path(), error);  // what fails here fails in writing
  WriteFileAtomically(path,
                      Serialize(photographer.depth(photo.camera, photo.cam_from_world, threads)));
}

}  // namespace

FlySummary TakePhotos(const PreparedFlight& prepared, const Photographer& photographer,
                      const FlightOptions& options, const FlyRequest& request,
                      const std::function<void(size_t, size_t)>& progress) {
  const std::vector<FlownPhoto>& photos = prepared.flight.photos;
  FlySummary summary;
  summary.notes = prepared.notes;
  const auto store_notes = OpenPhotoStore(request.survey, prepared.flight);
  summary.notes.insert(summary.notes.end(), store_notes.begin(), store_notes.end());
  std::vector<size_t> wanted;
  for (size_t i = 0; i < photos.size(); ++i) {
    if (photos[i].lost) {
      ++summary.lost;
    } else {
      ++(photos[i].held_out ? summary.held_out : summary.photos);
      wanted.push_back(i);
    }
  }
  if (wanted.empty()) return summary;
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  const Threads threads = Split(std::max(1, request.threads), photos[wanted[0]].camera);
  std::mutex mutex;
  size_t done = 0;
  ParallelFor(wanted.size(), threads.photos, [&](size_t i) {
    const FlownPhoto& photo = photos[wanted[i]];
    const fs::path path = PathOfPhoto(request.survey, photo);
    std::error_code error;
    const bool is_there = fs::exists(path, error);
    if (!is_there) {
      WritePhoto(TakePhoto(prepared, wanted[i], photographer, options, threads.inside), prepared,
                 wanted[i], options, path);
    }
    if (options.write_depth) {
      TakeDepth(photo, photographer, PathOfDepth(request.survey, photo), threads.inside);
    }
    const std::lock_guard lock(mutex);
    if (!is_there) {
      ++summary.rendered;
      summary.megapixels += 1e-6 * photo.camera.width_px * photo.camera.height_px;
    }
    if (progress) progress(++done, wanted.size());
  });
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  summary.render_s = took.count();
  summary.cpu_s = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  return summary;
}

}  // namespace stucco::simulate
