// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "report/internal/html_sections.h"
#include "report/photo_trust.h"
#include "survey/escape.h"
#include "survey/numbers.h"

namespace stucco::internal {
namespace {

constexpr size_t kMostOpen = 12;  // rows that are shown without a click

// What it is at the middle facade, besides the pixels of a photo.
std::string InPicture(const PageContent& page, double sigma_px) {
  if (sigma_px < 0) return "-";
  std::string text = "± " + Decimal(sigma_px, 1) + " px";
  if (const auto gsd = MedianGsd(page.data)) {
    text += " (" + PixelSize(sigma_px * *gsd, page.data.metric) + ")";
  }
  return text;
}

std::string Figures(const PageContent& page, const Placement& placement) {
  const bool metric = page.data.metric;
  std::string html = "<dl class=\"measures\">";
  if (placement.middle) {
    const PlacementSigma& middle = *placement.middle;
    const PlacementSigma& most = *placement.nine_in_ten;
    html += Figure("Place", "± " + Length(middle.position, metric),
                   "the middle photo; nine in ten ± " + Length(most.position, metric));
    html += Figure("Direction", "± " + Decimal(middle.rotation_deg, 3) + "°",
                   "nine in ten ± " + Decimal(most.rotation_deg, 3) + "°");
    html += Figure("On the wall", InPicture(page, middle.picture_px),
                   "nine in ten " + InPicture(page, most.picture_px));
  }
  const int weak = placement.states.at(PhotoState::kWeak);
  const int ambiguous = placement.states.at(PhotoState::kAmbiguous);
  const int record_only = placement.states.at(PhotoState::kRecordOnly);
  html += Figure("Tied by other photos", fmt::format("{}", placement.states.at(PhotoState::kTied)));
  if (weak > 0) html += Figure("Weak", fmt::format("{}", weak), "used; do not trust one alone");
  if (ambiguous > 0) html += Figure("Ambiguous", fmt::format("{}", ambiguous), "not used");
  if (record_only > 0) {
    html += Figure("By their records alone", fmt::format("{}", record_only), "not used");
  }
  if (placement.apart > 0) {
    html += Figure("In models apart", fmt::format("{}", placement.apart), "not used");
  }
  return html + "</dl>";
}

std::string Rows(const PageContent& page, const std::vector<const CalibratedPhoto*>& photos) {
  std::string html =
      "<table class=\"plain\"><thead><tr><th scope=\"col\">Photo</th><th scope=\"col\"></th>"
      "<th scope=\"col\" class=\"num\">Place</th><th scope=\"col\" class=\"num\">Direction</th>"
      "<th scope=\"col\" class=\"num\">On the wall</th><th scope=\"col\">Why</th></tr></thead>"
      "<tbody>";
  for (const CalibratedPhoto* photo : photos) {
    const bool known = photo->position_sigma >= 0;
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"state\">{}</td><td class=\"num\">{}</td>"
        "<td class=\"num\">{}</td><td class=\"num\">{}</td><td>{}</td></tr>",
        IsolatedHtml(photo->path), Name(photo->state),
        known ? "± " + Length(photo->position_sigma, page.data.metric) : "-",
        known ? "± " + Decimal(photo->rotation_sigma_deg, 2) + "°" : "-",
        InPicture(page, photo->picture_sigma_px), EscapeHtml(photo->why));
  }
  return html + "</tbody></table>";
}

std::string NotToTrust(const PageContent& page) {
  const auto photos = PhotosNotToTrust(*page.data.calibration);
  if (photos.empty()) return "<p>No photo is to be distrusted.</p>";
  const std::string title =
      fmt::format("{} not to trust", Count(static_cast<int>(photos.size()), "photo", "photos"));
  const std::string table = "<div class=\"scroll\">" + Rows(page, photos) + "</div>";
  if (photos.size() <= kMostOpen) return "<h3>" + title + "</h3>" + table;
  return "<details><summary>" + title + "</summary>" + table + "</details>";
}

std::string Parts(const Calibration& calibration) {
  if (calibration.parts.size() < 2) return "";
  std::string html = "<h3>Parts that do not hang together</h3><ul class=\"findings\">";
  for (size_t i = 1; i < calibration.parts.size(); ++i) {
    html += fmt::format("<li>{}</li>", EscapeHtml(calibration.parts[i].why));
  }
  return html + "</ul>";
}

}  // namespace

std::string PlacementSection(const PageContent& page) {
  if (!page.data.calibration) return "";
  const Calibration& calibration = *page.data.calibration;
  const Placement placement = SummarizePlacement(calibration);
  const bool says_something =
      placement.middle || !PhotosNotToTrust(calibration).empty() || calibration.parts.size() > 1;
  if (!says_something) return "";
  return "<section aria-labelledby=\"placement\"><h2 id=\"placement\">How surely photos are "
         "placed</h2>" +
         Figures(page, placement) +
         "<p>One standard deviation, within the model: where a photo stood, where it looked, and "
         "by how much both together move what it paints.</p>" +
         NotToTrust(page) + Parts(calibration) + "</section>";
}

}  // namespace stucco::internal
