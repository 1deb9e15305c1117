// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/model_look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/error.h"
#include "survey/files.h"
#include "survey/survey_folder.h"
#include "tests/survey/temporary_folder.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A survey with two walls, one painted.
class LooksTest : public testing::Test {
 protected:
  LooksTest() { Write(survey() / "texture", {Wall("W0", "old"), Wall("W1", "")}); }

  fs::path survey() const { return folder_.path(); }
  fs::path Epoch(const std::string& name) const { return survey() / kEpochsFolder / name; }

  // `bytes`: of its picture; none for none.
  static std::pair<TexturedFacet, std::string> Wall(const std::string& id,
                                                    const std::string& bytes) {
    TexturedFacet wall;
    wall.id = id;
    if (!bytes.empty()) wall.image = "textures/" + id + ".png";
    wall.width_px = 40;
    wall.height_px = 30;
    wall.metres_per_texel = 0.1;
    return {wall, bytes};
  }

  static void Write(const fs::path& folder,
                    const std::vector<std::pair<TexturedFacet, std::string>>& walls) {
    fs::create_directories(folder / "textures");
    TextureSet textures;
    for (const auto& [wall, bytes] : walls) {
      textures.facets.push_back(wall);
      if (!wall.image.empty()) WriteFile(folder / wall.image, bytes);
    }
    WriteTextureSet(textures, folder / "textures.json");
  }

  static std::vector<std::string> IdsOf(const ModelLook& look) {
    std::vector<std::string> ids;
    for (const TexturedFacet& facet : look.textures.facets) ids.push_back(facet.id);
    return ids;
  }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(LooksTest, AnEpochHasThePicturesThatAreOthers) {
  Write(Epoch("b"), {Wall("W0", "new"), Wall("W1", "first")});
  Write(Epoch("a"), {Wall("W0", "old"), Wall("W1", "")});
  WriteFile(survey() / kEpochsFolder / "note.txt", "no epoch");
  const SurveyLooks all = ReadLooks(survey());
  EXPECT_THAT(all.outdated, IsEmpty());
  ASSERT_EQ(all.looks.size(), 3u);
  EXPECT_EQ(all.looks[0].name, kOwnLook);
  EXPECT_EQ(all.looks[0].folder, survey() / "texture");
  EXPECT_THAT(IdsOf(all.looks[0]), ElementsAre("W0", "W1"));
  EXPECT_EQ(all.looks[1].name, "a");
  EXPECT_THAT(IdsOf(all.looks[1]), IsEmpty());
  EXPECT_EQ(all.looks[2].folder, Epoch("b"));
  EXPECT_THAT(IdsOf(all.looks[2]), ElementsAre("W0", "W1"));
}

TEST_F(LooksTest, EpochsOfOtherGridsOrFacetsAreOutdated) {
  auto shifted = Wall("W0", "new");
  shifted.first.origin.x() += 0.01;
  Write(Epoch("shifted"), {shifted});
  Write(Epoch("unknown"), {Wall("W7", "new")});
  const SurveyLooks all = ReadLooks(survey());
  EXPECT_EQ(all.looks.size(), 1u);
  EXPECT_THAT(all.outdated, ElementsAre("shifted", "unknown"));
}

TEST_F(LooksTest, WhatWasMovedAsideIsNoEpoch) {
  Write(Epoch("spring"), {Wall("W0", "new"), Wall("W1", "")});
  Write(Epoch("spring.old-1"), {Wall("W0", "older"), Wall("W1", "")});
  const SurveyLooks all = ReadLooks(survey());
  ASSERT_EQ(all.looks.size(), 2u);
  EXPECT_EQ(all.looks[1].name, "spring");
  EXPECT_TRUE(IsMovedAside("spring.old-12"));
  for (const char* name : {"spring", "old-1", "spring.old-", "spring.old-b", "spring.old", "7"}) {
    EXPECT_FALSE(IsMovedAside(name)) << name;
  }
}

TEST_F(LooksTest, ASurveyWithoutEpochsHasItsOwn) {
  EXPECT_EQ(ReadLooks(survey()).looks.size(), 1u);
  EXPECT_EQ(ReadLook(survey(), "").name, kOwnLook);
}

TEST_F(LooksTest, AnEpochAloneIsWhole) {
  Write(Epoch("a"), {Wall("W0", "old"), Wall("W1", "")});
  EXPECT_THAT(IdsOf(ReadLook(survey(), "a")), ElementsAre("W0", "W1"));
  for (const char* name : {"b", ".", "..", "../texture"}) {
    try {
      ReadLook(survey(), name);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_THAT(error.remedy(), HasSubstr("its epochs are a"));
    }
  }
}

}  // namespace
}  // namespace stucco
