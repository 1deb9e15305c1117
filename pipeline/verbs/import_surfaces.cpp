// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "pipeline/engine/layout.h"
#include "pipeline/engine/settings.h"
#include "pipeline/verbs/import.h"
#include "pipeline/verbs/internal/map_frame.h"
#include "pipeline/verbs/internal/publish_import.h"
#include "proxy/imported/proxy_of_surfaces.h"
#include "proxy/output/proxy_files.h"
#include "survey/colmap_io.h"
#include "survey/coordinate_system.h"
#include "survey/error.h"
#include "survey/plan_io.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

constexpr char kProxyStage[] = "proxy";

// What the survey has that a model can be held against.
struct Known {
  std::vector<SurveyPhoto> photos;
  SurfaceSurvey survey;
};

Known ReadKnown(const fs::path& survey) {
  std::error_code error;
  if (!fs::exists(survey / kSparseFolder, error) || !fs::exists(survey / kGeorefFile, error)) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}: there are no camera poses yet that could see a model", survey.string()),
        "import camera poses or run the survey until calib first");
  }
  Known known;
  const Reconstruction model = ReadColmapModel(survey / kSparseFolder);
  known.photos = JoinPhotos(model, {});
  if (fs::exists(survey / kCloudFile, error)) known.survey.cloud = survey / kCloudFile;
  for (const auto& [id, point] : model.points) known.survey.points.push_back(point.position);
  known.survey.georef = ReadGeoref(survey / kGeorefFile);
  if (fs::exists(survey / kPlanFile, error)) known.survey.plan = ReadPlan(survey / kPlanFile);
  return known;
}

// The coordinate system that the model is in; empty: the world of the survey.
std::string CrsOf(const SurfaceImportRequest& request, const Georef& georef, SurfaceModel& model) {
  std::string crs = request.crs.empty() ? model.crs : request.crs;
  if (crs.empty()) return crs;
  if (!IsCrsOnEarth(crs)) {
    if (request.crs.empty()) {
      model.notes.push_back(fmt::format(
          "its coordinate system {} is not on the earth, and taken for the survey's", crs));
      return "";
    }
    throw Error(ErrorKind::kUsage,
                fmt::format("--crs {}: is no coordinate system on the earth", crs),
                "give an EPSG code, as EPSG:25832, or a PROJ text");
  }
  if (georef.frame != "enu") {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is in {}, and the survey does not lie on the earth: its photos "
                            "have no positions",
                            request.file.string(), crs),
                "give the model in the world of the survey, as stucco writes its own "
                "(proxy/proxy.obj), or measure ground control points (gcp_list.txt)");
  }
  return crs;
}

void Place(const SurfaceImportRequest& request, const std::string& crs, const Georef& georef,
           SurfaceModel& model) {
  std::vector<Eigen::Vector3d> corners;
  ForCorners(model,
             [&](const Eigen::Vector3d& corner) { corners.emplace_back(corner + request.offset); });
  if (!crs.empty()) MovePointsFromMap(crs, request.file.string(), georef, corners);
  const Eigen::Vector3d* next = corners.data();
  ForCorners(model, [&](Eigen::Vector3d& corner) { corner = *next++; });
}

}  // namespace

SurfaceImportReport ImportSurfaces(const fs::path& survey, const SurfaceImportRequest& request,
                                   const StageTable& table, const Platform& platform) {
  RequireApart(survey, LoadSettings(survey, table, {}).photos, table);
  SurfaceModel model = ReadSurfaceModel(request.file, request.up);
  Known known = ReadKnown(survey);
  known.survey.photos = known.photos;
  const std::string crs = CrsOf(request, known.survey.georef, model);
  Place(request, crs, known.survey.georef, model);
  SurfaceImportReport report;
  report.format = model.format;
  SurfaceProxy made = ProxyOfSurfaces(std::move(model), known.survey,
                                      request.fits.value_or(!crs.empty()), request.file.string());
  made.proxy.findings.push_back(
      fmt::format("imported from {}", fs::absolute(request.file).lexically_normal().string()));
  report.notes = std::move(made.notes);
  for (std::string& note :
       PublishImport(survey, kProxyStage, request.file, platform,
                     [&](const fs::path& out) { WriteProxyFiles(made.proxy, out); })) {
    report.notes.push_back(std::move(note));
  }
  report.buildings = made.proxy.buildings.size();
  for (const Building& building : made.proxy.buildings) {
    report.closed += building.watertight;
    report.facets += building.facets.size();
  }
  return report;
}

}  // namespace stucco
