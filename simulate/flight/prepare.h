// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "simulate/flight/flight_folder.h"
#include "simulate/flight/metadata.h"
#include "simulate/flight/options.h"
#include "simulate/flight/placing.h"
#include "simulate/flight/schedule.h"
#include "simulate/flight/sensor.h"
#include "simulate/render/pictures.h"
#include "survey/depth_map.h"
#include "survey/plan.h"

namespace stucco::simulate {

// What takes pictures: the renderer, or what stands for it in a test.
struct Photographer {
  std::function<Radiance(const Camera&, const Pose&, const Light&, int threads)> photograph;
  std::function<DepthMap(const Camera&, const Pose&, int threads)> depth;
};

// A flight of which every photo is settled and none is taken.
struct PreparedFlight {
  Plan plan;
  PlacedPlan placed;
  Flight flight;            // scene and made_from are the caller's
  std::vector<Shot> shots;  // of flight.photos, by index
  std::vector<std::string> notes;
};

// Throws Error (kBadInput) when the plan is for another place and when more than one view in twenty
// is inside a building or below the ground; single ones are lost, with a note, and so are those in
// the crowns of trees.
PreparedFlight PrepareFlight(const Plan& plan, const SceneInfo& info, const SceneShape& scene,
                             const FlightOptions& options);

// Meters every photo that is taken by a small picture and settles exposures and white balances.
void MeterFlight(const Photographer& photographer, const FlightOptions& options, int threads,
                 PreparedFlight& prepared);

// What is particular to the picture of one photo: its noise and its motion.
SensorEffects EffectsOf(const PreparedFlight& prepared, size_t photo, const FlightOptions& options);

// What the drone believes and writes down: a position shifted by the flight's bias and by noise,
// gimbal angles with theirs.
PhotoMetadata MetadataOf(const PreparedFlight& prepared, size_t photo,
                         const FlightOptions& options);

}  // namespace stucco::simulate
