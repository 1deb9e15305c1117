// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/planned_photos.h"

#include <fmt/format.h>

#include "report/photo_trust.h"

namespace stucco {
namespace {

using ReasonByPath = std::map<std::string, std::string>;

std::string WithReason(const char* what, const std::string& why) {
  return why.empty() ? what : fmt::format("{}: {}", what, why);
}

// The photos that walls cannot be painted from.
ReasonByPath UselessPhotos(const SurveyData& data) {
  ReasonByPath reasons;
  for (const CapturedPhoto& photo : data.captures->photos) {
    if (!photo.usable) reasons[photo.path] = WithReason("cannot be used", photo.why);
  }
  if (!data.calibration) return reasons;
  // What ingest has said of a photo stands.
  for (const UnposedPhoto& photo : data.calibration->unposed) {
    reasons.emplace(photo.path, WithReason("has no pose", photo.why));
  }
  for (const CalibratedPhoto& photo : data.calibration->photos) {
    if (!IsInModel(photo.state)) {
      reasons.emplace(photo.path, fmt::format("has no sure pose ({})", Name(photo.state)));
    } else if (!IsInMainModel(*data.calibration, photo)) {
      reasons.emplace(photo.path, "is in a model apart");
    }
  }
  return reasons;
}

}  // namespace

LostViews FindLostViews(const SurveyData& data) {
  LostViews lost;
  if (!data.captures) return lost;
  const ReasonByPath useless = UselessPhotos(data);
  for (const CapturedView& view : data.captures->views) {
    if (view.photo.empty()) {
      lost[view.id] = "was not taken";
    } else if (const auto found = useless.find(view.photo); found != useless.end()) {
      lost[view.id] = found->second;
    }
  }
  return lost;
}

std::string LostViewsText(const PlannedFacade& facade, const LostViews& lost) {
  size_t count = 0;
  std::string views;
  for (const std::string& id : facade.views) {
    const auto found = lost.find(id);
    if (found == lost.end()) continue;
    views += fmt::format("{}{} {}", count++ > 0 ? "; " : "", id, found->second);
  }
  if (count == 0) return "";
  const size_t planned = facade.views.size();
  if (planned == 1) return "its one planned photo is lost: " + views;
  return fmt::format("{} of its {} planned photos {} lost: {}", count, planned,
                     count == 1 ? "is" : "are", views);
}

}  // namespace stucco
