// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/later_day.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "simulate/city/footprints.h"
#include "simulate/city/lay_out_town.h"
#include "simulate/city/make_city.h"
#include "simulate/city/occluders.h"
#include "survey/files.h"
#include "survey/image.h"
#include "tests/survey/support.h"

namespace stucco::simulate {
namespace {

namespace fs = std::filesystem;

// Every free wall is a facade.
FacadeIds AllFacades(const Town& town) {
  FacadeIds ids;
  for (const House& house : town.houses) {
    auto& of_house = ids.emplace_back();
    for (size_t edge = 0; edge < house.party.size(); ++edge) {
      of_house.push_back(house.party[edge] ? "" : house.id + "/F" + std::to_string(edge));
    }
  }
  return ids;
}

TEST(LaterDay, TheFirstIsAsItWasLaidOut) {
  Town town = LayOutTown("block", 1);
  const size_t cars = town.cars.size();
  const DayChanges changes = LiveUntil(1, AllFacades(town), town);
  EXPECT_TRUE(changes.repainted.empty() && changes.gone.empty() && changes.come.empty());
  EXPECT_EQ(town.cars.size(), cars);
}

TEST(LaterDay, OneFacadeIsRepaintedOneCarLeavesAndOneComes) {
  for (const std::string& style : CityStyles()) {
    for (int seed = 0; seed < 30; ++seed) {
      Town town = LayOutTown(style, seed);
      const Town before = town;
      const FacadeIds facades = AllFacades(town);
      const DayChanges changes = LiveUntil(2, facades, town);
      ASSERT_EQ(changes.repainted.size(), 1u) << style << seed;
      int repainted = 0;
      for (size_t i = 0; i < town.houses.size(); ++i) {
        const House& house = town.houses[i];
        if (house.repainted_edge < 0) continue;
        ++repainted;
        EXPECT_EQ(facades[i][house.repainted_edge], changes.repainted[0]);
        EXPECT_NE(house.cladding, Cladding::kGlass);
      }
      EXPECT_EQ(repainted, 1);
      if (before.cars.empty()) continue;
      ASSERT_EQ(changes.gone.size(), 1u);
      EXPECT_EQ(town.cars.size(), before.cars.size() - 1 + changes.come.size());
      for (const Car& car : town.cars) EXPECT_NE(ElementOf(car), changes.gone[0]);
      if (changes.come.empty()) continue;
      const Car& come = town.cars.back();
      EXPECT_EQ(ElementOf(come), changes.come[0]);
      for (const Car& car : before.cars) {
        EXPECT_GE((car.position - come.position).norm(), 5) << style << seed;
        EXPECT_NE(car.number, come.number);
      }
      for (const House& house : town.houses) {
        EXPECT_FALSE(Contains(house.outline, come.position)) << style << seed;
      }
    }
  }
}

TEST(LaterDay, DaysDifferAndAreTheSameEachTime) {
  const auto changes_of = [](int day) {
    Town town = LayOutTown("block", 1);
    const FacadeIds facades = AllFacades(town);
    return LiveUntil(day, facades, town);
  };
  EXPECT_EQ(changes_of(2).repainted, changes_of(2).repainted);
  EXPECT_NE(changes_of(2).repainted, changes_of(3).repainted);
}

TEST(LaterDay, ATownWithoutCarsHasNoneToLeave) {
  Town town = LayOutTown("hamlet", 1);
  town.cars.clear();
  const DayChanges changes = LiveUntil(2, AllFacades(town), town);
  EXPECT_TRUE(changes.gone.empty() && changes.come.empty());
}

std::map<std::string, std::string> Files(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[entry.path().lexically_relative(folder).generic_string()] = HashFile(entry.path());
    }
  }
  return files;
}

Eigen::Vector3d MeanColour(const fs::path& picture) {
  const Image image = ReadJpeg(picture);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < image.data.size(); ++i) sum[static_cast<int>(i % 3)] += image.data[i];
  return sum / (image.data.size() / 3.0);
}

// The whole scene: what has not changed has the bytes that it had.
TEST(LaterDay, ASceneDiffersInWhatItsTruthNames) {
  const test::TemporaryFolder folder;
  CityOptions options;
  options.metres_per_texel = 0.1;
  MakeCity(options, folder / "first");
  options.day = 2;
  const CitySummary summary = MakeCity(options, folder / "second");
  auto before = Files(folder / "first");
  auto after = Files(folder / "second");
  ASSERT_EQ(summary.changes.repainted.size(), 1u);
  std::string name = summary.changes.repainted[0];
  std::ranges::replace(name, '/', '_');
  const std::string picture = "truth/textures/" + name + ".jpg";
  for (const std::string& file : {picture, std::string(kSceneFile), std::string(kSceneModel)}) {
    EXPECT_NE(before.at(file), after.at(file)) << file;
    before.erase(file);
    after.erase(file);
  }
  EXPECT_EQ(after.erase(kTruthChanges), 1u);
  EXPECT_EQ(before, after);
  // Another hue, not only another brightness.
  const Eigen::Array3d ratio = MeanColour(folder / "second" / picture).array() /
                               MeanColour(folder / "first" / picture).array();
  EXPECT_GT(ratio.maxCoeff() / ratio.minCoeff(), 1.15);
  const auto changes = nlohmann::json::parse(ReadFile(folder / "second" / kTruthChanges));
  EXPECT_EQ(changes.at("repainted"), summary.changes.repainted);
  EXPECT_EQ(ReadSceneInfo(folder / "second").day, 2);
  // And back: no old truth stays.
  options.day = 1;
  MakeCity(options, folder / "second");
  EXPECT_EQ(Files(folder / "second"), Files(folder / "first"));
}

}  // namespace
}  // namespace stucco::simulate
