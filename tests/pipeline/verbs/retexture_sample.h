// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/verbs/retexture.h"
#include "survey/error.h"
#include "tests/survey/temporary_folder.h"

namespace stucco {

// Relative path -> hash of every file below a folder but work files and epochs.
std::map<std::string, std::string> Contents(const std::filesystem::path& folder);

// A survey of four fifths of the sample's photos, the set "old", with calibration, the true planes
// and textures, made once. The other photos are the set "same", of an unchanged world.
class RetextureSample : public testing::Test {
 protected:
  static void SetUpTestSuite();
  static void TearDownTestSuite();

  static std::filesystem::path Survey() { return *folder_ / "survey"; }
  static std::filesystem::path Photos(const std::string& set) { return *folder_ / set; }
  static std::filesystem::path Epoch(const std::string& name) { return Survey() / "epochs" / name; }

  static RetextureReport Run(const std::string& set, const std::string& epoch,
                             ReplaceMode replace = ReplaceMode::kAuto);
  static RetextureReport Run(const RetextureRequest& request);
  // The error that the same ends with; the second, in another folder than the survey's.
  static Error Refusal(const std::string& set, const std::string& epoch);
  static Error Refusal(const RetextureRequest& request);
  static Error RefusalOf(const std::filesystem::path& survey, const std::string& set,
                         const std::string& epoch);

  // Names of pictures and labels of an epoch whose bytes are not the survey's.
  static std::vector<std::string> OtherPictures(const std::filesystem::path& epoch);

  static bool interrupted_;  // as by Ctrl-C

 private:
  static RetextureReport RunIn(const std::filesystem::path& survey, RetextureRequest request);
  static Error RefusalIn(const std::filesystem::path& survey, const RetextureRequest& request);

  static test::TemporaryFolder* folder_;
  static std::FILE* log_;
};

}  // namespace stucco
