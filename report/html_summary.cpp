// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "report/internal/html_sections.h"
#include "survey/escape.h"
#include "survey/numbers.h"

namespace stucco::internal {
namespace {

std::string StateText(const Attention& item) {
  if (item.state == "failed") return "failed";
  if (item.state == "damaged") return "has a damaged result";
  if (item.state == "stale") return "is out of date";
  return "has no result";
}

std::string AttentionItem(const Attention& item) {
  std::string html =
      fmt::format("<li><strong>{} {}</strong>", IsolatedHtml(item.stage), StateText(item));
  if (!item.why.empty()) {
    html += fmt::format(": <span class=\"pre\">{}</span>", EscapeHtml(item.why));
  }
  if (!item.remedy.empty()) {
    html += fmt::format("<br>What to do: <span class=\"pre\">{}</span>", EscapeHtml(item.remedy));
  }
  return html + "</li>";
}

// Stages without a result share a line; the table of stages says more.
std::string AttentionItems(const std::vector<Attention>& items) {
  std::string html;
  std::string not_run;
  for (const Attention& item : items) {
    if (item.state == "missing") {
      not_run += (not_run.empty() ? "" : ", ") + IsolatedHtml(item.stage);
    } else {
      html += AttentionItem(item);
    }
  }
  if (!not_run.empty()) html += "<li><strong>Not run yet:</strong> " + not_run + "</li>";
  return "<ul>" + html + "</ul>";
}

// "7 of 12 facades are good."
std::string Headline(const PageContent& page, const VerdictCounts& counts) {
  if (page.rows.empty()) return "There are no facades yet.";
  if (!page.data.textures) return "The facades are found, but not painted yet.";
  if (counts.Total() == 0 && counts.exempt > 0) {
    return "No wall shows enough to be rated; all facets are in the table.";
  }
  if (counts.Total() == 0) return "No wall was found; roofs and ground are in the table.";
  if (counts.green == counts.Total()) {
    return counts.Total() == 1 ? "The one facade is good." : "All facades are good.";
  }
  if (counts.green == 0) return "No facade is good enough yet.";
  return fmt::format("{} of {} facades {} good.", counts.green, counts.Total(),
                     counts.green == 1 ? "is" : "are");
}

std::string Subline(const PageContent& page) {
  std::vector<std::string> parts;
  if (page.data.calibration) {
    parts.push_back(fmt::format("{} of {} photos posed", page.data.calibration->photos_posed,
                                page.data.calibration->photos_total));
    parts.push_back("reprojection error " +
                    Decimal(page.data.calibration->reprojection_error_px, 2) + " px");
  } else if (page.data.captures) {
    parts.push_back(Count(static_cast<int>(page.data.captures->photos.size()), "photo", "photos"));
  }
  if (const auto gsd = MedianGsd(page.data)) {
    parts.push_back("photo pixels of " + PixelSize(*gsd, page.data.metric) + " on the facades");
  }
  if (page.data.georef || page.data.proxy) {
    parts.push_back(page.data.metric ? "lengths in metres"
                                     : "lengths in units: nothing fixes the scale");
  }
  std::string line;
  for (const std::string& part : parts) line += (line.empty() ? "" : " · ") + part;
  return EscapeHtml(line);
}

std::string Tile(Verdict verdict, int count) {
  return fmt::format(
      "<button type=\"button\" class=\"tile {0}\" data-verdict=\"{0}\" aria-pressed=\"false\">"
      "<span class=\"tile-count\">{1}</span><span class=\"tile-name\">{2}</span></button>",
      Name(verdict), count, VerdictLabel(verdict));
}

std::string Bar(const VerdictCounts& counts) {
  const std::pair<const char*, int> parts[] = {{"green", counts.green},
                                               {"amber", counts.amber},
                                               {"red", counts.red},
                                               {"unknown", counts.unknown}};
  std::string html = "<div class=\"bar\" aria-hidden=\"true\">";
  for (const auto& [name, count] : parts) {
    if (count > 0) html += fmt::format("<span class=\"{}\" style=\"flex:{}\"></span>", name, count);
  }
  return html + "</div>";
}

// The worst facades in words, so that the first screen says what to do first.
std::string WorstList(const PageContent& page) {
  constexpr size_t kMost = 4;
  std::string items;
  size_t listed = 0;
  for (const size_t i : WorstFirst(page.rows)) {
    const FacetRow& row = page.rows[i];
    const bool listable =
        row.facet_class == FacetClass::kWall && !row.exempt && !row.findings.empty();
    if (!listable || listed == kMost) continue;
    ++listed;
    items += fmt::format(
        "<li>{}<span><button type=\"button\" class=\"link\" data-open=\"{}\">{}</button> "
        "<span class=\"quiet\">{}</span></span></li>",
        VerdictBadge(row.verdict), i, IsolatedHtml(row.Name()),
        EscapeHtml(row.findings.front().text));
  }
  if (items.empty()) return "";
  return "<h3>Look at these first</h3><ul class=\"worst\">" + items + "</ul>";
}

}  // namespace

std::string VerdictLabel(Verdict verdict) {
  switch (verdict) {
    case Verdict::kGreen:
      return "Good";
    case Verdict::kAmber:
      return "Check";
    case Verdict::kRed:
      return "Poor";
    case Verdict::kUnknown:
      break;
  }
  return "Not rated";
}

std::string VerdictBadge(Verdict verdict) {
  return fmt::format("<span class=\"badge {}\">{}</span>", Name(verdict), VerdictLabel(verdict));
}

std::string Figure(std::string_view name, std::string_view value, std::string_view note) {
  std::string html = fmt::format("<div class=\"figure\"><dt>{}</dt><dd>{}", name, value);
  if (!note.empty()) html += fmt::format("<span class=\"note\">{}</span>", note);
  return html + "</dd></div>";
}

std::vector<size_t> WorstFirst(const std::vector<FacetRow>& rows) {
  const auto badness = [](const FacetRow& row) {
    if (row.exempt) return -1;
    switch (row.verdict) {
      case Verdict::kRed:
        return 3;
      case Verdict::kAmber:
        return 2;
      case Verdict::kUnknown:
        return 1;
      case Verdict::kGreen:
        break;
    }
    return 0;
  };
  const auto area = [](const FacetRow& row) { return row.facet != nullptr ? row.facet->area : 0; };
  std::vector<size_t> order(rows.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    const int difference = badness(rows[a]) - badness(rows[b]);
    return difference != 0 ? difference > 0 : area(rows[a]) > area(rows[b]);
  });
  return order;
}

std::string AttentionSection(const PageContent& page) {
  const auto items = FindAttention(page.data);
  if (items.empty()) return "";
  const bool failed = std::any_of(items.begin(), items.end(), [](const Attention& item) {
    return item.state == "failed" || item.state == "damaged";
  });
  std::string html = fmt::format(
      "<section class=\"attention{}\" aria-labelledby=\"attention\"><h2 id=\"attention\">{}</h2>",
      failed ? " failed" : "",
      failed ? "Processing stopped; this report shows what there is"
             : "Processing is not complete; this report shows what there is");
  html += AttentionItems(items);
  html += fmt::format(
      "<p>Next command: <code>{}</code><br><span class=\"quiet\">SURVEY is the folder of this "
      "survey; what is done already is not computed again.</span></p></section>",
      EscapeHtml(items.front().command));
  return html;
}

std::string SummarySection(const PageContent& page) {
  const VerdictCounts counts = CountVerdicts(page.rows, /*walls_only=*/true);
  std::string html = fmt::format(
      "<section class=\"summary\" aria-labelledby=\"headline\"><div class=\"answer\">"
      "<h2 id=\"headline\">{}</h2><p class=\"quiet\">{}</p>",
      Headline(page, counts), Subline(page));
  if (!page.rows.empty()) {
    html += "<div class=\"tiles\" role=\"group\" aria-label=\"Show only facades with a verdict\">";
    html += Tile(Verdict::kGreen, counts.green) + Tile(Verdict::kAmber, counts.amber) +
            Tile(Verdict::kRed, counts.red);
    const int not_rated = counts.unknown + counts.exempt;
    if (not_rated > 0) html += Tile(Verdict::kUnknown, not_rated);
    html += "</div>" + Bar(counts) + WorstList(page);
  }
  return html + "</div>" + SiteMap(page) + "</section>";
}

}  // namespace stucco::internal
