// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "survey/survey_folder.h"

namespace stucco {

// What the orchestrator keeps in a survey's `.stucco` folder. All of it may be deleted while no
// run is going on: the price is that the stages run again, and that outputs which are there are
// moved aside instead of replaced.
struct WorkFolder {
  explicit WorkFolder(const std::filesystem::path& survey) : root(survey / kWorkFolder) {}

  std::filesystem::path Manifest(const std::string& stage) const {
    return root / "manifests" / (stage + ".json");
  }
  std::filesystem::path Failure(const std::string& stage) const {
    return root / "failures" / (stage + ".json");
  }
  // Says that survey/<stage> was made by this program, even where its manifest is missing.
  std::filesystem::path Mark(const std::string& stage) const { return root / "made" / stage; }
  std::filesystem::path Units(const std::string& stage) const { return root / "units" / stage; }
  std::filesystem::path Scratch() const { return root / "scratch"; }
  std::filesystem::path Hashes() const { return root / "hashes.txt"; }
  std::filesystem::path Lock() const { return root / "lock"; }
  std::filesystem::path Events() const { return root / "events.ndjson"; }

  std::filesystem::path root;
};

}  // namespace stucco
