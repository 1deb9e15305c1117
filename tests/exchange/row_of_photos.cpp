// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/exchange/row_of_photos.h"

#include <stdexcept>

#include "survey/files.h"
#include "survey/image.h"

namespace stucco {

namespace fs = std::filesystem;

RowOfPhotos::RowOfPhotos() {
  for (const char* photo : {"photos/a.jpg", "photos/b.jpg", "photos/sub/c.jpg"}) {
    AddPhoto(photo, 200, 100);
  }
}

void RowOfPhotos::AddPhoto(const std::string& path, int width_px, int height_px) const {
  Image image;
  image.width_px = width_px;
  image.height_px = height_px;
  image.data.assign(static_cast<size_t>(width_px) * height_px * 3, 128);
  fs::create_directories((root / path).parent_path());
  WriteImage(image, root / path);
}

fs::path RowOfPhotos::Write(const std::string& path, const std::string& text) const {
  fs::create_directories((root / path).parent_path());
  WriteFile(root / path, text);
  return root / path;
}

Eigen::Vector2d PixelIn(const Reconstruction& model, const std::string& photo,
                        const Eigen::Vector3d& point) {
  for (const auto& [id, each] : model.photos) {
    if (each.name != photo) continue;
    const auto pixel = model.cameras.at(each.camera).Project(each.cam_from_world * point);
    if (pixel) return *pixel;
    throw std::runtime_error("the point is behind " + photo);
  }
  throw std::runtime_error("no photo " + photo);
}

Error RefusalOf(const std::function<void()>& read) {
  try {
    read();
  } catch (const Error& e) {
    return e;
  }
  return {ErrorKind::kInterrupted, "was not refused"};
}

}  // namespace stucco
