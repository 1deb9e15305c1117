// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "report/internal/html_sections.h"
#include "survey/escape.h"
#include "survey/numbers.h"

namespace stucco::internal {
namespace {

std::string Rule(const char* measure, const std::string& amber, const std::string& red,
                 const char* option) {
  return fmt::format(
      "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td>"
      "<td><code>report.{}</code></td></tr>",
      measure, amber, red, option);
}

std::string FileItem(const std::string& path, const char* what) {
  return fmt::format("<li><a href=\"../{}\">{}</a> <span class=\"quiet\">{}</span></li>",
                     UrlPath(path), EscapeHtml(path), what);
}

std::string TimeCells(const StageStatus& status) {
  const std::string memory =
      status.peak_memory_mb >= 0 ? fmt::format("{:.0f} MiB", status.peak_memory_mb) : "-";
  return fmt::format("<td class=\"num\">{}</td><td class=\"num\">{}</td><td class=\"num\">{}</td>",
                     Duration(status.wall_s), Duration(status.cpu_s), memory);
}

const char* StateSign(const std::string& state) {
  if (state == "done") return "green";
  if (state == "failed") return "red";
  if (state == "stale") return "amber";
  return "unknown";
}

}  // namespace

std::string VerdictRulesSection(const PageContent& page) {
  if (page.rows.empty()) return "";
  const ReportOptions& o = page.options;
  const auto below = [](double share) { return "below " + Percent(share); };
  const auto above = [](double share) { return "above " + Percent(share); };
  const auto times = [](double ratio) { return fmt::format("above {:g} times", ratio); };
  const auto texels = [](double count) { return fmt::format("above {:g} texels", count); };
  return "<section aria-labelledby=\"rules\"><h2 id=\"rules\">How the verdicts are made</h2>"
         "<p>A facade has the worst colour of its measures, which are of what of it can be seen: "
         "walls that a neighbour or the ground hides and pieces too small to measure are not "
         "rated. "
         "The limits are settings of the survey; "
         "change them in survey.toml and run <code>stucco report SURVEY</code>.</p>"
         "<div class=\"scroll\"><table class=\"plain\"><thead><tr><th scope=\"col\">Measure</th>"
         "<th scope=\"col\">" +
         VerdictBadge(Verdict::kAmber) + "</th><th scope=\"col\">" + VerdictBadge(Verdict::kRed) +
         "</th><th scope=\"col\">Settings</th></tr></thead><tbody>" +
         Rule("Share of the area painted from photos", below(o.coverage_amber_below),
              below(o.coverage_red_below), "coverage_*") +
         Rule("Size of a photo pixel over the survey's median", times(o.gsd_amber_above),
              times(o.gsd_red_above), "gsd_*") +
         Rule("Share filled in without a photo", above(o.inpainted_amber_above),
              above(o.inpainted_red_above), "inpainted_*") +
         Rule("Share without measured points: the surface is inferred",
              above(o.inferred_amber_above), above(o.inferred_red_above), "inferred_*") +
         Rule("Shift between overlapping photos (median)", texels(o.misregistration_amber_above),
              texels(o.misregistration_red_above), "misregistration_*") +
         "<tr><th scope=\"row\">Painted at all</th><td></td><td>no photo</td><td></td></tr>" +
         "</tbody></table></div></section>";
}

std::string FilesSection(const PageContent& page) {
  std::string items;
  if (page.data.textures) {
    const TextureSet& textures = *page.data.textures;
    if (!textures.model_glb.empty()) {
      items += FileItem("texture/" + textures.model_glb, "the textured model for viewers");
    }
    if (!textures.model_obj.empty()) {
      items += FileItem("texture/" + textures.model_obj, "the same for modelling programs");
    }
  }
  if (page.data.captures) {
    items += FileItem("ingest/contact-sheet.jpg", "all photos at a glance");
  }
  items +=
      "<li><a href=\"report.json\">report/report.json</a> <span class=\"quiet\">everything on "
      "this page for programs</span></li><li><a href=\"facades.csv\">report/facades.csv</a> "
      "<span class=\"quiet\">the table for spreadsheets</span></li>";
  return "<section aria-labelledby=\"files\"><h2 id=\"files\">Files of this survey</h2>"
         "<ul class=\"files\">" +
         items + "</ul></section>";
}

std::string StagesSection(const PageContent& page) {
  const bool times = page.options.record_times;
  std::string html =
      "<section aria-labelledby=\"stages\"><h2 id=\"stages\">Processing</h2><div class=\"scroll\">"
      "<table class=\"plain\"><thead><tr><th scope=\"col\">Stage</th><th scope=\"col\">State</th>";
  if (times) {
    html +=
        "<th scope=\"col\" class=\"num\">Time</th><th scope=\"col\" class=\"num\">CPU time</th>"
        "<th scope=\"col\" class=\"num\">Memory</th>";
  }
  html += "<th scope=\"col\"></th></tr></thead><tbody>";
  for (const StageStatus& status : page.data.statuses) {
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td><span class=\"badge {}\">{}</span></td>{}<td>{}</td>"
        "</tr>",
        IsolatedHtml(status.stage), StateSign(status.state), EscapeHtml(status.state),
        times ? TimeCells(status) : "", EscapeHtml(status.why));
  }
  return html + "</tbody></table></div></section>";
}

}  // namespace stucco::internal
