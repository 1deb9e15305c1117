// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/options.h"

namespace stucco {

void Describe(OptionTable& table, ReportOptions& options) {
  table.Add("coverage_amber_below", options.coverage_amber_below, 0, 1,
            "A facade is amber when a smaller share of its area is painted from photos.");
  table.Add("coverage_red_below", options.coverage_red_below, 0, 1,
            "A facade is red when a smaller share of its area is painted from photos.");
  table.Add("gsd_amber_above", options.gsd_amber_above, 1, 1000,
            "A facade is amber when a photo pixel on it is larger than this many times the "
            "survey's median.");
  table.Add("gsd_red_above", options.gsd_red_above, 1, 1000,
            "A facade is red when a photo pixel on it is larger than this many times the "
            "survey's median.");
  table.Add("inpainted_amber_above", options.inpainted_amber_above, 0, 1,
            "A facade is amber when a larger share of its area was filled in without a photo.");
  table.Add("inpainted_red_above", options.inpainted_red_above, 0, 1,
            "A facade is red when a larger share of its area was filled in without a photo.");
  table.Add("inferred_amber_above", options.inferred_amber_above, 0, 1,
            "A facade is amber when a larger share of its area has no measured points.");
  table.Add("inferred_red_above", options.inferred_red_above, 0, 1,
            "A facade is red when a larger share of its area has no measured points.");
  table.Add("misregistration_amber_above", options.misregistration_amber_above, 0, 1000,
            "A facade is amber when overlapping photos disagree by more texels (median).");
  table.Add("misregistration_red_above", options.misregistration_red_above, 0, 1000,
            "A facade is red when overlapping photos disagree by more texels (median).");
  table.Add("least_area_m2", options.least_area_m2, 0, 10000,
            "Facets of which less can be seen have no verdict, unless the plan has them: steps of "
            "roofs, walls that a neighbour or the ground hides. Square metres.");
  table.Add("picture_px", options.picture_px, 100, 4000,
            "Longer side in pixels of the facade pictures in the page.");
  table.Add("record_times", options.record_times,
            "Write times and memory of the stages into the report; its bytes then differ between "
            "runs.");
}

}  // namespace stucco
