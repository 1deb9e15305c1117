// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "exchange/read_surfaces.h"
#include "pipeline/engine/console.h"
#include "pipeline/engine/platform.h"
#include "pipeline/engine/stages.h"

namespace stucco {

struct ImportReport {
  std::string format;  // "BlocksExchange 2.1"
  std::string frame;   // of georef.json: "enu" or "arbitrary"
  int photos = 0;
  int points = 0;
  int cameras = 0;
  std::vector<std::string> notes;  // "camera 1 was scaled from 1600 x 1066 to 3072 x 2048" ...
};

// Takes the camera poses of another program (COLMAP, Bundler, BlocksExchange, OpenSfM or
// RealityCapture; recognised by their contents) as the survey's calibration: writes the `calib`
// folder and a manifest that says where it came from, so that `run` goes on from it. Runs ingest
// first, where that is not done: models whose file does not say where they lie are brought to the
// positions of their photos. Photo names are matched to the photo folder by the ends of their
// paths, else by a file name that occurs once. A model of resized photos is scaled to the photos.
// Throws Error (kBadInput) when the model is damaged, names photos that are not there, has lenses
// that are none of ours, or was made from pictures of another shape.
ImportReport ImportModel(const std::filesystem::path& survey, const std::filesystem::path& path,
                         const StageTable& table, Console& console, const Platform& platform);

struct CloudImportReport {
  uint64_t points = 0;
  double seen_share = 0;  // of the points, in the picture of at least one posed photo
  std::vector<std::string> notes;
};

// Whether a file is a PLY cloud, by its beginning.
bool IsCloud(const std::filesystem::path& path);

// Takes a PLY cloud in the frame of the survey's calibration as its dense cloud: writes the `dense`
// folder and a manifest that says where it came from, so that `run` goes on from it. Lists of
// photos in the file are kept when all of them are photos of the calibration. Throws Error
// (kBadInput) without a calibration, when the file is damaged, and when hardly any photo sees it,
// as it is then in another frame.
CloudImportReport ImportCloud(const std::filesystem::path& survey,
                              const std::filesystem::path& source, const StageTable& table,
                              const Platform& platform);

struct SurfaceImportRequest {
  std::filesystem::path file;
  std::string crs;  // "EPSG:7415"; empty: the file's own, else the world of the survey
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // that was taken off the file's coordinates
  UpAxis up = UpAxis::kOfFormat;                     // of a mesh
  // Whether the model is moved onto the survey's points; nothing: where a coordinate system says
  // where it lies.
  std::optional<bool> fits;
};

struct SurfaceImportReport {
  std::string format;
  size_t buildings = 0;
  size_t closed = 0;  // of them
  size_t facets = 0;
  std::vector<std::string> notes;
};

// Takes a model of surfaces (OBJ, GLB, glTF or CityJSON) as the survey's planar model: writes the
// `proxy` folder and a manifest that says where it came from, so that `run` goes on to paint it.
// Throws Error (kBadInput): no calibration yet, a damaged file, a coordinate system for a survey
// that does not lie on the earth, and what ProxyOfSurfaces refuses.
SurfaceImportReport ImportSurfaces(const std::filesystem::path& survey,
                                   const SurfaceImportRequest& request, const StageTable& table,
                                   const Platform& platform);

}  // namespace stucco
