// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/planned_views.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

namespace stucco {
namespace {

bool IsPartOfWord(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// The last word of a file's name, without its extension.
std::string LastWord(const std::string& path) {
  const size_t slash = path.find_last_of('/');
  const size_t dot = path.find_last_of('.');
  const size_t begin = slash == std::string::npos ? 0 : slash + 1;
  size_t end = dot == std::string::npos || dot < begin ? path.size() : dot;
  while (end > begin && !IsPartOfWord(path[end - 1])) --end;
  size_t start = end;
  while (start > begin && IsPartOfWord(path[start - 1])) --start;
  return path.substr(start, end - start);
}

// The photos that carry each id, the best first.
std::map<std::string, std::vector<CapturedPhoto*>> PhotosById(std::vector<CapturedPhoto>& photos) {
  std::map<std::string, std::vector<CapturedPhoto*>> by_id;
  for (CapturedPhoto& photo : photos) by_id[LastWord(photo.path)].push_back(&photo);
  for (auto& [id, some] : by_id) {
    std::stable_sort(some.begin(), some.end(), [](const CapturedPhoto* a, const CapturedPhoto* b) {
      return std::tuple(!a->usable, a->capture_time, a->path) <
             std::tuple(!b->usable, b->capture_time, b->path);
    });
  }
  return by_id;
}

}  // namespace

std::vector<CapturedView> MatchToPlan(const Plan& plan, std::vector<CapturedPhoto>& photos) {
  const auto by_id = PhotosById(photos);
  std::vector<CapturedView> views;
  views.reserve(plan.views.size());
  for (const PlannedView& view : plan.views) {
    const auto found = by_id.find(view.id);
    if (found == by_id.end()) {
      views.push_back({view.id, "missing", ""});
      continue;
    }
    CapturedPhoto& photo = *found->second.front();
    photo.view = view.id;
    views.push_back({view.id, photo.usable ? "captured" : "unusable", photo.path});
  }
  return views;
}

}  // namespace stucco
