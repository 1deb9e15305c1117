// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/occluders.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulate/paint/paint.h"
#include "simulate/random.h"
#include "simulate/scene/scene_folder.h"

namespace stucco::simulate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kLeafPictures = 3;
constexpr int kLeafPicture_px = 256;
constexpr double kSprays_per_m2 = 11;  // of the crown's surface
constexpr double kCarTexel_m = 0.01;

Vector3d OnSphere(Random& random) {
  const double z = random.Uniform(-1, 1);
  const double turn = random.Uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

// A stem or a branch: a prism of six sides that grows thinner.
void AddStem(const Trim& bark, const Vector3d& from, const Vector3d& to, double radius_from,
             double radius_to, CityModel& model) {
  const Vector3d axis = (to - from).normalized();
  const Vector3d x = axis.unitOrthogonal();
  const Vector3d y = axis.cross(x);
  constexpr int kSides = 6;
  const auto at = [&](const Vector3d& foot, double radius, int side) -> Vector3d {
    const double turn = 2 * std::numbers::pi * side / kSides;
    return foot + radius * (std::cos(turn) * x + std::sin(turn) * y);
  };
  for (int i = 0; i < kSides; ++i) {
    AddTrim(bark,
            {at(from, radius_from, i), at(from, radius_from, i + 1), at(to, radius_to, i + 1),
             at(to, radius_to, i)},
            model);
  }
}

// Sprays of leaves on the hull of a crown and inside it, standing out in all directions.
void AddCrown(const Vector3d& middle, const Vector3d& radii, int element,
              const std::vector<int>& leaves, Random& random, CityModel& model) {
  const double surface = 4 * std::numbers::pi * radii.x() * radii.z();
  const int count = static_cast<int>(kSprays_per_m2 * surface);
  for (int i = 0; i < count; ++i) {
    // Most near the hull, whose bulges differ from tree to tree.
    const Vector3d direction = OnSphere(random);
    const double depth = 1 - 0.55 * std::pow(random.Unit(), 2);
    const double bulge = 1 + 0.16 * std::sin(4.1 * direction.x() + middle.x()) *
                                 std::cos(3.7 * direction.y() + 2.3 * direction.z() + middle.y());
    const Vector3d foot = middle + depth * bulge * radii.cwiseProduct(direction);
    Sheet sheet;
    sheet.element = element;
    sheet.material = leaves[random.Index(static_cast<int>(leaves.size()))];
    sheet.u = OnSphere(random);
    sheet.v = sheet.u.cross(OnSphere(random)).normalized();
    sheet.width_m = sheet.height_m = random.Uniform(0.45, 0.8);
    sheet.origin = foot - sheet.width_m / 2 * (sheet.u + sheet.v);
    const Vector3d right = sheet.width_m * sheet.u;
    const Vector3d down = sheet.height_m * sheet.v;
    AddConvex(
        sheet,
        {sheet.origin + down, sheet.origin + down + right, sheet.origin + right, sheet.origin},
        model);
  }
}

void AddTree(const Tree& tree, double ground, Trim bark, const std::vector<int>& leaves,
             Random random, CityModel& model) {
  const Vector3d foot(tree.position.x(), tree.position.y(), ground - 0.1);
  const double crown_height = tree.height_m * random.Uniform(0.62, 0.75);
  const Vector3d middle = foot + Vector3d(random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2),
                                          tree.height_m - crown_height / 2);
  const double trunk = 0.02 * tree.height_m + 0.05;
  AddStem(bark, foot, middle, trunk, trunk / 2, model);
  for (int i = 0; i < 5; ++i) {
    const Vector3d from = foot + random.Uniform(0.55, 0.95) * (middle - foot);
    const Vector3d reach = OnSphere(random).cwiseProduct(Vector3d(1, 1, 0.5)) + Vector3d(0, 0, 0.4);
    AddStem(bark, from, from + 0.75 * tree.crown_m * reach, trunk / 3, trunk / 8, model);
  }
  AddCrown(middle, {tree.crown_m, tree.crown_m, crown_height / 2}, bark.element, leaves, random,
           model);
}

// The outline of a car from its side: x from its nose, y down from its roof, as PaintCar paints it.
std::vector<Vector2d> CarOutline() {
  return {{0.06, 1.28}, {0.02, 0.72}, {0.5, 0.62},  {0.98, 0.58}, {1.42, 0.13},
          {3.56, 0.13}, {3.82, 0.6},  {4.36, 0.68}, {4.38, 1.28}};
}

class CarBuilder {
 public:
  CarBuilder(const Car& car, double ground, int element, int material, CityModel& model)
      : model_(model) {
    const Eigen::Rotation2Dd turn(car.heading_rad);
    const Vector2d ahead = turn * Vector2d::UnitX();
    back_ = {-ahead.x(), -ahead.y(), 0};
    left_ = {-ahead.y(), ahead.x(), 0};
    const Vector2d nose = car.position + kLength_m / 2 * ahead;
    top_of_nose_ = {nose.x(), nose.y(), ground + kHeight_m};
    sheet_.element = element;
    sheet_.material = material;
    sheet_.width_m = kLength_m;
    sheet_.height_m = kHeight_m;
    sheet_.origin = top_of_nose_;
    sheet_.u = back_;
    sheet_.v = -Vector3d::UnitZ();
  }

  void Build() {
    const std::vector<Vector2d> outline = CarOutline();
    Flank(outline, kHalfWidth_m);
    Flank(outline, -kHalfWidth_m);
    for (size_t i = 0; i < outline.size(); ++i) {
      const Vector2d& a = outline[i];
      const Vector2d& b = outline[(i + 1) % outline.size()];
      const bool glass = i == 3 || i == 5;  // windscreens
      const bool below = i + 1 == outline.size();
      // The spot of the picture that has the colour: a window, the sill, the lacquer.
      const Vector2d spot = glass   ? Vector2d(2.4, 0.45)
                            : below ? Vector2d(2, 1.4)
                                    : Vector2d(1.6, 0.95);
      Across(a, b, spot);
    }
    for (const double wheel : {0.85, 3.5}) {
      for (const double side : {-1.0, 1.0}) Wheel(wheel, side);
    }
  }

 private:
  static constexpr double kLength_m = 4.4;
  static constexpr double kHeight_m = 1.5;
  static constexpr double kHalfWidth_m = 0.86;

  Vector3d At(const Vector2d& p, double left) const {
    return top_of_nose_ + p.x() * back_ - p.y() * Vector3d::UnitZ() + left * left_;
  }

  void Flank(const std::vector<Vector2d>& outline, double left) {
    Loop loop;
    for (const Vector2d& p : outline) loop.push_back(At(p, left));
    if (left > 0) std::reverse(loop.begin(), loop.end());
    AddPolygon(sheet_, loop, {}, model_);
  }

  // A strip from flank to flank in the colour of one spot of the picture.
  void Across(const Vector2d& a, const Vector2d& b, const Vector2d& spot) {
    const Vector2f uv(static_cast<float>(spot.x() / kLength_m),
                      static_cast<float>(spot.y() / kHeight_m));
    const size_t first = model_.scene.uv.size();
    AddConvex(
        sheet_,
        {At(a, -kHalfWidth_m), At(a, kHalfWidth_m), At(b, kHalfWidth_m), At(b, -kHalfWidth_m)},
        model_);
    for (size_t i = first; i < model_.scene.uv.size(); ++i) model_.scene.uv[i] = uv;
  }

  void Wheel(double x, double side) {
    constexpr int kSides = 14;
    constexpr double kRadius_m = 0.32;
    constexpr double kWidth_m = 0.2;
    const Vector2d hub(x, kHeight_m - kRadius_m);
    Loop disc;
    for (int i = 0; i < kSides; ++i) {
      const double turn = 2 * std::numbers::pi * i / kSides;
      disc.push_back(At(hub + kRadius_m * Vector2d(std::cos(turn), std::sin(turn)),
                        side * (kHalfWidth_m + 0.01)));
    }
    AddConvex(sheet_, disc, model_);
    const Vector3d inwards = -side * kWidth_m * left_;
    const Vector2f tyre(static_cast<float>((x - 0.33) / kLength_m), 1.18f / kHeight_m);
    const size_t first = model_.scene.uv.size();
    for (int i = 0; i < kSides; ++i) {
      const Vector3d& a = disc[i];
      const Vector3d& b = disc[(i + 1) % kSides];
      AddConvex(sheet_, {a, b, b + inwards, a + inwards}, model_);
    }
    for (size_t i = first; i < model_.scene.uv.size(); ++i) model_.scene.uv[i] = tyre;
  }

  using Vector2f = Eigen::Vector2f;
  CityModel& model_;
  Vector3d back_, left_, top_of_nose_;
  Sheet sheet_;
};

std::vector<int> AddLeaves(uint64_t seed, CityModel& model) {
  std::vector<int> leaves;
  for (int i = 0; i < kLeafPictures; ++i) {
    const uint64_t own = Random(seed, 70 + i).Next();
    leaves.push_back(AddPainted(fmt::format("leaves-{}", i),
                                {[own] { return PaintLeaves(own, kLeafPicture_px); }, ""}, model));
    model.scene.materials[leaves.back()].cut_out = true;
  }
  return leaves;
}

}  // namespace

void AddOccluders(const Town& town, uint64_t seed, CityModel& model) {
  const std::vector<int> leaves = AddLeaves(seed, model);
  const CoveringDesign soil{.width_m = 2, .height_m = 2, .covering = Covering::kSoil, .seed = seed};
  Trim bark;
  bark.material = AddPainted("bark", {[soil] { return PaintCovering(soil, 0.01); }, ""}, model);
  for (size_t i = 0; i < town.trees.size(); ++i) {
    bark.element = AddElement(fmt::format("{}tree-{:03}", kOccluderPrefix, i), model);
    const double ground = GroundAt(town, town.trees[i].position);
    AddTree(town.trees[i], ground, bark, leaves, Random(seed, 2000 + i), model);
  }
  for (size_t i = 0; i < town.cars.size(); ++i) {
    const int element = AddElement(fmt::format("{}car-{:03}", kOccluderPrefix, i), model);
    const uint64_t own = Random(seed, 4000 + i).Next();
    const int material = AddPainted(fmt::format("car-{:03}", i),
                                    {[own] { return PaintCar(own, kCarTexel_m); }, ""}, model);
    model.scene.materials[material].gloss = 0.35f;
    CarBuilder(town.cars[i], GroundAt(town, town.cars[i].position), element, material, model)
        .Build();
  }
}

}  // namespace stucco::simulate
