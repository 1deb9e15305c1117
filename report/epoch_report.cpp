// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/epoch_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "report/internal/html_sections.h"
#include "report/internal/page_frame.h"
#include "report/pictures.h"
#include "survey/escape.h"
#include "survey/files.h"
#include "survey/numbers.h"
#include "survey/parallel.h"
#include "survey/proxy.h"
#include "survey/survey_folder.h"
#include "survey/texture_set.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using internal::Figure;

constexpr int kPicture_px = 720;
constexpr int kPlace_px = 480;
// Changes on less of a facet than this are not worth a line: a window that mirrors another sky.
constexpr double kWorthNaming = 0.01;

// A facet of the epoch with all that the page says of it.
struct Row {
  const EpochFacet* found = nullptr;
  const Facet* facet = nullptr;
  EmbeddedPicture before;
  EmbeddedPicture after;  // empty: as before
  std::string problem;
  std::vector<std::pair<EmbeddedPicture, EmbeddedPicture>> places;  // that changed, before and now
};

struct Page {
  const Epoch& epoch;
  bool metric = false;
  std::vector<Row> rows = {};  // in the order of `epoch`
};

std::string NameOf(const Row& row) {
  const std::string& id = row.found->id;
  if (row.facet == nullptr || FacadeName(*row.facet) == id) return IsolatedHtml(id);
  return fmt::format("{} <span class=\"quiet\">{}</span>", IsolatedHtml(FacadeName(*row.facet)),
                     IsolatedHtml(id));
}

bool HasChanged(const EpochFacet& found) {
  return found.repainted + found.other >= kWorthNaming;
}

// What became of it: kept pictures are as good as they were.
std::string ChoiceBadge(FacetChoice choice) {
  const char* colour = choice == FacetChoice::kKept ? "unknown" : "green";
  return fmt::format("<span class=\"badge {}\">{}</span>", colour, Name(choice));
}

std::string Changes(const Row& row, bool metric) {
  std::string text;
  const auto add = [&](double share, const char* what) {
    if (share < kWorthNaming) return;
    if (!text.empty()) text += ", ";
    text += fmt::format("{} of it {}", Percent(share), what);
    if (row.facet != nullptr) text += fmt::format(" ({})", Area(share * row.facet->area, metric));
  };
  add(row.found->repainted, "in another colour");
  add(row.found->other, "with another pattern");
  return text;
}

int CountOf(const Epoch& epoch, FacetChoice choice) {
  return static_cast<int>(std::ranges::count(epoch.facets, choice, &EpochFacet::choice));
}

std::string SummarySection(const Page& page) {
  const Epoch& epoch = page.epoch;
  const int placed =
      static_cast<int>(std::ranges::count(epoch.photos, true, &EpochPhoto::is_placed));
  const int changed = static_cast<int>(std::ranges::count_if(epoch.facets, HasChanged));
  const auto count = [&](FacetChoice choice) { return fmt::format("{}", CountOf(epoch, choice)); };
  return fmt::format(
      "<section aria-labelledby=\"headline\"><h2 id=\"headline\">{}</h2><dl class=\"measures\">"
      "{}{}{}{}{}</dl><p class=\"quiet\">Pictures that are kept have the bytes that they had; "
      "the survey itself is as it was.</p></section>\n",
      changed == 0 ? "Nothing that these photos show has changed"
                   : Count(changed, "surface has", "surfaces have") + " changed",
      Figure("Photos placed", fmt::format("{} of {}", placed, epoch.photos.size())),
      Figure("Replaced", count(FacetChoice::kReplaced)),
      Figure("Filled", count(FacetChoice::kFilled), "only what no photo had shown"),
      Figure("Painted", count(FacetChoice::kPainted), "for the first time"),
      Figure("Kept", count(FacetChoice::kKept)));
}

std::string PictureFigure(const EmbeddedPicture& picture, std::string_view id, const char* when) {
  if (picture.uri.empty()) {
    return fmt::format(
        "<figure><p class=\"no-texture\">No picture</p><figcaption>{}</figcaption>"
        "</figure>",
        when);
  }
  return fmt::format(
      "<figure><img loading=\"lazy\" src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{} {}\">"
      "<figcaption>{}</figcaption></figure>",
      picture.uri, picture.width_px, picture.height_px, EscapeHtml(id), when, when);
}

// Where on a facet something changed, and how it looks then and now.
std::string PlaceFigures(const Row& row, size_t number, bool metric) {
  const EpochPlace& place = row.found->places[number];
  const auto range = [&](const std::array<double, 2>& from_to) {
    return fmt::format("{} to {}", Decimal(from_to[0], 1), Length(from_to[1], metric));
  };
  const std::string where =
      fmt::format("{}: another {} on {}, {} from its left and {} above its lower edge", NameOf(row),
                  place.what, Area(place.area_m2, metric), range(place.along_m), range(place.up_m));
  const std::string name = fmt::format("{}, place {},", row.found->id, number + 1);
  return "<article class=\"epoch-facade\"><p>" + where + "</p><div class=\"then-now\">" +
         PictureFigure(row.places[number].first, name, "before") +
         PictureFigure(row.places[number].second, name, "now") + "</div></article>";
}

std::string ChangesSection(const Page& page) {
  std::string lines, places;
  for (const Row& row : page.rows) {
    if (!HasChanged(*row.found)) continue;
    for (size_t p = 0; p < row.places.size(); ++p) places += PlaceFigures(row, p, page.metric);
    lines += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>", NameOf(row),
                         Changes(row, page.metric), ChoiceBadge(row.found->choice));
  }
  if (lines.empty()) return "";
  return "<section aria-labelledby=\"changes\"><h2 id=\"changes\">What changed in the world</h2>"
         "<div class=\"scroll\"><table class=\"plain\"><thead><tr><th scope=\"col\">Surface</th>"
         "<th scope=\"col\">Since the survey</th><th scope=\"col\">Its picture is</th></tr></thead>"
         "<tbody>" +
         lines + "</tbody></table></div>" + places + "</section>\n";
}

std::string Figures(const Row& row, bool metric) {
  const EpochFacet& found = *row.found;
  std::string html = Figure("New photos show", Percent(found.shown));
  html += Figure("Painted from them", Percent(found.taken));
  if (found.both > 0) {
    html += Figure("Shown then and now", Percent(found.both),
                   Percent(found.compared) + " from much the same direction");
    html += Figure("Other colour", Percent(found.repainted));
    html += Figure("Other pattern", Percent(found.other));
    html += Figure("Other light and dark", Percent(found.shaded), "as shadows draw it");
  }
  const auto pixel = [&](double size) { return size > 0 ? PixelSize(size, metric) : "-"; };
  html += Figure("Photo pixel", pixel(found.gsd_after_m), "before: " + pixel(found.gsd_before_m));
  if (found.shift_px >= 0) {
    html += Figure("Shift of details", Decimal(found.shift_px, 1) + " texels");
  }
  return "<dl class=\"measures\">" + html + "</dl>";
}

std::string Article(const Row& row, bool metric) {
  const EpochFacet& found = *row.found;
  std::string html = fmt::format("<article class=\"epoch-facade\"><h3>{} {}</h3><p>{}</p>",
                                 NameOf(row), ChoiceBadge(found.choice), EscapeHtml(found.why));
  if (!row.problem.empty()) html += "<p class=\"quiet\">" + EscapeHtml(row.problem) + "</p>";
  html += "<div class=\"then-now\">" + PictureFigure(row.before, found.id, "before") +
          PictureFigure(row.after, found.id, "now") + "</div>";
  return html + Figures(row, metric) + "</article>";
}

// Those with another picture now.
std::string PicturesSection(const Page& page) {
  std::string articles;
  for (const Row& row : page.rows) {
    if (row.found->choice != FacetChoice::kKept) articles += Article(row, page.metric);
  }
  if (articles.empty()) return "";
  return "<section aria-labelledby=\"pictures\"><h2 id=\"pictures\">Before and now</h2>" +
         articles + "</section>\n";
}

std::string Thumbnail(const Row& row) {
  if (row.before.uri.empty()) return "<span class=\"no-picture\"></span>";
  return fmt::format("<img loading=\"lazy\" src=\"{}\" width=\"{}\" height=\"{}\" alt=\"\">",
                     row.before.uri, row.before.width_px, row.before.height_px);
}

std::string KeptSection(const Page& page) {
  std::string lines;
  for (const Row& row : page.rows) {
    const EpochFacet& found = *row.found;
    if (found.choice != FacetChoice::kKept) continue;
    lines += fmt::format(
        "<tr><td class=\"pic\">{}</td><th scope=\"row\">{}</th><td>{}</td>"
        "<td class=\"num\">{}</td></tr>",
        Thumbnail(row), NameOf(row), EscapeHtml(found.why),
        found.shown > 0 ? Percent(found.shown) : "-");
  }
  if (lines.empty()) return "";
  return "<section aria-labelledby=\"kept\"><h2 id=\"kept\">Kept</h2><div class=\"scroll\">"
         "<table class=\"plain\"><thead><tr><td></td><th scope=\"col\">Surface</th>"
         "<th scope=\"col\">Why</th><th scope=\"col\" class=\"num\">New photos show</th></tr>"
         "</thead><tbody>" +
         lines + "</tbody></table></div></section>\n";
}

std::string PhotosSection(const Page& page) {
  std::string lines;
  for (const EpochPhoto& photo : page.epoch.photos) {
    lines += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td class=\"num\">{}</td>"
        "<td class=\"num\">{}</td><td>{}</td></tr>",
        IsolatedHtml(photo.path), photo.is_placed() ? "placed" : "not used", photo.inliers,
        photo.picture_sigma_px >= 0 ? Decimal(photo.picture_sigma_px, 2) + " px" : "-",
        EscapeHtml(photo.why));
  }
  return "<section aria-labelledby=\"photos\"><h2 id=\"photos\">New photos</h2>"
         "<div class=\"scroll\"><table class=\"plain\"><thead><tr><th scope=\"col\">Photo</th>"
         "<th scope=\"col\">State</th><th scope=\"col\" class=\"num\">Points of the survey</th>"
         "<th scope=\"col\" class=\"num\">Placed to</th><th scope=\"col\">Why</th></tr></thead>"
         "<tbody>" +
         lines + "</tbody></table></div></section>\n";
}

EmbeddedPicture PictureOf(const TexturedFacet& texture, const fs::path& folder, int side_px,
                          std::string& problem) {
  FacetRow row;
  row.texture = &texture;
  FacetPictures pictures = MakeFacetPictures(row, folder, side_px);
  if (problem.empty()) problem = pictures.problem;
  return std::move(pictures.texture);
}

std::vector<Row> MakeRows(const Epoch& epoch, const Proxy& proxy, const StageContext& context) {
  const fs::path old_folder = (context.survey / kTexturesFile).parent_path();
  const TextureSet before = ReadTextureSet(context.survey / kTexturesFile);
  const TextureSet after = ReadTextureSet(context.out / fs::path(kTexturesFile).filename());
  std::map<std::string, const Facet*> facets;
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) facets[facet.id] = &facet;
  }
  const int side_px = PictureSide_px(kPicture_px, 2 * epoch.facets.size());
  std::vector<Row> rows(epoch.facets.size());
  context.progress->Begin("pictures of the report", rows.size());
  ParallelFor(rows.size(), context.threads, [&](size_t i) {
    context.ThrowIfCancelled();
    Row& row = rows[i];
    row.found = &epoch.facets[i];
    const auto facet = facets.find(row.found->id);
    row.facet = facet == facets.end() ? nullptr : facet->second;
    const bool kept = row.found->choice == FacetChoice::kKept;
    row.before = PictureOf(before.facets[i], old_folder, kept ? 120 : side_px, row.problem);
    if (!kept) row.after = PictureOf(after.facets[i], context.out, side_px, row.problem);
    if (HasChanged(*row.found)) {
      for (const EpochPlace& place : row.found->places) {
        row.places.emplace_back(MakePicture(context.out, place.before, kPlace_px, row.problem),
                                MakePicture(context.out, place.after, kPlace_px, row.problem));
      }
    }
    context.progress->Advance();
  });
  return rows;
}

}  // namespace

void WriteEpochReport(const Epoch& epoch, StageContext& context) {
  const Proxy proxy = ReadProxy(context.survey / kFacetsFile);
  const Page page{epoch, proxy.metric, MakeRows(epoch, proxy, context)};
  std::string html = internal::PageBegin("New photos: " + epoch.name);
  html += SummarySection(page) + ChangesSection(page) + PicturesSection(page) + KeptSection(page) +
          PhotosSection(page);
  WriteFile(context.out / "report.html", html + internal::PageEnd());
}

}  // namespace stucco
