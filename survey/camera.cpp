// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/camera.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cassert>
#include <cmath>
#include <stdexcept>

namespace stucco {
namespace {

struct ModelInfo {
  CameraModel model;
  std::string_view name;
  std::span<const std::string_view> parameters;
  std::span<const ParameterKind> kinds;
};

constexpr std::array<std::string_view, 3> kSimplePinholeNames = {"f", "cx", "cy"};
constexpr std::array<std::string_view, 4> kPinholeNames = {"fx", "fy", "cx", "cy"};
constexpr std::array<std::string_view, 4> kSimpleRadialNames = {"f", "cx", "cy", "k"};
constexpr std::array<std::string_view, 5> kRadialNames = {"f", "cx", "cy", "k1", "k2"};
constexpr std::array<std::string_view, 8> kOpenCvNames = {"fx", "fy", "cx", "cy",
                                                          "k1", "k2", "p1", "p2"};
constexpr std::array<std::string_view, 12> kFullOpenCvNames = {"fx", "fy", "cx", "cy", "k1", "k2",
                                                               "p1", "p2", "k3", "k4", "k5", "k6"};

using enum ParameterKind;
constexpr std::array kOneFocalKinds = {kFocalLength, kPrincipalPoint, kPrincipalPoint, kRadial,
                                       kRadial};
constexpr std::array kTwoFocalKinds = {kFocalLength, kFocalLength, kPrincipalPoint, kPrincipalPoint,
                                       kRadial,      kRadial,      kTangential,     kTangential,
                                       kRational,    kRational,    kRational,       kRational};

// Of the models with as many focal lengths each is the beginning of the next.
template <size_t kAll, size_t kCount>
constexpr std::span<const ParameterKind> FirstKinds(
    const std::array<ParameterKind, kAll>& kinds,
    const std::array<std::string_view, kCount>& /*names*/) {
  return std::span(kinds).template first<kCount>();
}

constexpr std::array<ModelInfo, 6> kModels = {{
    {CameraModel::kSimplePinhole, "SIMPLE_PINHOLE", kSimplePinholeNames,
     FirstKinds(kOneFocalKinds, kSimplePinholeNames)},
    {CameraModel::kPinhole, "PINHOLE", kPinholeNames, FirstKinds(kTwoFocalKinds, kPinholeNames)},
    {CameraModel::kSimpleRadial, "SIMPLE_RADIAL", kSimpleRadialNames,
     FirstKinds(kOneFocalKinds, kSimpleRadialNames)},
    {CameraModel::kRadial, "RADIAL", kRadialNames, FirstKinds(kOneFocalKinds, kRadialNames)},
    {CameraModel::kOpenCv, "OPENCV", kOpenCvNames, FirstKinds(kTwoFocalKinds, kOpenCvNames)},
    {CameraModel::kFullOpenCv, "FULL_OPENCV", kFullOpenCvNames,
     FirstKinds(kTwoFocalKinds, kFullOpenCvNames)},
}};

const ModelInfo& InfoOf(CameraModel model) {
  for (const ModelInfo& info : kModels) {
    if (info.model == model) return info;
  }
  throw std::logic_error("unknown camera model");
}

// Models with one focal length start with f cx cy, the others with fx fy cx cy.
bool HasOneFocalLength(CameraModel model) {
  return model == CameraModel::kSimplePinhole || model == CameraModel::kSimpleRadial ||
         model == CameraModel::kRadial;
}

// Brown's distortion with a rational radial part, as OpenCV and COLMAP write it; every model of
// CameraModel is a case of it:
//   q(s) = (1 + k1 s + k2 s^2 + k3 s^3) / (1 + k4 s + k5 s^2 + k6 s^3),  s = x^2 + y^2
//   x' = x q + 2 p1 x y + p2 (s + 2 x^2),  y' = y q + p1 (s + 2 y^2) + 2 p2 x y
struct Lens {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0, k4 = 0, k5 = 0, k6 = 0;

  double Numerator(double s) const { return 1 + s * (k1 + s * (k2 + s * k3)); }
  double NumeratorSlope(double s) const { return k1 + s * (2 * k2 + s * 3 * k3); }
  double Denominator(double s) const { return 1 + s * (k4 + s * (k5 + s * k6)); }
  double DenominatorSlope(double s) const { return k4 + s * (2 * k5 + s * 3 * k6); }
  // dq / ds
  double RadialSlope(double s) const {
    const double denominator = Denominator(s);
    return (NumeratorSlope(s) * denominator - Numerator(s) * DenominatorSlope(s)) /
           (denominator * denominator);
  }

  Eigen::Vector2d Apply(const Eigen::Vector2d& ray) const {
    const double x = ray.x(), y = ray.y(), s = x * x + y * y;
    const double radial = Numerator(s) / Denominator(s);
    return {x * radial + 2 * p1 * x * y + p2 * (s + 2 * x * x),
            y * radial + p1 * (s + 2 * y * y) + 2 * p2 * x * y};
  }

  Eigen::Matrix2d Jacobian(const Eigen::Vector2d& ray) const {
    const double x = ray.x(), y = ray.y(), s = x * x + y * y;
    const double radial = Numerator(s) / Denominator(s);
    const double slope = 2 * RadialSlope(s);
    const double mixed = slope * x * y + 2 * (p1 * x + p2 * y);
    Eigen::Matrix2d jacobian;
    jacobian << radial + slope * x * x + 2 * p1 * y + 6 * p2 * x, mixed,  //
        mixed, radial + slope * y * y + 6 * p1 * y + 2 * p2 * x;
    return jacobian;
  }

  bool IsIdentity() const {
    return k1 == 0 && k2 == 0 && p1 == 0 && p2 == 0 && k3 == 0 && k4 == 0 && k5 == 0 && k6 == 0;
  }
};

Lens LensOf(const Camera& camera) {
  const std::vector<double>& p = camera.params;
  switch (camera.model) {
    case CameraModel::kSimplePinhole:
    case CameraModel::kPinhole:
      return {};
    case CameraModel::kSimpleRadial:
      assert(p.size() == 4);
      return {.k1 = p[3]};
    case CameraModel::kRadial:
      assert(p.size() == 5);
      return {.k1 = p[3], .k2 = p[4]};
    case CameraModel::kOpenCv:
      assert(p.size() == 8);
      return {.k1 = p[4], .k2 = p[5], .p1 = p[6], .p2 = p[7]};
    case CameraModel::kFullOpenCv:
      assert(p.size() == 12);
      return {.k1 = p[4],
              .k2 = p[5],
              .p1 = p[6],
              .p2 = p[7],
              .k3 = p[8],
              .k4 = p[9],
              .k5 = p[10],
              .k6 = p[11]};
  }
  throw std::logic_error("unknown camera model");
}

// True when r q(r^2) rises all the way from the axis to this radius. A polynomial that has turned
// back may rise again further out, so the way there is sampled, too; only a dip that fits between
// two samples is missed.
bool RisesUpTo(const Lens& lens, double s) {
  constexpr int kSamples = 16;
  for (int i = kSamples; i > 0; --i) {
    const double at = s * i / kSamples;
    const double numerator = lens.Numerator(at);
    const double denominator = lens.Denominator(at);
    // d/dr (r q) > 0, times the squared denominator.
    const double bend =
        lens.NumeratorSlope(at) * denominator - numerator * lens.DenominatorSlope(at);
    if (!(denominator > 0) || !(numerator * denominator + 2 * at * bend > 0)) return false;
  }
  return true;
}

// The ray that `lens` bends to `target`: Newton's method, halving a step that does not help.
std::optional<Eigen::Vector2d> Straighten(const Lens& lens, const Eigen::Vector2d& target) {
  constexpr double kResidual = 1e-10;  // far below a thousandth of a pixel for any focal length
  constexpr int kMaxSteps = 100;
  constexpr int kMaxHalvings = 20;
  Eigen::Vector2d ray = target;
  Eigen::Vector2d residual = lens.Apply(ray) - target;
  for (int step = 0; step < kMaxSteps && residual.norm() > 0; ++step) {
    const Eigen::Vector2d change = lens.Jacobian(ray).inverse() * residual;
    double share = 1;
    bool better = false;
    for (int halving = 0; halving < kMaxHalvings && !better; ++halving, share /= 2) {
      const Eigen::Vector2d next = ray - share * change;
      const Eigen::Vector2d next_residual = lens.Apply(next) - target;
      if (!(next_residual.norm() < residual.norm())) continue;
      ray = next;
      residual = next_residual;
      better = true;
    }
    if (!better) break;
  }
  if (!(residual.norm() < kResidual) || !RisesUpTo(lens, ray.squaredNorm())) return std::nullopt;
  return ray;
}

}  // namespace

std::string_view Name(CameraModel model) {
  return InfoOf(model).name;
}

std::optional<CameraModel> CameraModelFromName(std::string_view name) {
  for (const ModelInfo& info : kModels) {
    if (info.name == name) return info.model;
  }
  return std::nullopt;
}

std::optional<CameraModel> CameraModelFromNumber(int number) {
  for (const ModelInfo& info : kModels) {
    if (static_cast<int>(info.model) == number) return info.model;
  }
  return std::nullopt;
}

std::span<const std::string_view> ParameterNames(CameraModel model) {
  return InfoOf(model).parameters;
}

std::span<const ParameterKind> ParameterKinds(CameraModel model) {
  return InfoOf(model).kinds;
}

double Camera::FocalY() const {
  return HasOneFocalLength(model) ? params[0] : params[1];
}

Eigen::Vector2d Camera::PrincipalPoint() const {
  const size_t first = HasOneFocalLength(model) ? 1 : 2;
  return {params[first], params[first + 1]};
}

Eigen::Vector2d Camera::Distort(const Eigen::Vector2d& normalized) const {
  const Eigen::Vector2d bent = LensOf(*this).Apply(normalized);
  return Eigen::Vector2d(FocalX() * bent.x(), FocalY() * bent.y()) + PrincipalPoint();
}

std::optional<Eigen::Vector2d> Camera::Project(const Eigen::Vector3d& point_in_cam) const {
  if (!(point_in_cam.z() > 0)) return std::nullopt;
  return Distort(point_in_cam.hnormalized());
}

std::optional<Eigen::Vector2d> Camera::Unproject(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d centred = pixel - PrincipalPoint();
  const Eigen::Vector2d bent(centred.x() / FocalX(), centred.y() / FocalY());
  if (!bent.allFinite()) return std::nullopt;
  const Lens lens = LensOf(*this);
  return lens.IsIdentity() ? bent : Straighten(lens, bent);
}

bool Camera::IsInvertibleAt(const Eigen::Vector2d& normalized) const {
  const Lens lens = LensOf(*this);
  return lens.IsIdentity() || RisesUpTo(lens, normalized.squaredNorm());
}

bool Camera::Contains(const Eigen::Vector2d& pixel) const {
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < width_px && pixel.y() < height_px;
}

Camera Resized(const Camera& camera, int width_px, int height_px) {
  assert(width_px > 0 && height_px > 0 && camera.width_px > 0 && camera.height_px > 0);
  const double scale_x = static_cast<double>(width_px) / camera.width_px;
  const double scale_y = static_cast<double>(height_px) / camera.height_px;
  Camera resized = camera;
  resized.width_px = width_px;
  resized.height_px = height_px;
  if (HasOneFocalLength(camera.model) && scale_x != scale_y) {
    // Rounding to whole pixels scaled the axes apart, so the lens needs two focal lengths now.
    const Lens lens = LensOf(camera);
    resized.model = lens.IsIdentity() ? CameraModel::kPinhole : CameraModel::kOpenCv;
    resized.params.insert(resized.params.begin() + 1, camera.params[0]);
    resized.params.resize(4);
    if (!lens.IsIdentity()) {
      resized.params.insert(resized.params.end(), {lens.k1, lens.k2, 0.0, 0.0});
    }
  }
  const size_t first = HasOneFocalLength(resized.model) ? 1 : 2;
  resized.params[0] *= scale_x;
  if (first == 2) resized.params[1] *= scale_y;
  resized.params[first] *= scale_x;
  resized.params[first + 1] *= scale_y;
  return resized;
}

std::optional<std::string> FindProblem(const Camera& camera) {
  if (camera.width_px <= 0 || camera.height_px <= 0) {
    return fmt::format("size is {} x {}", camera.width_px, camera.height_px);
  }
  const auto names = ParameterNames(camera.model);
  if (camera.params.size() != names.size()) {
    return fmt::format("{} has {} parameters, not {}", Name(camera.model), names.size(),
                       camera.params.size());
  }
  for (size_t i = 0; i < names.size(); ++i) {
    if (!std::isfinite(camera.params[i])) return fmt::format("{} is not finite", names[i]);
  }
  if (!(camera.FocalX() > 0) || !(camera.FocalY() > 0)) return "focal length is not positive";
  return std::nullopt;
}

}  // namespace stucco
