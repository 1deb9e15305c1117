// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "survey/camera.h"
#include "survey/pose.h"

namespace stucco {

// Pictures of a survey's facets as photos of another day show them: a folder epochs/NAME beside the
// survey's own results, which stay as they are.

// When new photos take the place of what was painted.
enum class ReplaceMode { kAuto, kAlways, kNever };
std::string_view Name(ReplaceMode mode);  // "auto", "always", "never"
std::optional<ReplaceMode> ReplaceModeFromName(std::string_view name);

// What became of a facet's picture.
enum class FacetChoice {
  kKept,      // the same bytes as before, or none as before
  kReplaced,  // from new photos wherever they show it
  kFilled,    // from new photos where none had shown it
  kPainted,   // for the first time
};
std::string_view Name(FacetChoice choice);  // "kept", "replaced", "filled", "painted"

// A place on a facet where what photos show changed. Metres (units of the world) on the facet's
// picture, from its left and from its lower edge.
struct EpochPlace {
  std::string what;  // "colour" or "pattern"
  std::array<double, 2> along_m = {};
  std::array<double, 2> up_m = {};
  double area_m2 = 0;  // that changed in it
  std::string before;  // pictures of it and what is around it, relative to the epoch's folder
  std::string after;
};

// Shares are of the facet's area.
struct EpochFacet {
  std::string id;
  FacetChoice choice = FacetChoice::kKept;
  std::string why;          // for people
  double shown = 0;         // painted from new photos, if all of them were taken
  double taken = 0;         // that are in the epoch's picture
  double both = 0;          // shown by photos then and now
  double compared = 0;      // of these, from much the same direction
  double repainted = 0;     // of another colour
  double other = 0;         // of another pattern and hue: something new, or gone
  double shaded = 0;        // of another pattern of light and dark, which shadows may be
  double gsd_before_m = 0;  // median size of a photo pixel; 0: not painted
  double gsd_after_m = 0;
  double shift_px = -1;  // median distance of details then and now, texels; -1: not measured
  std::vector<EpochPlace> places;  // that changed; the largest first
};

// A new photo, and where it is in the survey.
struct EpochPhoto {
  std::string path;  // relative to the photo folder
  std::string hash;
  std::optional<Pose> cam_from_world;  // nothing: not placed
  std::string why;                     // not placed, for people
  int matched_photos = 0;              // of the survey
  int points = 0;                      // of the survey that it seems to show
  int inliers = 0;                     // of these, in agreement with its pose
  // One standard deviation of the pose, the survey taken as it is: unit of the world, root of the
  // sum over the axes; in its picture, full-size pixels. -1: not known.
  double position_sigma = -1;
  double picture_sigma_px = -1;
  Camera camera;

  bool is_placed() const { return cam_from_world.has_value(); }
};

struct Epoch {
  std::string name;
  ReplaceMode replace = ReplaceMode::kAuto;
  std::string photo_folder;  // absolute
  std::vector<EpochPhoto> photos;
  std::vector<EpochFacet> facets;  // in the order of textures.json
};

// epochs/NAME/retexture.json; the names in it are fixed (docs/formats.md). Throws Error.
void WriteEpoch(const Epoch& epoch, const std::filesystem::path& path);

// What that file says of how the epoch was asked for: without photos and facets. Throws Error
// (kBadInput).
Epoch ReadEpochRequest(const std::filesystem::path& path);

}  // namespace stucco
