// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/page/evaluation_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/files.h"

namespace stucco::evaluate {
namespace {

using testing::HasSubstr;
using testing::Not;

Evaluation MadeEvaluation() {
  Evaluation evaluation;
  evaluation.survey = "a <b>survey</b>";
  evaluation.scene = "hamlet & co";
  evaluation.poses = {.posed = 41, .total = 42, .position_mean_m = 0.0123};
  evaluation.dense.all = {.error95_m = 0.031, .completeness = 0.871, .completeness_all = 0.62};
  evaluation.dense.wall = {.error95_m = 0.27, .completeness = 0.331, .completeness_all = 0.2};
  evaluation.painted = 0.715;
  FacadeFigures painted;
  painted.id = "B0001/F03";
  painted.facet = "B0001/W02";
  painted.area_m2 = 57.25;
  painted.painted = 0.93;
  painted.picture = {.ssim = 0.8125, .ms_ssim = 0.9, .psnr = 24.75, .gmsd = 0.11, .flip = 0.07};
  painted.texel_m = 0.02;
  painted.misregistration_px = 0.625;
  painted.truth_picture = "pictures/0000-a b\"c-truth.jpg";
  painted.result_picture = "pictures/r.jpg";
  painted.error_picture = "pictures/e.jpg";
  FacadeFigures bare;
  bare.id = "<script>alert(1)</script>";
  evaluation.facades = {painted, bare};
  return evaluation;
}

TEST(EvaluationHtml, HoldsTheFigures) {
  const std::string html = EvaluationHtml(MadeEvaluation());
  EXPECT_THAT(html, HasSubstr("41 of 42"));
  EXPECT_THAT(html, HasSubstr("1.2 cm"));
  EXPECT_THAT(html, HasSubstr("87 %"));
  EXPECT_THAT(html, HasSubstr("62 %"));
  EXPECT_THAT(html, HasSubstr("data-sort=\"0.8125\">0.812<"));
  EXPECT_THAT(html, HasSubstr("data-sort=\"0.0125\">1.2 cm"));
  EXPECT_THAT(html, HasSubstr("33 %"));
  EXPECT_THAT(html, HasSubstr("no facet of the result lies here"));
  EXPECT_THAT(html, HasSubstr("nothing painted"));
  // What no facade has is no column, what has no figures no section.
  EXPECT_THAT(html, Not(HasSubstr("LPIPS</button>")));
  EXPECT_THAT(html, Not(HasSubstr("id=\"views\"")));
  EXPECT_THAT(html, Not(HasSubstr("nan")));
}

TEST(EvaluationHtml, MakesTextOfNamesAndUrlsOfPaths) {
  const std::string html = EvaluationHtml(MadeEvaluation());
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(1)"));
  EXPECT_THAT(html, Not(HasSubstr("a <b>survey")));
  EXPECT_THAT(html, HasSubstr("src=\"pictures/0000-a%20b%22c-truth.jpg\""));
}

TEST(EvaluationHtml, TellsWhatCannotBeReadFromWhatIsNotPainted) {
  Evaluation evaluation;
  evaluation.facades.resize(1);
  EXPECT_THAT(EvaluationHtml(evaluation), HasSubstr("nothing painted"));
  evaluation.facades[0].problem = "gone.png: cannot be read";
  EXPECT_THAT(EvaluationHtml(evaluation), Not(HasSubstr("nothing painted")));
  EXPECT_THAT(EvaluationHtml(evaluation), HasSubstr("a picture cannot be read"));
}

TEST(EvaluationHtml, LoadsNothingFromElsewhere) {
  const std::string html = EvaluationHtml(MadeEvaluation());
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  EXPECT_THAT(html, Not(HasSubstr("http:")));
  EXPECT_THAT(html, Not(HasSubstr("https:")));
  EXPECT_THAT(html, Not(HasSubstr("@import")));
}

TEST(EvaluationHtml, ShowsLpipsPhotosAndNotesWhereThereAreSome) {
  Evaluation evaluation = MadeEvaluation();
  evaluation.facades[0].picture.lpips = 0.25;
  evaluation.views.push_back({"held_out/x.jpg", 0.625, {.ssim = 0.5}, "a.jpg", "b.jpg", "c.jpg"});
  evaluation.views_mean.psnr = 20;
  evaluation.views_compared = 0.625;
  evaluation.texture_mean.psnr = 20;
  evaluation.notes = {"no <mesh>"};
  const std::string html = EvaluationHtml(evaluation);
  EXPECT_THAT(html, HasSubstr("LPIPS</button>"));
  EXPECT_THAT(html, HasSubstr("id=\"views\""));
  EXPECT_THAT(html, HasSubstr("no &lt;mesh&gt;"));
  EXPECT_THAT(html, HasSubstr("72 %"));  // painted
  EXPECT_THAT(html, HasSubstr("62 %"));  // compared
}

TEST(EvaluationHtml, NothingMeasuredIsStillAPage) {
  const std::string html = EvaluationHtml({});
  EXPECT_THAT(html, HasSubstr("Against the truth"));
  EXPECT_THAT(html, Not(HasSubstr("id=\"facades\"")));
  EXPECT_THAT(html, HasSubstr("</html>"));
}

TEST(EvaluationHtml, AModelWithoutBuildingsSaysSo) {
  Evaluation evaluation;
  EXPECT_THAT(EvaluationHtml(evaluation), Not(HasSubstr("the truth has")));
  evaluation.proxy.truth_buildings = 3;
  EXPECT_THAT(EvaluationHtml(evaluation), HasSubstr("the truth has 3"));
}

TEST(WriteEvaluationPage, WritesIt) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "page";
  std::filesystem::create_directories(folder);
  WriteEvaluationPage(MadeEvaluation(), folder);
  EXPECT_EQ(ReadFile(folder / "evaluation.html"), EvaluationHtml(MadeEvaluation()));
}

}  // namespace
}  // namespace stucco::evaluate
