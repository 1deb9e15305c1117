// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/wall_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace stucco::simulate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFrame_m = 0.07;     // of windows, which is matt, around the pane
constexpr double kBacking_m = 0.004;  // of the wall behind a balcony
constexpr double kRailing_m = 0.06;   // thickness

struct Rect {
  double left, right, top, bottom;  // y downwards
};

Rect RectOf(const WallPart& part) {
  return {part.top_left.x(), part.bottom_right.x(), part.top_left.y(), part.bottom_right.y()};
}

class WallBuilder {
 public:
  WallBuilder(const WallShape& shape, CityModel& model) : shape_(shape), model_(model) {}

  void Recess(const WallPart& part, const Rect& r) {
    const double back = part.relief_m;
    Reveal(r, back);
    // Where a balcony hides the foot of a door, its pane goes on behind it.
    const Rect pane = {r.left + kFrame_m, r.right - kFrame_m, r.top + kFrame_m,
                       std::min(r.bottom, part.bottom_right.y() - kFrame_m)};
    if (!HasPane(part) || pane.left >= pane.right || pane.top >= pane.bottom) {
      Front(r, back, shape_.sheet.material);
      return;
    }
    Front(pane, back, shape_.pane_material);
    Front({r.left, r.right, r.top, pane.top}, back, shape_.sheet.material);
    if (pane.bottom < r.bottom) {
      Front({r.left, r.right, pane.bottom, r.bottom}, back, shape_.sheet.material);
    }
    Front({r.left, pane.left, pane.top, pane.bottom}, back, shape_.sheet.material);
    Front({pane.right, r.right, pane.top, pane.bottom}, back, shape_.sheet.material);
  }

  void Balcony(const Rect& r, double out) {
    Trimmed({At(r.left, r.bottom, kBacking_m), At(r.right, r.bottom, kBacking_m),
             At(r.right, r.top, kBacking_m), At(r.left, r.top, kBacking_m)});
    const double floor = r.bottom - kBalconySlab_m;
    Front(r, out, shape_.sheet.material);
    Box({r.left, r.right, floor, r.bottom}, 0, out, /*with_front=*/false);
    Box({r.left, r.right, r.top, floor}, out - kRailing_m, out, /*with_front=*/false);
    Box({r.left, r.left + kRailing_m, r.top, floor}, 0, out - kRailing_m, /*with_front=*/true);
    Box({r.right - kRailing_m, r.right, r.top, floor}, 0, out - kRailing_m, /*with_front=*/true);
  }

  // Runs around the corners of the house with mitres.
  void Band(const Rect& r, double out) {
    Front(r, out, shape_.sheet.material);
    const double left = r.left - (shape_.corner_left ? out : 0);
    const double right = r.right + (shape_.corner_right ? out : 0);
    Trimmed(
        {At(r.left, r.top, 0), At(left, r.top, out), At(right, r.top, out), At(r.right, r.top, 0)});
    Trimmed({At(r.right, r.bottom, 0), At(right, r.bottom, out), At(left, r.bottom, out),
             At(r.left, r.bottom, 0)});
    if (shape_.corner_left) {
      TrimmedFront({left, r.left, r.top, r.bottom}, out);
    } else {
      Side(r.left, r, 0, out, /*to_right=*/false);
    }
    if (shape_.corner_right) {
      TrimmedFront({r.right, right, r.top, r.bottom}, out);
    } else {
      Side(r.right, r, 0, out, /*to_right=*/true);
    }
  }

  void Plane(const std::vector<Rect>& openings) {
    Loop outer;
    for (const Vector2d& corner : shape_.outline) outer.push_back(At(corner.x(), corner.y(), 0));
    std::vector<Loop> holes;
    holes.reserve(openings.size());
    for (const Rect& r : openings) {
      holes.push_back({At(r.left, r.bottom, 0), At(r.left, r.top, 0), At(r.right, r.top, 0),
                       At(r.right, r.bottom, 0)});
    }
    AddPolygon(shape_.sheet, outer, holes, model_);
  }

 private:
  Vector3d At(double x, double y, double out) const {
    return shape_.sheet.origin + x * shape_.sheet.u + y * shape_.sheet.v +
           out * shape_.sheet.normal();
  }

  void Trimmed(const Loop& corners) { AddTrim(shape_.trim, corners, model_); }

  void Front(const Rect& r, double out, int material) {
    Sheet sheet = shape_.sheet;
    sheet.material = material;
    AddConvex(sheet, FrontLoop(r, out), model_);
  }

  void TrimmedFront(const Rect& r, double out) { Trimmed(FrontLoop(r, out)); }

  Loop FrontLoop(const Rect& r, double out) const {
    return {At(r.left, r.bottom, out), At(r.right, r.bottom, out), At(r.right, r.top, out),
            At(r.left, r.top, out)};
  }

  // A face across the wall at x, from `in` to `out`, looking to the right or to the left.
  void Side(double x, const Rect& r, double in, double out, bool to_right) {
    const double first = to_right ? out : in;
    const double second = to_right ? in : out;
    Trimmed({At(x, r.bottom, first), At(x, r.bottom, second), At(x, r.top, second),
             At(x, r.top, first)});
  }

  // The sides of an opening whose back lies at `back` < 0.
  void Reveal(const Rect& r, double back) {
    Side(r.left, r, back, 0, /*to_right=*/true);
    Side(r.right, r, back, 0, /*to_right=*/false);
    Trimmed({At(r.left, r.bottom, 0), At(r.right, r.bottom, 0), At(r.right, r.bottom, back),
             At(r.left, r.bottom, back)});
    Trimmed({At(r.left, r.top, back), At(r.right, r.top, back), At(r.right, r.top, 0),
             At(r.left, r.top, 0)});
  }

  void Box(const Rect& r, double in, double out, bool with_front) {
    Side(r.left, r, in, out, /*to_right=*/false);
    Side(r.right, r, in, out, /*to_right=*/true);
    Trimmed({At(r.left, r.top, in), At(r.left, r.top, out), At(r.right, r.top, out),
             At(r.right, r.top, in)});
    Trimmed({At(r.right, r.bottom, in), At(r.right, r.bottom, out), At(r.left, r.bottom, out),
             At(r.left, r.bottom, in)});
    Trimmed({At(r.right, r.bottom, in), At(r.left, r.bottom, in), At(r.left, r.top, in),
             At(r.right, r.top, in)});
    if (with_front) TrimmedFront(r, out);
  }

  const WallShape& shape_;
  CityModel& model_;
};

// A balcony's picture hides the foot of the door behind it.
Rect AboveBalconies(Rect r, const std::vector<WallPart>& parts) {
  for (const WallPart& part : parts) {
    if (part.kind != PartKind::kBalcony) continue;
    const Rect b = RectOf(part);
    if (b.left < r.right && r.left < b.right && b.top < r.bottom && r.top < b.top) {
      r.bottom = b.top;
    }
  }
  return r;
}

}  // namespace

bool HasPane(const WallPart& part) {
  return part.kind == PartKind::kWindow || part.kind == PartKind::kShopWindow ||
         part.kind == PartKind::kBalconyDoor;
}

void AddWall(const WallShape& shape, const WallDesign& design, CityModel& model) {
  WallBuilder builder(shape, model);
  std::vector<Rect> openings;
  for (const WallPart& part : design.parts) {
    if (part.relief_m < 0) {
      const Rect opening = AboveBalconies(RectOf(part), design.parts);
      openings.push_back(opening);
      builder.Recess(part, opening);
    } else if (part.relief_m > 0 && part.kind == PartKind::kBalcony) {
      builder.Balcony(RectOf(part), part.relief_m);
    } else if (part.relief_m > 0) {
      builder.Band(RectOf(part), part.relief_m);
    }
  }
  builder.Plane(openings);
}

}  // namespace stucco::simulate
