// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/ground.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "simulate/city/footprints.h"
#include "simulate/city/internal/loops.h"
#include "simulate/paint/paint.h"
#include "simulate/random.h"
#include "survey/geometry2d.h"

namespace stucco::simulate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFields_m = 350;  // how far the ground goes beyond the town
constexpr double kCell_m = 4;      // where it is not flat
constexpr double kFieldCell_m = 20;
constexpr double kFieldPicture_m = 60;  // repeated: nobody looks closely at fields far away
constexpr double kFieldOverlap_m = 12;  // a whole number of the tracks of a crop
constexpr double kFieldTexel_m = 0.08;
constexpr double kMostParcelTexels = 1.2e7;  // of all parcels together
constexpr std::array<Covering, kFieldKinds> kCoveringOfField = {Covering::kGrass, Covering::kCrop,
                                                                Covering::kCrop, Covering::kSoil};
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

// What lies around a town: by axis, borders of parcels from one end of the fields to the other, the
// town's own among them.
struct Surroundings {
  Bounds town;
  std::array<std::vector<double>, 2> borders;
};

Surroundings SurroundingsOf(const Town& town) {
  Surroundings around;
  around.town = BoundsOf(town);
  for (const int axis : {0, 1}) {
    Random random(town.seed, 60 + axis);
    std::vector<double>& borders = around.borders[axis];
    for (double away = 0; away < kFields_m; away += random.Uniform(50, 120)) {
      borders.push_back(around.town.low[axis] - away);
      borders.push_back(around.town.high[axis] + away);
    }
    std::sort(borders.begin(), borders.end());
  }
  return around;
}

std::vector<double> Lines(const Town& town, const Surroundings& around, int axis) {
  const double low = around.town.low[axis];
  const double high = around.town.high[axis];
  std::vector<double> lines = around.borders[axis];
  lines.push_back(low - kFields_m);
  lines.push_back(high + kFields_m);
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

// A street that crosses the town from edge to edge goes on through the fields: its patch, where
// `at` lies beyond one of its ends, else -1.
int StreetTo(const Town& town, const Bounds& bounds, const Vector2d& at) {
  const Vector2d edge = at.cwiseMax(bounds.low).cwiseMin(bounds.high);
  const int patch = PatchAt(town, edge);
  if (patch == static_cast<int>(town.ground.size())) return -1;
  const GroundPatch& street = town.ground[patch];
  if (street.covering != Covering::kAsphalt) return -1;
  for (const int along : {0, 1}) {
    const int across = 1 - along;
    const bool crosses =
        street.low[along] <= bounds.low[along] && street.high[along] >= bounds.high[along];
    const bool narrow =
        street.low[across] > bounds.low[across] && street.high[across] < bounds.high[across];
    if (crosses && narrow && edge[across] == at[across]) return patch;
  }
  return -1;
}

// Which of the kinds of field grows at a place beyond the town.
int FieldAt(const Town& town, const Surroundings& around, const Vector2d& at) {
  uint64_t parcel = town.seed;
  for (const int axis : {0, 1}) {
    const std::vector<double>& borders = around.borders[axis];
    const auto next = std::upper_bound(borders.begin(), borders.end(), at[axis]);
    parcel = SeedOf(parcel, next - borders.begin());
  }
  return Random(parcel).Index(kFieldKinds);
}

// The eight that touch the town.
std::vector<GroundPatch> ParcelsOf(const Town& town, const Surroundings& around) {
  std::array<std::array<double, 4>, 2> lines;  // around the parcels and the town, by axis
  for (const int axis : {0, 1}) {
    const std::vector<double>& borders = around.borders[axis];
    const auto low = std::lower_bound(borders.begin(), borders.end(), around.town.low[axis]);
    std::copy_n(low - 1, 4, lines[axis].begin());
  }
  std::vector<GroundPatch> parcels;
  for (const int row : {0, 1, 2}) {
    for (const int column : {0, 1, 2}) {
      if (row == 1 && column == 1) continue;
      GroundPatch parcel;
      parcel.low = {lines[0][column], lines[1][row]};
      parcel.high = {lines[0][column + 1], lines[1][row + 1]};
      parcel.covering = kCoveringOfField[FieldAt(town, around, (parcel.low + parcel.high) / 2)];
      parcels.push_back(parcel);
    }
  }
  return parcels;
}

// The patch, field, street or parcel of a place, as GroundGrid::patch_of has them.
int GroundOf(const Town& town, const Surroundings& around, const std::vector<GroundPatch>& parcels,
             const Vector2d& at) {
  const int patches = static_cast<int>(town.ground.size());
  const int patch = PatchAt(town, at);
  if (patch < patches) return patch;
  const int street = StreetTo(town, around.town, at);
  if (street >= 0) return patches + kFieldKinds + street;
  const auto parcel = std::ranges::find_if(parcels, [&](const GroundPatch& each) {
    return Eigen::AlignedBox2d(each.low, each.high).contains(at);
  });
  if (parcel == parcels.end()) return patches + FieldAt(town, around, at);
  return 2 * patches + kFieldKinds + static_cast<int>(parcel - parcels.begin());
}

bool IsTown(const Town& town, int patch) {
  return patch < static_cast<int>(town.ground.size());
}

double RaiseOf(const Town& town, int patch) {
  if (IsTown(town, patch)) return town.ground[patch].raise_m;
  const int street = patch - static_cast<int>(town.ground.size()) - kFieldKinds;
  const bool is_street = street >= 0 && street < static_cast<int>(town.ground.size());
  return is_street ? town.ground[street].raise_m : 0;
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

  // z of the ground, as a cell draws it, at a place of the cell in the axes of the ground: on one
  // of the two triangles beside the diagonal from the south-west to the north-east.
  double HeightIn(int column, int row, const Vector2d& at) const {
    const Loop cell = Cell(column, row);
    const double u = (at.x() - grid_.x[column]) / (grid_.x[column + 1] - grid_.x[column]);
    const double v = (at.y() - grid_.y[row]) / (grid_.y[row + 1] - grid_.y[row]);
    const Vector3d& corner = u > v ? cell[1] : cell[3];
    const double along_u = u > v ? corner.z() - cell[0].z() : cell[2].z() - corner.z();
    const double along_v = u > v ? cell[2].z() - corner.z() : corner.z() - cell[0].z();
    return cell[0].z() + u * along_u + v * along_v;
  }

  // The risers between cells of different heights.
  void AddKerbs(const Trim& trim, CityModel& model) const {
    const auto add = [&](int before, int after, const Eigen::Array2i& a, const Eigen::Array2i& b) {
      const double low = RaiseOf(town_, before);
      const double high = RaiseOf(town_, after);
      if (low == high) return;
      AddTrim(trim,
              {Corner(a.x(), a.y(), low), Corner(b.x(), b.y(), low), Corner(b.x(), b.y(), high),
               Corner(a.x(), a.y(), high)},
              model);
    };
    for (int row = 0; row < grid_.rows(); ++row) {
      for (int column = 0; column < grid_.columns(); ++column) {
        const int here = PatchOf(column, row);
        if (column > 0) add(PatchOf(column - 1, row), here, {column, row + 1}, {column, row});
        if (row > 0) add(PatchOf(column, row - 1), here, {column, row}, {column + 1, row});
      }
    }
  }

 private:
  const Town& town_;
  const GroundGrid& grid_;
};

// At least `finest_m`, so that all of them together have no more texels than that.
double TexelOf(const std::vector<GroundPatch>& patches, double finest_m, double most_texels) {
  double area = 0;
  for (const GroundPatch& patch : patches) area += (patch.high - patch.low).prod();
  return std::max(finest_m, std::sqrt(area / most_texels));
}

// Mixes what is right of and below the wanted size into the left and upper margins, so that the
// picture goes on where it ends. Two mixed pictures have less contrast than one; what is lost is
// given back (Heitz and Neyret, "High-performance by-example noise using a histogram-preserving
// blending operator", 2018, for colours that are normally distributed).
Image Seamless(const Image& large, int width_px, int height_px) {
  std::array<double, 3> mean = {};
  for (size_t i = 0; i < large.data.size(); ++i) mean[i % 3] += large.data[i];
  for (double& value : mean) value *= 3.0 / static_cast<double>(large.data.size());
  const auto mixed = [&](const auto& value, int at, int size, int all) {
    const double share = at < all - size ? (at + 0.5) / (all - size) : 1;
    const double gain = 1 / std::hypot(share, 1 - share);
    return share == 1 ? value(at) : gain * (share * value(at) + (1 - share) * value(at + size));
  };
  Image image{width_px, height_px, 3, {}};
  const auto mixed_at = [&](int x, int y, int c) {
    const auto in_row = [&](int row) {
      const auto value = [&](int column) { return large.Pixel(column, row)[c] - mean[c]; };
      return mixed(value, x, width_px, large.width_px);
    };
    return mean[c] + mixed(in_row, y, height_px, large.height_px);
  };
  image.data.reserve(size_t{3} * width_px * height_px);
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double value = std::clamp(mixed_at(x, y, c), 0.0, 255.0);
        image.data.push_back(static_cast<uint8_t>(std::lround(value)));
      }
    }
  }
  return image;
}

Image PaintField(CoveringDesign design, double metres_per_texel) {
  const int width = Texels(design.width_m, metres_per_texel);
  const int height = Texels(design.height_m, metres_per_texel);
  design.width_m += kFieldOverlap_m;
  design.height_m += kFieldOverlap_m;
  return Seamless(PaintCovering(design, metres_per_texel), width, height);
}

// A sheet in the ground's axes over a rectangle of them; its material is left to the caller.
Sheet GroundSheet(const Town& town, const Vector2d& low, const Vector2d& size, double texel_m) {
  const Eigen::Rotation2Dd turn(town.turn_rad);
  const Vector2d north_west = turn * Vector2d(low.x(), low.y() + size.y());
  const Vector2d east = turn * Vector2d::UnitX();
  Sheet sheet;
  sheet.origin = {north_west.x(), north_west.y(), 0};
  sheet.u = {east.x(), east.y(), 0};
  sheet.v = {east.y(), -east.x(), 0};
  sheet.width_m = Texels(size.x(), texel_m) * texel_m;
  sheet.height_m = Texels(size.y(), texel_m) * texel_m;
  return sheet;
}

CoveringDesign DesignOf(const Town& town, Covering covering, const Vector2d& size, uint64_t index) {
  const uint64_t seed = Random(town.seed, 50 + index).Next();
  return {.width_m = size.x(),
          .height_m = size.y(),
          .covering = covering,
          .palette = static_cast<int>(seed % 1000),
          .seed = seed};
}

// By what GroundGrid::patch_of names.
std::vector<Sheet> MakeSheets(const Town& town, const std::vector<GroundPatch>& parcels,
                              double finest_m, int element, CityModel& model) {
  std::vector<Sheet> sheets;
  const auto add = [&](Sheet sheet, const std::string& name, std::function<Image()> paint) {
    sheet.element = element;
    sheet.material = AddPainted(name, {std::move(paint), ""}, model);
    sheets.push_back(sheet);
  };
  const auto add_patch = [&](const GroundPatch& patch, uint64_t index, double texel,
                             const std::string& name) {
    const Vector2d size = patch.high - patch.low;
    const CoveringDesign design = DesignOf(town, patch.covering, size, index);
    add(GroundSheet(town, patch.low, size, texel), name,
        [design, texel] { return PaintCovering(design, texel); });
  };
  const double texel = TexelOf(town.ground, finest_m, kMostTexels);
  for (size_t i = 0; i < town.ground.size(); ++i) {
    add_patch(town.ground[i], i, texel, fmt::format("ground-{}", i));
  }
  const double coarse = std::max(finest_m, kFieldTexel_m);
  const Vector2d size = Vector2d::Constant(kFieldPicture_m);
  for (int i = 0; i < kFieldKinds; ++i) {
    const CoveringDesign design = DesignOf(town, kCoveringOfField[i], size, 1000 + i);
    add(GroundSheet(town, BoundsOf(town).low, size, coarse), fmt::format("field-{}", i),
        [design, coarse] { return PaintField(design, coarse); });
  }
  const std::vector<Sheet> streets(sheets.begin(), sheets.end() - kFieldKinds);
  sheets.insert(sheets.end(), streets.begin(), streets.end());
  const double parcel_texel = TexelOf(parcels, coarse, kMostParcelTexels);
  for (size_t i = 0; i < parcels.size(); ++i) {
    add_patch(parcels[i], 2000 + i, parcel_texel, fmt::format("parcel-{}", i));
  }
  return sheets;
}

bool IsUnderAHouse(const Town& town, const Loop& loop) {
  return std::ranges::any_of(town.houses, [&](const House& house) {
    return std::ranges::all_of(
        loop, [&](const Vector3d& corner) { return Contains(house.outline, corner.head<2>()); });
  });
}

std::vector<Facet> SlopeFacets(const Town& town, const GroundGrid& grid) {
  const GroundBuilder builder(town, grid);
  std::vector<Facet> facets;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      if (!IsTown(town, builder.PatchOf(column, row))) continue;
      const Loop cell = builder.Cell(column, row);
      for (const Loop& half : {Loop{cell[0], cell[1], cell[2]}, Loop{cell[0], cell[2], cell[3]}}) {
        if (IsUnderAHouse(town, half)) continue;
        facets.push_back(ExactFacet(FacetClass::kGround, half, {}));
      }
    }
  }
  return facets;
}

// The outlines of houses that touch as one; clockwise loops are courtyards between them.
std::vector<Ring> HouseLoops(const Town& town) {
  std::vector<Ring> rings;
  for (const House& house : town.houses) {
    rings.insert(rings.end(), house.outline.rings.begin(), house.outline.rings.end());
  }
  return internal::JoinLoops(rings);
}

std::vector<Ring> LevelLoops(const Town& town, const GroundGrid& grid, double raise) {
  const GroundBuilder builder(town, grid);
  std::vector<Ring> cells;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const int patch = builder.PatchOf(column, row);
      if (!IsTown(town, patch) || RaiseOf(town, patch) != raise) continue;
      Ring ring;
      for (const Vector3d& corner : builder.Cell(column, row)) ring.push_back(corner.head<2>());
      cells.push_back(std::move(ring));
    }
  }
  return internal::JoinLoops(cells);
}

Loop AtHeight(const Ring& ring, double z) {
  Loop loop;
  for (const Vector2d& corner : ring) loop.emplace_back(corner.x(), corner.y(), z);
  return loop;
}

std::vector<Facet> LevelFacets(const Town& town, const GroundGrid& grid) {
  std::map<double, std::vector<Ring>> levels;
  for (const GroundPatch& patch : town.ground) levels[patch.raise_m];
  for (auto& [raise, loops] : levels) loops = LevelLoops(town, grid, raise);
  // Houses stand at z = 0; their outlines are rings of that level with the ground outside.
  for (Ring ring : HouseLoops(town)) {
    std::reverse(ring.begin(), ring.end());
    levels[0].push_back(std::move(ring));
  }
  std::vector<Facet> facets;
  for (const auto& [raise, loops] : levels) {
    for (const Polygon& polygon : internal::PolygonsOf(loops)) {
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
  const Surroundings around = SurroundingsOf(town);
  GroundGrid grid{Lines(town, around, 0), Lines(town, around, 1), {}, ParcelsOf(town, around)};
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      grid.patch_of.push_back(GroundOf(
          town, around, grid.parcels,
          {(grid.x[column] + grid.x[column + 1]) / 2, (grid.y[row] + grid.y[row + 1]) / 2}));
    }
  }
  return grid;
}

void AddGround(const Town& town, const GroundGrid& grid, double metres_per_texel,
               CityModel& model) {
  const int element = AddElement("G0", model);
  const std::vector<Sheet> sheets =
      MakeSheets(town, grid.parcels, metres_per_texel, element, model);
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

double DrawnHeight(const Town& town, const GroundGrid& grid, int column, int row,
                   const Vector2d& at) {
  return GroundBuilder(town, grid).HeightIn(column, row, at);
}

std::vector<Facet> GroundFacets(const Town& town, const GroundGrid& grid) {
  std::vector<Facet> facets =
      town.relief.IsFlat() ? LevelFacets(town, grid) : SlopeFacets(town, grid);
  std::stable_sort(facets.begin(), facets.end(),
                   [](const Facet& a, const Facet& b) { return a.area > b.area; });
  for (size_t i = 0; i < facets.size(); ++i) {
    facets[i].id = fmt::format("G{}", i);
  }
  return facets;
}

}  // namespace stucco::simulate
