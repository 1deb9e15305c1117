// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cassert>
#include <limits>
#include <string_view>

#include "survey/colmap_io.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/internal/bytes.h"
#include "survey/internal/colmap.h"
#include "survey/internal/output_file.h"

namespace stucco {
namespace internal {
namespace {

// Smallest sizes of records in bytes; they bound every count that a file states.
constexpr size_t kCameraBytes = 4 + 4 + 8 + 8;
constexpr size_t kPhotoBytes = 4 + 7 * 8 + 4 + 1 + 8;
constexpr size_t kObservationBytes = 8 + 8 + 8;
constexpr size_t kPointBytes = 8 + 3 * 8 + 3 + 8 + 8;
constexpr size_t kTrackElementBytes = 4 + 4;

class ByteReader {
 public:
  explicit ByteReader(const std::filesystem::path& path)
      : name_(path.string()), bytes_(ReadFile(path)) {}

  template <typename Number>
  Number Next() {
    if (bytes_.size() - position_ < sizeof(Number)) Fail("ends too early");
    const auto number = LoadLittleEndian<Number>(bytes_.data() + position_);
    position_ += sizeof(Number);
    return number;
  }

  // A count is believed only as far as the file has bytes for it.
  size_t NextCount(size_t bytes_each) {
    const auto count = Next<uint64_t>();
    const size_t left = bytes_.size() - position_;
    if (count > left / bytes_each) {
      Fail(fmt::format("{} bytes cannot hold {} entries", left, count));
    }
    return static_cast<size_t>(count);
  }

  std::string NextText() {
    const size_t end = bytes_.find('\0', position_);
    if (end == std::string::npos) Fail("a name has no end");
    std::string text = bytes_.substr(position_, end - position_);
    position_ = end + 1;
    return text;
  }

  void CheckEnd() const {
    if (position_ != bytes_.size()) {
      Fail(fmt::format("{} bytes too many", bytes_.size() - position_));
    }
  }

  std::string Where() const { return fmt::format("{} at byte {}", name_, position_); }
  [[noreturn]] void Fail(const std::string& reason) const { FailColmap(Where(), reason); }

 private:
  std::string name_;
  std::string bytes_;
  size_t position_ = 0;
};

int NextSide(ByteReader& bytes) {
  const auto side = bytes.Next<uint64_t>();
  if (side > static_cast<uint64_t>(std::numeric_limits<int>::max())) {
    bytes.Fail(fmt::format("picture side {} is too long", side));
  }
  return static_cast<int>(side);
}

void ReadCamerasBinary(const std::filesystem::path& path, Reconstruction& reconstruction) {
  ByteReader bytes(path);
  const size_t count = bytes.NextCount(kCameraBytes);
  for (size_t i = 0; i < count; ++i) {
    Camera camera;
    camera.id.value = bytes.Next<uint32_t>();
    const auto number = bytes.Next<int32_t>();
    const auto model = CameraModelFromNumber(number);
    if (!model) FailCameraModel(bytes.Where(), fmt::format("number {}", number));
    camera.model = *model;
    camera.width_px = NextSide(bytes);
    camera.height_px = NextSide(bytes);
    camera.params.resize(ParameterNames(camera.model).size());
    for (double& parameter : camera.params) parameter = bytes.Next<double>();
    AddCamera(std::move(camera), bytes.Where(), reconstruction);
  }
  bytes.CheckEnd();
}

void ReadPhotosBinary(const std::filesystem::path& path, Reconstruction& reconstruction) {
  ByteReader bytes(path);
  const size_t count = bytes.NextCount(kPhotoBytes);
  for (size_t i = 0; i < count; ++i) {
    RegisteredImage photo;
    photo.id.value = bytes.Next<uint32_t>();
    const auto w = bytes.Next<double>();
    const auto x = bytes.Next<double>();
    const auto y = bytes.Next<double>();
    const auto z = bytes.Next<double>();
    photo.cam_from_world.rotation = UnitRotation(w, x, y, z, bytes.Where());
    for (double& number : photo.cam_from_world.translation) number = bytes.Next<double>();
    photo.camera.value = bytes.Next<uint32_t>();
    photo.name = bytes.NextText();
    photo.observations.resize(bytes.NextCount(kObservationBytes));
    for (Observation& observation : photo.observations) {
      for (double& number : observation.pixel) number = bytes.Next<double>();
      observation.point.value = bytes.Next<uint64_t>();  // COLMAP's "none" is ours
    }
    AddPhoto(std::move(photo), bytes.Where(), reconstruction);
  }
  bytes.CheckEnd();
}

void ReadPointsBinary(const std::filesystem::path& path, Reconstruction& reconstruction) {
  ByteReader bytes(path);
  const size_t count = bytes.NextCount(kPointBytes);
  for (size_t i = 0; i < count; ++i) {
    TrackPoint point;
    point.id.value = bytes.Next<uint64_t>();
    for (double& number : point.position) number = bytes.Next<double>();
    for (uint8_t& byte : point.rgb) byte = bytes.Next<uint8_t>();
    point.error_px = bytes.Next<double>();
    point.track.resize(bytes.NextCount(kTrackElementBytes));
    for (TrackElement& element : point.track) {
      element.photo.value = bytes.Next<uint32_t>();
      element.observation = bytes.Next<uint32_t>();
    }
    AddPoint(std::move(point), bytes.Where(), reconstruction);
  }
  bytes.CheckEnd();
}

std::string CamerasBytes(const Reconstruction& reconstruction) {
  std::string out;
  AppendLittleEndian(out, uint64_t{reconstruction.cameras.size()});
  for (const auto& [id, camera] : reconstruction.cameras) {
    AppendLittleEndian(out, id.value);
    AppendLittleEndian(out, static_cast<int32_t>(camera.model));
    AppendLittleEndian(out, static_cast<uint64_t>(camera.width_px));
    AppendLittleEndian(out, static_cast<uint64_t>(camera.height_px));
    for (const double parameter : camera.params) AppendLittleEndian(out, parameter);
  }
  return out;
}

std::string PhotosBytes(const Reconstruction& reconstruction) {
  std::string out;
  AppendLittleEndian(out, uint64_t{reconstruction.photos.size()});
  for (const auto& [id, photo] : reconstruction.photos) {
    const Eigen::Quaterniond& rotation = photo.cam_from_world.rotation;
    AppendLittleEndian(out, id.value);
    for (const double number : {rotation.w(), rotation.x(), rotation.y(), rotation.z()}) {
      AppendLittleEndian(out, number);
    }
    for (const double number : photo.cam_from_world.translation) AppendLittleEndian(out, number);
    AppendLittleEndian(out, photo.camera.value);
    out += photo.name;
    out += '\0';
    AppendLittleEndian(out, uint64_t{photo.observations.size()});
    for (const Observation& observation : photo.observations) {
      for (const double number : observation.pixel) AppendLittleEndian(out, number);
      AppendLittleEndian(out, observation.point.value);
    }
  }
  return out;
}

std::string PointsBytes(const Reconstruction& reconstruction) {
  std::string out;
  AppendLittleEndian(out, uint64_t{reconstruction.points.size()});
  for (const auto& [id, point] : reconstruction.points) {
    AppendLittleEndian(out, id.value);
    for (const double number : point.position) AppendLittleEndian(out, number);
    for (const uint8_t byte : point.rgb) AppendLittleEndian(out, byte);
    AppendLittleEndian(out, point.error_px);
    AppendLittleEndian(out, uint64_t{point.track.size()});
    for (const TrackElement& element : point.track) {
      AppendLittleEndian(out, element.photo.value);
      AppendLittleEndian(out, element.observation);
    }
  }
  return out;
}

}  // namespace

Reconstruction ReadColmapBinary(const std::filesystem::path& folder) {
  Reconstruction reconstruction;
  ReadCamerasBinary(folder / "cameras.bin", reconstruction);
  ReadPhotosBinary(folder / "images.bin", reconstruction);
  ReadPointsBinary(folder / "points3D.bin", reconstruction);
  return reconstruction;
}

}  // namespace internal

void WriteColmapBinary(const Reconstruction& reconstruction, const std::filesystem::path& folder) {
  assert(!FindProblem(reconstruction));
  internal::CreateFolder(folder);
  WriteFile(folder / "cameras.bin", internal::CamerasBytes(reconstruction));
  WriteFile(folder / "images.bin", internal::PhotosBytes(reconstruction));
  WriteFile(folder / "points3D.bin", internal::PointsBytes(reconstruction));
}

}  // namespace stucco
