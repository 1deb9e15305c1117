// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/painting/paint.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "texture/painting/align.h"
#include "texture/painting/composite.h"
#include "texture/painting/fill.h"
#include "texture/painting/patch_fill.h"
#include "texture/relief/find_relief.h"
#include "texture/selection/background.h"
#include "texture/selection/eaves.h"
#include "texture/selection/foliage.h"
#include "texture/selection/select.h"
#include "texture/views/plan_prior.h"

namespace stucco {
namespace {

constexpr int kCellSplit = 4;         // raster texels per cell side
constexpr double kMostCells = 20000;  // of one facet
// Bounds on what selection holds.
constexpr double kMostRasterViews = 1e7;  // raster texels times candidates
constexpr double kMostSeams = 1e8;        // cells times two directions times pairs of candidates
constexpr int kAlignSide = 1600;          // longest side of the alignment raster
// Memory: bytes per texel of the picture (with masks, rasters, encoded files), per raster texel and
// candidate, per seam, per texel of an aligned photo and of one being resampled, per photo pixel
// (three channels and their halvings).
constexpr double kBytesPerTexel = 25;
constexpr double kBytesPerRasterView = 60;
constexpr double kBytesPerSeam = 4;
constexpr double kBytesPerAligned = 2;
constexpr double kBytesPerSample = 13;
constexpr double kBytesPerPhotoPixel = 4;
constexpr int kPatchFillSide = 512;
constexpr double kMostPatchFilled = 0.5;  // of the facet: beyond, copies would be invention
constexpr uint32_t kFillSeed = 20260101;

struct Selected {
  FacetRaster raster;
  std::vector<RasterView> views;  // of the used photos, most painted first
  Ownership ownership;            // indices into `views`
};

TexelGrid GridToPaint(const Facet& facet, const FacetLook& look, const Eigen::Vector3d& up,
                      const TextureOptions& options) {
  return look.grid ? *look.grid : MakeGrid(facet, up, look.texel, options.max_texture_px);
}

void ApplyGain(const Eigen::Vector3d& gain, std::vector<float>& rgb) {
  for (size_t i = 0; i < rgb.size(); ++i) {
    rgb[i] = std::min(255.0f, rgb[i] * static_cast<float>(gain[static_cast<int>(i % 3)]));
  }
}

RasterPicture MakeRasterPicture(const RasterView& view, const TexelGrid& raster, double texel,
                                const Eigen::Vector3d& gain, const PaintScene& scene) {
  const SurveyPhoto& photo = scene.sights.photos[view.photo];
  RasterPicture picture;
  picture.sight.reserve(view.texels.size());
  for (const TexelView& seen : view.texels) picture.sight.push_back(seen.sight);
  picture.cost = ViewCosts(view, raster.texel, texel, photo.relative_sharpness);
  picture.rgb = SampleRaster(photo, raster, *scene.cache);
  SkyClues clues;
  for (const TexelView& seen : view.texels) clues.no_points.push_back(seen.no_points);
  clues.skyward = FindSkyward(raster, photo.cam_from_world.Center(), scene.up);
  MarkSky(raster, clues, picture.rgb, picture.sight);
  ApplyGain(gain, picture.rgb);
  const Eigen::Vector3d camera = photo.cam_from_world.Center();
  picture.camera.head<2>() = raster.From(camera);
  picture.camera.z() = (camera - raster.origin).dot(raster.normal) / raster.texel;
  return picture;
}

// Texels per cell: the wish, a multiple of kCellSplit, larger on large facets with many candidates.
int CellSide(const TexelGrid& grid, int wish_px, size_t candidates) {
  const auto count = static_cast<double>(candidates);
  const double most = std::min({kMostCells, kMostRasterViews / (kCellSplit * kCellSplit * count),
                                kMostSeams / (2 * count * count)});
  const double needed = std::sqrt(static_cast<double>(grid.size()) / most);
  const double side = std::max(needed, static_cast<double>(wish_px)) / kCellSplit;
  return kCellSplit * std::max(1, static_cast<int>(std::ceil(side)));
}

// Keeps the photos that own something, most first, and renumbers the owners.
void KeepUsed(std::vector<RasterView>& views, std::span<const uint16_t> inside,
              std::vector<int>& owner) {
  std::vector<uint64_t> area(views.size(), 0);
  for (size_t i = 0; i < owner.size(); ++i) {
    if (owner[i] >= 0) area[owner[i]] += inside[i];
  }
  std::vector<int> order(views.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return area[a] > area[b]; });
  std::vector<int> number(views.size(), -1);
  std::vector<RasterView> kept;
  for (int old : order) {
    if (area[old] == 0 || static_cast<int>(kept.size()) >= kMostCandidates) continue;
    number[old] = static_cast<int>(kept.size());
    kept.push_back(std::move(views[old]));
  }
  for (int& o : owner) o = o >= 0 ? number[o] : -1;
  views = std::move(kept);
}

Selected SelectPhotos(const PaintJob& job, const PaintedFacet& canvas, PaintRecord* record) {
  const auto& [facet, look, gains, scene, options] = job;
  Selected out;
  const int cell = CellSide(canvas.grid, options.cell_px, look.candidates.size());
  const int step = cell / kCellSplit;
  out.raster = {Coarsened(canvas.grid, step), CountInside(canvas.grid, canvas.mask, step),
                step * step};
  out.ownership.step = step;
  out.ownership.raster_width = out.raster.grid.width;
  std::vector<int> photos;
  for (const Candidate& candidate : look.candidates) photos.push_back(candidate.photo);
  const std::vector<float> prior = PriorCosts(facet, scene.sights.photos, photos);
  std::vector<RasterPicture> pictures;
  for (const Candidate& candidate : look.candidates) {
    out.views.push_back(MeasureView(scene.sights, candidate.photo, facet, out.raster, look.limits));
    pictures.push_back(MakeRasterPicture(out.views.back(), out.raster.grid, canvas.grid.texel,
                                         gains[candidate.photo], scene));
    for (float& cost : pictures.back().cost) cost += prior[pictures.size() - 1];
  }
  if (facet.facet_class == FacetClass::kWall) {
    DropFoliage(out.raster, look.limits.clearance / out.raster.grid.texel, pictures);
  }
  for (size_t p = 0; p < pictures.size(); ++p) {
    for (size_t i = 0; i < out.raster.grid.size(); ++i) {
      out.views[p].texels[i].sight = pictures[p].sight[i];
    }
  }
  const SelectOptions select{kCellSplit, options.photo_cost, options.seam_cost, options.min_region,
                             look.limits.clearance / out.raster.grid.texel};
  out.ownership.owner = SelectPictures(pictures, out.raster, select);
  if (facet.facet_class == FacetClass::kGround) {
    ClearEaves(out.raster.grid, pictures, look.limits.clearance / out.raster.grid.texel,
               out.ownership.owner);
  }
  DropBackground(out.raster.grid, out.raster.inside, pictures, out.ownership.owner);
  if (record != nullptr) {
    *record = {out.raster, std::move(photos), std::move(pictures), out.ownership.owner, {}};
  }
  KeepUsed(out.views, out.raster.inside, out.ownership.owner);
  return out;
}

std::vector<PhotoLayer> OpenChosen(const Selected& selected, std::span<const Eigen::Vector3d> gains,
                                   const PaintScene& scene) {
  std::vector<PhotoLayer> chosen;
  for (const RasterView& view : selected.views) {
    PhotoLayer photo;
    photo.photo = &scene.sights.photos[view.photo];
    photo.open = [cache = scene.cache, path = photo.photo->path()] { return cache->Get(path, 0); };
    photo.gain = gains[view.photo];
    for (const TexelView& seen : view.texels) photo.sight.push_back(seen.sight);
    chosen.push_back(std::move(photo));
  }
  return chosen;
}

// The part of the raster that a chosen photo shows freely; a texel of the selection's raster is
// `scale` of this one's.
Tile FreeArea(const PhotoLayer& chosen, const Ownership& ownership, const TexelGrid& raster,
              double scale) {
  int left = raster.width;
  int top = raster.height;
  int right = 0;
  int bottom = 0;
  for (size_t i = 0; i < chosen.sight.size(); ++i) {
    if (chosen.sight[i] != Sight::kFree) continue;
    const double x = scale * static_cast<double>(i % ownership.raster_width);
    const size_t row = i / ownership.raster_width;
    const double y = scale * static_cast<double>(row);
    left = std::min(left, static_cast<int>(x));
    top = std::min(top, static_cast<int>(y));
    right = std::max(right, static_cast<int>(std::ceil(x + scale)));
    bottom = std::max(bottom, static_cast<int>(std::ceil(y + scale)));
  }
  right = std::min(right, raster.width);
  bottom = std::min(bottom, raster.height);
  return {left, top, std::max(0, right - left), std::max(0, bottom - top)};
}

GreyPicture MakeGreyPicture(const PhotoLayer& chosen, const TexelGrid& raster, int step,
                            const PaintedFacet& canvas, const Ownership& ownership) {
  const Tile area = FreeArea(chosen, ownership, raster, static_cast<double>(ownership.step) / step);
  if (area.size() == 0) return {};
  const SampledTile sampled = SamplePhoto(*chosen.photo, *chosen.open(), raster, area);
  GreyPicture out{area.width, area.height, {}, sampled.valid, area.x, area.y};
  out.grey.reserve(area.size());
  for (size_t i = 0; i < area.size(); ++i) {
    const float* rgb = &sampled.rgb[3 * i];
    out.grey.push_back(GreyOf(rgb));
    const int x = area.x + static_cast<int>(i % area.width);
    const int y = area.y + static_cast<int>(i / area.width);
    const int column = std::min(canvas.grid.width - 1, x * step + step / 2);
    const int row = std::min(canvas.grid.height - 1, y * step + step / 2);
    if (chosen.sight[ownership.RasterIndex(column, row)] != Sight::kFree) out.valid[i] = 0;
  }
  return out;
}

void AlignChosen(const Selected& selected, const TextureOptions& options,
                 std::vector<PhotoLayer>& chosen, PaintedFacet& painted) {
  if (chosen.size() < 2) return;
  const int longest = std::max(painted.grid.width, painted.grid.height);
  const int step = (longest + kAlignSide - 1) / kAlignSide;
  const TexelGrid raster = Coarsened(painted.grid, step);
  std::vector<GreyPicture> pictures;
  pictures.reserve(chosen.size());
  for (const PhotoLayer& photo : chosen) {
    pictures.push_back(MakeGreyPicture(photo, raster, step, painted, selected.ownership));
  }
  Alignment alignment = AlignPictures(pictures, Eigen::Vector2d(raster.width, raster.height),
                                      options.align_limit_px / step);
  if (alignment.before_px < 0) return;
  painted.misregistration_before_px = alignment.before_px * step;
  painted.misregistration_px = alignment.before_px * step;
  if (!options.align) return;
  painted.misregistration_px = alignment.after_px * step;
  for (size_t k = 0; k < chosen.size(); ++k) {
    GridShift shift = alignment.shifts[k];
    shift.center *= step;
    shift.radius *= step;
    shift.terms *= step;
    chosen[k].shift = shift;
  }
}

// The picture as the photos are, one beside the other.
Image WithoutLight(const PaintedFacet& painted, std::vector<PhotoLayer> chosen,
                   const Ownership& ownership) {
  for (PhotoLayer& photo : chosen) photo.gain = Eigen::Vector3d::Ones();
  return ComposePicture(painted.grid, painted.mask, chosen, ownership, /*blend=*/false).picture;
}

// Texels whose photo sees points of the cloud before the facet.
std::vector<uint8_t> FindInFront(const Selected& selected, const PaintedFacet& painted) {
  std::vector<uint8_t> in_front(painted.labels.size(), 0);
  for (size_t i = 0; i < in_front.size(); ++i) {
    if (painted.labels[i] == 0) continue;
    const size_t texel = selected.ownership.RasterIndex(static_cast<int>(i % painted.grid.width),
                                                        static_cast<int>(i / painted.grid.width));
    const RasterView& view = selected.views[painted.labels[i] - 1];
    in_front[i] = view.texels[texel].sight == Sight::kBehind;
  }
  return in_front;
}

// What relief hides from some photos, and shows others only something before it, is nobody's.
void LetGoBehindRelief(const Selected& selected, const PaintScene& scene, PaintedFacet& painted) {
  const TexelGrid& grid = painted.grid;
  if (!grid.relief) return;
  std::vector<Eigen::Vector3d> cameras;
  for (const RasterView& view : selected.views) {
    cameras.push_back(scene.sights.photos[view.photo].cam_from_world.Center());
  }
  for (size_t i = 0; i < painted.labels.size(); ++i) {
    if (!painted.in_front[i]) continue;
    const Eigen::Vector3d point =
        grid.Center(static_cast<int>(i % grid.width), static_cast<int>(i / grid.width));
    if (std::ranges::none_of(cameras, [&](const Eigen::Vector3d& camera) {
          return grid.ReliefHides(point, camera);
        })) {
      continue;
    }
    painted.labels[i] = 0;
    painted.in_front[i] = 0;
  }
}

// Continues colours into holes and beyond the facet, copies texture into the holes, and counts.
void FillAndCount(const TextureOptions& options, PaintedFacet& painted) {
  std::vector<uint8_t> known(painted.labels.size());
  std::vector<uint8_t> hole(painted.labels.size());
  size_t area = 0;
  size_t known_area = 0;
  for (size_t i = 0; i < known.size(); ++i) {
    known[i] = painted.labels[i] != 0;
    hole[i] = painted.mask[i] != 0 && !known[i];
    area += painted.mask[i] != 0;
    known_area += known[i];
  }
  painted.painted = static_cast<double>(known_area) / static_cast<double>(area);
  painted.sharpness = MeasureSharpness(painted.picture, known);
  if (options.inpaint) {
    FillPictureSmoothly(painted.picture, known);
    painted.inpainted = 1 - painted.painted;
    if (known_area < area && painted.inpainted <= kMostPatchFilled) {
      FillWithPatches(painted.picture, hole, known, kPatchFillSide, kFillSeed);
    }
    for (size_t i = 0; i < hole.size(); ++i) {
      if (hole[i]) painted.labels[i] = 255;
    }
    return;
  }
  // Holes stay black; the surroundings of the facet still get colours, for mipmaps.
  std::vector<uint8_t> fixed(known);
  for (size_t i = 0; i < hole.size(); ++i) {
    if (!hole[i]) continue;
    fixed[i] = 1;
    std::fill_n(&painted.picture.data[3 * i], 3, uint8_t{0});
  }
  FillPictureSmoothly(painted.picture, fixed);
}

}  // namespace

uint64_t PaintingBytes(const Facet& facet, const FacetLook& look, const PaintScene& scene,
                       const TextureOptions& options) {
  if (look.candidates.empty()) return 0;
  const TexelGrid grid = GridToPaint(facet, look, scene.up, options);
  const auto texels = static_cast<double>(grid.size());
  const auto count = static_cast<double>(look.candidates.size());
  const int step = CellSide(grid, options.cell_px, look.candidates.size()) / kCellSplit;
  const double raster = texels / (static_cast<double>(step) * step);
  const double cells = raster / (kCellSplit * kCellSplit);
  double shown = 0;
  double photo_px = 0;
  for (const Candidate& candidate : look.candidates) {
    const Camera& camera = scene.sights.photos[candidate.photo].camera;
    shown += candidate.seen;
    photo_px = std::max(photo_px, static_cast<double>(camera.width_px) * camera.height_px);
  }
  const double aligned = std::min(texels, static_cast<double>(kAlignSide) * kAlignSide);
  return (options.relief ? ReliefBytes(grid) : 0) +
         static_cast<uint64_t>(kBytesPerTexel * texels + kBytesPerRasterView * raster * count +
                               kBytesPerSeam * 2 * cells * count * count +
                               aligned * (kBytesPerAligned * shown + kBytesPerSample) +
                               kBytesPerPhotoPixel * photo_px);
}

PaintedFacet PaintFacet(const PaintJob& job, PaintRecord* record) {
  const auto& [facet, look, gains, scene, options] = job;
  PaintedFacet painted;
  if (look.candidates.empty()) return painted;
  painted.grid = GridToPaint(facet, look, scene.up, options);
  painted.wanted_texel = look.texel;
  painted.mask = RasterizeFacet(facet, painted.grid);

  // 1. What stands out of it, or lies back in it.
  if (LooksForRelief(facet, look, options, scene.metric)) {
    painted.grid.relief = FindRelief(facet, painted.grid, look.limits, scene);
  }

  // 2. Which photo paints what.
  const Selected selected = SelectPhotos(job, painted, record);
  if (selected.views.empty()) return painted;
  for (const RasterView& view : selected.views) painted.photos.push_back(view.photo);

  // 3. Bring the chosen photos together on the facet's plane.
  std::vector<PhotoLayer> chosen = OpenChosen(selected, gains, scene);
  AlignChosen(selected, options, chosen, painted);
  if (record != nullptr) record->unlit = WithoutLight(painted, chosen, selected.ownership);

  // 4. Paint, and fill what nobody shows.
  Composite composite =
      ComposePicture(painted.grid, painted.mask, chosen, selected.ownership, options.blend);
  painted.picture = std::move(composite.picture);
  painted.labels = std::move(composite.labels);
  if (std::all_of(painted.labels.begin(), painted.labels.end(), [](uint8_t l) { return l == 0; })) {
    PaintedFacet nothing;
    nothing.grid = painted.grid;
    return nothing;
  }
  painted.in_front = FindInFront(selected, painted);
  LetGoBehindRelief(selected, scene, painted);
  FillAndCount(options, painted);

  // 5. Measure.
  painted.quality = MeasureQuality(selected.views, scene.sights.photos, selected.raster,
                                   selected.ownership.owner, look.texel);
  return painted;
}

}  // namespace stucco
