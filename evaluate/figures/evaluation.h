// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace stucco::evaluate {

// A measure that could not be taken: the stage has no result. Written as null.
inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

struct PoseFigures {
  int posed = 0;
  int total = 0;
  double position_mean_m = kNotMeasured;  // after the best similarity
  double position_max_m = kNotMeasured;
  double rotation_mean_deg = kNotMeasured;
  double rotation_max_deg = kNotMeasured;
  // In the frames as they are, without any alignment.
  double georeferenced_mean_m = kNotMeasured;
  double georeferenced_max_m = kNotMeasured;
  double georeferenced_rotation_mean_deg = kNotMeasured;
  double georeferenced_rotation_max_deg = kNotMeasured;
};

struct SurfaceFigures {
  double error95_m = kNotMeasured;  // 95 % of the result lies nearer to the truth
  double seen95_m = kNotMeasured;   // 95 % of what photos show lies nearer to a surface
  // Share of the truth's area with the result nearby: of what the photos show, of what at least
  // three do, and of everything.
  double completeness = kNotMeasured;
  double completeness_of_three = kNotMeasured;
  double completeness_all = kNotMeasured;

  bool IsMeasured() const { return std::isfinite(error95_m) || std::isfinite(completeness); }
};

// Of everything near buildings, and of its parts: the buildings alone (walls, roofs and what stands
// out from them), and each class.
struct PartFigures {
  SurfaceFigures all, building, wall, roof, ground;
};

struct ProxyFigures {
  int buildings = 0;
  int watertight = 0;
  int manifold = 0;
  int self_intersecting = 0;
  int truth_buildings = 0;
  int facets = 0;
  int superstructure_facets = 0;  // of them, of what stands on roofs and the truth has not
  int truth_facets = 0;
  PartFigures surface;
  // Share of the truth's wall area whose facet has its id, or none where the plan has no such
  // facade.
  double facade_id_rate = kNotMeasured;
};

struct PictureFigures {
  double ssim = kNotMeasured;
  double ms_ssim = kNotMeasured;
  double psnr = kNotMeasured;
  double gmsd = kNotMeasured;
  double flip = kNotMeasured;
  double lpips = kNotMeasured;
};

// How like the truth a picture is, without what depends on its light as a whole.
struct Likeness {
  double ssim = kNotMeasured;
  double psnr = kNotMeasured;
  double shift_m = kNotMeasured;  // of the content
};

// Of some texels: the result's and that of ideal photos on the same ones, which is all that a
// texture can reach.
struct LikenessOfPart {
  double share = kNotMeasured;  // of the compared area
  Likeness result;
  Likeness ceiling;
};

// Of a wall's painted area what some photo shows freely, and what of that was painted from a photo
// in which something that is no part of the building stands before the wall.
struct OccludedArea {
  double free_m2 = 0;
  double through_m2 = 0;

  double Share() const { return free_m2 > 0 ? through_m2 / free_m2 : kNotMeasured; }
};

struct FacadeFigures {
  std::string id;     // of the truth
  std::string facet;  // of the result; empty: none
  double area_m2 = 0;
  double painted = 0;  // share of the truth's area that the result paints
  PictureFigures picture;
  double texel_m = kNotMeasured;  // at which both pictures were compared
  double misregistration_px = kNotMeasured;
  double ideal_distance_m = kNotMeasured;  // of the photos that make the ceiling
  Likeness ceiling = {};                   // of everything that is compared
  LikenessOfPart plane = {};               // on the wall's plane
  LikenessOfPart relief = {};              // what stands out or lies back, with its rim
  OccludedArea occluded = {};
  std::string truth_picture;  // for the page, relative to the output folder; may be empty
  std::string result_picture;
  std::string error_picture;  // FLIP's map
  std::string problem = {};   // why a picture of the result could not be read; mostly empty
};

struct HeldOutFigures {
  std::string photo;
  double compared = kNotMeasured;  // share of what the photo shows of buildings that the model has
  PictureFigures picture;
  std::string truth_picture;
  std::string result_picture;
  std::string error_picture;
  std::string problem = {};       // why the photo could not be read; mostly empty
  PictureFigures buildings = {};  // where the photo shows one
};

struct PlanFigures {
  std::string method;
  int photos = 0;
  int hovers = 0;
  double length_m = 0;
  double time_min = 0;
  double battery_percent = 0;
  double q_s = 0, q_d = 0, q_u = 0, q_c = 0;  // means over facades, by length
};

struct Evaluation {
  std::string survey;
  std::string scene;
  double tolerance_m = 0.1;  // of completeness
  PoseFigures poses;
  PartFigures dense, mesh;
  ProxyFigures proxy;
  // Of what is painted: `painted` says how much of the facades' area that is.
  double painted = kNotMeasured;
  PictureFigures texture_mean;
  double misregistration_px = kNotMeasured;  // median over facades, by area
  double misregistration_m = kNotMeasured;
  // Means by painted area, of shifts medians.
  Likeness ceiling_mean;
  LikenessOfPart plane_mean;
  LikenessOfPart relief_mean;
  OccludedArea occluded;  // of all facades
  std::vector<FacadeFigures> facades;
  double views_compared = kNotMeasured;  // mean of HeldOutFigures::compared
  PictureFigures views_mean;
  PictureFigures views_buildings_mean;
  std::vector<HeldOutFigures> views;
  bool has_plan = false;
  PlanFigures plan;
  std::vector<std::string> notes;  // what could not be measured and why
};

}  // namespace stucco::evaluate
