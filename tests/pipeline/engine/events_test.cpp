// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/events.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

TEST(Events, AreOneObjectALineWhateverTheyHold) {
  const FakeSurvey fake;
  const fs::path path = fake.root / "events.ndjson";
  WriteFile(path, "{\"torn");
  EventLog(path).Write("note", {{"text", "a\n\"b\"\xff"}, {"count", int64_t{3}}, {"share", 0.5}});
  std::istringstream lines(ReadFile(path));
  std::string torn, whole, none;
  std::getline(lines, torn);
  std::getline(lines, whole);
  EXPECT_FALSE(std::getline(lines, none));
  const auto json = nlohmann::json::parse(whole);
  EXPECT_EQ(json.at("event"), "note");
  EXPECT_EQ(json.at("count"), 3);
  EXPECT_EQ(json.at("time").get<std::string>().size(), 24u);
  EventLog(fake.root / "no folder/x").Write("note", {});  // no error
}

}  // namespace
}  // namespace stucco
