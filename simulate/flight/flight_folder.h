// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "simulate/render/light.h"
#include "survey/camera.h"
#include "survey/georef.h"
#include "survey/pose.h"

namespace stucco::simulate {

// The truth of a simulated flight, beside its photos in SURVEY/truth:
//   flight.json          this struct
//   sparse/{cameras,images,points3D}.txt  the same cameras and poses for COLMAP's readers
//   depth/<photo>.dmap   on request; in the photo's own pixels, distortion and all
//   held_out/<photo>     photos that the survey does not have, listed in flight.json
inline constexpr char kTruthFolder[] = "truth";
inline constexpr char kFlightFile[] = "truth/flight.json";
inline constexpr char kPhotoFolder[] = "photos";  // of a survey that was flown here

struct FlownPhoto {
  std::string path;     // a file of the photo folder, or of truth/: "held_out/a.JPG"
  std::string view;     // of the plan; empty: none
  Camera camera;        // exact, with its distortion
  Pose cam_from_world;  // exact; the world is the scene's frame
  Light light;          // at its time
  double time_s = 0;    // since the first photo
  double exposure = 1;  // radiance times this is what the sensor counts, 1 = white
  Eigen::Vector3d white_balance = Eigen::Vector3d::Ones();  // times this, by channel
  bool held_out = false;
  bool lost = false;         // planned, but there is no such file
  std::string duplicate_of;  // path of the photo that was taken twice
};

// What is not perfect about every picture of a flight; see FlightOptions.
struct PictureFaults {
  double motion_blur_px = 0.4;
  double focus_blur_px = 0.5;
  double noise = 0.006;
  double sharpening = 1;
  int jpeg_quality = 92;
};

struct Flight {
  std::string scene;       // as given
  std::string scene_hash;  // of its model's bytes; empty: not known
  uint64_t seed = 0;
  std::string made_from;           // hash of scene, plan and options: equal ones make equal photos
  Georef georef;                   // of the world: frame "enu"
  PictureFaults faults;            // the usual ones where flight.json has none
  std::vector<FlownPhoto> photos;  // in order of capture, held-out ones last
};

// Reading throws Error (kBadInput). Writing also writes the COLMAP model: all photos that there
// are, named as below the photo folder, without held-out ones.
Flight ReadFlight(const std::filesystem::path& survey);
void WriteFlight(const Flight& flight, const std::filesystem::path& survey);

}  // namespace stucco::simulate
