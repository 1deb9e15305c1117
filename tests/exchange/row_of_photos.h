// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <string>

#include "exchange/exchanged_model.h"
#include "exchange/photo_index.h"
#include "survey/error.h"
#include "tests/survey/temporary_folder.h"

namespace stucco {

// A temporary folder with photos a.jpg, b.jpg and sub/c.jpg of 200 x 100 pixels in photos/, and
// room for the files of other programs.
//
// The files of the tests are written by hand from the formats' documents, all for one view: a
// camera at (1, 2, 3) that looks along +x with +z up, focal length 100 pixels, principal point in
// the middle. What is 10 ahead of it, 1 to its right and 2 above its axis, the point (11, 1, 5), is
// 10 pixels right and 20 above the middle of the photo: at (110, 30) in our pixels.
class RowOfPhotos {
 public:
  RowOfPhotos();

  void AddPhoto(const std::string& path, int width_px, int height_px) const;  // below root
  std::filesystem::path Write(const std::string& path, const std::string& text) const;
  PhotoIndex Index() const { return PhotoIndex(root / "photos"); }

 private:
  test::TemporaryFolder folder_;

 public:
  std::filesystem::path root = folder_.path();
};

inline const Eigen::Vector3d kSeen(11, 1, 5);
inline const Eigen::Vector2d kSeenAt(110, 30);

// Where a photo of the model shows a point.
Eigen::Vector2d PixelIn(const Reconstruction& model, const std::string& photo,
                        const Eigen::Vector3d& point);

// What a reader throws.
Error RefusalOf(const std::function<void()>& read);

}  // namespace stucco
