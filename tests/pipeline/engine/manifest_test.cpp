// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/manifest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Manifest, ReadsBackExactly) {
  const FakeSurvey fake;
  Manifest manifest;
  manifest.stage = "calib";
  manifest.program = "1.2.3";
  manifest.fingerprint = {3, {{"size", "2"}}, {{"photos/\xff.jpg", "00"}, {"photos/ü.jpg", "01"}}};
  manifest.outputs = {{"calib/a.bin", "11"}};
  manifest.usage = {1.5, 2.25, 812.5, 2};
  manifest.units["features"] = {4, 5};
  manifest.imported_from = "/somewhere";
  const fs::path path = fake.root / "m/calib.json";
  WriteManifest(manifest, path);
  const ManifestFile file = ReadManifest(path);
  ASSERT_TRUE(file.manifest) << file.problem;
  EXPECT_EQ(file.manifest->outputs, manifest.outputs);
  EXPECT_EQ(file.manifest->fingerprint.options, manifest.fingerprint.options);
  EXPECT_EQ(file.manifest->fingerprint.inputs.at("photos/ü.jpg"), "01");
  EXPECT_EQ(file.manifest->usage.cpu_s, 2.25);
  EXPECT_EQ(file.manifest->usage.cores, 2);
  EXPECT_EQ(file.manifest->units.at("features").reused, 5);
  EXPECT_EQ(file.manifest->imported_from, "/somewhere");
  EXPECT_FALSE(ReadManifest(fake.root / "none.json").manifest);
  EXPECT_EQ(ReadManifest(fake.root / "none.json").problem, "");
}

}  // namespace
}  // namespace stucco
