// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stucco {

// How surely a photo is placed.
enum class PhotoState {
  kTied,        // other photos hold its pose
  kWeak,        // they hardly do: do not trust it alone
  kAmbiguous,   // its matches fit more than one pose: in no model
  kRecordOnly,  // only its record says where it was: in no model
};

std::string_view Name(PhotoState state);  // "tied", "weak", "ambiguous", "record-only"
std::optional<PhotoState> PhotoStateFromName(std::string_view name);

// Whether a model has photos of this state: what works on models need not look at states.
bool IsInModel(PhotoState state);

// calib/calibration.json: what calibration knows about its own result.
struct CalibratedPhoto {
  std::string path;
  double reprojection_error_px = 0;
  int observations = 0;
  double prior_residual_m = -1;  // distance to its GPS position; -1: none
  bool prior_outlier = false;
  double coverage = 0;  // share of a 10 x 10 grid over the image with observations
  PhotoState state = PhotoState::kTied;
  std::string why = {};  // where it is not tied, for people
  int part = 0;          // index into Calibration::parts; -1: in no model
  // One standard deviation of the pose within its part, root of the sum over the axes; position in
  // the unit of the model; -1: not computed. Of photos in no model: of the record.
  double position_sigma = -1;
  double rotation_sigma_deg = -1;
  // By how much that moves what the photo shows in its picture, full-size pixels.
  double picture_sigma_px = -1;
  // Of photos in no model, in the world frame: centre x y z, cam_from_world w x y z. Else empty.
  std::vector<double> center = {};
  std::vector<double> rotation = {};
};

// Photos that are tied to each other, and by nothing but records, if at all, to those of other
// parts.
struct CalibratedPart {
  std::string model;  // folder in calib/; later stages use "sparse/0" alone
  int photos = 0;
  int points = 0;
  // "photos": the first part, which the others are placed against; "records": in the world frame,
  // by recorded positions; "nothing": in a frame and scale of its own.
  std::string placed_by = "photos";
  // One standard deviation of the place of the whole part against the first, root of the sum over
  // the axes; -1: of the first part, or not placed.
  double position_sigma_m = -1;
  double rotation_sigma_deg = -1;
  double shared_surface = 0;  // share of its points on surfaces that the first part sees as well
  std::string why = {};       // it stands apart, and what would join it, for people
};

// How the photos' records of one flight err, as the model shows.
struct CalibratedFlight {
  int photos = 0;
  std::vector<double> shift_m = {0, 0, 0};  // east, north, up, against the mean of all flights
  double sigma_horizontal_m = 0;            // per axis
  double sigma_vertical_m = 0;
  double yaw_deg = 0;  // true minus recorded, clockwise
};

struct CalibratedRecords {
  std::vector<CalibratedFlight> flights;
  // Recorded minus true, of all flights together: east, north, up. Only control points tell; empty:
  // not known.
  std::vector<double> shift_m;
  double attitude_sigma_deg = -1;  // about each axis; -1: no records of angles
  double hover_sigma_m = -1;  // of photos about the place of their hover, per axis; -1: not known
  double mount_deg = 0;       // angle between what the gimbal says and where the camera looks
  int barometric_photos = 0;  // whose height is the barometer's, where satellites put its zero
  double satellite_heights_sigma_m = 0;  // of single heights by satellites about these
};

// Where the walls of the plan's map show the model that positions place.
struct CalibratedMap {
  std::vector<double> shift_m = {0, 0};  // east, north: from the positions' model to the map's
  double turn_deg = 0;                   // likewise, counter-clockwise from above
  double sigma_m = 0;                    // one standard deviation of the shift
  int walls = 0;                         // on which it was measured
  bool moved = false;                    // the model was moved by it (calib.georef = "map")
};

struct UnposedPhoto {
  std::string path;
  std::string why;
};

struct CalibratedCamera {
  int id = 0;
  std::string label;
  std::string model;
  std::vector<std::string> names;
  std::vector<double> params;
  std::vector<double> sigma;  // one standard deviation; 0: held fixed; empty: not computed
  std::vector<std::string>
      held;  // parameters that the photos could not determine or that were given
};

// A surveyed point of gcp_list.txt, and how the model meets it.
struct CalibratedPoint {
  std::string name;
  std::string role;   // "control", "check"
  std::string state;  // "used", "measured" (check points), "blunder", "not seen", "unused"
  std::string why;    // sentences; may be empty
  int photos = 0;     // whose marks agree on it
  // Where marks and poses put it, minus where it was surveyed: east, north, up; empty: not known.
  std::vector<double> error_m;
  double reprojection_error_px = -1;  // root mean square; -1: not known
  double ground_pixel_m = -1;         // what a pixel covers there; -1: not known
  std::string verdict;                // "green", "amber", "red"; empty: not judged
};

// Root mean square errors of the points that are used, or measured.
struct CalibratedPointSet {
  int points = 0;
  double east_rms_m = 0;
  double north_rms_m = 0;
  double horizontal_rms_m = 0;  // of the distance
  double vertical_rms_m = 0;
  double reprojection_error_px = 0;
  double ground_pixel_m = 0;
  std::string verdict;
};

struct Calibration {
  int photos_total = 0;
  int photos_posed = 0;  // in the model that later stages use
  double reprojection_error_px = 0;
  int points = 0;
  double mean_track_length = 0;
  double prior_rms_horizontal_m = -1;  // -1: no positions
  double prior_rms_vertical_m = -1;
  std::vector<CalibratedPhoto> photos;  // of all models, and those with a record alone
  std::vector<UnposedPhoto> unposed;    // in no model
  std::vector<CalibratedPart> parts;    // the largest first; empty: of an imported model
  std::vector<CalibratedCamera> cameras;
  CalibratedRecords records;                      // empty where there are none, or they do not fit
  std::vector<CalibratedPoint> ground_control;    // as in the file
  std::optional<CalibratedPointSet> control_rms;  // of those used
  std::optional<CalibratedPointSet> check_rms;
  std::optional<CalibratedMap> map;   // nothing without a plan, or where its walls are not found
  std::vector<std::string> findings;  // "6 photos were taken from one point (rotation only) ..."
};

// Throws Error (kBadInput). Writing requires lists that fit each other: parts that photos name,
// numbers for each name of a camera's parameters, three for a place and four for a rotation.
Calibration ReadCalibration(const std::filesystem::path& path);
void WriteCalibration(const Calibration& calibration, const std::filesystem::path& path);

}  // namespace stucco
