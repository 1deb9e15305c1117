// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/options.h"
#include "report/survey_data.h"

namespace stucco {

enum class Verdict { kGreen, kAmber, kRed, kUnknown };

std::string Name(Verdict verdict);  // "green", "amber", "red", "unknown"

// The shares of a facet's area that its verdict is made of: of what of it can be seen, which is all
// but what another building or the ground hides (Facet::party).
struct VisibleShares {
  double painted = 0;
  double inpainted = 0;
  double inferred = 0;
};

// One measure held against its limits.
struct Finding {
  Verdict verdict = Verdict::kGreen;
  std::string text;  // "54 % painted from photos (red below 60 %)"
};

// A facet of the proxy with all that is known about it.
struct FacetRow {
  std::string id;
  std::string building;
  const Facet* facet = nullptr;            // nullptr: only textured
  const TexturedFacet* texture = nullptr;  // nullptr: not textured
  const PlannedFacade* planned = nullptr;  // that it is a part of; nullptr: none, or no plan
  bool texture_outdated = false;           // there is a picture, but of an older model
  FacetClass facet_class = FacetClass::kWall;
  double gsd_ratio = 0;  // size of a photo pixel on it over the survey's median; 0: not known
  VisibleShares shares;  // 0 where they are not known
  bool exempt = false;   // nothing of it to speak of can be seen, so it has no verdict
  Verdict verdict = Verdict::kUnknown;
  std::vector<Finding> findings;  // amber and red ones, worst first
  std::string lost_views;         // which of its planned photos cannot serve, and why; may be empty

  // For people: the plan's id of the facade, which its parts share, else its own.
  const std::string& Name() const { return planned != nullptr ? planned->id : id; }
  bool IsPainted() const { return texture != nullptr && !texture->image.empty(); }
};

// A row per facet in the order of the proxy, then of the textures; the rows point into `data`.
// Verdicts are kUnknown as long as there are no textures. Facets have the pictures of their id;
// where texturing has not been finished since the proxy, only those that still fit.
std::vector<FacetRow> MakeFacetRows(const SurveyData& data, const ReportOptions& options);

// The rows that a page shows: all but the smaller ones of many pieces of ground, as hills are made
// of.
std::vector<FacetRow> RowsForPage(const std::vector<FacetRow>& rows);

// The plan's facades that no row is a part of, in its order; none without a plan.
std::vector<std::string> MissingFacades(const SurveyData& data, const std::vector<FacetRow>& rows);

// "Wall", "Roof", ... for people.
std::string ClassLabel(FacetClass facet_class);

struct VerdictCounts {
  int green = 0;
  int amber = 0;
  int red = 0;
  int unknown = 0;
  int exempt = 0;
  int Total() const { return green + amber + red + unknown; }  // without the exempt
};

VerdictCounts CountVerdicts(const std::vector<FacetRow>& rows, bool walls_only);

// Median size of a photo pixel over the painted facets, world units; nothing without any.
std::optional<double> MedianGsd(const SurveyData& data);

}  // namespace stucco
