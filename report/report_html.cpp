// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/report_html.h"

#include "report/internal/html_sections.h"
#include "report/internal/web_assets.h"

namespace stucco {
namespace {

// The policy keeps the page from loading anything, whatever a file name may hold.
constexpr char kHead[] =
    "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
    "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
    "<meta name=\"color-scheme\" content=\"light dark\">\n"
    "<title>Facade report</title>\n<style>\n";

}  // namespace

std::string ReportHtml(const SurveyData& data, const std::vector<FacetRow>& rows,
                       const std::vector<FacetPictures>& pictures, const ReportOptions& options) {
  const internal::PageContent page{data, rows, pictures, options};
  std::string html = kHead;
  html += internal::PageStyle();
  html +=
      "</style>\n<noscript><style>dialog.facade{display:block;position:static}</style>"
      "</noscript>\n</head>\n<body>\n<header class=\"page-head\"><h1>Facade report</h1>"
      "<span class=\"quiet\">Stucco</span></header>\n<main>\n";
  for (const auto section :
       {internal::AttentionSection, internal::SummarySection, internal::FacadeTableSection,
        internal::PhotosSection, internal::PlacementSection, internal::CalibrationSection,
        internal::GroundControlSection, internal::VerdictRulesSection, internal::FilesSection,
        internal::StagesSection, internal::FacadeDialogs}) {
    html += section(page) + "\n";
  }
  html += "</main>\n<script>\n";
  html += internal::PageScript();
  html += "</script>\n</body>\n</html>\n";
  return html;
}

}  // namespace stucco
