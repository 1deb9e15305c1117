// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Calibrates a made-up survey of any size of which there are features only, no pictures, and says
// what each step cost: how calibration grows beyond what can be rendered.
//
//   features_only OUT PHOTOS FEATURES [THREADS]
//
// A drone flies rows over a field of points 60 m below, photos 15 m apart that look down at two
// slants, with positions good to half a metre and gimbal angles good to half a degree. Features are
// made when they are asked for, as if they lay in checkpoints.
#include <fmt/format.h>
#include <sys/resource.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <map>
#include <mutex>
#include <string>

#include "calib/calibrate.h"
#include "calib/features/features.h"
#include "calib/matching/detect_photos.h"
#include "survey/attitude.h"
#include "survey/calibration.h"
#include "survey/captures.h"
#include "survey/georef.h"

namespace stucco::test {
namespace {

constexpr double kApart_m = 15;
constexpr double kHeight_m = 60;
constexpr double kRelief_m = 8;
constexpr double kDetected = 0.7;  // of the points in a picture
constexpr int kWidth_px = 1000;
constexpr int kHeight_px = 750;
constexpr double kFocal_px = 710;
constexpr double kKeypointNoise_px = 0.3;

// A number that looks random, of two others (splitmix64: Steele et al. 2014).
uint64_t Mix(uint64_t a, uint64_t b) {
  uint64_t z = a * 0x9e3779b97f4a7c15 + b * 0xd1b54a32d192ed03 + 0x632be59bd9b4e019;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

// From 0 to 1.
double Share(uint64_t number) {
  return static_cast<double>(number >> 11) * 0x1p-53;
}

// About normal, with deviation 1.
double Noise(uint64_t a, uint64_t b) {
  double sum = -6;
  for (uint64_t i = 0; i < 12; ++i) sum += Share(Mix(Mix(a, b), i));
  return sum;
}

Camera MadeCamera() {
  Camera camera;
  camera.id = CameraId{1};
  camera.model = CameraModel::kOpenCv;
  camera.width_px = kWidth_px;
  camera.height_px = kHeight_px;
  camera.params = {kFocal_px, kFocal_px, kWidth_px / 2.0, kHeight_px / 2.0, -0.02, 0.005, 0, 0};
  return camera;
}

class MadeSurvey {
 public:
  MadeSurvey(int num_photos, int features_per_photo)
      : num_photos_(num_photos), side_(static_cast<int>(std::ceil(std::sqrt(num_photos)))) {
    const double area_m2 = kWidth_px * kHeight_px * kHeight_m * kHeight_m / (kFocal_px * kFocal_px);
    cell_m_ = std::sqrt(area_m2 * kDetected / features_per_photo);
    georef_.origin_latitude_deg = 50;
    georef_.origin_longitude_deg = 14;
    georef_.origin_height_m = 200;
  }

  Captures Records() const {
    Captures captures;
    Camera guess = camera_;
    guess.params = {
        kFocal_px * 1.01, kFocal_px * 1.01, kWidth_px / 2.0, kHeight_px / 2.0, 0, 0, 0, 0};
    captures.cameras.push_back({"made", "made up", guess, "exif_35mm", false});
    for (int i = 0; i < num_photos_; ++i) {
      CapturedPhoto photo;
      photo.path = fmt::format("{:06}.jpg", i);
      photo.hash = fmt::format("made {}", i);
      photo.usable = true;
      photo.width_px = kWidth_px;
      photo.height_px = kHeight_px;
      photo.camera = 0;
      const uint64_t seed = Mix(i, 77);
      const Eigen::Vector3d noise(Noise(seed, 0), Noise(seed, 1), Noise(seed, 2));
      const Eigen::Vector3d place = PlaceOf(i) + 0.5 * noise;
      const Eigen::Vector3d geodetic = GeodeticFromEnu(georef_, place);
      photo.position = GeoPosition{geodetic.x(), geodetic.y(), geodetic.z(), true, 0.5, 0.5, false};
      GimbalAngles angles = AnglesOf(i);
      angles.yaw_deg += 0.5 * Noise(seed, 3);
      angles.pitch_deg += 0.5 * Noise(seed, 4);
      photo.gimbal = angles;
      captures.photos.push_back(photo);
    }
    return captures;
  }

  Features FeaturesOf(int photo) const {
    const Eigen::Quaterniond rotation = CamFromEnu(AnglesOf(photo));
    const Eigen::Vector3d place = PlaceOf(photo);
    const int reach = static_cast<int>(1.8 * kHeight_m / cell_m_);
    const int middle_x = static_cast<int>(std::floor(place.x() / cell_m_));
    const int middle_y = static_cast<int>(std::floor(place.y() / cell_m_));
    Features features;
    for (int y = middle_y - reach; y <= middle_y + reach; ++y) {
      for (int x = middle_x - reach; x <= middle_x + reach; ++x) {
        const uint64_t point = Mix(static_cast<uint64_t>(x), static_cast<uint64_t>(y));
        const uint64_t seen = Mix(point, photo);
        if (Share(seen) > kDetected) continue;
        const auto pixel = camera_.Project(rotation * (PointIn(x, y, point) - place));
        if (!pixel) continue;
        const Eigen::Vector2d keypoint =
            *pixel + kKeypointNoise_px * Eigen::Vector2d(Noise(seen, 1), Noise(seen, 2));
        if (!camera_.Contains(keypoint)) continue;
        features.keypoints.push_back(
            {static_cast<float>(keypoint.x()), static_cast<float>(keypoint.y()), 2});
        features.colors.push_back({128, 128, 128});
        features.descriptors.push_back(DescriptorOf(point, seen));
      }
    }
    return features;
  }

 private:
  Eigen::Vector3d PlaceOf(int photo) const {
    return {kApart_m * (photo % side_), kApart_m * (photo / side_), kHeight_m};
  }
  // There and back along the rows.
  GimbalAngles AnglesOf(int photo) const {
    return {photo / side_ % 2 == 0 ? 90.0 : -90.0, photo % 2 == 0 ? -85.0 : -65.0, 0};
  }
  Eigen::Vector3d PointIn(int x, int y, uint64_t point) const {
    return {cell_m_ * (x + Share(Mix(point, 1))), cell_m_ * (y + Share(Mix(point, 2))),
            kRelief_m * Share(Mix(point, 3))};
  }
  static std::array<uint8_t, 128> DescriptorOf(uint64_t point, uint64_t seen) {
    std::array<uint8_t, 128> descriptor;
    for (size_t i = 0; i < descriptor.size(); i += 8) {
      const uint64_t own = Mix(point, 100 + i);
      const uint64_t noise = Mix(seen, 100 + i);
      for (size_t k = 0; k < 8; ++k) {
        const auto value = static_cast<uint8_t>(own >> (8 * k));
        const int changed = (value < 160 ? 0 : value / 2) + static_cast<int>(noise >> (8 * k) & 15);
        descriptor[i + k] = static_cast<uint8_t>(changed);
      }
    }
    return descriptor;
  }

  int num_photos_;
  int side_;
  double cell_m_ = 1;
  Camera camera_ = MadeCamera();
  Georef georef_;
};

// Checkpoints that are made when they are asked for. Nothing is kept.
class MadeUnits : public UnitStore {
 public:
  MadeUnits(const MadeSurvey& survey, const CalibOptions& options, const Captures& captures)
      : survey_(survey) {
    for (size_t i = 0; i < captures.photos.size(); ++i) {
      photos_[FeaturesKey(options, captures.photos[i])] = static_cast<int>(i);
    }
  }
  std::optional<std::string> Load(std::string_view kind, std::string_view key) override {
    if (kind != "features") return std::nullopt;
    return Serialize(survey_.FeaturesOf(photos_.at(std::string(key))));
  }
  void Save(std::string_view, std::string_view, std::string_view) override {}

 private:
  const MadeSurvey& survey_;
  std::map<std::string, int> photos_;
};

double CpuSeconds() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Since it was asked for the last time: Linux forgets what was before.
int TakePeak_mb() {
  std::ifstream status("/proc/self/status");
  std::string word;
  int peak_kb = 0;
  while (status >> word) {
    if (word == "VmHWM:") status >> peak_kb;
  }
  std::ofstream("/proc/self/clear_refs") << 5;
  return peak_kb / 1024;
}

// Prints what each step cost when it is over.
class StepCosts : public Progress {
 public:
  ~StepCosts() override { End(); }
  void Begin(std::string_view step, size_t) override {
    End();
    step_ = step;
  }
  void Advance(size_t) override {}
  void Warn(std::string_view text) override { Note(text); }
  void Note(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    fmt::print("  {}\n", text);
  }
  bool Cancelled() const override { return false; }

 private:
  void End() {
    const auto now = std::chrono::steady_clock::now();
    const double cpu_s = CpuSeconds();
    fmt::print("{:20} {:8.1f} CPU s {:8.1f} s {:6} MB\n", step_, cpu_s - cpu_s_,
               std::chrono::duration<double>(now - since_).count(), TakePeak_mb());
    std::fflush(stdout);
    since_ = now;
    cpu_s_ = cpu_s;
  }

  std::mutex mutex_;
  std::string step_ = "reading";
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
  double cpu_s_ = CpuSeconds();
};

int Run(const std::filesystem::path& out, int num_photos, int num_features, int threads) {
  const MadeSurvey made(num_photos, num_features);
  const Captures captures = made.Records();
  std::filesystem::create_directories(out / "ingest");
  std::filesystem::create_directories(out / "calib");
  WriteCaptures(captures, out / "ingest" / "captures.json");
  CalibOptions options;
  options.neighbours = 12;
  MadeUnits units(made, options, captures);
  StageContext context;
  context.survey = out;
  context.out = out / "calib";
  context.threads = threads;
  context.units = &units;
  {
    StepCosts costs;
    context.progress = &costs;
    RunCalib(options, context);
  }
  const Calibration calibration = ReadCalibration(out / "calib" / "calibration.json");
  return calibration.photos_posed == num_photos ? 0 : 1;
}

}  // namespace
}  // namespace stucco::test

int main(int argc, char** argv) {
  if (argc < 4 || argc > 5) {
    fmt::print(stderr, "features_only OUT PHOTOS FEATURES [THREADS]\n");
    return 2;
  }
  try {
    return stucco::test::Run(argv[1], std::atoi(argv[2]), std::atoi(argv[3]),
                             argc > 4 ? std::atoi(argv[4]) : 2);
  } catch (const std::exception& error) {
    fmt::print(stderr, "features_only: {}\n", error.what());
    return 1;
  }
}
