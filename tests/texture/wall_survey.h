// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "survey/image.h"
#include "survey/proxy.h"
#include "survey/reconstruction.h"
#include "survey/stage.h"
#include "survey/survey_photo.h"
#include "survey/texture_set.h"
#include "tests/survey/temporary_folder.h"
#include "tests/texture/synthetic.h"
#include "texture/options/texture_options.h"

namespace stucco::test {

// A survey folder with a wall of 4 x 3 m, rendered photos and their poses.
class WallSurvey {
 public:
  WallSurvey();

  std::filesystem::path Folder() const { return folder_.path() / "survey"; }
  std::filesystem::path Photos() const { return folder_.path() / "photos"; }
  std::filesystem::path Out(const std::string& name = "out") const { return folder_.path() / name; }

  void SetProxy(const Proxy& proxy);

  SurveyPhoto Add(const std::string& name, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                  double exposure = 1, const Scene& scene = WallScene(4, 3));

  // Poses a photo without writing a file.
  void Pose(const SurveyPhoto& photo);

  // The pose that the program is told is wrong by this rotation about the camera's y axis.
  void Disturb(const std::string& name, double yaw_rad);

  // A plan whose only facade is the wall, with one view for the photo of this name, if any.
  void Plan(const std::string& planned_photo);

  TextureSet Run(TextureOptions options = {}, const std::string& out = "out", int threads = 1,
                 UnitStore* units = nullptr) const;

  Image Picture(const TexturedFacet& facet, const std::string& out = "out") const;
  Image Labels(const TexturedFacet& facet, const std::string& out = "out") const;

 private:
  TemporaryFolder folder_;
  Reconstruction model_;
};

// Without the normal, which pictures do not depend on.
TexelGrid GridOf(const TexturedFacet& facet);

}  // namespace stucco::test
