// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/realitycapture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "exchange/brown_lens.h"
#include "exchange/internal/xml_file.h"
#include "exchange/rotation.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/text.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

constexpr char kNamespace[] = "http://www.capturingreality.com/ns/xcr/";
constexpr double kFullFrame_mm = 36;

bool IsXmp(const fs::path& path) {
  return LowerCase(path.extension().string()) == ".xmp";
}

// Fields of one photo: each is an attribute or an element of rdf:Description, as the program that
// wrote it liked.
class Sidecar {
 public:
  explicit Sidecar(const fs::path& path)
      : file_(path),
        description_(file_.root().child("x:xmpmeta").child("rdf:RDF").child("rdf:Description")) {}

  bool Has(const char* name) const { return !Text(name).empty(); }

  std::string_view Text(const char* name) const {
    const pugi::xml_attribute attribute = description_.attribute(name);
    return Trim(attribute ? attribute.value() : description_.child_value(name));
  }

  template <size_t kCount>
  std::array<double, kCount> Numbers(const char* name) const {
    std::array<double, kCount> numbers;
    std::string_view rest = Text(name);
    for (double& number : numbers) {
      const auto next = ParseNumber<double>(TakeWord(rest));
      if (!next || !std::isfinite(*next)) Fail(name);
      number = *next;
    }
    if (!Trim(rest).empty()) Fail(name);
    return numbers;
  }

  double Number(const char* name, double otherwise) const {
    return Has(name) ? Numbers<1>(name)[0] : otherwise;
  }

  [[noreturn]] void Fail(const char* name) const {
    Fail(name, fmt::format("\"{}\" is not what it should be", Text(name)),
         "export the XMP files again");
  }
  [[noreturn]] void Fail(const char* name, const std::string& reason,
                         const std::string& remedy) const {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: {}: {}", file_.path().string(), name, reason), remedy);
  }

 private:
  XmlFile file_;
  pugi::xml_node description_;
};

// k1 k2 k3 k4 t1 t2: three or four radial terms, two tangential ones in Brown's order.
void ReadDistortion(const Sidecar& sidecar, BrownLens& lens) {
  const std::string model(sidecar.Text("xcr:DistortionModel"));
  if (model.empty() || model == "perspective") return;
  const auto k = sidecar.Has("xcr:DistortionCoeficients")
                     ? sidecar.Numbers<6>("xcr:DistortionCoeficients")
                     : std::array<double, 6>{};
  if (std::ranges::all_of(k, [](double each) { return each == 0; })) return;
  const std::array known = {"brown3", "brown3t2", "brown4", "brown4t2"};
  const bool is_brown = std::ranges::find(known, model) != known.end();
  if (!is_brown || k[3] != 0) {
    sidecar.Fail("xcr:DistortionModel",
                 is_brown ? fmt::format("{} with a fourth radial term is not supported", model)
                          : fmt::format("{} is not supported", model),
                 "align again with the distortion model Brown3 or Brown3 with tangential2, and "
                 "export the XMP files again");
  }
  lens.k1 = k[0];
  lens.k2 = k[1];
  lens.k3 = k[2];
  lens.p1 = k[5];
  lens.p2 = k[4];
}

Camera ReadCamera(const Sidecar& sidecar, const ImageSize& size) {
  if (!sidecar.Has("xcr:FocalLength35mm")) {
    sidecar.Fail("xcr:FocalLength35mm", "is missing",
                 "export the XMP files with the calibration of the cameras");
  }
  constexpr double kNoSkew = 1e-9;
  if (!(std::abs(sidecar.Number("xcr:Skew", 0)) <= kNoSkew)) {
    sidecar.Fail("xcr:Skew", "a camera with skew is not supported", "align again without skew");
  }
  const double longer = std::max(size.width_px, size.height_px);
  BrownLens lens;
  lens.fx = sidecar.Numbers<1>("xcr:FocalLength35mm")[0] / kFullFrame_mm * longer;
  lens.fy = lens.fx * sidecar.Number("xcr:AspectRatio", 1);
  lens.cx = size.width_px / 2.0 + longer * sidecar.Number("xcr:PrincipalPointU", 0);
  lens.cy = size.height_px / 2.0 + longer * sidecar.Number("xcr:PrincipalPointV", 0);
  ReadDistortion(sidecar, lens);
  Camera camera = CameraWithLens(lens, size);
  if (const auto problem = FindProblem(camera)) {
    sidecar.Fail("xcr:FocalLength35mm", *problem, "export the XMP files again");
  }
  return camera;
}

Pose ReadPose(const Sidecar& sidecar, const fs::path& path) {
  const auto m = sidecar.Numbers<9>("xcr:Rotation");
  const auto c = sidecar.Numbers<3>("xcr:Position");
  Eigen::Matrix3d matrix;
  matrix << m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8];
  Pose pose;
  pose.rotation = RotationOfMatrix(matrix, fmt::format("{}: xcr:Rotation", path.string()));
  pose.translation = -(pose.rotation * Eigen::Vector3d(c[0], c[1], c[2]));
  return pose;
}

// The photos of sidecars, by place.
std::vector<std::string> PhotosOf(const std::vector<fs::path>& sidecars, const fs::path& folder,
                                  const PhotoIndex& photos) {
  std::vector<std::string> names;
  for (const fs::path& path : sidecars) {
    const std::string name = path.lexically_relative(folder).generic_string();
    names.push_back(photos.FindBySidecar(name).value_or(name));
  }
  return photos.Require(names);
}

}  // namespace

std::vector<fs::path> FindRealityCaptureFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied,
                                              error);
       !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (!IsXmp(entry->path()) || !entry->is_regular_file(error)) continue;
    if (ReadFile(entry->path()).find(kNamespace) != std::string::npos) {
      files.push_back(entry->path());
    }
  }
  std::ranges::sort(files);
  return files;
}

ExchangedModel ReadRealityCapture(const fs::path& folder, const PhotoIndex& photos) {
  ExchangedModel result;
  result.format = "RealityCapture XMP";
  std::vector<fs::path> posed;
  const std::vector<fs::path> files = FindRealityCaptureFiles(folder);
  for (const fs::path& path : files) {
    const Sidecar sidecar(path);
    if (sidecar.Has("xcr:Rotation") && sidecar.Has("xcr:Position")) posed.push_back(path);
  }
  if (posed.empty()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: none of its {} XMP files of RealityCapture has a pose",
                            folder.string(), files.size()),
                "export them after the alignment, with camera export mode Exact or Locked");
  }
  const std::vector<std::string> paths = PhotosOf(posed, folder, photos);
  for (size_t i = 0; i < posed.size(); ++i) {
    const Sidecar sidecar(posed[i]);
    const Camera camera = ReadCamera(sidecar, photos.SizeOf(paths[i]));
    AddPosedPhoto(SharedCamera(camera, result.model), paths[i], ReadPose(sidecar, posed[i]),
                  result.model);
  }
  if (files.size() > posed.size()) {
    result.notes.push_back(
        fmt::format("{} of its XMP files have no pose", files.size() - posed.size()));
  }
  return result;
}

}  // namespace stucco
