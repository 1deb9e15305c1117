// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/default_stages.h"

#include "calib/calibrate.h"
#include "capture_ingest/ingest.h"
#include "dense/densify.h"
#include "proxy/run_proxy.h"
#include "report/report.h"
#include "survey/survey_folder.h"
#include "texture/texture.h"

namespace stucco {
namespace {

Stage IngestStage() {
  Stage stage;
  stage.name = "ingest";
  stage.version = 3;
  stage.title = "the list of photos with metadata and health";
  stage.inputs = {kPlanFile};
  stage.photos_are_input = true;
  stage.opens_photos = true;
  stage.cost = {
      .cpu_s_per_megapixel = 0.012, .memory_mb = 60, .memory_mb_per_largest_megapixel = 12};
  stage.bind = [] { return Bind<IngestOptions>("ingest", Describe, RunIngest); };
  return stage;
}

// From here on the photos themselves are covered by captures.json, which holds their hashes.
Stage CalibStage() {
  Stage stage;
  stage.name = "calib";
  stage.version = 15;
  stage.title = "camera poses and lens calibration";
  stage.needs = {"ingest"};
  stage.inputs = {kCapturesFile, kPlanFile, kGroundControlFile};
  stage.opens_photos = true;
  // Of 522 photos with 5000 features each: 979 CPU seconds, a third of them for 10 911 pairs, whose
  // time grows with the square of the features.
  stage.cost = {.cpu_s_per_photo = 0.6,
                .cpu_s_per_megapixel = 0.55,
                .cpu_s_per_pair = 0.09,
                .disk_mb_per_photo = 1.4,
                .memory_mb = 250,
                .thread_mb_per_largest_megapixel = 200,
                .threads_share = 0.7};
  stage.bind = [] { return Bind<CalibOptions>("calib", Describe, RunCalib); };
  return stage;
}

Stage DenseStage() {
  Stage stage;
  stage.name = "dense";
  stage.version = 8;
  stage.title = "the dense point cloud";
  stage.needs = {"ingest", "calib"};
  stage.inputs = {kCapturesFile, kSparseFolder};
  stage.opens_photos = true;
  // Photos (10 bytes a pixel) and depth maps (8) are cached, a quarter of the limit each; matching
  // has another quarter.
  stage.cost = {.cpu_s_per_megapixel = 11,
                .disk_mb_per_megapixel = 30,
                .memory_mb = 60,
                .memory_mb_per_photo = 0.18,
                .memory_mb_per_megapixel = 0.2,
                .thread_mb_per_largest_megapixel = 60,
                .cached_mb_per_megapixel = 18,
                .cached_share = 0.5};
  stage.bind = [] { return Bind<DenseOptions>("dense", Describe, RunDense); };
  return stage;
}

Stage ProxyStage() {
  Stage stage;
  stage.name = "proxy";
  stage.title = "the planar model";
  stage.version = 34;
  stage.needs = {"calib", "dense"};
  stage.inputs = {kCloudFile, kSparseFolder, kGeorefFile, kPlanFile};
  stage.cost = {.cpu_s_per_photo = 0.25, .disk_mb_per_photo = 0.02, .memory_mb = 700};
  stage.bind = [] { return Bind<ProxyOptions>("proxy", Describe, RunProxy); };
  return stage;
}

Stage TextureStage() {
  Stage stage;
  stage.name = "texture";
  stage.title = "facade textures and the textured model";
  stage.version = 16;
  stage.needs = {"ingest", "calib", "dense", "proxy"};
  stage.inputs = {kFacetsFile, kSparseFolder, kGeorefFile, kCloudFile, kCapturesFile, kPlanFile};
  stage.opens_photos = true;
  stage.cost = {.cpu_s_per_photo = 0.4,
                .cpu_s_per_megapixel = 0.2,
                .disk_mb_per_megapixel = 0.7,
                .memory_mb = 600,
                .memory_mb_per_largest_megapixel = 30};
  stage.bind = [] { return Bind<TextureOptions>("texture", Describe, RunTexture); };
  return stage;
}

Stage ReportStage() {
  Stage stage;
  stage.name = "report";
  stage.title = "the quality report";
  stage.version = 11;
  stage.needs = {"ingest", "calib", "dense", "proxy", "texture"};
  stage.inputs = {"ingest", "calib", kCloudFile, "proxy", "texture", kPlanFile};
  stage.reports_failures = true;
  stage.cost = {.cpu_s_per_photo = 0.03, .disk_mb_per_photo = 0.05, .memory_mb = 300};
  stage.bind = [] { return Bind<ReportOptions>("report", Describe, RunReport); };
  return stage;
}

}  // namespace

StageTable DefaultStages() {
  return {IngestStage(), CalibStage(), DenseStage(), ProxyStage(), TextureStage(), ReportStage()};
}

}  // namespace stucco
