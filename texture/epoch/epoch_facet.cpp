// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/epoch/epoch_facet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "survey/decode_image.h"
#include "survey/error.h"
#include "survey/files.h"
#include "texture/epoch/decide.h"
#include "texture/epoch/merge.h"
#include "texture/epoch/new_plants.h"
#include "texture/grid/grid.h"
#include "texture/painting/align.h"

namespace stucco {
namespace {

constexpr size_t kRatioTexels = 40'000;  // enough for a median
constexpr int kShiftSide = 1600;         // longest side of the pictures whose shift is measured
// Pictures are compared where what stands out of the facet's plane lies in them within this share
// of its depth: at right angles, from directions within 27 degrees. From farther apart, eaves,
// balconies and reveals show and hide other parts, which is no change.
constexpr double kMostParallax = 0.5;

Image Decode(const std::string& bytes, const std::string& name, const TexturedFacet& facet,
             int channels) {
  Image image = DecodeImage(bytes, name);
  if (image.width_px != facet.width_px || image.height_px != facet.height_px ||
      image.channels != channels) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is not the picture that textures.json describes", name),
                "make the survey's textures again first: stucco texture SURVEY --force");
  }
  return image;
}

GreyPicture GreyPictureOf(const FacetPicture& facet, int step) {
  GreyPicture grey;
  grey.width = (facet.picture.width_px + step - 1) / step;
  grey.height = (facet.picture.height_px + step - 1) / step;
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      const size_t texel = static_cast<size_t>(y) * step * facet.picture.width_px + x * step;
      const uint8_t* rgb = &facet.picture.data[3 * texel];
      grey.grey.push_back(GreyOf(rgb));
      grey.valid.push_back(IsPainted(facet.labels[texel]));
    }
  }
  return grey;
}

// How far details lie apart in both pictures, texels; -1 where too few are the same.
double ShiftBetween(const FacetPicture& before, const FacetPicture& after, double limit_px) {
  const int longest = std::max(before.picture.width_px, before.picture.height_px);
  const int step = (longest + kShiftSide - 1) / kShiftSide;
  const std::vector<GreyPicture> pictures = {GreyPictureOf(before, step),
                                             GreyPictureOf(after, step)};
  const Alignment alignment = AlignPictures(
      pictures, Eigen::Vector2d(pictures[0].width, pictures[0].height), limit_px / step);
  return alignment.before_px < 0 ? -1 : alignment.before_px * step;
}

// Of the texels inside the facet, those that are set in both.
double ShareOf(std::span<const uint8_t> a, std::span<const uint8_t> b,
               std::span<const uint8_t> mask) {
  size_t area = 0;
  size_t count = 0;
  for (size_t i = 0; i < mask.size(); ++i) {
    area += mask[i] != 0;
    count += mask[i] != 0 && a[i] != 0 && b[i] != 0;
  }
  return area > 0 ? static_cast<double>(count) / static_cast<double>(area) : 0;
}

void ApplyLevel(const Eigen::Vector3d& level, Image& picture) {
  for (size_t k = 0; k < picture.data.size(); ++k) {
    const double value = level[static_cast<int>(k % 3)] * picture.data[k] + 0.5;
    picture.data[k] = static_cast<uint8_t>(std::min(255.0, value));
  }
}

// New photos as they are called in the epoch, then those of the old picture; with their gains.
struct PhotosOfBoth {
  std::vector<SurveyPhoto> photos;
  std::vector<Eigen::Vector3d> gains;
};

PhotosOfBoth JoinPhotosOfBoth(const EpochFacetInput& input, const EpochStyle& style) {
  std::map<std::string, const SurveyPhoto*> by_path;
  for (const SurveyPhoto& photo : style.photos) by_path[photo.path()] = &photo;
  PhotosOfBoth both;
  const double level = input.level.mean();
  for (const std::string& path : input.painted.facet.photos) {
    both.photos.push_back(*by_path.at(path));
    both.photos.back().captured.path = fmt::format("{}:{}", style.epoch, path);
    both.gains.emplace_back(Eigen::Vector3d::Constant(level * input.painted.facet.gains.at(path)));
  }
  for (const std::string& path : input.old.photos) {
    SurveyPhoto& photo = both.photos.emplace_back();
    photo.captured.path = path;
    if (std::ranges::count(input.old.planned_photos, path) > 0) {
      photo.planned_facades = input.facet.planned_facades;
    }
    const auto gain = input.old.gains.find(path);
    both.gains.emplace_back(
        Eigen::Vector3d::Constant(gain == input.old.gains.end() ? 1 : gain->second));
  }
  return both;
}

// Where a facet's texels are, and which of them are inside of it.
struct Canvas {
  TexelGrid grid;
  std::vector<uint8_t> mask;
};

// The figures of the part that weighs more, and those of the whole picture measured anew.
FacetFiles FilesOf(FacetPicture picture, const EpochFacetInput& input, Canvas canvas,
                   const EpochStyle& style, bool is_mostly_old) {
  const std::vector<uint8_t>& mask = canvas.mask;
  const TexturedFacet& more = is_mostly_old ? input.old : input.painted.facet;
  PaintedFacet painted;
  painted.grid = canvas.grid;
  painted.wanted_texel = more.wanted_metres_per_texel;
  painted.photos = Renumber(picture.labels);
  const std::vector<uint8_t> from_photos = PaintedTexels(picture);
  painted.painted = ShareOf(from_photos, from_photos, mask);
  std::vector<uint8_t> inpainted;
  for (const uint8_t label : picture.labels) inpainted.push_back(label == 255);
  painted.inpainted = ShareOf(inpainted, inpainted, mask);
  painted.misregistration_px = more.misregistration_px;
  painted.sharpness = MeasureSharpness(picture.picture, from_photos);
  painted.quality = {more.q_s, more.q_d, more.q_u, more.q_c, more.gsd_m};
  painted.mask = std::move(canvas.mask);
  painted.picture = std::move(picture.picture);
  painted.labels = std::move(picture.labels);
  const PhotosOfBoth both = JoinPhotosOfBoth(input, style);
  FacetFiles files =
      MakeFacetFiles(input.facet, painted, both.photos, both.gains, style.options.orthophotos);
  files.relief = input.painted.relief;
  return files;
}

// From where each label of a picture was taken; nothing for those that no photo is known for.
using Viewpoints = std::array<std::optional<Eigen::Vector3d>, 256>;

Viewpoints ViewpointsOf(const TexturedFacet& facet,
                        const std::map<std::string, Eigen::Vector3d>& taken_at) {
  Viewpoints from;
  for (size_t i = 0; i < facet.photos.size() && i + 1 < from.size(); ++i) {
    const auto found = taken_at.find(facet.photos[i]);
    if (found != taken_at.end()) from[i + 1] = found->second;
  }
  return from;
}

// Texels that photos look at from about the same direction then and now.
std::vector<uint8_t> SeenAlike(const EpochFacetInput& input, const FacetPicture& after,
                               const TexelGrid& grid, const EpochStyle& style) {
  std::map<std::string, Eigen::Vector3d> taken_at;
  for (const SurveyPhoto& photo : style.photos) {
    taken_at[photo.path()] = photo.cam_from_world.Center();
  }
  const Viewpoints now = ViewpointsOf(input.painted.facet, taken_at);
  const Viewpoints then = ViewpointsOf(input.old, style.taken_at);
  std::vector<uint8_t> alike(after.labels.size(), 0);
  for (size_t i = 0; i < alike.size(); ++i) {
    const auto& a = then[input.before->labels[i]];
    const auto& b = now[after.labels[i]];
    if (!a || !b) continue;
    const Eigen::Vector3d texel =
        grid.Center(static_cast<int>(i % grid.width), static_cast<int>(i / grid.width));
    const Eigen::Vector3d to_a = *a - texel;
    const Eigen::Vector3d to_b = *b - texel;
    const Eigen::Vector3d moved = to_a / to_a.dot(grid.normal) - to_b / to_b.dot(grid.normal);
    alike[i] = moved.norm() <= kMostParallax;
  }
  return alike;
}

// Of the mask, what is not at an edge of relief: photos from elsewhere show other things there.
std::vector<uint8_t> AwayFromEdges(const Canvas& canvas, const Relief* relief) {
  std::vector<uint8_t> out = canvas.mask;
  if (relief == nullptr) return out;
  constexpr double kCells = 2;  // to which edges are known
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kCells * relief->cell);
  for (size_t i = 0; i < out.size(); ++i) {
    if (!out[i]) continue;
    const size_t column = i % canvas.grid.width;
    const size_t row = i / canvas.grid.width;
    const Eigen::Vector2d at =
        canvas.grid.texel *
        Eigen::Vector2d(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
    out[i] = relief->IsLevel(at - margin, at + margin);
  }
  return out;
}

// What a facet's picture is decided by.
struct Compared {
  FacetEvidence evidence;
  FacetChanges changes;  // of what both show
};

// Square metres of a mask.
double AreaOf(std::span<const uint8_t> mask, const TexelGrid& grid) {
  const auto outside = std::ranges::count(mask, uint8_t{0});
  return static_cast<double>(mask.size() - static_cast<size_t>(outside)) * grid.texel * grid.texel;
}

// Fills in what is found, before anything is decided.
Compared Compare(const EpochFacetInput& input, const FacetPicture& after, const Canvas& canvas,
                 const EpochStyle& style, EpochPicture& result) {
  EpochFacet& found = result.found;
  const std::vector<uint8_t>& mask = canvas.mask;
  const std::vector<uint8_t> painted_after = PaintedTexels(after);
  found.shown = ShareOf(painted_after, painted_after, mask);
  found.gsd_after_m = input.painted.facet.gsd_m;
  Compared compared;
  auto& [evidence, changes] = compared;
  evidence.painted_after = found.shown;
  evidence.gsd_after_m = found.gsd_after_m;
  if (!input.before) return compared;
  const std::vector<uint8_t> painted_before = PaintedTexels(*input.before);
  evidence.painted_before = ShareOf(painted_before, painted_before, mask);
  evidence.both = ShareOf(painted_before, painted_after, mask);
  // What lies at no edge of relief speaks for all that both show.
  const std::vector<uint8_t> judged = AwayFromEdges(canvas, input.relief.get());
  const double both_judged = ShareOf(painted_before, painted_after, judged);
  const double of_facet = both_judged > 0 ? evidence.both / both_judged : 0;
  changes = FindChanges(*input.before, after, judged, SeenAlike(input, after, canvas.grid, style));
  evidence.compared = of_facet * changes.compared;
  evidence.gsd_before_m = found.gsd_before_m;
  found.both = evidence.both;
  found.compared = evidence.compared;
  found.repainted = of_facet * changes.repainted;
  found.other = of_facet * changes.other;
  found.shaded = of_facet * changes.shaded;
  if (evidence.both > 0) {
    evidence.changed_share = (found.repainted + found.other) / evidence.both;
  }
  const double judged_m2 = AreaOf(judged, canvas.grid);
  for (const ChangedBox& box : WorthShowing(changes.boxes, judged_m2)) {
    found.places.push_back(PlaceOf(box, canvas.grid, judged_m2));
    result.places.push_back(ShowPlace(box, *input.before, after));
  }
  found.shift_px = ShiftBetween(*input.before, after, style.options.align_limit_px);
  return compared;
}

// What of a replaced picture no new photo shows although it is no longer as it was.
std::vector<uint8_t> OutdatedTexels(const FacetChanges& changes, const FacetPicture& before,
                                    std::span<const uint8_t> take, const Canvas& canvas) {
  std::vector<uint8_t> outdated(take.size(), 0);
  for (size_t i = 0; i < take.size(); ++i) {
    const auto x = static_cast<int>(i % canvas.grid.width);
    const auto y = static_cast<int>(i / canvas.grid.width);
    outdated[i] =
        canvas.mask[i] && !take[i] && changes.IsOutdated(x, y, before.picture.Pixel(x, y));
  }
  // More of it than of what is known would be invention.
  if (std::ranges::count(outdated, uint8_t{1}) > std::ranges::count(take, uint8_t{1})) {
    std::ranges::fill(outdated, uint8_t{0});
  }
  return outdated;
}

}  // namespace

std::optional<FacetPicture> ReadPicture(const TexturedFacet& facet,
                                        const std::filesystem::path& folder) {
  if (facet.image.empty()) return std::nullopt;
  const std::filesystem::path image = folder / facet.image;
  const std::filesystem::path labels = folder / facet.label_image;
  return FacetPicture{Decode(ReadFile(image), image.string(), facet, 3),
                      Decode(ReadFile(labels), labels.string(), facet, 1).data};
}

std::optional<FacetPicture> PictureOf(const FacetFiles& files) {
  if (files.texture_png.empty()) return std::nullopt;
  return FacetPicture{Decode(files.texture_png, files.facet.id, files.facet, 3),
                      Decode(files.label_png, files.facet.id, files.facet, 1).data};
}

std::optional<ColourRatio> BrightnessRatio(const FacetPicture& before, const FacetPicture& after) {
  const size_t step = after.labels.size() / kRatioTexels + 1;
  std::vector<float> rgb_after;
  std::vector<float> rgb_before;
  std::vector<uint8_t> both;
  for (size_t i = 0; i < after.labels.size(); i += step) {
    both.push_back(IsPainted(before.labels[i]) && IsPainted(after.labels[i]));
    for (size_t k = 3 * i; k < 3 * i + 3; ++k) {
      rgb_after.push_back(after.picture.data[k]);
      rgb_before.push_back(before.picture.data[k]);
    }
  }
  const auto ratios = MeasureRatios({0, rgb_after, {}}, {1, rgb_before, {}}, both);
  return ratios.empty() ? std::nullopt : std::optional(ratios.front());
}

EpochPicture MakeEpochPicture(EpochFacetInput input, const EpochStyle& style) {
  EpochPicture result;
  result.found.id = input.facet.id;
  result.found.gsd_before_m = input.old.image.empty() ? 0 : input.old.gsd_m;
  std::optional<FacetPicture> after = PictureOf(input.painted);
  if (!after) {
    result.found.why = Decide(style.replace, {}).why;
    return result;
  }
  ApplyLevel(input.level, after->picture);
  const bool hidden = input.before && LeaveOutNewPlants(*input.before, *after);
  Canvas canvas{GridOf(input.painted.facet, input.facet), {}};
  canvas.mask = RasterizeFacet(input.facet, canvas.grid);
  const Compared compared = Compare(input, *after, canvas, style, result);
  const FacetDecision decision = Decide(style.replace, compared.evidence);
  result.found.choice = decision.choice;
  result.found.why = hidden ? "what new photos show of it are plants before it" : decision.why;
  if (decision.choice == FacetChoice::kKept) return result;
  const std::vector<uint8_t> all = PaintedTexels(*after);
  if (!input.before) {
    result.found.taken = result.found.shown;
    result.files = FilesOf(std::move(*after), input, std::move(canvas), style, false);
    return result;
  }
  const std::vector<uint8_t> take = TexelsToTake(decision.choice, *input.before, *after);
  result.found.taken = ShareOf(take, all, canvas.mask);
  const bool is_mostly_old = decision.choice == FacetChoice::kFilled || result.found.taken < 0.5;
  std::vector<uint8_t> outdated(take.size(), 0);
  if (decision.choice == FacetChoice::kReplaced) {
    outdated = OutdatedTexels(compared.changes, *input.before, take, canvas);
  }
  std::vector<uint8_t> no_longer_old = take;
  for (size_t i = 0; i < take.size(); ++i) no_longer_old[i] = take[i] | outdated[i];
  FacetPicture merged = MergePictures(*input.before, *after, no_longer_old, canvas.mask,
                                      input.painted.facet.photos.size());
  FillOutdated(outdated, take, merged);
  result.files = FilesOf(std::move(merged), input, std::move(canvas), style, is_mostly_old);
  return result;
}

}  // namespace stucco
