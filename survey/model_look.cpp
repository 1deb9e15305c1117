// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/model_look.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "survey/error.h"
#include "survey/files.h"
#include "survey/survey_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

constexpr double kSameTexel = 1e-6;  // of a texel's side, and of texels

// By name: a folder without textures is none.
std::vector<std::string> EpochsOf(const fs::path& survey) {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(survey / kEpochsFolder, error)) {
    if (!fs::exists(entry.path() / fs::path(kTexturesFile).filename(), error)) continue;
    const std::string name = entry.path().filename().string();
    if (!IsMovedAside(name)) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

bool HasSameGrid(const TexturedFacet& a, const TexturedFacet& b) {
  const double slack = kSameTexel * a.metres_per_texel;
  return a.width_px == b.width_px && a.height_px == b.height_px &&
         std::abs(a.metres_per_texel - b.metres_per_texel) <= slack &&
         (a.origin - b.origin).norm() <= slack && (a.u_axis - b.u_axis).norm() <= kSameTexel &&
         (a.v_axis - b.v_axis).norm() <= kSameTexel;
}

// An epoch without what it shares with the survey's own look; nothing where it is of other facets.
std::optional<ModelLook> Others(const ModelLook& own, ModelLook epoch) {
  std::map<std::string, const TexturedFacet*> own_of;
  for (const TexturedFacet& facet : own.textures.facets) own_of[facet.id] = &facet;
  for (const TexturedFacet& facet : epoch.textures.facets) {
    const auto found = own_of.find(facet.id);
    if (found == own_of.end()) return std::nullopt;
    const bool is_in_both = !facet.image.empty() && !found->second->image.empty();
    if (is_in_both && !HasSameGrid(*found->second, facet)) return std::nullopt;
  }
  std::erase_if(epoch.textures.facets, [&](const TexturedFacet& facet) {
    const TexturedFacet& before = *own_of.at(facet.id);
    if (facet.image.empty() || before.image.empty()) return facet.image.empty();
    return ReadFile(epoch.folder / facet.image) == ReadFile(own.folder / before.image);
  });
  return epoch;
}

}  // namespace

bool IsMovedAside(const std::string& name) {
  const size_t hyphen = name.find_last_not_of("0123456789");
  return hyphen != std::string::npos && hyphen + 1 < name.size() && name[hyphen] == '-' &&
         name.substr(0, hyphen).ends_with(kOldSuffix);
}

SurveyLooks ReadLooks(const fs::path& survey) {
  SurveyLooks all;
  all.looks.push_back(ReadLook(survey, ""));
  for (const std::string& name : EpochsOf(survey)) {
    auto others = Others(all.looks.front(), ReadLook(survey, name));
    if (others) {
      all.looks.push_back(std::move(*others));
    } else {
      all.outdated.push_back(name);
    }
  }
  return all;
}

fs::path LookFolder(const fs::path& survey, const std::string& epoch) {
  if (epoch.empty()) return (survey / kTexturesFile).parent_path();
  const std::vector<std::string> names = EpochsOf(survey);
  if (std::ranges::find(names, epoch) == names.end()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: has no epoch \"{}\"", survey.string(), epoch),
                names.empty() ? "make one of new photos first: stucco retexture"
                              : fmt::format("its epochs are {}", fmt::join(names, ", ")));
  }
  return survey / kEpochsFolder / epoch;
}

ModelLook ReadLook(const fs::path& survey, const std::string& epoch) {
  const fs::path folder = LookFolder(survey, epoch);
  return {epoch.empty() ? kOwnLook : epoch,
          ReadTextureSet(folder / fs::path(kTexturesFile).filename()), folder};
}

}  // namespace stucco
