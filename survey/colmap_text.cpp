// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cassert>
#include <iterator>
#include <string_view>

#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/internal/colmap.h"
#include "survey/internal/output_file.h"
#include "survey/text.h"

namespace stucco {
namespace internal {
namespace {

// The lines of a file, read word by word.
class LineReader {
 public:
  explicit LineReader(const std::filesystem::path& path)
      : name_(path.string()), text_(ReadFile(path)), rest_(text_) {}

  // Goes to the next line; false at the end of the file.
  bool NextLine() {
    const auto line = TakeLine(rest_);
    line_ = line.value_or(std::string_view());
    ++number_;
    return line.has_value();
  }

  // Goes to the next line that is neither blank nor a comment; false at the end of the file.
  bool NextEntry() {
    while (NextLine()) {
      const std::string_view text = Trim(line_);
      if (!text.empty() && !text.starts_with('#')) return true;
    }
    return false;
  }

  bool AtLineEnd() const { return Trim(line_).empty(); }
  std::string_view RestOfLine() const { return Trim(line_); }

  std::string_view Word(const char* what) {
    const std::string_view word = TakeWord(line_);
    if (word.empty()) Fail(fmt::format("{} is missing", what));
    return word;
  }

  template <typename Number>
  Number Next(const char* what) {
    const std::string_view word = Word(what);
    const auto number = ParseNumber<Number>(word);
    if (!number) Fail(fmt::format("{} \"{}\" is not a number that fits", what, word));
    return *number;
  }

  std::string Where() const { return fmt::format("{}:{}", name_, number_); }
  [[noreturn]] void Fail(const std::string& reason) const { FailColmap(Where(), reason); }

 private:
  std::string name_;
  std::string text_;
  std::string_view rest_;
  std::string_view line_;
  int number_ = 0;
};

void ReadCamerasText(const std::filesystem::path& path, Reconstruction& reconstruction) {
  LineReader lines(path);
  while (lines.NextEntry()) {
    Camera camera;
    camera.id.value = lines.Next<uint32_t>("camera id");
    const std::string_view model = lines.Word("camera model");
    const auto known = CameraModelFromName(model);
    if (!known) FailCameraModel(lines.Where(), std::string(model));
    camera.model = *known;
    camera.width_px = lines.Next<int>("width");
    camera.height_px = lines.Next<int>("height");
    while (!lines.AtLineEnd()) camera.params.push_back(lines.Next<double>("camera parameter"));
    AddCamera(std::move(camera), lines.Where(), reconstruction);
  }
}

void ReadObservations(LineReader& lines, RegisteredImage& photo) {
  while (!lines.AtLineEnd()) {
    Observation observation;
    observation.pixel.x() = lines.Next<double>("x");
    observation.pixel.y() = lines.Next<double>("y");
    const std::string_view point = lines.Word("point id");
    if (point != "-1") {
      const auto id = ParseNumber<uint64_t>(point);
      if (!id) lines.Fail(fmt::format("point id \"{}\" is not a number that fits", point));
      observation.point.value = *id;
    }
    photo.observations.push_back(observation);
  }
}

void ReadPhotosText(const std::filesystem::path& path, Reconstruction& reconstruction) {
  LineReader lines(path);
  while (lines.NextEntry()) {
    RegisteredImage photo;
    photo.id.value = lines.Next<uint32_t>("image id");
    const auto w = lines.Next<double>("qw");
    const auto x = lines.Next<double>("qx");
    const auto y = lines.Next<double>("qy");
    const auto z = lines.Next<double>("qz");
    photo.cam_from_world.rotation = UnitRotation(w, x, y, z, lines.Where());
    for (double& number : photo.cam_from_world.translation) number = lines.Next<double>("t");
    photo.camera.value = lines.Next<uint32_t>("camera id");
    photo.name = lines.RestOfLine();
    const std::string where = lines.Where();
    // The second line of an image may be blank, and be missing at the end of the file.
    if (lines.NextLine()) ReadObservations(lines, photo);
    AddPhoto(std::move(photo), where, reconstruction);
  }
}

void ReadPointsText(const std::filesystem::path& path, Reconstruction& reconstruction) {
  LineReader lines(path);
  while (lines.NextEntry()) {
    TrackPoint point;
    point.id.value = lines.Next<uint64_t>("point id");
    for (double& number : point.position) number = lines.Next<double>("coordinate");
    for (uint8_t& byte : point.rgb) byte = lines.Next<uint8_t>("colour");
    point.error_px = lines.Next<double>("error");
    while (!lines.AtLineEnd()) {
      TrackElement element;
      element.photo.value = lines.Next<uint32_t>("image id");
      element.observation = lines.Next<uint32_t>("observation");
      point.track.push_back(element);
    }
    AddPoint(std::move(point), lines.Where(), reconstruction);
  }
}

// 17 significant digits are enough for every double to read back exactly.
void AppendNumber(std::string& out, double number) {
  fmt::format_to(std::back_inserter(out), " {:.17g}", number);
}

template <typename Integer>
void AppendInteger(std::string& out, Integer number) {
  fmt::format_to(std::back_inserter(out), " {}", number);
}

std::string CamerasText(const Reconstruction& reconstruction) {
  std::string out = "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n";
  for (const auto& [id, camera] : reconstruction.cameras) {
    out +=
        fmt::format("{} {} {} {}", id.value, Name(camera.model), camera.width_px, camera.height_px);
    for (const double parameter : camera.params) AppendNumber(out, parameter);
    out += '\n';
  }
  return out;
}

std::string PhotosText(const Reconstruction& reconstruction) {
  std::string out =
      "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n# POINTS2D[] as (X, Y, "
      "POINT3D_ID)\n";
  for (const auto& [id, photo] : reconstruction.photos) {
    if (photo.name.find_first_of("\r\n") != std::string::npos || Trim(photo.name) != photo.name) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("photo name \"{}\" cannot be written as COLMAP text", photo.name),
                  "rename the photo: no line breaks, no blanks at its ends");
    }
    const Eigen::Quaterniond& rotation = photo.cam_from_world.rotation;
    out += fmt::format("{}", id.value);
    for (const double number : {rotation.w(), rotation.x(), rotation.y(), rotation.z()}) {
      AppendNumber(out, number);
    }
    for (const double number : photo.cam_from_world.translation) AppendNumber(out, number);
    out += fmt::format(" {} {}\n", photo.camera.value, photo.name);
    for (const Observation& observation : photo.observations) {
      for (const double number : observation.pixel) AppendNumber(out, number);
      if (observation.point.IsValid()) {
        AppendInteger(out, observation.point.value);
      } else {
        out += " -1";
      }
    }
    out += '\n';
  }
  return out;
}

std::string PointsText(const Reconstruction& reconstruction) {
  std::string out = "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
  for (const auto& [id, point] : reconstruction.points) {
    out += fmt::format("{}", id.value);
    for (const double number : point.position) AppendNumber(out, number);
    for (const uint8_t byte : point.rgb) AppendInteger(out, byte);
    AppendNumber(out, point.error_px);
    for (const TrackElement& element : point.track) {
      AppendInteger(out, element.photo.value);
      AppendInteger(out, element.observation);
    }
    out += '\n';
  }
  return out;
}

}  // namespace

Reconstruction ReadColmapText(const std::filesystem::path& folder) {
  Reconstruction reconstruction;
  ReadCamerasText(folder / "cameras.txt", reconstruction);
  ReadPhotosText(folder / "images.txt", reconstruction);
  ReadPointsText(folder / "points3D.txt", reconstruction);
  return reconstruction;
}

}  // namespace internal

void WriteColmapText(const Reconstruction& reconstruction, const std::filesystem::path& folder) {
  assert(!FindProblem(reconstruction));
  internal::CreateFolder(folder);
  WriteFile(folder / "cameras.txt", internal::CamerasText(reconstruction));
  WriteFile(folder / "images.txt", internal::PhotosText(reconstruction));
  WriteFile(folder / "points3D.txt", internal::PointsText(reconstruction));
}

}  // namespace stucco
