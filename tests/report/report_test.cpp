// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "survey/error.h"
#include "survey/files.h"
#include "survey/plan_io.h"
#include "survey/survey_folder.h"
#include "tests/report/made_survey.h"

namespace stucco {
namespace {

class Report : public testing::Test {
 protected:
  void Run(const ReportOptions& options = {}, std::vector<StageStatus> statuses = {},
           int threads = 2) {
    StageContext context;
    context.survey = folder_.path();
    context.out = folder_.path() / "out";
    context.threads = threads;
    context.progress = &SilentProgress();
    context.units = &NoUnits();
    context.statuses = std::move(statuses);
    std::filesystem::create_directories(context.out);
    RunReport(options, context);
  }

  std::string Output(const char* name) { return ReadFile(folder_.path() / "out" / name); }
  std::string Page() { return Output("report.html"); }
  nlohmann::json Json() { return nlohmann::json::parse(Output("report.json")); }

  test::TemporaryFolder folder_;
};

size_t CountOf(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// The page without its own style and script: what comes from data.
std::string Content(const std::string& page) {
  return page.substr(page.find("<body>"), page.rfind("<script>") - page.find("<body>"));
}

TEST_F(Report, AnswersFirst) {
  WriteSurvey(MakeSurvey(), folder_.path());
  Run();
  const std::string page = Page();
  EXPECT_TRUE(Has(page, "of 12 facades are good."));
  EXPECT_TRUE(Has(page, "21 of 22 photos posed"));
  EXPECT_EQ(CountOf(page, "<tr data-index="), 15U);
  EXPECT_EQ(CountOf(page, "<dialog "), 15U);
  EXPECT_EQ(CountOf(page, "alt=\"Picture of B0001/W01\""), 2U);
  EXPECT_FALSE(Has(page, "class=\"attention"));
  EXPECT_LT(page.find("facades are good"), page.find("facade-table\""));
}

TEST_F(Report, LoadsNothingFromOutside) {
  WriteSurvey(MakeSurvey(), folder_.path());
  Run();
  const std::string page = Content(Page());
  EXPECT_EQ(CountOf(page, "src="), CountOf(page, "src=\"data:"));  // data: only
  EXPECT_FALSE(Has(page, "http://"));
  EXPECT_FALSE(Has(page, "https://"));
  EXPECT_FALSE(Has(Page(), "@import"));
  EXPECT_FALSE(Has(Page(), "url("));
  EXPECT_FALSE(Has(Page(), "<link"));
  EXPECT_TRUE(Has(Page(), "default-src 'none'"));
}

TEST_F(Report, TablesAndDialogsAreClosed) {
  WriteSurvey(MakeSurvey(), folder_.path());
  Run();
  const std::string page = Content(Page());
  for (const char* tag : {"table", "tr", "td", "section", "dialog", "figure", "ul", "li", "dl",
                          "dd", "div", "span", "button", "svg", "g", "bdi", "p", "h2", "details"}) {
    const std::regex opening(std::string("<") + tag + "[ >]");
    const auto opened = std::distance(std::sregex_iterator(page.begin(), page.end(), opening), {});
    EXPECT_EQ(static_cast<size_t>(opened), CountOf(page, std::string("</") + tag + ">")) << tag;
  }
}

TEST_F(Report, SaysWhatEachBuildingIsMadeFrom) {
  MadeSurvey made = MakeSurvey({.buildings = 4});
  const char* details[] = {"full", "extrusion", "coarse", ""};
  for (int i = 0; i < 4; ++i) {
    made.proxy.buildings[i].watertight = i < 3;
    made.proxy.buildings[i].detail = details[i];
    if (i < 3) made.proxy.buildings[i].source = "map";
  }
  for (Facet& facet : made.proxy.buildings[1].facets) facet.seen = 0.37;
  WriteSurvey(made, folder_.path());
  Run();
  const std::string page = Content(Page());
  EXPECT_TRUE(Has(page, "3 of 4 buildings closed."));
  for (const char* form : {"every roof plane that was found", "only its large roof planes",
                           "the map's outline and height", "open: only facets"}) {
    EXPECT_EQ(CountOf(page, form), 1U) << form;
  }
  EXPECT_EQ(CountOf(page, "<td class=\"num\">37 %</td><td>on the map</td>"), 1U);
}

TEST_F(Report, SaysWhereTheMapAndThePhotosDisagree) {
  MadeSurvey made = MakeSurvey();
  WriteSurvey(made, folder_.path());
  Run();
  EXPECT_EQ(CountOf(Content(Page()), "<li>B0002: wings that the map lacks lean on it, 34 m2</li>"),
            1U);
  made.proxy.findings.clear();
  WriteSurvey(made, folder_.path());
  Run();
  EXPECT_FALSE(Has(Content(Page()), "Where the model, the map and photos differ"));
}

TEST_F(Report, NamesFacadesAsThePlanDoes) {
  MadeSurvey made = MakeSurvey();
  made.proxy.buildings[0].facets[0].planned_facades = {"B0007/F01"};
  WriteSurvey(made, folder_.path());
  Run();
  EXPECT_FALSE(Has(Content(Page()), "B0007"));
  EXPECT_FALSE(Has(Page(), "with-plan\" title"));
  Plan plan;
  plan.crs = "+proj=tmerc";
  for (const char* id : {"B0007/F00", "B0007/F01"}) {
    PlannedFacade facade;
    facade.id = id;
    facade.b_m = {8, 0};
    facade.predicted = {0.91, 0.82, 0.73, 0.94};
    plan.facades.push_back(facade);
  }
  std::filesystem::create_directories(folder_.path() / "plan");
  WritePlan(plan, folder_.path() / kPlanFile);
  Run();
  const std::string page = Content(Page());
  EXPECT_EQ(CountOf(page, "<bdi>B0007/F01</bdi>"), 2U);  // in the table and over its page
  EXPECT_EQ(CountOf(page, "Achieved quality and planned"), 1U);
  EXPECT_TRUE(Has(page, "0.73"));
  EXPECT_TRUE(Has(page, "one was not found in the model: <bdi>B0007/F00</bdi>"));
  EXPECT_EQ(Json()["facades"][0]["planned"]["q_u"], 0.73);
}

TEST_F(Report, LinksTheElevationsThatAreThere) {
  const MadeSurvey made = MakeSurvey();
  WriteSurvey(made, folder_.path());
  Run();
  EXPECT_FALSE(Has(Content(Page()), "elevations/"));
  const Building& building = made.proxy.buildings[1];
  const auto folder = folder_.path() / kElevationsFolder;
  std::filesystem::create_directories(folder);
  WriteFile(folder / ElevationFile(building), "a picture");
  Run();
  EXPECT_EQ(CountOf(Content(Page()), "\"../proxy/elevations/" + ElevationFile(building) + "\""),
            1U);
  EXPECT_EQ(CountOf(Content(Page()), "../proxy/elevations/"), 1U);
}

TEST_F(Report, SaysWhichPlannedPhotosAFacadeLacks) {
  MadeSurvey made = MakeSurvey();
  made.proxy.buildings[0].facets[0].planned_facades = {"B0007/F00"};
  made.textures.facets[0].painted = 0.1;  // so there is something to explain
  made.captures.views = {{"h7v0", "missing", ""}};
  WriteSurvey(made, folder_.path());
  Plan plan;
  plan.crs = "+proj=tmerc";
  PlannedFacade facade;
  facade.id = "B0007/F00";
  facade.b_m = {8, 0};
  facade.views = {"h7v0"};
  plan.facades.push_back(facade);
  PlannedView view;
  view.id = "h7v0";
  view.targets.push_back({"B0007/F00", {0, 8}, {0, 5}});
  plan.views.push_back(view);
  std::filesystem::create_directories(folder_.path() / "plan");
  WritePlan(plan, folder_.path() / kPlanFile);
  Run();
  const std::string lost = "its one planned photo is lost: h7v0 was not taken";
  const std::string page = Content(Page());
  EXPECT_EQ(CountOf(page, "; planned photos are lost</span>"), 1U);  // in the table
  EXPECT_EQ(CountOf(page, lost), 1U);                                // over the facade's page
  EXPECT_EQ(Json()["facades"][0]["lost_views"], lost);
  EXPECT_TRUE(Json()["facades"][1]["lost_views"].is_null());
}

TEST_F(Report, APlanThatCannotBeReadChangesNothing) {
  WriteSurvey(MakeSurvey(), folder_.path());
  Run();
  const std::string page = Page();
  std::filesystem::create_directories(folder_.path() / "plan");
  WriteFile(folder_.path() / kPlanFile, "{}");
  Run();
  EXPECT_EQ(Page(), page);
  EXPECT_TRUE(Json()["plan"].is_null());
}

TEST_F(Report, AnEmptySurveyGetsOneToo) {
  Run();
  EXPECT_TRUE(Has(Page(), "There are no facades yet."));
  EXPECT_TRUE(Has(Page(), "Not run yet:"));
  EXPECT_TRUE(Has(Page(), "stucco run SURVEY"));
  EXPECT_EQ(Json()["facades"].size(), 0U);
}

TEST_F(Report, OneFacade) {
  MadeSurvey made = MakeSurvey({.buildings = 1});
  made.proxy.buildings[0].facets.resize(1);
  made.textures.facets.resize(1);
  WriteSurvey(made, folder_.path());
  Run();
  EXPECT_TRUE(Has(Page(), "The one facade is good."));
  EXPECT_EQ(CountOf(Page(), "<tr data-index="), 1U);
}

TEST_F(Report, WallsThatNobodySeesAreNoHeadline) {
  MadeSurvey made = MakeSurvey({.buildings = 1});
  for (Facet& facet : made.proxy.buildings[0].facets) facet.party = 1;
  WriteSurvey(made, folder_.path());
  Run();
  EXPECT_TRUE(Has(Page(), "No wall shows enough to be rated"));
}

TEST_F(Report, NoFacadeAtAll) {
  MadeSurvey made = MakeSurvey({.buildings = 0});
  WriteSurvey(made, folder_.path());
  Run();
  EXPECT_TRUE(Has(Page(), "There are no facades yet."));
  EXPECT_TRUE(Has(Page(), "Reprojection error"));
}

TEST_F(Report, BeginsWithWhatFailed) {
  WriteSurvey(MakeSurvey(), folder_.path());
  std::filesystem::remove(folder_.path() / kTexturesFile);
  StageStatus failed;
  failed.stage = "texture";
  failed.state = "failed";
  failed.why = "no <space> left";
  failed.remedy = "free 2 GB";
  Run({}, {failed});
  const std::string page = Page();
  EXPECT_TRUE(Has(page, "<bdi>texture</bdi> failed"));
  EXPECT_TRUE(Has(page, "no &lt;space&gt; left"));
  EXPECT_TRUE(Has(page, "free 2 GB"));
  EXPECT_LT(page.find("Processing stopped"), page.find("facade-table\""));
  EXPECT_TRUE(Has(page, "not painted yet"));
  EXPECT_EQ(Json()["attention"][0]["why"], "no <space> left");
  EXPECT_TRUE(Json()["facades"][0]["verdict"].is_null());
}

TEST_F(Report, HalfASurvey) {
  WriteSurvey(MakeSurvey(), folder_.path());
  for (const char* stage : {"proxy", "texture"}) {
    std::filesystem::remove_all(folder_.path() / stage);
  }
  Run();
  EXPECT_TRUE(Has(Page(), "Reprojection error"));
  EXPECT_TRUE(Has(Page(), "3 photos left out"));
}

TEST_F(Report, FilesDeletedBehindItsBack) {
  WriteSurvey(MakeSurvey(), folder_.path());
  std::filesystem::remove_all(folder_.path() / "texture/textures");
  std::filesystem::remove_all(folder_.path() / "calib/sparse");
  std::filesystem::remove(folder_.path() / kCapturesFile);
  Run();
  EXPECT_TRUE(Has(Page(), "texture/textures/B0001_W01.png is missing"));
  EXPECT_TRUE(Has(Page(), "of 12 facades are good."));
}

TEST_F(Report, HostileNamesStayText) {
  MadeSurvey made = MakeSurvey();
  const std::string names[] = {"<script>alert(1)</script>.jpg",
                               "\"><img src=x onerror=alert(1)>",
                               "'quotes' & \"more\"",
                               "emoji 😀.jpg",
                               "\u202egpj.exe",
                               std::string(300, 'x'),
                               "</dialog></table>"};
  for (size_t i = 0; i < std::size(names); ++i) {
    made.textures.facets[0].photos.push_back(names[i]);
    made.textures.facets[0].gains[names[i]] = 1;
    made.calibration.unposed.push_back({names[i], names[i]});
    made.calibration.findings.push_back(names[i]);
    made.proxy.findings.push_back(names[i]);
    CalibratedPoint& point = made.calibration.ground_control.emplace_back();
    point.name = point.role = point.state = point.why = point.verdict = names[i];
    made.captures.photos[i].path = names[i];
    made.proxy.buildings[0].facets[0].source = names[i];
  }
  made.proxy.buildings[0].facets[1].id = made.textures.facets[1].id = names[1];
  made.calibration.cameras[0].label = names[0];
  WriteSurvey(made, folder_.path());
  // A file of somebody else's: ours are never written with such a frame.
  const std::filesystem::path georef_file = folder_.path() / kGeorefFile;
  nlohmann::json georef = nlohmann::json::parse(ReadFile(georef_file));
  georef["frame"] = names[2];
  WriteFile(georef_file, georef.dump());
  Run();
  const std::string page = Content(Page());
  EXPECT_EQ(CountOf(page, "<script"), 0U);
  EXPECT_EQ(CountOf(page, "<img src=x"), 0U);
  EXPECT_EQ(CountOf(page, "<img "), CountOf(page, "src=\"data:image/"));
  EXPECT_TRUE(Has(page, "&lt;script&gt;alert(1)&lt;/script&gt;.jpg"));
  EXPECT_TRUE(Has(page, "emoji 😀.jpg"));
  EXPECT_TRUE(Has(page, "<bdi>\u202egpj.exe</bdi>"));
  EXPECT_EQ(CountOf(page, "</dialog>"), 15U);
}

TEST_F(Report, ShowsGroundControl) {
  MadeSurvey made = MakeSurvey();
  made.georef.source = "gcp";
  CalibratedPoint point;
  point.name = "P<1>";
  point.role = "check";
  point.state = "measured";
  point.photos = 5;
  point.error_m = {0.0124, -0.031, 0.2};
  point.reprojection_error_px = 0.8;
  point.ground_pixel_m = 0.02;
  point.verdict = "red";
  CalibratedPoint unseen;
  unseen.name = "P2";
  unseen.role = "control";
  unseen.state = "not seen";
  unseen.why = "marked in 1 photo with a pose, two are needed";
  made.calibration.ground_control = {point, unseen};
  made.calibration.check_rms = CalibratedPointSet{1, 0.0124, 0.031, 0.0334, 0.2, 0.8, 0.02, "red"};
  WriteSurvey(made, folder_.path());
  Run();
  const std::string page = Content(Page());
  EXPECT_TRUE(Has(page, "P&lt;1&gt;"));
  EXPECT_TRUE(Has(page, "<td class=\"num\">-0.031</td>"));
  EXPECT_TRUE(Has(page, "marked in 1 photo"));
  EXPECT_TRUE(Has(page, "Check points"));
  EXPECT_TRUE(Has(page, "known from ground control points"));
  EXPECT_TRUE(Has(page, "10.0"));  // pixels on the ground, vertically
  const auto json = Json()["calibration"]["ground_control"];
  EXPECT_EQ(json["points"].size(), 2U);
  EXPECT_EQ(json["points"][0]["verdict"], "red");
  EXPECT_DOUBLE_EQ(json["check"]["vertical_rms_m"], 0.2);
  EXPECT_TRUE(json["control"].is_null());
}

TEST_F(Report, SaysHowSurelyPhotosArePlaced) {
  MadeSurvey made = MakeSurvey();
  std::vector<CalibratedPhoto>& photos = made.calibration.photos;
  for (size_t i = 0; i < photos.size(); ++i) {
    photos[i].position_sigma = 0.012;
    photos[i].rotation_sigma_deg = 0.02;
    photos[i].picture_sigma_px = 0.4;
  }
  photos[4].state = PhotoState::kWeak;
  photos[4].why = "only 23 points <hold> it";
  photos[4].position_sigma = 0.31;
  photos[4].picture_sigma_px = 3.2;
  photos[5].part = 1;  // of a model apart
  CalibratedPhoto& unposed = photos.emplace_back();
  unposed.path = "left/out.jpg";
  unposed.state = PhotoState::kRecordOnly;
  unposed.part = -1;
  unposed.position_sigma = 0.9;
  unposed.rotation_sigma_deg = 0.35;
  made.calibration.parts = {{"sparse/0", 18, 900}, {"sparse/1", 1, 50, "nothing"}};
  made.calibration.parts[1].why = "nothing joins <them>";
  made.textures.facets[0].photos = {photos[3].path, photos[4].path};
  WriteSurvey(made, folder_.path());
  Run();
  const std::string page = Content(Page());
  EXPECT_TRUE(Has(page, "How surely photos are placed"));
  EXPECT_TRUE(Has(page, "± 1.2 cm"));
  EXPECT_TRUE(Has(page, "± 0.4 px"));
  EXPECT_TRUE(Has(page, "2 photos not to trust"));
  EXPECT_TRUE(Has(page, "only 23 points &lt;hold&gt; it"));
  EXPECT_TRUE(Has(page, "± 90.0 cm"));
  EXPECT_TRUE(Has(page, "nothing joins &lt;them&gt;"));
  const auto painted_by_it =
      std::ranges::count_if(made.textures.facets, [&](const TexturedFacet& facet) {
        return std::ranges::count(facet.photos, photos[4].path) > 0;
      });
  EXPECT_GT(painted_by_it, 0);
  EXPECT_EQ(CountOf(page, "weakly placed"), static_cast<size_t>(painted_by_it));
  const auto json = Json();
  const auto placement = json["calibration"]["placement"];
  EXPECT_EQ(placement["states"]["weak"], 1);
  EXPECT_EQ(placement["states"]["record-only"], 1);
  EXPECT_EQ(placement["states"]["ambiguous"], 0);
  EXPECT_EQ(placement["states"]["tied"], photos.size() - 3);
  EXPECT_DOUBLE_EQ(placement["middle"]["position"], 0.012);
  EXPECT_DOUBLE_EQ(placement["nine_in_ten"]["picture_px"], 0.4);
  ASSERT_EQ(placement["not_to_trust"].size(), 2U);
  EXPECT_EQ(placement["not_to_trust"][0]["path"], "left/out.jpg");
  EXPECT_TRUE(placement["not_to_trust"][0]["picture_sigma_px"].is_null());
  EXPECT_EQ(placement["not_to_trust"][1]["state"], "weak");
  EXPECT_EQ(placement["parts"].size(), 2U);
  EXPECT_DOUBLE_EQ(json["facades"][0]["photos_placed_px"]["largest"], 3.2);
}

TEST_F(Report, SaysNothingOfPlacesThatAreNotKnown) {
  WriteSurvey(MakeSurvey(), folder_.path());
  Run();
  EXPECT_FALSE(Has(Page(), "How surely photos are placed"));
  EXPECT_TRUE(Json()["calibration"]["placement"]["middle"].is_null());
  EXPECT_TRUE(Json()["facades"][0]["photos_placed_px"].is_null());
}

TEST_F(Report, NeverSaysMetresWithoutScale) {
  MadeSurvey made = MakeSurvey({.metric = false});
  made.calibration.cameras[0].label = "no millimetres of a lens";
  WriteSurvey(made, folder_.path());
  Run();
  const std::string page = Content(Page());
  EXPECT_TRUE(Has(page, "units²"));
  EXPECT_TRUE(Has(page, "nothing fixes the scale"));
  EXPECT_FALSE(std::regex_search(page, std::regex("[0-9] ?(m|cm|mm|m²)[^a-z0-9A-Z=/+]")));
  EXPECT_FALSE(Has(page, " metres"));
}

TEST_F(Report, TimesOnlyOnRequest) {
  WriteSurvey(MakeSurvey(), folder_.path());
  StageStatus done;
  done.stage = "calib";
  done.state = "done";
  done.wall_s = 200;
  done.peak_memory_mb = 777;
  Run({}, {done});
  EXPECT_FALSE(Has(Page(), "3 min 20 s"));
  Run({.record_times = true}, {done});
  EXPECT_TRUE(Has(Page(), "3 min 20 s"));
  EXPECT_TRUE(Has(Page(), "777 MiB"));
}

TEST_F(Report, BytesDependOnTheSurveyAlone) {
  const MadeSurvey made = MakeSurvey();
  WriteSurvey(made, folder_.path());
  Run({}, {}, 1);
  const std::string page = Page();
  const std::string json = Output("report.json");
  const std::string csv = Output("facades.csv");
  EXPECT_FALSE(Has(page, folder_.path().string()));
  Run({}, {}, 4);
  EXPECT_EQ(Page(), page);
  const test::TemporaryFolder elsewhere;
  WriteSurvey(made, elsewhere.path());
  StageContext context;
  context.survey = context.out = elsewhere.path();
  context.progress = &SilentProgress();
  context.units = &NoUnits();
  RunReport({}, context);
  EXPECT_EQ(ReadFile(elsewhere.path() / "report.html"), page);
  EXPECT_EQ(ReadFile(elsewhere.path() / "report.json"), json);
  EXPECT_EQ(ReadFile(elsewhere.path() / "facades.csv"), csv);
}

TEST_F(Report, ExplainsItsLimits) {
  WriteSurvey(MakeSurvey(), folder_.path());
  Run({.coverage_amber_below = 0.77, .gsd_red_above = 4.5});
  EXPECT_TRUE(Has(Page(), "below 77 %"));
  EXPECT_TRUE(Has(Page(), "above 4.5 times"));
}

TEST(DescribeReport, EveryOptionHasHelpAndADefaultInRange) {
  ReportOptions options;
  OptionTable table("report");
  Describe(table, options);
  EXPECT_EQ(table.options().size(), 13U);
  for (const Option& option : table.options()) {
    EXPECT_FALSE(option.help.empty()) << option.name;
    if (const auto* value = std::get_if<double*>(&option.value)) {
      EXPECT_GE(**value, option.min) << option.name;
      EXPECT_LE(**value, option.max) << option.name;
    }
  }
}

}  // namespace
}  // namespace stucco
