// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/engine/fingerprint.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class ExportTest : public testing::Test {
 protected:
  void Write(const std::string& file, const std::string& text) {
    fs::create_directories((fake.survey / file).parent_path());
    WriteFile(fake.survey / file, text);
  }
  void Export(const std::string& format, bool overwrite = false) {
    ExportSurvey(fake.survey, format, out, overwrite);
  }
  Error Refused(const std::string& format) {
    try {
      Export(format);
    } catch (const Error& e) {
      return e;
    }
    return Error(ErrorKind::kInterrupted, "was not refused");
  }

  FakeSurvey fake;
  const fs::path out = fake.root / "deep/out";
};

TEST_F(ExportTest, EveryFormatSaysWhatHasToRunFirst) {
  for (const ExportFormat& format : ExportFormats()) {
    const Error error = Refused(format.name);
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput) << format.name;
    EXPECT_THAT(error.remedy(), HasSubstr("stucco " + format.stage + " ")) << format.name;
    EXPECT_FALSE(fs::exists(out)) << format.name;
  }
}

TEST_F(ExportTest, FilesAreCopiedAndNeverReplacedUnasked) {
  Write("texture/model.glb", "first");
  Export("glb");
  EXPECT_EQ(ReadFile(out), "first");
  Write("texture/model.glb", "second");
  EXPECT_THAT(Refused("glb").remedy(), HasSubstr("--overwrite"));
  EXPECT_EQ(ReadFile(out), "first");
  Export("glb", true);
  EXPECT_EQ(ReadFile(out), "second");
}

TEST_F(ExportTest, AnObjComesWithItsMaterialsAndPicturesAlone) {
  Write("texture/model.obj", "mtllib model.mtl");
  Write("texture/model.mtl", "map_Kd textures/a.png");
  Write("texture/textures/a.png", "png");
  Write("texture/orthophotos/a.png", "another");
  fs::create_directories(out);  // an empty folder is free
  Export("obj");
  EXPECT_THAT(FilesBelow(out), ElementsAre("model.mtl", "model.obj", "textures/a.png"));
  EXPECT_THAT(Refused("obj").what(), HasSubstr("exists already"));
}

TEST_F(ExportTest, AnUnknownFormatGetsASuggestion) {
  EXPECT_EQ(Refused("gltf").kind(), ErrorKind::kUsage);
  EXPECT_THAT(Refused("gltf").remedy(), HasSubstr("did you mean glb?"));
  EXPECT_THAT(Refused("collada").remedy(), HasSubstr("colmap-txt, colmap-bin, obj, glb, ply"));
}

}  // namespace
}  // namespace stucco
