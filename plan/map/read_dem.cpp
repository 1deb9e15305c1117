// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/read_dem.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "plan/map/internal/ogr.h"
#include "survey/coordinate_system.h"
#include "survey/error.h"
#include "survey/quiet_gdal.h"

namespace stucco::plan {
namespace {

constexpr double kLeastStep_m = 2;
constexpr double kMostSamples = 4e6;
constexpr double kMetresPerFoot = 0.3048;
constexpr float kGap = std::numeric_limits<float>::quiet_NaN();

// A window of the raster. Pixel (0, 0) is the top left; its centre is at (0.5, 0.5).
struct Raster {
  std::string crs;
  std::array<double, 6> pixel_from_crs{};
  int columns = 0;  // of the whole raster
  int rows = 0;
  int left = 0;  // of the window
  int top = 0;
  int width = 0;
  int height = 0;
  std::vector<float> z_m;

  Eigen::Vector2d Pixel(const Eigen::Vector2d& p) const {
    const auto& m = pixel_from_crs;
    return {m[0] + m[1] * p.x() + m[2] * p.y(), m[3] + m[4] * p.x() + m[5] * p.y()};
  }

  float Value(int column, int row) const {
    const int x = std::clamp(column - left, 0, width - 1);
    const int y = std::clamp(row - top, 0, height - 1);
    return z_m[static_cast<size_t>(y) * width + x];
  }

  // Bilinear; a gap where one of the four pixels is one.
  float Interpolated(const Eigen::Vector2d& pixel) const {
    const Eigen::Array2d at = pixel.array() - 0.5;
    const Eigen::Array2d low = at.floor();
    const int column = static_cast<int>(low.x());
    const int row = static_cast<int>(low.y());
    const double x = at.x() - low.x();
    const double y = at.y() - low.y();
    const double upper = std::lerp(Value(column, row), Value(column + 1, row), x);
    const double lower = std::lerp(Value(column, row + 1), Value(column + 1, row + 1), x);
    return static_cast<float>(std::lerp(upper, lower, y));
  }
};

[[noreturn]] void Fail(const std::filesystem::path& path, const std::string& reason,
                       const std::string& remedy) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", path.string(), reason), remedy);
}

Raster Describe(GDALDataset& dataset, const std::filesystem::path& path) {
  Raster raster;
  raster.columns = dataset.GetRasterXSize();
  raster.rows = dataset.GetRasterYSize();
  std::array<double, 6> crs_from_pixel{};
  if (dataset.GetRasterCount() < 1 || dataset.GetGeoTransform(crs_from_pixel.data()) != CE_None ||
      !GDALInvGeoTransform(crs_from_pixel.data(), raster.pixel_from_crs.data())) {
    Fail(path, "does not say where it lies", "give a georeferenced raster of heights (GeoTIFF)");
  }
  raster.crs = dataset.GetProjectionRef();
  if (raster.crs.empty()) {
    Fail(path, "names no coordinate system",
         "add one, as with gdal_edit.py -a_srs EPSG:25832 FILE");
  }
  return raster;
}

// The grid of samples over the bounds.
TerrainGrid GridOver(const Eigen::AlignedBox2d& bounds, double pixel_m) {
  const double area = bounds.sizes().prod();
  const double step = std::max({pixel_m, kLeastStep_m, std::sqrt(area / kMostSamples)});
  return {.corner = bounds.min(),
          .step_m = step,
          .columns = static_cast<int>(std::ceil(bounds.sizes().x() / step)) + 1,
          .rows = static_cast<int>(std::ceil(bounds.sizes().y() / step)) + 1,
          .z_m = {}};
}

std::vector<Eigen::Vector2d> PixelsOf(const Raster& raster, const PlanOrigin& origin,
                                      const std::vector<Eigen::Vector2d>& positions,
                                      const std::filesystem::path& path) {
  std::vector<Geodetic> places;
  places.reserve(positions.size());
  for (const Eigen::Vector2d& position : positions) {
    places.push_back(GeodeticFromPlan(origin, position));
  }
  std::vector<Eigen::Vector2d> pixels = CrsFromGeodetic(raster.crs, places, path.string());
  for (Eigen::Vector2d& pixel : pixels) pixel = raster.Pixel(pixel);
  return pixels;
}

// Metres on the ground of one pixel at the origin.
double PixelSize(const Raster& raster, const PlanOrigin& origin,
                 const std::filesystem::path& path) {
  constexpr double kProbe_m = 10;
  const auto pixels = PixelsOf(raster, origin, {{0, 0}, {kProbe_m, 0}, {0, kProbe_m}}, path);
  const double per_pixel = std::max((pixels[1] - pixels[0]).norm(), (pixels[2] - pixels[0]).norm());
  return kProbe_m / per_pixel;
}

// The border of the bounds, as densely as the grid.
std::vector<Eigen::Vector2d> BorderOf(const Eigen::AlignedBox2d& bounds, double step_m) {
  std::vector<Eigen::Vector2d> border;
  const Eigen::Vector2d size = bounds.sizes();
  const int steps = static_cast<int>(std::ceil(size.maxCoeff() / step_m)) + 1;
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d along = size * i / steps;
    border.emplace_back(bounds.min() + Eigen::Vector2d(along.x(), 0));
    border.emplace_back(bounds.max() - Eigen::Vector2d(along.x(), 0));
    border.emplace_back(bounds.min() + Eigen::Vector2d(0, along.y()));
    border.emplace_back(bounds.max() - Eigen::Vector2d(0, along.y()));
  }
  return border;
}

void CheckCover(const Raster& raster, const std::vector<Eigen::Vector2d>& pixels, double pixel_m,
                const std::filesystem::path& path) {
  double outside = 0;
  for (const Eigen::Vector2d& pixel : pixels) {
    if (!pixel.allFinite()) {
      Fail(path, "lies elsewhere than the map", "give the terrain of the place of the map");
    }
    const Eigen::Array2d past =
        (-pixel.array()).max(pixel.array() - Eigen::Array2d(raster.columns, raster.rows));
    outside = std::max(outside, past.maxCoeff());
  }
  constexpr double kRim = 1;  // pixel: the border may cut one
  if (!(outside <= kRim)) {
    Fail(path,
         fmt::format("does not cover the site: {:.0f} m are missing beside it", outside * pixel_m),
         "give a larger terrain, a smaller --area or a smaller --margin");
  }
}

void ReadWindow(GDALDataset& dataset, const std::vector<Eigen::Vector2d>& pixels, Raster& raster,
                const std::filesystem::path& path) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& pixel : pixels) box.extend(pixel);
  raster.left = std::clamp(static_cast<int>(box.min().x()) - 2, 0, raster.columns - 1);
  raster.top = std::clamp(static_cast<int>(box.min().y()) - 2, 0, raster.rows - 1);
  raster.width = std::clamp(static_cast<int>(box.max().x()) + 3, 1, raster.columns) - raster.left;
  raster.height = std::clamp(static_cast<int>(box.max().y()) + 3, 1, raster.rows) - raster.top;
  raster.z_m.resize(static_cast<size_t>(raster.width) * raster.height);
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  const QuietGdal quiet;
  if (band.RasterIO(GF_Read, raster.left, raster.top, raster.width, raster.height,
                    raster.z_m.data(), raster.width, raster.height, GDT_Float32, 0, 0,
                    nullptr) != CE_None) {
    Fail(path, fmt::format("cannot be read: {}", QuietGdal::Message()),
         "check the file with gdalinfo -checksum");
  }
  int has_gap_value = 0;
  const double gap = band.GetNoDataValue(&has_gap_value);
  const std::string unit = band.GetUnitType();
  const double metres =
      unit == "ft" || unit == "foot" || unit == "US survey foot" ? kMetresPerFoot : 1;
  const double scale = band.GetScale();
  const double offset = band.GetOffset();
  constexpr double kHighestGround_m = 9000;  // beyond it are other programs' marks for gaps
  for (float& z : raster.z_m) {
    const double value = (z * scale + offset) * metres;
    const bool is_gap = has_gap_value != 0 && z == static_cast<float>(gap);
    z = is_gap || !(std::abs(value) <= kHighestGround_m) ? kGap : static_cast<float>(value);
  }
}

// Mean of the known neighbours of a sample, NaN where there are none.
float MeanAround(const TerrainGrid& terrain, int sample) {
  const int column = sample % terrain.columns;
  const int row = sample / terrain.columns;
  double sum = 0;
  int known = 0;
  const auto add = [&](bool inside, int step) {
    if (!inside || std::isnan(terrain.z_m[sample + step])) return;
    sum += terrain.z_m[sample + step];
    ++known;
  };
  add(column > 0, -1);
  add(column + 1 < terrain.columns, 1);
  add(row > 0, -terrain.columns);
  add(row + 1 < terrain.rows, terrain.columns);
  return known > 0 ? static_cast<float>(sum / known) : kGap;
}

// Gaps are filled from their rims inwards and then smoothed, towards a membrane that hangs in the
// rim. Returns how many samples that were.
size_t FillGaps(TerrainGrid& terrain) {
  std::vector<int> gaps;
  for (size_t i = 0; i < terrain.z_m.size(); ++i) {
    if (std::isnan(terrain.z_m[i])) gaps.push_back(static_cast<int>(i));
  }
  int across = 0;
  std::vector<float> means(gaps.size());
  for (std::vector<int> left = gaps; !left.empty(); ++across) {
    for (size_t i = 0; i < left.size(); ++i) means[i] = MeanAround(terrain, left[i]);
    for (size_t i = 0; i < left.size(); ++i) terrain.z_m[left[i]] = means[i];
    std::erase_if(left, [&](int gap) { return !std::isnan(terrain.z_m[gap]); });
  }
  // Smoothing spreads by a sample a round, and as its square; huge gaps stay a little uneven.
  constexpr double kMostWork = 2e8;
  const double rounds = std::min(double{2} * across * across, kMostWork / (gaps.size() + 1.0));
  for (int round = 0; round < rounds; ++round) {
    for (size_t i = 0; i < gaps.size(); ++i) means[i] = MeanAround(terrain, gaps[i]);
    for (size_t i = 0; i < gaps.size(); ++i) terrain.z_m[gaps[i]] = means[i];
  }
  return gaps.size();
}

float RoundedUp(double value) {
  const float rounded = static_cast<float>(value);
  return rounded >= value ? rounded
                          : std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

// Raises the corners of a cell of the grid onto a plane that the raster does not pierce within the
// cell: a level one or the one along the slope, whichever is lower on average.
class CellCover {
 public:
  CellCover(const Raster& raster, const std::vector<Eigen::Vector2d>& pixels,
            const TerrainGrid& ground)
      : raster_(raster), pixels_(pixels), ground_(ground) {}

  void Raise(const std::array<size_t, 4>& corners, std::vector<float>& z_m) const {
    const Eigen::Vector2d gradient = Gradient(corners);
    Eigen::AlignedBox2d box;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    double mean = 0;
    for (const size_t corner : corners) {
      box.extend(pixels_[corner]);
      middle += pixels_[corner] / 4;
      mean += ground_.z_m[corner] / 4;
    }
    const auto tilted = [&](const Eigen::Vector2d& at) { return mean + gradient.dot(at - middle); };
    double above = 0;  // the tilted plane
    double highest = -std::numeric_limits<double>::infinity();
    const auto cover = [&](const Eigen::Vector2d& at, double z) {
      if (std::isnan(z)) return;
      above = std::max(above, z - tilted(at));
      highest = std::max(highest, z);
    };
    for (const size_t corner : corners) cover(pixels_[corner], ground_.z_m[corner]);
    const Eigen::Array2i low = (box.min().array() - 0.5).floor().cast<int>();
    const Eigen::Array2i high = (box.max().array() - 0.5).floor().cast<int>() + 1;
    for (int row = low.y(); row <= high.y(); ++row) {
      for (int column = low.x(); column <= high.x(); ++column) {
        cover({column + 0.5, row + 0.5}, raster_.Value(column, row));
      }
    }
    for (const size_t corner : corners) {
      const double z = mean + above < highest ? tilted(pixels_[corner]) + above : highest;
      z_m[corner] = std::max(z_m[corner], RoundedUp(z));
    }
  }

 private:
  // Of the ground in the cell, per pixel.
  Eigen::Vector2d Gradient(const std::array<size_t, 4>& corners) const {
    const auto along = [&](int from, int to) {
      return Eigen::Vector2d(pixels_[corners[to]] - pixels_[corners[from]]);
    };
    const auto rise = [&](int from, int to) {
      return double{ground_.z_m[corners[to]]} - ground_.z_m[corners[from]];
    };
    Eigen::Matrix2d sides;
    sides << (along(0, 1) + along(2, 3)).transpose(), (along(0, 2) + along(1, 3)).transpose();
    return sides.inverse() * Eigen::Vector2d(rise(0, 1) + rise(2, 3), rise(0, 2) + rise(1, 3));
  }

  const Raster& raster_;
  const std::vector<Eigen::Vector2d>& pixels_;
  const TerrainGrid& ground_;
};

// A grid whose bilinear surface is nowhere below the raster's, so that nothing flies through a
// ridge between two samples. Proof: let L be an affine function of position that no pixel exceeds
// whose bilinear patches reach into a cell. A patch minus L is bilinear in the coordinates of the
// raster, thus highest at one of its four pixels, so that the raster is below L in the cell. The
// grid minus L is bilinear in the coordinates of the grid, and where all four corners are not below
// L nothing in between is. Each cell has such an L; a corner takes the highest of its four cells'.
// (That L is affine in both coordinates leaves out how the map projections bend within a cell: less
// than 0.1 mm in the plane.) Slopes stay as they are, as L follows them.
TerrainGrid Covering(const Raster& raster, const std::vector<Eigen::Vector2d>& pixels,
                     const TerrainGrid& ground) {
  TerrainGrid result = ground;
  const CellCover cover(raster, pixels, ground);
  for (int row = 0; row + 1 < ground.rows; ++row) {
    for (int column = 0; column + 1 < ground.columns; ++column) {
      const size_t corner = static_cast<size_t>(row) * ground.columns + column;
      cover.Raise({corner, corner + 1, corner + ground.columns, corner + ground.columns + 1},
                  result.z_m);
    }
  }
  return result;
}

}  // namespace

ReadTerrain ReadDem(const std::filesystem::path& path, const PlanOrigin& origin,
                    const Eigen::AlignedBox2d& bounds) {
  const GDALDatasetUniquePtr dataset = internal::OpenDataset(path, GDAL_OF_RASTER);
  Raster raster = Describe(*dataset, path);
  const double pixel_m = PixelSize(raster, origin, path);
  ReadTerrain result;
  TerrainGrid& ground = result.ground;
  ground = GridOver(bounds, pixel_m);
  std::vector<Eigen::Vector2d> positions;
  positions.reserve(static_cast<size_t>(ground.rows) * ground.columns);
  for (int row = 0; row < ground.rows; ++row) {
    for (int column = 0; column < ground.columns; ++column) {
      positions.push_back(ground.corner + ground.step_m * Eigen::Vector2d(column, row));
    }
  }
  // The last samples lie up to a step beyond the bounds, where the raster need not reach.
  CheckCover(raster, PixelsOf(raster, origin, BorderOf(bounds, ground.step_m), path), pixel_m,
             path);
  const std::vector<Eigen::Vector2d> pixels = PixelsOf(raster, origin, positions, path);
  ReadWindow(*dataset, pixels, raster, path);
  for (const Eigen::Vector2d& pixel : pixels) ground.z_m.push_back(raster.Interpolated(pixel));
  if (std::all_of(ground.z_m.begin(), ground.z_m.end(), [](float z) { return std::isnan(z); })) {
    Fail(path, "has no heights at the place of the map",
         "give the terrain of the place of the map");
  }
  if (const size_t gaps = FillGaps(ground); gaps > 0) {
    result.repairs.Add("",
                       fmt::format("terrain: gaps ({:.1f} % of the site) filled from around them",
                                   100.0 * gaps / ground.z_m.size()));
  }
  result.terrain = Covering(raster, pixels, ground);
  result.origin_height_m = ground.HeightAt({0, 0});
  for (float& z : ground.z_m) z = static_cast<float>(z - result.origin_height_m);
  for (float& z : result.terrain.z_m) z = RoundedUp(z - result.origin_height_m);
  return result;
}

}  // namespace stucco::plan
