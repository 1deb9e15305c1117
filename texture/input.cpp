// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/input.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "survey/error.h"
#include "survey/files.h"
#include "survey/plan_of_survey.h"
#include "survey/ply.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

// Enough to cover the small rasters in which foreground is looked up; more only costs time.
constexpr size_t kMostPoints = 1'000'000;

std::vector<SurveyPhoto> ReadPhotos(const StageContext& context, bool guided) {
  std::vector<SurveyPhoto> photos = ReadSurveyPhotos(context.survey);
  for (SurveyPhoto& photo : photos) {
    const std::filesystem::path path = context.photos / photo.path();
    if (!std::filesystem::exists(path)) {
      throw Error(ErrorKind::kBadInput, fmt::format("{}: this posed photo is gone", path.string()),
                  "put it back, or compute the camera poses again without it: stucco run SURVEY "
                  "--from ingest");
    }
    if (photo.captured.hash.empty()) photo.captured.hash = HashFile(path);
  }
  std::ranges::sort(photos, {}, &SurveyPhoto::path);
  if (guided) {
    if (const auto plan = PlanOfSurvey(context)) JoinPlan(*plan, photos);
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

TextureInput ReadSurfaces(const StageContext& context, const TextureOptions& options) {
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
  return input;
}

TextureInput ReadTextureInput(const StageContext& context, const TextureOptions& options) {
  TextureInput input = ReadSurfaces(context, options);
  input.photos = ReadPhotos(context, options.guided);
  if (input.photos.empty()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: no photo is posed", (context.survey / kSparseFolder).string()),
                "compute the camera poses again: stucco run SURVEY --from calib");
  }
  return input;
}

}  // namespace stucco
