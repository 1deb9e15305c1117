// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "survey/georef.h"
#include "survey/reconstruction.h"

namespace stucco {

// Camera poses of another program in our conventions: pixels, camera axes, lens models and names of
// photos are ours, whatever the file has. The world frame is the file's.
struct ExchangedModel {
  std::string format;  // for people: "Bundler v0.3"
  Reconstruction model;
  // Where the file says that its frame is metres east, north and up of a place.
  std::optional<Georef> georef;
  // Where its coordinates are those of a map: what PROJ calls that, "EPSG:25832". Positions are
  // then x, y, z of the map (longitude and latitude in degrees where it has those), and rotations
  // are from its directions at the camera, so that no length or angle of `model` means anything
  // until its positions are converted.
  std::string crs;
  std::vector<std::string> notes;  // what the user should know of the reading
};

// A point as a file has it: where photos see it, by keys of the file.
struct ExchangedPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::array<uint8_t, 3> rgb = {0, 0, 0};
  std::vector<std::pair<PhotoId, Eigen::Vector2d>> pixels;
};

// A camera of the model with these properties: the one that is there already, else a new one. Many
// formats repeat the lens for every photo.
CameraId SharedCamera(const Camera& camera, Reconstruction& model);

// Adds a photo; its id is the next free one, from 1.
PhotoId AddPosedPhoto(CameraId camera, std::string name, const Pose& cam_from_world,
                      Reconstruction& model);

// Adds a point that at least two photos see, with its observations, and passes over any other.
// Requires that its photos are of the model.
void AddSeenPoint(const ExchangedPoint& point, Reconstruction& model);

// Mean reprojection error of the points that have none: most formats leave it out. Requires that
// the coordinates are not those of a map.
void MeasurePointErrors(ExchangedModel& exchanged);

}  // namespace stucco
