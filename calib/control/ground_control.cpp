// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/control/ground_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "survey/error.h"
#include "survey/files.h"
#include "survey/median.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

constexpr size_t kProblemsSaid = 10;  // one by one
// No receiver is that far off: another zone, or columns the other way round.
constexpr double kElsewhere_m = 10000;

// What a name in the list stands for.
struct FoundPhoto {
  int photo = -1;   // of the scene
  std::string why;  // where it is none
};

std::string LastName(const std::string& path) {
  return fs::path(path).filename().string();
}

std::string LowerCase(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

// Photos by path, else by the file's name, else by it in lower case, where only one has it.
class PhotoNames {
 public:
  PhotoNames(const Captures& captures, const std::vector<const CapturedPhoto*>& photos) {
    for (const CapturedPhoto& photo : captures.photos) {
      const auto used = std::ranges::find(photos, &photo);
      const int index = used == photos.end() ? -1 : static_cast<int>(used - photos.begin());
      Add(photo.path, index);
      Add(LastName(photo.path), index);
      Add(LowerCase(LastName(photo.path)), index);
    }
  }

  FoundPhoto Find(const std::string& name) const {
    for (const std::string& form : {name, LastName(name), LowerCase(LastName(name))}) {
      const auto found = by_name_.find(form);
      if (found == by_name_.end()) continue;
      if (found->second.ambiguous) {
        return {-1, fmt::format("several photos are called {}; write the path below the photo "
                                "folder",
                                name)};
      }
      if (found->second.photo < 0) {
        return {-1, fmt::format("{} is not usable; ingest/captures.json says why", name)};
      }
      return {found->second.photo, {}};
    }
    return {-1,
            fmt::format("{} is no photo of this survey; check the name, or delete the line", name)};
  }

 private:
  struct NamedPhoto {
    int photo = -1;  // of the scene; -1: not usable
    bool ambiguous = false;
  };

  void Add(const std::string& name, int photo) {
    const auto [it, is_new] = by_name_.try_emplace(name, NamedPhoto{photo});
    if (!is_new && it->second.photo != photo) it->second.ambiguous = true;
  }

  std::map<std::string, NamedPhoto> by_name_;
};

// The file that holds the list; nothing where the survey has none.
std::optional<fs::path> ListOf(const CalibOptions& options, const fs::path& survey) {
  const fs::path path =
      survey / (options.ground_control.empty() ? kGroundControlFile : options.ground_control);
  if (fs::exists(path)) return path;
  if (options.ground_control.empty()) return std::nullopt;
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("{}: calib.ground_control names it, but there is no such file", path.string()),
      "correct the path in survey.toml, which counts from the survey's folder");
}

bool IsInPicture(const Eigen::Vector2d& pixel, const CapturedPhoto& photo) {
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= photo.width_px &&
         pixel.y() <= photo.height_px;
}

std::vector<PhotoMark> MarksOf(const SurveyedPoint& point, const PhotoNames& names,
                               const std::vector<const CapturedPhoto*>& photos,
                               GroundControl& control) {
  std::vector<PhotoMark> marks;
  for (const PointMarking& marking : point.markings) {
    FoundPhoto found = names.Find(marking.photo);
    if (found.why.empty() && !IsInPicture(marking.pixel, *photos[found.photo])) {
      const CapturedPhoto& photo = *photos[found.photo];
      found.why = fmt::format(
          "pixel {:.1f}, {:.1f} is outside of {}, which has {} x {}; mark in the photo as it is, "
          "neither reduced nor turned",
          marking.pixel.x(), marking.pixel.y(), marking.photo, photo.width_px, photo.height_px);
    }
    const bool twice = found.why.empty() && std::ranges::any_of(marks, [&](const PhotoMark& mark) {
                         return mark.photo == found.photo;
                       });
    if (twice) {
      found.why = fmt::format("point {} is marked in {} twice; delete one of them", point.name,
                              marking.photo);
    }
    if (found.why.empty()) {
      marks.push_back({found.photo, marking.pixel});
    } else {
      control.problems.push_back(
          fmt::format("{}, line {}: {}", control.file, marking.line, found.why));
    }
  }
  return marks;
}

PlaceOnEarth MiddleOf(const GroundControl& control) {
  std::vector<double> latitudes, longitudes, heights;
  for (const MarkedPoint& point : control.points) {
    latitudes.push_back(point.place.latitude_deg);
    longitudes.push_back(point.place.longitude_deg);
    heights.push_back(point.place.height_m);
  }
  return {*Median(std::move(latitudes)), *Median(std::move(longitudes)),
          *Median(std::move(heights))};
}

void RequireNearPhotos(const GroundControl& control,
                       const std::vector<const CapturedPhoto*>& photos) {
  std::vector<double> latitudes, longitudes;
  for (const CapturedPhoto* photo : photos) {
    if (!photo->position) continue;
    latitudes.push_back(photo->position->latitude_deg);
    longitudes.push_back(photo->position->longitude_deg);
  }
  if (latitudes.empty()) return;
  Georef at_photos;
  at_photos.frame = "enu";
  at_photos.origin_latitude_deg = *Median(std::move(latitudes));
  at_photos.origin_longitude_deg = *Median(std::move(longitudes));
  PlaceOnEarth middle = MiddleOf(control);
  middle.height_m = 0;
  const double distance_m = PositionIn(at_photos, middle).norm();
  if (distance_m < kElsewhere_m) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: its points lie {:.0f} km from where the photos say they were taken",
                          control.file, distance_m / 1000),
              "check the coordinate system in its first line (the zone, too), and that x is east "
              "or longitude and y is north or latitude");
}

// The first ones, and how many more there are; a file of another survey has thousands.
void SayProblems(GroundControl& control, Progress& progress) {
  const size_t count = control.problems.size();
  if (count > kProblemsSaid) {
    control.problems.resize(kProblemsSaid);
    control.problems.push_back(fmt::format("{}: {} more lines are left out for such reasons",
                                           control.file, count - kProblemsSaid));
  }
  for (const std::string& problem : control.problems) progress.Warn(problem);
}

}  // namespace

GroundControl ReadGroundControl(const CalibOptions& options, const Captures& captures,
                                const std::vector<const CapturedPhoto*>& photos,
                                const StageContext& context) {
  GroundControl control;
  const std::optional<fs::path> path = ListOf(options, context.survey);
  if (!path) return control;
  control.file = LastName(path->string());
  GroundControlList list = ParseGroundControl(ReadFile(*path), control.file);
  control.problems = std::move(list.problems);
  std::vector<Eigen::Vector3d> coordinates;
  for (const SurveyedPoint& point : list.points) coordinates.push_back(point.coordinates);
  const PlacesOnEarth places = PlacesFromSystem(list.crs, coordinates, control.file);
  if (!places.doubt.empty()) control.problems.push_back(places.doubt);
  const PhotoNames names(captures, photos);
  size_t num_marks = 0;
  for (size_t i = 0; i < list.points.size(); ++i) {
    const SurveyedPoint& point = list.points[i];
    if (!places.places[i]) {
      control.problems.push_back(fmt::format(
          "{}, line {}: point {} has no place on the earth in {}; x is east or longitude, y north "
          "or latitude",
          control.file, point.markings.front().line, point.name, list.crs));
      continue;
    }
    std::vector<PhotoMark> marks = MarksOf(point, names, photos, control);
    num_marks += marks.size();
    control.points.push_back({point.name, point.role, *places.places[i], std::move(marks)});
  }
  SayProblems(control, *context.progress);
  if (num_marks == 0) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: no point is marked in a photo of this survey", control.file),
                control.problems.empty() ? "" : control.problems.front());
  }
  if (options.use_positions) RequireNearPhotos(control, photos);
  return control;
}

Georef FrameAtPoints(const GroundControl& control) {
  const PlaceOnEarth middle = MiddleOf(control);
  Georef georef;
  georef.frame = "enu";
  georef.origin_latitude_deg = middle.latitude_deg;
  georef.origin_longitude_deg = middle.longitude_deg;
  georef.origin_height_m = middle.height_m;
  georef.up = Eigen::Vector3d::UnitZ();
  georef.metric = true;
  georef.source = kGroundControlSource;
  return georef;
}

Eigen::Vector3d PositionIn(const Georef& georef, const PlaceOnEarth& place) {
  return EnuFromGeodetic(georef, place.latitude_deg, place.longitude_deg, place.height_m);
}

}  // namespace stucco
