// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "pipeline/engine/layout.h"
#include "pipeline/engine/settings.h"
#include "pipeline/verbs/import.h"
#include "pipeline/verbs/internal/publish_import.h"
#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/point_cloud.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

constexpr char kDenseStage[] = "dense";

// A scan may reach far beyond what was photographed; one in another frame is hardly seen at all.
constexpr double kLeastSeen = 0.02;
constexpr size_t kPointsTested = 20'000;

bool IsSeen(const Reconstruction& model, const Eigen::Vector3d& point) {
  return std::any_of(model.photos.begin(), model.photos.end(), [&](const auto& entry) {
    const Camera& camera = model.cameras.at(entry.second.camera);
    const auto pixel = camera.Project(entry.second.cam_from_world * point);
    return pixel && camera.Contains(*pixel);
  });
}

double SeenShare(const Reconstruction& model, const PointCloud& cloud) {
  const size_t step = cloud.size() / kPointsTested + 1;
  size_t seen = 0;
  size_t tested = 0;
  for (size_t i = 0; i < cloud.size(); i += step) {
    seen += IsSeen(model, cloud.positions[i]);
    ++tested;
  }
  return tested == 0 ? 0 : static_cast<double>(seen) / static_cast<double>(tested);
}

bool KnowsAllViews(const Reconstruction& model, const PointCloud& cloud) {
  return std::all_of(cloud.views.begin(), cloud.views.end(), [&](const auto& views) {
    return std::all_of(views.begin(), views.end(),
                       [&](uint32_t photo) { return model.photos.contains(PhotoId{photo}); });
  });
}

Reconstruction ReadPoses(const fs::path& survey) {
  std::error_code error;
  if (!fs::exists(survey / kSparseFolder, error)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: there are no camera poses yet that a cloud could belong to",
                            survey.string()),
                "import camera poses or run the survey until calib first");
  }
  return ReadColmapModel(survey / kSparseFolder);
}

}  // namespace

bool IsCloud(const fs::path& path) {
  std::string head(3, '\0');
  std::ifstream(path, std::ios::binary).read(head.data(), std::ssize(head));
  return head == "ply";
}

CloudImportReport ImportCloud(const fs::path& survey, const fs::path& source,
                              const StageTable& table, const Platform& platform) {
  RequireApart(survey, LoadSettings(survey, table, {}).photos, table);
  const Reconstruction model = ReadPoses(survey);
  PointCloud cloud = ReadPly(source);
  if (const auto problem = FindProblem(cloud)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", source.string(), *problem),
                "export the cloud again");
  }
  CloudImportReport report;
  report.points = cloud.size();
  report.seen_share = SeenShare(model, cloud);
  if (report.seen_share < kLeastSeen) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: the photos see {:.1f} % of its {} points; the cloud is not in the "
                            "frame of the camera poses",
                            source.string(), 100 * report.seen_share, cloud.size()),
                "import the camera poses that the cloud was made with as well (stucco import "
                "SURVEY FOLDER), then the cloud");
  }
  if (cloud.normals.empty()) {
    report.notes.emplace_back("the cloud has no normals; they are estimated from the points");
  }
  if (!cloud.views.empty() && !KnowsAllViews(model, cloud)) {
    cloud.views.clear();
    report.notes.emplace_back("its lists of photos do not fit the poses and are left out");
  }
  for (std::string& note : PublishImport(
           survey, kDenseStage, source, platform,
           [&](const fs::path& out) { WritePly(cloud, out / fs::path(kCloudFile).filename()); })) {
    report.notes.push_back(std::move(note));
  }
  return report;
}

}  // namespace stucco
