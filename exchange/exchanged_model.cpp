// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/exchanged_model.h"

#include <cassert>

namespace stucco {

CameraId SharedCamera(const Camera& camera, Reconstruction& model) {
  for (const auto& [id, known] : model.cameras) {
    if (known.model == camera.model && known.width_px == camera.width_px &&
        known.height_px == camera.height_px && known.params == camera.params) {
      return id;
    }
  }
  const CameraId id{static_cast<uint32_t>(model.cameras.size() + 1)};
  model.cameras[id] = camera;
  model.cameras[id].id = id;
  return id;
}

PhotoId AddPosedPhoto(CameraId camera, std::string name, const Pose& cam_from_world,
                      Reconstruction& model) {
  const PhotoId id{static_cast<uint32_t>(model.photos.size() + 1)};
  RegisteredImage& photo = model.photos[id];
  photo.id = id;
  photo.camera = camera;
  photo.name = std::move(name);
  photo.cam_from_world = cam_from_world;
  return id;
}

void AddSeenPoint(const ExchangedPoint& point, Reconstruction& model) {
  if (point.pixels.size() < 2) return;
  const PointId id{model.points.size() + 1};
  TrackPoint& added = model.points[id];
  added.id = id;
  added.position = point.position;
  added.rgb = point.rgb;
  for (const auto& [photo_id, pixel] : point.pixels) {
    assert(model.photos.contains(photo_id));
    RegisteredImage& photo = model.photos.at(photo_id);
    added.track.push_back({photo_id, static_cast<uint32_t>(photo.observations.size())});
    photo.observations.push_back({pixel, id});
  }
}

void MeasurePointErrors(ExchangedModel& exchanged) {
  assert(exchanged.crs.empty());
  Reconstruction& model = exchanged.model;
  for (auto& [id, point] : model.points) {
    if (point.error_px >= 0) continue;
    double sum_px = 0;
    int count = 0;
    for (const TrackElement& element : point.track) {
      const RegisteredImage& photo = model.photos.at(element.photo);
      const auto pixel =
          model.cameras.at(photo.camera).Project(photo.cam_from_world * point.position);
      if (!pixel) continue;
      sum_px += (*pixel - photo.observations[element.observation].pixel).norm();
      ++count;
    }
    if (count > 0) point.error_px = sum_px / count;
  }
}

}  // namespace stucco
