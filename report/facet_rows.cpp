// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/facet_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "report/planned_photos.h"
#include "survey/facet_picture.h"
#include "survey/median.h"
#include "survey/numbers.h"

namespace stucco {
namespace {

// A picture whose texels are this much larger than its photos' shows visibly less than they do.
constexpr double kCoarseAbove = 1.25;

// A measure that is bad when it is high, or, with `low_is_bad`, when it is low.
struct Limit {
  double amber = 0;
  double red = 0;
  bool low_is_bad = false;

  // Written so that a value that is not a number is red.
  Verdict Judge(double value) const {
    const double sign = low_is_bad ? -1 : 1;
    if (!(sign * value <= sign * red)) return Verdict::kRed;
    if (!(sign * value <= sign * amber)) return Verdict::kAmber;
    return Verdict::kGreen;
  }
  double Passed(Verdict verdict) const { return verdict == Verdict::kRed ? red : amber; }
};

VisibleShares SharesOf(const FacetRow& row) {
  const double party = row.facet != nullptr ? row.facet->party : 0;
  const double visible = std::max(1e-9, 1 - party);
  VisibleShares shares;
  if (row.texture != nullptr) {
    shares.painted = std::clamp(row.texture->painted / visible, 0.0, 1.0);
    shares.inpainted = std::clamp((row.texture->inpainted - party) / visible, 0.0, 1.0);
  }
  if (row.facet != nullptr) {
    shares.inferred = std::clamp((row.facet->inferred - party) / visible, 0.0, 1.0);
  }
  return shares;
}

class Judge {
 public:
  Judge(const ReportOptions& options, bool metric) : options_(options), metric_(metric) {}

  void Fill(FacetRow& row) const {
    if (const std::string why = WhyExempt(row); !why.empty()) {
      row.exempt = true;
      row.findings = {{Verdict::kUnknown, why}};
      return;
    }
    if (row.texture_outdated) {
      row.findings = {{Verdict::kUnknown, "its picture is of an older model; texture it again"}};
      return;
    }
    if (!row.IsPainted()) {
      row.findings.push_back({Verdict::kRed, "no photo paints it"});
    } else {
      JudgeTexture(row);
    }
    if (row.facet != nullptr) {
      const Limit limit{options_.inferred_amber_above, options_.inferred_red_above};
      Add(row, limit, row.shares.inferred, [](double value, double bound) {
        return fmt::format("{} without measured points (limit {})", Percent(value), Percent(bound));
      });
    }
    std::stable_sort(row.findings.begin(), row.findings.end(),
                     [](const Finding& a, const Finding& b) { return a.verdict > b.verdict; });
    row.verdict = row.findings.empty() ? Verdict::kGreen : row.findings.front().verdict;
  }

 private:
  void JudgeTexture(FacetRow& row) const {
    const TexturedFacet& texture = *row.texture;
    Add(row, {options_.coverage_amber_below, options_.coverage_red_below, /*low_is_bad=*/true},
        row.shares.painted, [](double value, double bound) {
          return fmt::format("{} painted from photos (limit {})", Percent(value), Percent(bound));
        });
    if (row.gsd_ratio > 0) {
      Add(row, {options_.gsd_amber_above, options_.gsd_red_above}, row.gsd_ratio,
          [](double value, double bound) {
            return fmt::format("photo pixels {:.1f} times as large as usual here (limit {:g})",
                               value, bound);
          });
    }
    Add(row, {options_.inpainted_amber_above, options_.inpainted_red_above}, row.shares.inpainted,
        [](double value, double bound) {
          return fmt::format("{} filled in without a photo (limit {})", Percent(value),
                             Percent(bound));
        });
    const double coarser = texture.metres_per_texel / texture.wanted_metres_per_texel;
    if (texture.wanted_metres_per_texel > 0 && coarser > kCoarseAbove) {
      row.findings.push_back(
          {Verdict::kAmber, fmt::format("picture {:.1f} times coarser than the photos: raise "
                                        "texture.max_texture_px",
                                        coarser)});
    }
    if (texture.misregistration_px >= 0) {
      Add(row, {options_.misregistration_amber_above, options_.misregistration_red_above},
          texture.misregistration_px, [](double value, double bound) {
            return fmt::format("photos disagree by {:.1f} texels (limit {:g})", value, bound);
          });
    }
  }

  // A wall that a neighbour or the ground hides, or a piece too small to measure, such as a step
  // between roofs. Facades of the plan have a verdict however little of them there is, unless
  // nearly all of it is hidden: shares of so small a rest are mostly rounding.
  std::string WhyExempt(const FacetRow& row) const {
    constexpr double kHidden = 0.95;
    if (row.facet == nullptr) return "";
    const double party = row.facet->party;
    if (party > kHidden) {
      return fmt::format("not rated: a neighbour or the ground hides {} of it", Percent(party));
    }
    const double visible = row.facet->area * (1 - party);
    if (!metric_ || row.planned != nullptr || visible >= options_.least_area_m2) return "";
    return fmt::format("not rated: {} of it can be seen", Area(visible, metric_));
  }

  template <typename Text>
  static void Add(FacetRow& row, const Limit& limit, double value, Text text) {
    const Verdict verdict = limit.Judge(value);
    if (verdict == Verdict::kGreen) return;
    row.findings.push_back({verdict, text(value, limit.Passed(verdict))});
  }

  const ReportOptions& options_;
  bool metric_;
};

// Whether the textures may be of another model than the proxy: texturing was not finished since.
bool TexturesMayBeOld(const SurveyData& data) {
  return data.proxy && std::any_of(data.statuses.begin(), data.statuses.end(), [](const auto& s) {
           return s.stage == "texture" && s.state != "done";
         });
}

// The picture of a facet, or a note that the one of this id is of another model.
void Join(const TexturedFacet& texture, bool may_be_old, FacetRow& row) {
  const bool has_picture = !texture.image.empty();
  row.texture_outdated = may_be_old && !(has_picture && FitsFacet(texture, *row.facet));
  if (!row.texture_outdated) row.texture = &texture;
}

using TexturesById = std::map<std::string, const TexturedFacet*>;

// The row of a facet of the model; its picture leaves `texture_by_id`.
FacetRow RowOf(const Building& building, const Facet& facet, bool may_be_old,
               TexturesById& texture_by_id) {
  FacetRow row;
  row.id = facet.id;
  row.building = building.id;
  row.facet = &facet;
  row.facet_class = facet.facet_class;
  const auto found = texture_by_id.find(facet.id);
  if (found == texture_by_id.end()) {
    row.texture_outdated = may_be_old;
    return row;
  }
  Join(*found->second, may_be_old, row);
  texture_by_id.erase(found);
  return row;
}

std::vector<FacetRow> ListFacets(const SurveyData& data) {
  TexturesById texture_by_id;
  if (data.textures) {
    for (const TexturedFacet& texture : data.textures->facets) {
      texture_by_id.emplace(texture.id, &texture);
    }
  }
  const bool may_be_old = TexturesMayBeOld(data);
  std::vector<FacetRow> rows;
  if (data.proxy) {
    for (const Building& building : data.proxy->buildings) {
      for (const Facet& facet : building.facets) {
        rows.push_back(RowOf(building, facet, may_be_old, texture_by_id));
      }
    }
  }
  if (!data.textures || may_be_old) return rows;
  for (const TexturedFacet& texture : data.textures->facets) {
    if (texture_by_id.erase(texture.id) == 0) continue;
    FacetRow row;
    row.id = texture.id;
    row.building = texture.id.substr(0, texture.id.find('/'));
    row.texture = &texture;
    rows.push_back(std::move(row));
  }
  return rows;
}

void JoinPlan(const SurveyData& data, std::vector<FacetRow>& rows) {
  if (!data.plan) return;
  const LostViews lost = FindLostViews(data);
  std::map<std::string, const PlannedFacade*> facades;
  for (const PlannedFacade& facade : data.plan->facades) facades[facade.id] = &facade;
  for (FacetRow& row : rows) {
    if (row.facet == nullptr || row.facet->planned_facades.empty()) continue;
    const auto found = facades.find(row.facet->planned_facades.front());
    if (found == facades.end()) continue;
    row.planned = found->second;
    row.lost_views = LostViewsText(*row.planned, lost);
  }
}

}  // namespace

std::string Name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kGreen:
      return "green";
    case Verdict::kAmber:
      return "amber";
    case Verdict::kRed:
      return "red";
    case Verdict::kUnknown:
      break;
  }
  return "unknown";
}

std::string ClassLabel(FacetClass facet_class) {
  switch (facet_class) {
    case FacetClass::kWall:
      return "Wall";
    case FacetClass::kRoof:
      return "Roof";
    case FacetClass::kGround:
      return "Ground";
    case FacetClass::kOuterFloor:
      break;
  }
  return "Overhang";
}

std::optional<double> MedianGsd(const SurveyData& data) {
  std::vector<double> sizes;
  if (data.textures) {
    for (const TexturedFacet& texture : data.textures->facets) {
      if (texture.gsd_m > 0 && !texture.image.empty()) sizes.push_back(texture.gsd_m);
    }
  }
  return Median(std::move(sizes));
}

std::vector<FacetRow> MakeFacetRows(const SurveyData& data, const ReportOptions& options) {
  std::vector<FacetRow> rows = ListFacets(data);
  JoinPlan(data, rows);
  for (FacetRow& row : rows) row.shares = SharesOf(row);
  if (!data.textures) return rows;
  const double median = MedianGsd(data).value_or(0);
  const Judge judge(options, data.metric);
  for (FacetRow& row : rows) {
    if (row.texture != nullptr && median > 0) row.gsd_ratio = row.texture->gsd_m / median;
    judge.Fill(row);
  }
  return rows;
}

std::vector<FacetRow> RowsForPage(const std::vector<FacetRow>& rows) {
  constexpr int kMostGround = 12;  // facets are listed by falling area
  std::vector<FacetRow> shown;
  int ground = 0;
  for (const FacetRow& row : rows) {
    const bool is_ground = row.facet_class == FacetClass::kGround && row.building == "G0";
    if (!is_ground || ground++ < kMostGround) shown.push_back(row);
  }
  return shown;
}

std::vector<std::string> MissingFacades(const SurveyData& data, const std::vector<FacetRow>& rows) {
  std::vector<std::string> missing;
  if (!data.plan) return missing;
  std::set<std::string> found;
  for (const FacetRow& row : rows) {
    if (row.planned == nullptr) continue;
    found.insert(row.facet->planned_facades.begin(), row.facet->planned_facades.end());
  }
  for (const PlannedFacade& facade : data.plan->facades) {
    if (!found.contains(facade.id)) missing.push_back(facade.id);
  }
  return missing;
}

VerdictCounts CountVerdicts(const std::vector<FacetRow>& rows, bool walls_only) {
  VerdictCounts counts;
  for (const FacetRow& row : rows) {
    if (walls_only && row.facet_class != FacetClass::kWall) continue;
    if (row.exempt) {
      ++counts.exempt;
      continue;
    }
    switch (row.verdict) {
      case Verdict::kGreen:
        ++counts.green;
        break;
      case Verdict::kAmber:
        ++counts.amber;
        break;
      case Verdict::kRed:
        ++counts.red;
        break;
      case Verdict::kUnknown:
        ++counts.unknown;
        break;
    }
  }
  return counts;
}

}  // namespace stucco
