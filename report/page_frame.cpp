// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/internal/page_frame.h"

#include <fmt/format.h>

#include "report/internal/web_assets.h"
#include "survey/escape.h"

namespace stucco::internal {
namespace {

// The policy keeps the page from loading anything, whatever a file name may hold.
constexpr char kHead[] =
    "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
    "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
    "<meta name=\"color-scheme\" content=\"light dark\">\n";

}  // namespace

std::string PageBegin(std::string_view title) {
  const std::string text = EscapeHtml(title);
  std::string html = kHead;
  html += fmt::format("<title>{}</title>\n<style>\n", text);
  html += PageStyle();
  html +=
      "</style>\n<noscript><style>dialog.facade{display:block;position:static}</style>"
      "</noscript>\n</head>\n<body>\n";
  return html + fmt::format(
                    "<header class=\"page-head\"><h1>{}</h1>"
                    "<span class=\"quiet\">Stucco</span></header>\n<main>\n",
                    text);
}

std::string PageEnd() {
  std::string html = "</main>\n<script>\n";
  html += PageScript();
  return html + "</script>\n</body>\n</html>\n";
}

}  // namespace stucco::internal
