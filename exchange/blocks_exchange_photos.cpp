// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/internal/blocks_exchange_photos.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "exchange/brown_lens.h"
#include "exchange/rotation.h"

namespace stucco {
namespace {

// Camera axes of a file in ours (x right, y down, z forward); they are right-handed, so that x and
// y say all.
struct AxesName {
  std::string_view name;
  Eigen::Vector3d x, y;
};

Eigen::Matrix3d OursFromFile(const XmlFile& file, const pugi::xml_node& group) {
  const Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d down = Eigen::Vector3d::UnitY();
  const std::array<AxesName, 8> known = {{{"XRightYDown", right, down},
                                          {"XRightYUp", right, -down},
                                          {"XLeftYDown", -right, down},
                                          {"XLeftYUp", -right, -down},
                                          {"XDownYRight", down, right},
                                          {"XDownYLeft", down, -right},
                                          {"XUpYRight", -down, right},
                                          {"XUpYLeft", -down, -right}}};
  const std::string name = TextOf(group, "CameraOrientation");
  for (const AxesName& axes : known) {
    if (axes.name != name && !(name.empty() && axes.name == "XRightYDown")) continue;
    Eigen::Matrix3d ours_from_file;
    ours_from_file << axes.x, axes.y, axes.x.cross(axes.y);
    return ours_from_file;
  }
  file.Fail(group, fmt::format("CameraOrientation \"{}\" is not known", name),
            "export the block with CameraOrientation XRightYDown");
}

bool IsFalse(const pugi::xml_node& group, const char* child) {
  const std::string text = TextOf(group, child);
  return text == "false" || text == "0";
}

bool HasPose(const pugi::xml_node& group, const pugi::xml_node& photo) {
  if (IsFalse(group, "ManualPose")) return false;
  const pugi::xml_node pose = photo.child("Pose");
  // 1 is the block itself; 0 are photos that could not be connected, others are fragments of their
  // own.
  const std::string component = TextOf(photo, "Component");
  return (component.empty() || component == "1") && pose.child("Rotation") && pose.child("Center");
}

bool HasPosedPhoto(const pugi::xml_node& group) {
  return std::ranges::any_of(group.children("Photo"),
                             [&](const pugi::xml_node& photo) { return HasPose(group, photo); });
}

double FocalInPixels(const XmlFile& file, const pugi::xml_node& group, const ImageSize& size) {
  if (const auto pixels = file.FindNumber(group, "FocalLengthPixels")) return *pixels;
  const double focal_mm = file.Number(group, "FocalLength");
  if (const auto pixel_mm = file.FindNumber(group, "PixelSize")) return focal_mm / *pixel_mm;
  return focal_mm * std::max(size.width_px, size.height_px) / file.Number(group, "SensorSize");
}

Eigen::Vector2d PrincipalPoint(const XmlFile& file, const pugi::xml_node& group,
                               const ImageSize& size) {
  const pugi::xml_node point = group.child("PrincipalPoint");
  if (!point) return {size.width_px / 2.0, size.height_px / 2.0};
  if (point.child("xmm")) {
    file.Fail(point, "it is in millimetres", "export the block with optical values in pixels");
  }
  return {file.Number(point, "x") + kPixelCentre, file.Number(point, "y") + kPixelCentre};
}

void RequireKnownLens(const XmlFile& file, const pugi::xml_node& group) {
  const std::string type = TextOf(group, "CameraModelType");
  if (!type.empty() && type != "Perspective") {
    file.Fail(group, fmt::format("camera model {} is not supported", type),
              "export the block with undistorted photos, and use those in the survey");
  }
  if (IsFalse(group, "ManualOpticalParams")) {
    file.Fail(group, "its optical values are to be taken from the photos",
              "export the block after its aerotriangulation");
  }
  constexpr double kNoSkew = 1e-9;
  if (std::abs(file.FindNumber(group, "Skew").value_or(0)) > kNoSkew) {
    file.Fail(group, "a camera with skew is not supported",
              "run the aerotriangulation with skew held at 0");
  }
}

Camera ReadCamera(const XmlFile& file, const pugi::xml_node& group) {
  RequireKnownLens(file, group);
  const pugi::xml_node dimensions = group.child("ImageDimensions");
  constexpr int64_t kLargest = 1 << 20;
  const auto side = [&](const char* name) {
    const int64_t pixels = file.Integer(dimensions ? dimensions : group, name);
    if (pixels <= 0 || pixels > kLargest) file.Fail(group, fmt::format("{} is {}", name, pixels));
    return static_cast<int>(pixels);
  };
  const ImageSize size = {side("Width"), side("Height")};
  BrownLens lens;
  lens.fx = FocalInPixels(file, group, size);
  lens.fy = lens.fx * file.FindNumber(group, "AspectRatio").value_or(1);
  const Eigen::Vector2d principal = PrincipalPoint(file, group, size);
  lens.cx = principal.x();
  lens.cy = principal.y();
  const pugi::xml_node distortion = group.child("Distortion");
  lens.k1 = file.FindNumber(distortion, "K1").value_or(0);
  lens.k2 = file.FindNumber(distortion, "K2").value_or(0);
  lens.k3 = file.FindNumber(distortion, "K3").value_or(0);
  // Brown's order: P1 (r^2 + 2 x^2) + 2 P2 x y is what bends x.
  lens.p1 = file.FindNumber(distortion, "P2").value_or(0);
  lens.p2 = file.FindNumber(distortion, "P1").value_or(0);
  Camera camera = CameraWithLens(lens, size);
  if (const auto problem = FindProblem(camera)) file.Fail(group, *problem);
  return camera;
}

Pose ReadPose(const XmlFile& file, const pugi::xml_node& photo,
              const Eigen::Matrix3d& ours_from_file) {
  const pugi::xml_node rotation = photo.child("Pose").child("Rotation");
  if (!rotation.child("M_00")) {
    file.Fail(rotation, "the rotation is given by angles, of which programs mean different things",
              "export the block with rotations as matrices");
  }
  Eigen::Matrix3d matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      matrix(row, column) = file.Number(rotation, fmt::format("M_{}{}", row, column).c_str());
    }
  }
  Pose pose;
  pose.rotation = RotationOfMatrix(ours_from_file * matrix, file.Where(rotation));
  pose.translation = -(pose.rotation * file.Vector(photo.child("Pose").child("Center")));
  return pose;
}

bool IsAbsolute(std::string_view path) {
  const bool has_drive = path.size() > 1 && path[1] == ':' && std::isalpha(path[0]) != 0;
  return path.starts_with('/') || path.starts_with('\\') || has_drive;
}

std::string NameOf(const XmlFile& file, const pugi::xml_node& photo) {
  const std::string path = TextOf(photo, "ImagePath");
  if (path.empty()) file.Fail(photo, "ImagePath is missing");
  const std::string base = TextOf(file.root().child("BlocksExchange"), "BaseImagePath");
  return base.empty() || IsAbsolute(path) ? path : base + "/" + path;
}

struct PosedElement {
  pugi::xml_node photo;
  int64_t id = 0;
  size_t group = 0;  // index into groups
};

struct PosedGroup {
  CameraId camera;
  Eigen::Matrix3d ours_from_file;
};

}  // namespace

int CountPosed(const pugi::xml_node& block) {
  int count = 0;
  for (const pugi::xml_node group : block.child("Photogroups").children("Photogroup")) {
    for (const pugi::xml_node photo : group.children("Photo")) count += HasPose(group, photo);
  }
  return count;
}

BlockPhotos ReadBlockPhotos(const XmlFile& file, const pugi::xml_node& block,
                            const PhotoIndex& photos, ExchangedModel& result) {
  BlockPhotos found;
  std::vector<PosedGroup> groups;
  std::vector<PosedElement> posed;
  std::vector<std::string> names;
  for (const pugi::xml_node group : block.child("Photogroups").children("Photogroup")) {
    if (HasPosedPhoto(group)) {
      groups.push_back(
          {SharedCamera(ReadCamera(file, group), result.model), OursFromFile(file, group)});
      const std::string own_srs = TextOf(group, "SRSId");
      found.srs_ids.insert(own_srs.empty() ? TextOf(block, "SRSId") : own_srs);
    }
    for (const pugi::xml_node photo : group.children("Photo")) {
      const int64_t id = file.Integer(photo, "Id");
      if (!found.all.insert(id).second) {
        file.Fail(photo, fmt::format("two photos have the Id {}", id));
      }
      if (!HasPose(group, photo)) continue;
      posed.push_back({photo, id, groups.size() - 1});
      names.push_back(NameOf(file, photo));
    }
  }
  const std::vector<std::string> paths = photos.Require(names);
  for (size_t i = 0; i < posed.size(); ++i) {
    const PosedGroup& group = groups[posed[i].group];
    found.posed[posed[i].id] = AddPosedPhoto(
        group.camera, paths[i], ReadPose(file, posed[i].photo, group.ours_from_file), result.model);
  }
  return found;
}

}  // namespace stucco
