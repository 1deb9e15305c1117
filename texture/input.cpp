// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/input.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "survey/captures.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/median.h"
#include "survey/plan_of_survey.h"
#include "survey/ply.h"
#include "survey/survey_folder.h"
#include "texture/plan_prior.h"

namespace stucco {
namespace {

// Enough to cover the small rasters in which foreground is looked up; more only costs time.
constexpr size_t kMostPoints = 1'000'000;

std::map<std::string, CapturedPhoto> ReadCapturesByPath(const std::filesystem::path& path) {
  std::map<std::string, CapturedPhoto> out;
  if (!std::filesystem::exists(path)) return out;
  for (CapturedPhoto& photo : ReadCaptures(path).photos) out[photo.path] = std::move(photo);
  return out;
}

double MedianSharpness(const std::map<std::string, CapturedPhoto>& captures) {
  std::vector<double> values;
  for (const auto& [path, photo] : captures) {
    if (photo.usable && photo.sharpness > 0) values.push_back(photo.sharpness);
  }
  return Median(std::move(values)).value_or(0);
}

std::vector<TexturePhoto> ReadPhotos(const StageContext& context, bool guided) {
  const Reconstruction model = ReadColmapModel(context.survey / kSparseFolder);
  const auto captures = ReadCapturesByPath(context.survey / kCapturesFile);
  const double typical = MedianSharpness(captures);
  std::vector<TexturePhoto> photos;
  for (const auto& [id, posed] : model.photos) {
    const std::filesystem::path path = context.photos / posed.name;
    if (!std::filesystem::exists(path)) {
      throw Error(ErrorKind::kBadInput, fmt::format("{}: this posed photo is gone", path.string()),
                  "put it back, or compute the camera poses again without it: stucco run SURVEY "
                  "--from ingest");
    }
    TexturePhoto photo;
    photo.name = posed.name;
    photo.camera = model.cameras.at(posed.camera);
    photo.cam_from_world = posed.cam_from_world;
    const auto captured = captures.find(posed.name);
    if (captured != captures.end()) {
      photo.hash = captured->second.hash;
      const double sharpness = captured->second.sharpness;
      if (typical > 0 && sharpness > 0) photo.sharpness = sharpness / typical;
    }
    if (photo.hash.empty()) photo.hash = HashFile(path);
    KnowLens(photo);
    photos.push_back(std::move(photo));
  }
  std::sort(photos.begin(), photos.end(),
            [](const TexturePhoto& a, const TexturePhoto& b) { return a.name < b.name; });
  if (guided) {
    if (const auto plan = PlanOfSurvey(context)) KnowPlan(*plan, captures, photos);
  }
  return photos;
}

// Every k-th point of a cloud, so that about kMostPoints are left.
std::vector<Eigen::Vector3d> ReadThinned(const std::filesystem::path& cloud) {
  const uint64_t step =
      std::max<uint64_t>(1, (ReadPlyLayout(cloud).points + kMostPoints - 1) / kMostPoints);
  std::vector<Eigen::Vector3d> points;
  uint64_t number = 0;
  ForEachPoint(cloud, [&](const CloudPoint& point) {
    if (number++ % step == 0) points.push_back(point.position);
  });
  return points;
}

}  // namespace

TextureInput ReadTextureInput(const StageContext& context, const TextureOptions& options) {
  TextureInput input;
  const std::filesystem::path facets = context.survey / kFacetsFile;
  input.proxy = ReadProxy(facets);
  std::string cloud_hash;
  const std::filesystem::path cloud = context.survey / kCloudFile;
  if (options.occluders && std::filesystem::exists(cloud)) {
    input.cloud = ReadThinned(cloud);
    cloud_hash = HashFile(cloud);
  } else if (options.occluders) {
    context.progress->Warn(fmt::format(
        "{} is missing: what stands in front of facades is only known from the photos themselves",
        cloud.string()));
  }
  const std::vector<std::string> parts = {HashFile(facets), cloud_hash};
  input.geometry_hash = HashParts(parts);
  const std::filesystem::path georef = context.survey / kGeorefFile;
  if (std::filesystem::exists(georef)) input.georef = ReadGeoref(georef);
  input.photos = ReadPhotos(context, options.guided);
  if (input.photos.empty()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: no photo is posed", (context.survey / kSparseFolder).string()),
                "compute the camera poses again: stucco run SURVEY --from calib");
  }
  return input;
}

}  // namespace stucco
