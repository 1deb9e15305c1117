// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "survey/texture_set.h"

namespace stucco {

// What a survey's own look is called beside those of its epochs.
inline constexpr char kOwnLook[] = "survey";

// Pictures of a model's facets as photos of one day show them.
struct ModelLook {
  std::string name;              // kOwnLook, or an epoch's
  TextureSet textures;           // of further looks only the pictures that the first has not
  std::filesystem::path folder;  // which they are relative to
};

struct SurveyLooks {
  std::vector<ModelLook> looks;       // the survey's own, then those of its epochs by name
  std::vector<std::string> outdated;  // epochs left out, as their pictures are of an earlier model
};

// Whether a name is of a folder that was moved aside for another: no epoch is called like that.
bool IsMovedAside(const std::string& name);

// All looks of a textured survey. Pictures that an epoch kept are its first look's, whose bytes
// they have; all others lie on the same grids. Throws Error (kBadInput).
SurveyLooks ReadLooks(const std::filesystem::path& survey);

// The look of an epoch alone, whole; the survey's own for an empty name. Throws Error (kBadInput),
// also where there is no such epoch.
ModelLook ReadLook(const std::filesystem::path& survey, const std::string& epoch);

// Where the pictures and models of that look lie; with textures where it is an epoch's. Throws
// Error (kBadInput) where there is no such epoch.
std::filesystem::path LookFolder(const std::filesystem::path& survey, const std::string& epoch);

}  // namespace stucco
