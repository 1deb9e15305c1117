// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/facet_rows.h"
#include "report/pictures.h"
#include "report/survey_data.h"

namespace stucco::internal {

// The page's content that the sections share.
struct PageContent {
  const SurveyData& data;
  const std::vector<FacetRow>& rows;
  const std::vector<FacetPictures>& pictures;  // by row
  const ReportOptions& options;
};

// Each returns one <section>, or nothing where it has nothing to say.
std::string AttentionSection(const PageContent& page);
std::string SummarySection(const PageContent& page);
std::string SiteMap(const PageContent& page);  // an <svg>, part of the summary
std::string FacadeTableSection(const PageContent& page);
std::string FacadeDialogs(const PageContent& page);
std::string BuildingsSection(const PageContent& page);
std::string PhotosSection(const PageContent& page);
std::string PlacementSection(const PageContent& page);  // how surely photos are placed
std::string CalibrationSection(const PageContent& page);
std::string GroundControlSection(const PageContent& page);
std::string VerdictRulesSection(const PageContent& page);
std::string FilesSection(const PageContent& page);
std::string StagesSection(const PageContent& page);

// "<span class=badge ...>" with a sign that does not need its colour to be read.
std::string VerdictBadge(Verdict verdict);
std::string VerdictLabel(Verdict verdict);  // "Good", "Check", "Poor", "Not rated"

// A number with its name: a cell of a row of figures. `value` and `note` are HTML.
std::string Figure(std::string_view name, std::string_view value, std::string_view note = {});

// Rows in the order of the table: the worst first, larger ones before smaller ones.
std::vector<size_t> WorstFirst(const std::vector<FacetRow>& rows);

}  // namespace stucco::internal
