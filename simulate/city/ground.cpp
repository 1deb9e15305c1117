// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/ground.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "plan/polygons.h"
#include "simulate/city/footprints.h"
#include "simulate/city/internal/loops.h"
#include "simulate/paint/paint.h"
#include "simulate/random.h"

namespace stucco::simulate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFields_m = 350;  // how far the ground goes beyond the town
constexpr double kCell_m = 4;      // where it is not flat
constexpr double kFieldCell_m = 20;
constexpr double kFieldPicture_m = 24;  // repeated: nobody looks at fields closely
constexpr double kFieldTexel_m = 0.04;
// Ground pictures of a town together: a hamlet's are sharp to 2 cm, a quarter's to 5 cm.
constexpr double kMostTexels = 1.6e7;
constexpr double kKerbTexel_m = 0.01;

struct Bounds {
  Vector2d low, high;
};

Bounds BoundsOf(const Town& town) {
  Bounds bounds{town.ground.at(0).low, town.ground.at(0).high};
  for (const GroundPatch& patch : town.ground) {
    bounds.low = bounds.low.cwiseMin(patch.low);
    bounds.high = bounds.high.cwiseMax(patch.high);
  }
  return bounds;
}

void AddLines(double from, double to, double step, std::vector<double>& lines) {
  const int count = static_cast<int>(std::ceil((to - from) / step));
  for (int i = 0; i <= count; ++i) lines.push_back(from + (to - from) * i / count);
}

std::vector<double> Lines(const Town& town, int axis) {
  const Bounds bounds = BoundsOf(town);
  const double low = bounds.low[axis];
  const double high = bounds.high[axis];
  std::vector<double> lines = {low - kFields_m, high + kFields_m};
  for (const GroundPatch& patch : town.ground) {
    lines.push_back(patch.low[axis]);
    lines.push_back(patch.high[axis]);
  }
  if (!town.relief.IsFlat()) {
    AddLines(low, high, kCell_m, lines);
    AddLines(low - kFields_m, low, kFieldCell_m, lines);
    AddLines(high, high + kFields_m, kFieldCell_m, lines);
  }
  std::sort(lines.begin(), lines.end());
  constexpr double kSame_m = 1e-3;  // cells narrower than this are none
  lines.erase(
      std::unique(lines.begin(), lines.end(), [](double a, double b) { return b - a < kSame_m; }),
      lines.end());
  return lines;
}

double RaiseOf(const Town& town, int patch) {
  return patch < static_cast<int>(town.ground.size()) ? town.ground[patch].raise_m : 0;
}

class GroundBuilder {
 public:
  GroundBuilder(const Town& town, const GroundGrid& grid) : town_(town), grid_(grid) {}

  Vector3d Corner(int column, int row, double raise) const {
    const Vector2d at =
        Eigen::Rotation2Dd(town_.turn_rad) * Vector2d(grid_.x[column], grid_.y[row]);
    return {at.x(), at.y(), town_.relief.HeightAt(at) + raise};
  }

  int PatchOf(int column, int row) const { return grid_.patch_of[row * grid_.columns() + column]; }

  // South-west, south-east, north-east, north-west.
  Loop Cell(int column, int row) const {
    const double raise = RaiseOf(town_, PatchOf(column, row));
    return {Corner(column, row, raise), Corner(column + 1, row, raise),
            Corner(column + 1, row + 1, raise), Corner(column, row + 1, raise)};
  }

  // The risers between cells of different heights.
  void AddKerbs(const Trim& trim, CityModel& model) const {
    for (int row = 0; row < grid_.rows(); ++row) {
      for (int column = 0; column < grid_.columns(); ++column) {
        if (column > 0)
          AddKerb(PatchOf(column - 1, row), PatchOf(column, row), {column, row + 1}, {column, row},
                  trim, model);
        if (row > 0)
          AddKerb(PatchOf(column, row - 1), PatchOf(column, row), {column, row}, {column + 1, row},
                  trim, model);
      }
    }
  }

 private:
  void AddKerb(int before, int after, const Eigen::Array2i& a, const Eigen::Array2i& b,
               const Trim& trim, CityModel& model) const {
    const double low = RaiseOf(town_, before);
    const double high = RaiseOf(town_, after);
    if (low == high) return;
    AddTrim(trim,
            {Corner(a.x(), a.y(), low), Corner(b.x(), b.y(), low), Corner(b.x(), b.y(), high),
             Corner(a.x(), a.y(), high)},
            model);
  }

  const Town& town_;
  const GroundGrid& grid_;
};

double TexelOf(const Town& town, double finest_m) {
  double area = 0;
  for (const GroundPatch& patch : town.ground) area += (patch.high - patch.low).prod();
  return std::max(finest_m, std::sqrt(area / kMostTexels));
}

CoveringDesign DesignOf(const Covering covering, const Vector2d& size, uint64_t seed) {
  return {.width_m = size.x(),
          .height_m = size.y(),
          .covering = covering,
          .palette = static_cast<int>(seed % 1000),
          .seed = seed};
}

// The sheets of the patches, then that of the fields, which go on in the tone of the last patch.
std::vector<Sheet> MakeSheets(const Town& town, double finest_m, int element, CityModel& model) {
  std::vector<Sheet> sheets;
  const double texel = TexelOf(town, finest_m);
  const Eigen::Rotation2Dd turn(town.turn_rad);
  const uint64_t seed = town.houses.empty() ? 0 : town.houses[0].seed;
  for (size_t i = 0; i <= town.ground.size(); ++i) {
    const bool fields = i == town.ground.size();
    const Bounds town_bounds = BoundsOf(town);
    const Vector2d low = fields ? town_bounds.low : town.ground[i].low;
    const Vector2d size = fields ? Vector2d::Constant(kFieldPicture_m)
                                 : Vector2d(town.ground[i].high - town.ground[i].low);
    const auto design = DesignOf(fields ? Covering::kGrass : town.ground[i].covering, size,
                                 Random(seed, 50 + std::min(i, town.ground.size() - 1)).Next());
    const double mpt = fields ? std::max(finest_m, kFieldTexel_m) : texel;
    Sheet sheet;
    sheet.element = element;
    sheet.material = AddPainted(fields ? "fields" : fmt::format("ground-{}", i),
                                {[design, mpt] { return PaintCovering(design, mpt); }, ""}, model);
    const Vector2d north_west = turn * Vector2d(low.x(), low.y() + size.y());
    const Vector2d east = turn * Vector2d::UnitX();
    const Vector2d south = turn * -Vector2d::UnitY();
    sheet.origin = {north_west.x(), north_west.y(), 0};
    sheet.u = {east.x(), east.y(), 0};
    sheet.v = {south.x(), south.y(), 0};
    sheet.width_m = Texels(size.x(), mpt) * mpt;
    sheet.height_m = Texels(size.y(), mpt) * mpt;
    sheets.push_back(sheet);
  }
  return sheets;
}

std::vector<Facet> SlopeFacets(const Town& town, const GroundGrid& grid) {
  const GroundBuilder builder(town, grid);
  std::vector<Facet> facets;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      if (builder.PatchOf(column, row) == static_cast<int>(town.ground.size())) continue;
      const Loop cell = builder.Cell(column, row);
      for (const Loop& half : {Loop{cell[0], cell[1], cell[2]}, Loop{cell[0], cell[2], cell[3]}}) {
        const bool hidden =
            std::any_of(town.houses.begin(), town.houses.end(), [&](const House& house) {
              return std::all_of(half.begin(), half.end(), [&](const Vector3d& corner) {
                return plan::Contains(house.outline, corner.head<2>());
              });
            });
        if (!hidden) facets.push_back(ExactFacet(FacetClass::kGround, half, {}));
      }
    }
  }
  return facets;
}

// The outlines of houses that touch as one; clockwise loops are courtyards between them.
std::vector<plan::Ring> HouseLoops(const Town& town) {
  std::vector<plan::Ring> rings;
  for (const House& house : town.houses) {
    rings.insert(rings.end(), house.outline.rings.begin(), house.outline.rings.end());
  }
  return internal::JoinLoops(rings);
}

std::vector<plan::Ring> LevelLoops(const Town& town, const GroundGrid& grid, double raise) {
  const GroundBuilder builder(town, grid);
  std::vector<plan::Ring> cells;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const int patch = builder.PatchOf(column, row);
      if (patch == static_cast<int>(town.ground.size()) || RaiseOf(town, patch) != raise) continue;
      plan::Ring ring;
      for (const Vector3d& corner : builder.Cell(column, row)) ring.push_back(corner.head<2>());
      cells.push_back(std::move(ring));
    }
  }
  return internal::JoinLoops(cells);
}

Loop AtHeight(plan::Ring ring, double z) {
  Loop loop;
  for (const Vector2d& corner : ring) loop.emplace_back(corner.x(), corner.y(), z);
  return loop;
}

std::vector<Facet> LevelFacets(const Town& town, const GroundGrid& grid) {
  std::map<double, std::vector<plan::Ring>> levels;
  for (const GroundPatch& patch : town.ground) levels[patch.raise_m];
  for (auto& [raise, loops] : levels) loops = LevelLoops(town, grid, raise);
  // Houses stand at z = 0; their outlines are rings of that level with the ground outside.
  for (plan::Ring ring : HouseLoops(town)) {
    std::reverse(ring.begin(), ring.end());
    levels[0].push_back(std::move(ring));
  }
  std::vector<Facet> facets;
  for (const auto& [raise, loops] : levels) {
    for (const plan::Polygon& polygon : internal::PolygonsOf(loops)) {
      std::vector<Loop> holes;
      for (size_t i = 1; i < polygon.rings.size(); ++i) {
        holes.push_back(AtHeight(polygon.rings[i], raise));
      }
      facets.push_back(
          ExactFacet(FacetClass::kGround, AtHeight(polygon.rings[0], raise), std::move(holes)));
    }
  }
  return facets;
}

}  // namespace

GroundGrid MakeGroundGrid(const Town& town) {
  GroundGrid grid{Lines(town, 0), Lines(town, 1), {}};
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      grid.patch_of.push_back(PatchAt(
          town, {(grid.x[column] + grid.x[column + 1]) / 2, (grid.y[row] + grid.y[row + 1]) / 2}));
    }
  }
  return grid;
}

void AddGround(const Town& town, const GroundGrid& grid, double metres_per_texel,
               CityModel& model) {
  const int element = AddElement("G0", model);
  const std::vector<Sheet> sheets = MakeSheets(town, metres_per_texel, element, model);
  const GroundBuilder builder(town, grid);
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      AddConvex(sheets[builder.PatchOf(column, row)], builder.Cell(column, row), model);
    }
  }
  WallDesign kerb;
  kerb.width_m = kerb.height_m = 2;
  kerb.cladding = Cladding::kConcrete;
  const int material =
      AddPainted("kerb", {[kerb] { return PaintTrim(kerb, kKerbTexel_m); }, ""}, model);
  builder.AddKerbs({element, material, 2}, model);
}

std::vector<Facet> GroundFacets(const Town& town, const GroundGrid& grid) {
  std::vector<Facet> facets =
      town.relief.IsFlat() ? LevelFacets(town, grid) : SlopeFacets(town, grid);
  std::stable_sort(facets.begin(), facets.end(),
                   [](const Facet& a, const Facet& b) { return a.area > b.area; });
  for (size_t i = 0; i < facets.size(); ++i) {
    facets[i].id = fmt::format("G{}", i);
    facets[i].facade = facets[i].id;
  }
  return facets;
}

}  // namespace stucco::simulate
