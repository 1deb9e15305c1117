// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "pipeline/events.h"
#include "pipeline/manifest.h"
#include "pipeline/progress.h"
#include "pipeline/stages.h"
#include "pipeline/units.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Stages, KnowWhatTheyNeedAndWhoNeedsThem) {
  const FakeSurvey fake;
  EXPECT_THAT(WithNeeds(fake.table, "dense"), ElementsAre("ingest", "calib", "dense"));
  EXPECT_THAT(Dependants(fake.table, "calib"), ElementsAre("dense", "report"));
  EXPECT_EQ(FindProblem(fake.table), "");
  EXPECT_EQ(FindStage(fake.table, "nothing"), nullptr);
  EXPECT_THROW(GetStage(fake.table, "nothing"), Error);
}

TEST(Stages, ATableInTheWrongOrderIsFound) {
  FakeSurvey fake;
  std::swap(fake.table[0], fake.table[1]);
  EXPECT_THAT(FindProblem(fake.table), HasSubstr("calib needs ingest"));
  fake.table = {fake.table[1], fake.table[1]};
  EXPECT_THAT(FindProblem(fake.table), HasSubstr("listed twice"));
}

TEST(Manifest, ReadsBackExactly) {
  const FakeSurvey fake;
  Manifest manifest;
  manifest.stage = "calib";
  manifest.program = "1.2.3";
  manifest.fingerprint = {3, {{"size", "2"}}, {{"photos/\xff.jpg", "00"}, {"photos/ü.jpg", "01"}}};
  manifest.outputs = {{"calib/a.bin", "11"}};
  manifest.usage = {1.5, 2.25, 812.5};
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
  EXPECT_EQ(file.manifest->units.at("features").reused, 5);
  EXPECT_EQ(file.manifest->imported_from, "/somewhere");
  EXPECT_FALSE(ReadManifest(fake.root / "none.json").manifest);
  EXPECT_EQ(ReadManifest(fake.root / "none.json").problem, "");
}

TEST(Units, KeepBytesUnderAnyKey) {
  const FakeSurvey fake;
  int heard = 0;
  DiskUnits units(fake.root / "units", [&](auto, auto, size_t) { ++heard; });
  const std::string bytes("\0\n\xff bytes", 9);
  const std::string long_key(5000, 'k');
  for (const std::string key : {"plain-1.2_x", "a/../../b", "", ".hidden", long_key.c_str()}) {
    EXPECT_FALSE(units.Load("kind", key)) << key;
    units.Save("kind", key, bytes);
    EXPECT_EQ(units.Load("kind", key), bytes) << key;
  }
  units.Save("kind", "empty", "");
  EXPECT_EQ(units.Load("kind", "empty"), "");
  EXPECT_EQ(heard, 6);
  EXPECT_EQ(units.counts().at("kind").computed, 6);
  EXPECT_EQ(units.counts().at("kind").reused, 0);
  EXPECT_EQ(FilesBelow(fake.root / "units").size(), 6u);
  EXPECT_TRUE(fs::exists(fake.root / "units/kind/plain-1.2_x"));
}

TEST(Units, DamageInAnyByteIsAbsence) {
  const FakeSurvey fake;
  const fs::path path = fake.root / "units/kind/key";
  DiskUnits(fake.root / "units", nullptr).Save("kind", "key", "some bytes");
  const std::string good = ReadFile(path);
  for (size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] ^= 4;
    WriteFile(path, bad);
    EXPECT_FALSE(DiskUnits(fake.root / "units", nullptr).Load("kind", "key")) << i;
    WriteFile(path, good.substr(0, i));
    EXPECT_FALSE(DiskUnits(fake.root / "units", nullptr).Load("kind", "key")) << i;
  }
  WriteFile(path, good);
  EXPECT_EQ(DiskUnits(fake.root / "units", nullptr).Load("kind", "key"), "some bytes");
}

TEST(Units, OnlyUsedOnesStay) {
  const FakeSurvey fake;
  {
    DiskUnits units(fake.root / "units", nullptr);
    units.Save("a", "1", "x");
    units.Save("a", "2", "x");
    units.Save("b", "3", "x");
  }
  DiskUnits units(fake.root / "units", nullptr);
  units.Load("a", "2");
  units.Save("c", "4", "x");
  units.DeleteUntouched();
  EXPECT_THAT(FilesBelow(fake.root / "units"), ElementsAre("a/2", "c/4"));
}

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

TEST(Console, FormatsForPeople) {
  EXPECT_EQ(DurationText(0.04), "0.0 s");
  EXPECT_EQ(DurationText(9.97), "10 s");
  EXPECT_EQ(DurationText(59.6), "1 min 00 s");
  EXPECT_EQ(DurationText(7620), "2 h 07 min");
  EXPECT_EQ(DurationText(-1), "unknown");
  EXPECT_EQ(MemoryText(812.4), "812 MiB");
  EXPECT_EQ(MemoryText(3277), "3.2 GiB");
  EXPECT_EQ(GroupedDigits(7), "7");
  EXPECT_EQ(GroupedDigits(1234567), "1 234 567");
}

TEST(Console, ThatCannotBeWrittenStopsNothing) {
  std::FILE* file = std::fopen("/dev/full", "w");
  if (file == nullptr) {
    GTEST_SKIP() << "there is no /dev/full here";
  }
  Console console(file, true, Verbosity::kVerbose);
  EventLog no_events;
  {
    StageProgress progress("calib", console, no_events);
    progress.Begin("matching", 3);
    progress.Warn("a warning");
    EXPECT_NO_THROW(console.Bar("a bar"));
  }
  EXPECT_NO_THROW(console.Line(std::string(100'000, 'x')));
  std::fclose(file);
}

TEST(Progress, TextSaysCountsRateAndTimeLeft) {
  EXPECT_THAT(ProgressText("calib", "matching", 120, 480, 12),
              HasSubstr("matching 120/480 (25 %)"));
  EXPECT_THAT(ProgressText("calib", "matching", 120, 480, 12), HasSubstr("12/s, 30 s left"));
  EXPECT_THAT(ProgressText("dense", "depth", 1, 4, 0.05), HasSubstr("20 s each, 1 min 00 s left"));
  EXPECT_THAT(ProgressText("calib", "matching", 9, 4, 0), HasSubstr("4/4 (100 %)"));
  EXPECT_THAT(ProgressText("calib", "thinking", 0, 0, 0), HasSubstr("thinking"));
}

TEST(Progress, RateForgetsTheReusedUnitsOfTheBeginning) {
  RateMeter meter;
  meter.Restart(0);
  EXPECT_EQ(meter.rate(), 0);
  meter.Add(0.2, 1000);  // checkpoints, at once
  for (int second = 1; second <= 60; ++second) {
    meter.Add(second, 1000 + 2 * static_cast<size_t>(second));
  }
  EXPECT_NEAR(meter.rate(), 2, 0.1);
}

TEST(Progress, QuietShowsWarningsOnly) {
  std::FILE* file = std::tmpfile();
  EventLog no_events;
  Console console(file, true, Verbosity::kQuiet);
  {
    StageProgress progress("calib", console, no_events);
    progress.Begin("matching", 3);
    progress.Advance(3);
    progress.Note("a note");
    progress.Warn("a warning");
  }
  std::rewind(file);
  char text[1000] = {};
  const size_t size = std::fread(text, 1, sizeof(text) - 1, file);
  std::fclose(file);
  EXPECT_EQ(std::string(text, size), "  calib: warning: a warning\n");
}

}  // namespace
}  // namespace stucco
