// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/page/evaluation_page.h"

#include "evaluate/page/internal/sections.h"
#include "survey/escape.h"
#include "survey/files.h"

namespace stucco::evaluate {
namespace internal {

std::string NotesSection(const Evaluation& evaluation) {
  if (evaluation.notes.empty()) return "";
  std::string html =
      "<section aria-labelledby=\"notes\"><h2 id=\"notes\">Notes</h2><ul class=\"files\">";
  for (const std::string& note : evaluation.notes) html += "<li>" + IsolatedHtml(note) + "</li>";
  return html + "</ul></section>";
}

std::string MeasuresSection(const Evaluation& evaluation) {
  if (evaluation.facades.empty() && evaluation.views.empty()) return "";
  return "<section aria-labelledby=\"measures\"><h2 id=\"measures\">What the figures mean</h2>"
         "<p>Every facade of the truth is drawn at right angles on the texels of the result, in "
         "the light of the middle of the flight. Both are compared where they overlap and the "
         "result was painted from photos. One gain per colour for the whole survey is taken off, "
         "because exposure and white balance cannot be known. Photos held out have one gain per "
         "photo and colour, and what their lens loses towards the corners is fitted.</p>"
         "<p>SSIM and MS-SSIM are 1 for equal pictures, PSNR is at most 100 dB, and GMSD, FLIP "
         "and LPIPS are 0. Shift is the median length of the optical flow from truth to result, "
         "in the texels that were compared. In the FLIP pictures black is no visible error, "
         "bright yellow the largest, and grey was not measured.</p></section>";
}

}  // namespace internal

namespace {

// The policy keeps the page from loading anything but the pictures beside it, whatever a name may
// hold.
constexpr char kHead[] =
    "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src 'self' "
    "file:; style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
    "<meta name=\"color-scheme\" content=\"light dark\">\n"
    "<title>Evaluation</title>\n<style>\n";

}  // namespace

std::string EvaluationHtml(const Evaluation& evaluation) {
  std::string html = kHead;
  html += internal::PageStyle();
  html +=
      "</style>\n</head>\n<body>\n<header class=\"page-head\"><h1>Evaluation</h1>"
      "<span class=\"quiet\">Stucco</span></header>\n<main>\n";
  for (const auto section :
       {internal::HeadlineSection, internal::NotesSection, internal::FacadesSection,
        internal::ViewsSection, internal::MeasuresSection}) {
    html += section(evaluation) + "\n";
  }
  html +=
      "</main>\n<dialog id=\"viewer\"><header><h3></h3><button type=\"button\" "
      "aria-label=\"Close\">"
      "✕</button></header><div class=\"side-by-side\"></div></dialog>\n<script>\n";
  html += internal::PageScript();
  html += "</script>\n</body>\n</html>\n";
  return html;
}

void WriteEvaluationPage(const Evaluation& evaluation, const std::filesystem::path& output) {
  WriteFileAtomically(output / "evaluation.html", EvaluationHtml(evaluation));
}

}  // namespace stucco::evaluate
