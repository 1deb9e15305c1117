// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/report_html.h"

#include "report/internal/html_sections.h"
#include "report/internal/page_frame.h"

namespace stucco {
std::string ReportHtml(const SurveyData& data, const std::vector<FacetRow>& rows,
                       const std::vector<FacetPictures>& pictures, const ReportOptions& options) {
  const internal::PageContent page{data, rows, pictures, options};
  std::string html = internal::PageBegin("Facade report");
  for (const auto section :
       {internal::AttentionSection, internal::SummarySection, internal::FacadeTableSection,
        internal::BuildingsSection, internal::PhotosSection, internal::PlacementSection,
        internal::CalibrationSection, internal::GroundControlSection, internal::VerdictRulesSection,
        internal::FilesSection, internal::StagesSection, internal::FacadeDialogs}) {
    html += section(page) + "\n";
  }
  return html + internal::PageEnd();
}

}  // namespace stucco
