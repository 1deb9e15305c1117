// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/import_scan.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "pipeline/engine/layout.h"
#include "pipeline/engine/lock.h"
#include "pipeline/engine/outputs.h"
#include "pipeline/engine/settings.h"
#include "pipeline/verbs/init.h"
#include "pipeline/verbs/internal/map_frame.h"
#include "pipeline/verbs/internal/publish_import.h"
#include "plan/map/read_site.h"
#include "plan/options/plan_options.h"
#include "plan/plan_of_map.h"
#include "survey/calibration.h"
#include "survey/captures.h"
#include "survey/colmap_io.h"
#include "survey/coordinate_system.h"
#include "survey/error.h"
#include "survey/georef.h"
#include "survey/median.h"
#include "survey/photo_files.h"
#include "survey/plan_frame.h"
#include "survey/plan_io.h"
#include "survey/point_cloud.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

std::string CloudCrs(const ScanRequest& request) {
  const std::string& crs = request.crs.empty() ? request.map_crs : request.crs;
  if (crs.empty()) {
    throw Error(ErrorKind::kUsage,
                fmt::format("{}: a PLY names no coordinate system", request.cloud.string()),
                "say which its points are in, as --crs EPSG:2056");
  }
  if (!IsCrsOnEarth(crs)) {
    throw Error(ErrorKind::kUsage,
                fmt::format("--crs {}: is no coordinate system on the earth", crs),
                "give an EPSG code, as EPSG:25832, or a PROJ text");
  }
  return crs;
}

// The map without a flight. Nobody flies by its heights: tops that it does not know are taken for
// those of two storeys, and only where the cloud shows nothing either.
Plan ReadMapAsPlan(const ScanRequest& request, std::vector<std::string>& repairs) {
  constexpr double kTwoStoreys_m = 6;
  plan::PlanOptions options;
  options.map_crs = request.map_crs.empty() ? request.crs : request.map_crs;
  options.altitude_m = plan::kMostAltitude_m;  // so that heights may be unknown
  Site site = plan::ReadSite({.map = request.map}, options);
  repairs = site.repairs;
  const auto lower = [&](Interval& z_m, bool known) {
    if (!known) z_m.to_m = std::min(z_m.to_m, z_m.from_m + kTwoStoreys_m);
  };
  for (Footprint& footprint : site.footprints) lower(footprint.z_m, footprint.top_known);
  for (Facade& facade : site.facades) lower(facade.z_m, facade.top_known);
  return plan::PlanOfMap(site);
}

// East, north and up of the plan's origin, heights from the middle one of the cloud.
Georef FrameOf(const Plan& plan, const PointCloud& cloud, double metres_per_unit) {
  std::vector<double> heights;
  heights.reserve(cloud.size());
  for (const Eigen::Vector3d& p : cloud.positions) heights.push_back(p.z());
  Georef georef;
  georef.frame = "enu";
  georef.metric = true;
  georef.up = Eigen::Vector3d::UnitZ();
  georef.source = "file";
  georef.origin_latitude_deg = plan.origin.latitude_deg;
  georef.origin_longitude_deg = plan.origin.longitude_deg;
  georef.origin_height_m = std::round(Median(heights).value_or(0) * metres_per_unit);
  return georef;
}

// How many buildings of the map the box of the cloud reaches.
size_t BuildingsInCloud(const Plan& plan, const Georef& georef, const PointCloud& cloud) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& p : cloud.positions) box.extend(Eigen::Vector2d(p.head<2>()));
  return static_cast<size_t>(std::ranges::count_if(plan.footprints, [&](const auto& footprint) {
    Eigen::AlignedBox2d reached;
    for (const Eigen::Vector2d& corner : footprint.rings_m.front()) {
      reached.extend(EnuFromPlan(plan.origin, georef, corner));
    }
    return box.intersects(reached);
  }));
}

void RequireNoPhotos(const fs::path& survey, const StageTable& table) {
  std::error_code error;
  if (!fs::exists(survey / kSettingsFile, error)) return;
  const fs::path photos = LoadSettings(survey, table, {}).photos;
  if (!fs::is_directory(photos, error) || FindPhotoFiles(photos).empty()) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: has photos, whose poses a scan without photos would replace",
                          survey.string()),
              "take a new folder for the scan, or leave out --map where the cloud is in the frame "
              "of the poses");
}

void PublishPlan(const fs::path& survey, const ScanRequest& request, const Plan& plan,
                 const Platform& platform, std::vector<std::string>& notes) {
  const SurveyLock lock(survey, fmt::format("import {}", request.map.string()), platform);
  CleanScratch(survey);
  ScratchFolder scratch(survey, kPlanFolder);
  WritePlan(plan, scratch.path() / fs::path(kPlanFile).filename());
  if (const auto moved = scratch.Publish(platform)) {
    notes.push_back(fmt::format("a folder {} that stucco did not make is now {}", kPlanFolder,
                                moved->string()));
  }
}

struct Scan {
  fs::path file;
  PointCloud cloud;  // in the frame of `georef`
  Georef georef;
};

// All that the stages before proxy would have made, of no photo.
void PublishStages(const fs::path& survey, const Scan& scan, const Platform& platform,
                   std::vector<std::string>& notes) {
  const auto publish = [&](const std::string& stage, const auto& write) {
    for (std::string& note : PublishImport(survey, stage, scan.file, platform, write)) {
      if (std::ranges::find(notes, note) == notes.end()) notes.push_back(std::move(note));
    }
  };
  publish("ingest", [&](const fs::path& out) {
    WriteCaptures({}, out / fs::path(kCapturesFile).filename());
  });
  publish("calib", [&](const fs::path& out) {
    WriteColmapBinary({}, out / "sparse/0");
    WriteColmapText({}, out / "sparse/0");
    WriteGeoref(scan.georef, out / fs::path(kGeorefFile).filename());
    Calibration calibration;
    calibration.findings.push_back("no photos: a scan with a map was imported");
    WriteCalibration(calibration, out / fs::path(kCalibrationFile).filename());
  });
  publish("dense", [&](const fs::path& out) {
    WritePly(scan.cloud, out / fs::path(kCloudFile).filename());
  });
}

PointCloud ReadScan(const fs::path& path) {
  PointCloud cloud = ReadPly(path);
  auto problem = FindProblem(cloud);
  if (!problem && cloud.size() == 0) problem = "has no points";
  if (problem) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", path.string(), *problem),
                "export the cloud again");
  }
  // Normals of the file are in the directions of its map, and its photos are not here.
  cloud.normals.clear();
  cloud.views.clear();
  return cloud;
}

}  // namespace

ScanImportReport ImportScan(const fs::path& survey, const ScanRequest& request,
                            const StageTable& table, const Platform& platform) {
  // All that can be wrong with the input shows before the survey is touched.
  const std::string crs = CloudCrs(request);
  RequireNoPhotos(survey, table);
  ScanImportReport report;
  const Plan plan = ReadMapAsPlan(request, report.notes);
  Scan scan{request.cloud, ReadScan(request.cloud), {}};
  const CrsUnits units = UnitsOfCrs(crs);
  const double metres_per_unit = units.vertical_m.value_or(units.horizontal_m);
  scan.georef = FrameOf(plan, scan.cloud, metres_per_unit);
  MovePointsFromMap(crs, request.cloud.string(), scan.georef, scan.cloud.positions);
  report.points = scan.cloud.size();
  report.buildings = plan.footprints.size();
  report.reached = BuildingsInCloud(plan, scan.georef, scan.cloud);
  if (report.reached == 0) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: none of the {} footprints of {} lies in the cloud",
                            request.cloud.string(), report.buildings, request.map.string()),
                "check that both are of one place and in the coordinate systems that --crs and "
                "--map-crs name");
  }
  if (report.reached < report.buildings) {
    report.notes.push_back(fmt::format("{} of {} footprints lie in the box of the cloud",
                                       report.reached, report.buildings));
  }
  InitWaitingSurvey(survey, table);
  PublishPlan(survey, request, plan, platform, report.notes);
  PublishStages(survey, scan, platform, report.notes);
  return report;
}

}  // namespace stucco
