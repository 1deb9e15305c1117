// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/views/input.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "survey/error.h"
#include "survey/files.h"
#include "survey/plan_of_survey.h"
#include "survey/ply.h"
#include "survey/survey_folder.h"
#include "texture/views/views_by_pose.h"

namespace stucco {
namespace {

// Enough to cover the small rasters in which foreground is looked up; more only costs time.
constexpr size_t kMostPoints = 1'000'000;

std::vector<SurveyPhoto> ReadPhotos(const StageContext& context, const Georef& georef,
                                    bool guided) {
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
    if (const auto plan = PlanOfSurvey(context)) {
      NameViewsByPose(*plan, georef, photos);
      JoinPlan(*plan, photos);
    }
  }
  return photos;
}

// Every k-th point of a cloud, so that about kMostPoints are left.
SightedPoints ReadThinned(const std::filesystem::path& cloud) {
  const PlyLayout layout = ReadPlyLayout(cloud);
  const uint64_t step = std::max<uint64_t>(1, (layout.points + kMostPoints - 1) / kMostPoints);
  SightedPoints points;
  uint64_t number = 0;
  ForEachPoint(cloud, [&](const CloudPoint& point) {
    if (number++ % step != 0) return;
    points.positions.push_back(point.position);
    if (!layout.views) return;
    points.views.insert(points.views.end(), point.views.begin(), point.views.end());
    points.ends.push_back(points.views.size());
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
  input.photos = ReadPhotos(context, input.georef, options.guided);
  if (input.photos.empty()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: no photo is posed", (context.survey / kSparseFolder).string()),
                "compute the camera poses again: stucco run SURVEY --from calib");
  }
  return input;
}

}  // namespace stucco
