// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "report/facet_rows.h"
#include "report/survey_data.h"

namespace stucco {

// report.json; its names are fixed (docs/formats.md) and "version" counts changes of meaning.
// Values that are not known are null.
std::string ReportJson(const SurveyData& data, const std::vector<FacetRow>& rows,
                       const ReportOptions& options);

// facades.csv: RFC 4180, a header line, one line per facade, shares in [0, 1], lengths in the unit
// that the column `unit` names.
std::string FacadesCsv(const SurveyData& data, const std::vector<FacetRow>& rows);

}  // namespace stucco
