// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/occluders.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulate/paint/car_shape.h"
#include "simulate/paint/paint.h"
#include "simulate/random.h"
#include "simulate/scene/scene_folder.h"
#include "survey/triangulate.h"

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
struct Stem {
  Vector3d from, to;
  double radius_from, radius_to;
};

void AddStem(const Stem& stem, const Trim& bark, CityModel& model) {
  const Vector3d axis = (stem.to - stem.from).normalized();
  const Vector3d x = axis.unitOrthogonal();
  const Vector3d y = axis.cross(x);
  constexpr int kSides = 6;
  const auto at = [&](const Vector3d& foot, double radius, int side) -> Vector3d {
    const double turn = 2 * std::numbers::pi * side / kSides;
    return foot + radius * (std::cos(turn) * x + std::sin(turn) * y);
  };
  for (int i = 0; i < kSides; ++i) {
    AddTrim(bark,
            {at(stem.from, stem.radius_from, i), at(stem.from, stem.radius_from, i + 1),
             at(stem.to, stem.radius_to, i + 1), at(stem.to, stem.radius_to, i)},
            model);
  }
}

// What a tree is made of.
struct Foliage {
  Trim bark;
  std::vector<int> leaves;  // materials
};

// Sprays of leaves on the hull of a crown and inside it, standing out in all directions.
void AddCrown(const Vector3d& middle, const Vector3d& radii, const Foliage& foliage, Random& random,
              CityModel& model) {
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
    sheet.element = foliage.bark.element;
    sheet.material = foliage.leaves[random.Index(static_cast<int>(foliage.leaves.size()))];
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

void AddTree(const Tree& tree, double ground, const Foliage& foliage, Random random,
             CityModel& model) {
  const Vector3d foot(tree.position.x(), tree.position.y(), ground - 0.1);
  const double crown_height = tree.height_m * random.Uniform(0.62, 0.75);
  const double north = random.Uniform(-0.2, 0.2);
  const double east = random.Uniform(-0.2, 0.2);
  const Vector3d middle = foot + Vector3d(east, north, tree.height_m - crown_height / 2);
  const double trunk = 0.02 * tree.height_m + 0.05;
  AddStem({foot, middle, trunk, trunk / 2}, foliage.bark, model);
  for (int i = 0; i < 5; ++i) {
    const Vector3d from = foot + random.Uniform(0.55, 0.95) * (middle - foot);
    const Vector3d reach = OnSphere(random).cwiseProduct(Vector3d(1, 1, 0.5)) + Vector3d(0, 0, 0.4);
    AddStem({from, from + 0.75 * tree.crown_m * reach, trunk / 3, trunk / 8}, foliage.bark, model);
  }
  AddCrown(middle, {tree.crown_m, tree.crown_m, crown_height / 2}, foliage, random, model);
}

class CarBuilder {
 public:
  CarBuilder(const Car& car, const CarShape& shape, double ground, const Sheet& sheet,
             CityModel& model)
      : shape_(shape), sheet_(sheet), model_(model) {
    const Vector2d ahead = Eigen::Rotation2Dd(car.heading_rad) * Vector2d::UnitX();
    back_ = {-ahead.x(), -ahead.y(), 0};
    left_ = {-ahead.y(), ahead.x(), 0};
    const Vector2d nose = car.position + kCarLength_m / 2 * ahead;
    top_of_nose_ = {nose.x(), nose.y(), ground + kCarHeight_m};
  }

  void Build() {
    const std::vector<Vector2d>& outline = shape_.outline;
    const auto belt = outline.begin() + shape_.windscreen;
    const auto belt_end = outline.begin() + shape_.rear_window + 2;
    std::vector<Vector2d> body(outline.begin(), belt + 1);
    body.insert(body.end(), belt_end - 1, outline.end());
    for (const double side : {-1.0, 1.0}) {
      Flank(body, side);
      Flank(std::vector<Vector2d>(belt, belt_end), side);
      for (const double wheel : {0.85, 3.5}) Wheel(wheel, side);
    }
    for (size_t i = 0; i + 1 < outline.size(); ++i) Across(outline[i], outline[i + 1]);
    Across(outline.back(), outline.front());
  }

 private:
  // A corner of the car: a place of its side view, and how far to the left.
  struct Corner {
    Vector2d side;
    double left;
  };

  Vector3d At(const Corner& corner) const {
    return top_of_nose_ + corner.side.x() * back_ - corner.side.y() * Vector3d::UnitZ() +
           corner.left * left_;
  }

  // Corners counter-clockwise seen from outside, each with its place on the picture in metres.
  void Face(const std::vector<Corner>& corners, const std::vector<Vector2d>& on_picture) {
    const size_t first = model_.scene.uv.size();
    Loop loop;
    for (const Corner& corner : corners) loop.push_back(At(corner));
    AddConvex(sheet_, loop, model_);
    for (size_t i = 0; i < corners.size(); ++i) {
      const Vector2d uv = on_picture[i].cwiseQuotient(Vector2d(sheet_.width_m, sheet_.height_m));
      model_.scene.uv[first + i] = uv.cast<float>();
    }
  }

  // A polygon of the side view, bent as the car's width has it.
  void Flank(const std::vector<Vector2d>& outline, double side) {
    Loop flat;
    for (const Vector2d& p : outline) flat.emplace_back(p.x(), -p.y(), 0);
    // It runs clockwise as seen from the left: from the foot of the nose upwards.
    std::reverse(flat.begin(), flat.end());
    const FacetTriangles shape = TriangulateFacet(ExactFacet(FacetClass::kWall, flat, {}));
    for (const auto& triangle : shape.triangles) {
      std::vector<Corner> corners;
      std::vector<Vector2d> on_picture;
      for (const uint32_t i : triangle) {
        const Vector2d at(shape.vertices[i].x(), -shape.vertices[i].y());
        corners.push_back({at, side * shape_.HalfWidth(at)});
        on_picture.push_back(at);
      }
      if (side < 0) {  // seen from the right, the nose is on the right
        std::swap(corners[1], corners[2]);
        std::swap(on_picture[1], on_picture[2]);
      }
      Face(corners, on_picture);
    }
  }

  // A strip from flank to flank. What is steep is painted as seen from before or behind, the rest
  // as seen from above; what lies under the car is as dark as its sills.
  void Across(const Vector2d& a, const Vector2d& b) {
    std::vector<Corner> corners;
    std::vector<Vector2d> on_picture;
    const bool steep = std::abs(b.y() - a.y()) > std::abs(b.x() - a.x());
    const bool below = !steep && b.x() < a.x();
    const bool nose = a.x() < kCarLength_m / 2;
    const auto add = [&](const Vector2d& p, double side) {
      const double left = side * shape_.HalfWidth(p);
      corners.push_back({p, left});
      if (below) {
        on_picture.emplace_back(2, 1.4);
      } else if (!steep) {
        on_picture.emplace_back(p.x(), kCarRoofTop_m + kCarWidth_m / 2 - left);
      } else if (nose) {
        on_picture.emplace_back(kCarWidth_m / 2 + left, kCarEndsTop_m + p.y());
      } else {
        on_picture.emplace_back(1.5 * kCarWidth_m - left, kCarEndsTop_m + p.y());
      }
    };
    add(a, -1);
    add(a, 1);
    add(b, 1);
    add(b, -1);
    Face(corners, on_picture);
  }

  void Wheel(double x, double side) {
    constexpr int kSides = 14;
    constexpr double kRadius_m = 0.32;
    constexpr double kWidth_m = 0.2;
    const double outside = side * (kCarWidth_m / 2 + 0.005);
    const Vector2d hub(x, kCarHeight_m - kRadius_m);
    const Vector2d tyre(x - 0.33, 1.18);
    std::vector<Corner> disc;
    std::vector<Vector2d> on_picture;
    for (int i = 0; i < kSides; ++i) {
      const double turn = -side * 2 * std::numbers::pi * i / kSides;
      on_picture.push_back(hub + kRadius_m * Vector2d(std::cos(turn), std::sin(turn)));
      disc.push_back({on_picture.back(), outside});
    }
    Face(disc, on_picture);
    for (int i = 0; i < kSides; ++i) {
      const Corner& a = disc[i];
      const Corner& b = disc[(i + 1) % kSides];
      const double inside = outside - side * kWidth_m;
      Face({b, a, {a.side, inside}, {b.side, inside}}, {tyre, tyre, tyre, tyre});
    }
  }

  const CarShape& shape_;
  const Sheet& sheet_;
  CityModel& model_;
  Vector3d back_, left_, top_of_nose_;
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

std::string ElementOf(const Car& car) {
  return fmt::format("{}car-{:03}", kOccluderPrefix, car.number);
}

void AddOccluders(const Town& town, CityModel& model) {
  const uint64_t seed = town.seed;
  Foliage foliage;
  foliage.leaves = AddLeaves(seed, model);
  const CoveringDesign soil{.width_m = 2, .height_m = 2, .covering = Covering::kSoil, .seed = seed};
  foliage.bark.material =
      AddPainted("bark", {[soil] { return PaintCovering(soil, 0.01); }, ""}, model);
  for (size_t i = 0; i < town.trees.size(); ++i) {
    foliage.bark.element = AddElement(fmt::format("{}tree-{:03}", kOccluderPrefix, i), model);
    const double ground = GroundAt(town, town.trees[i].position);
    AddTree(town.trees[i], ground, foliage, Random(seed, 2000 + i), model);
  }
  for (const Car& car : town.cars) {
    const int element = AddElement(ElementOf(car), model);
    const uint64_t own = Random(seed, 4000 + static_cast<uint64_t>(car.number)).Next();
    const int material = AddPainted(fmt::format("car-{:03}", car.number),
                                    {[own] { return PaintCar(own, kCarTexel_m); }, ""}, model);
    model.scene.materials[material].gloss = 0.35f;
    Sheet sheet;
    sheet.element = element;
    sheet.material = material;
    sheet.width_m = kCarLength_m;
    sheet.height_m = kCarPicture_m;
    const CarShape shape = ShapeOfCar(own);
    CarBuilder(car, shape, GroundAt(town, car.position), sheet, model).Build();
  }
}

}  // namespace stucco::simulate
