// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "report/facet_rows.h"
#include "report/pictures.h"
#include "report/survey_data.h"

namespace stucco {

// report.html: one page without a reference to anything outside it except links to the other files
// of the survey. `pictures` belong to the rows by index.
std::string ReportHtml(const SurveyData& data, const std::vector<FacetRow>& rows,
                       const std::vector<FacetPictures>& pictures, const ReportOptions& options);

}  // namespace stucco
