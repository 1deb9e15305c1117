// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>

#include "plan/mission/internal/zip_archive.h"
#include "plan/mission/wpml_lint.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/plan/mission_fixture.h"

namespace stucco::plan {
namespace {

using test::Replaced;
using test::TemporaryFolder;

std::string Listed(const std::vector<LintFinding>& findings) {
  std::string text;
  for (const LintFinding& finding : findings) {
    text += finding.element + " | " + finding.rule + " | " + finding.text + "\n";
  }
  return text;
}

bool Has(const std::vector<LintFinding>& findings, const std::string& rule,
         const std::string& element_part) {
  for (const LintFinding& finding : findings) {
    if (finding.rule == rule && finding.element.find(element_part) != std::string::npos) {
      return true;
    }
  }
  return false;
}

struct Fault {
  const char* from;
  const char* to;
  const char* rule;
  const char* element;
};

std::string Waylines() {
  return WpmlWaylines(MissionRoutes(test::MakePlan())[0], test::Mavic3E());
}
std::string Template() {
  const Plan plan = test::MakePlan();
  return WpmlTemplate(plan, MissionRoutes(plan)[0], test::Mavic3E());
}

TEST(WpmlLint, FindsNothingInOurOwnFiles) {
  EXPECT_EQ(Listed(LintWaylines(Waylines())), "");
  EXPECT_EQ(Listed(LintTemplate(Template())), "");
}

TEST(WpmlLint, NamesRuleAndElementOfSeededFaults) {
  const std::vector<Fault> faults = {
      {"<kml ", "<kml <", "xml", ""},
      {"<kml", "<lmk", "xml", ""},
      {"http://www.dji.com/wpmz/1.0.2", "http://example.org/", "namespace", "kml"},
      {"safely", "carefully", "enum", "missionConfig/wpml:flyToWaylineMode"},
      {"<wpml:finishAction>goHome</wpml:finishAction>", "", "required", "wpml:finishAction"},
      {"<wpml:executeRCLostAction>goBack</wpml:executeRCLostAction>", "", "required",
       "executeRCLostAction"},
      {"<wpml:takeOffSecurityHeight>30.00</wpml:takeOffSecurityHeight>", "", "required",
       "takeOffSecurityHeight"},
      {"SecurityHeight>30.00<", "SecurityHeight>1.10<", "range", "takeOffSecurityHeight"},
      {"TransitionalSpeed>8.0<", "TransitionalSpeed>15.5<", "range", "globalTransitionalSpeed"},
      {"RTHHeight>30.00<", "RTHHeight>65535<", "unset", "globalRTHHeight"},
      {"droneEnumValue>77<", "droneEnumValue>7<", "enum", "droneInfo/wpml:droneEnumValue"},
      {"payloadEnumValue>66<", "payloadEnumValue>x<", "number", "payloadEnumValue"},
      {"PositionIndex>0<", "PositionIndex>3<", "range", "payloadInfo/wpml:payloadPositionIndex"},
      {"relativeToStartPoint", "aboveGround", "enum", "Folder/wpml:executeHeightMode"},
      {"<wpml:distance>231.5</wpml:distance>", "", "required", "Folder/wpml:distance"},
      {"<wpml:duration>195.0</wpml:duration>", "<wpml:duration/>", "unset", "wpml:duration"},
      {"autoFlightSpeed>5.0<", "autoFlightSpeed>0<", "range", "autoFlightSpeed"},
      {"<wpml:index>2<", "<wpml:index>3<", "index", "Placemark[2]/wpml:index"},
      {"<wpml:index>2<", "<wpml:index>2.5<", "number", "Placemark[2]/wpml:index"},
      {"<wpml:executeHeight>8.00<", "<wpml:executeHeight>-2000<", "range",
       "Placemark[1]/wpml:executeHeight"},
      {"<wpml:executeHeight>8.00</wpml:executeHeight>", "", "required",
       "Placemark[1]/wpml:executeHeight"},
      {"<wpml:executeHeight>8.00</wpml:executeHeight>",
       "<wpml:executeHeight>8</wpml:executeHeight><wpml:executeHeight>8</wpml:executeHeight>",
       "once", "Placemark[1]/wpml:executeHeight"},
      {"<wpml:index>0</wpml:index>",
       "<wpml:executeHeight>30.00</wpml:executeHeight><wpml:index>0</wpml:index>", "order",
       "Placemark[0]/wpml:index"},
      {"waypointSpeed>5.0<", "waypointSpeed>16<", "range", "waypointSpeed"},
      {"<coordinates>4.", "<coordinates>lon4.", "coordinates", "Placemark[0]/Point/coordinates"},
      {"<coordinates>4.", "<coordinates>194.", "coordinates", "Placemark[0]/Point/coordinates"},
      {"smoothTransition", "smooth", "enum", "waypointHeadingParam/wpml:waypointHeadingMode"},
      {"<wpml:waypointHeadingAngle>0.00</wpml:waypointHeadingAngle>", "", "required",
       "Placemark[0]/wpml:waypointHeadingParam/wpml:waypointHeadingAngle"},
      {"HeadingAngle>0.00<", "HeadingAngle>270<", "range", "waypointHeadingAngle"},
      {"followBadArc", "shortest", "enum", "waypointHeadingPathMode"},
      {"toPointAndStopWithDiscontinuityCurvature", "stop", "enum", "waypointTurnMode"},
      {"<wpml:waypointTurnMode>toPointAndStopWithDiscontinuityCurvature</wpml:waypointTurnMode>\n"
       "     <wpml:waypointTurnDampingDist>0<",
       "<wpml:waypointTurnMode>coordinateTurn</wpml:waypointTurnMode>"
       "<wpml:waypointTurnDampingDist>500<",
       "damping", "Placemark[1]/wpml:waypointTurnParam"},
      {"<wpml:waypointTurnMode>toPointAndStopWithDiscontinuityCurvature</wpml:waypointTurnMode>\n"
       "     <wpml:waypointTurnDampingDist>0</wpml:waypointTurnDampingDist>",
       "<wpml:waypointTurnMode>coordinateTurn</wpml:waypointTurnMode>", "required",
       "Placemark[0]/wpml:waypointTurnParam/wpml:waypointTurnDampingDist"},
      {"<wpml:useStraightLine>1<", "<wpml:useStraightLine>2<", "enum", "useStraightLine"},
      {"actionGroupId>1<", "actionGroupId>0<", "action-group-id",
       "Placemark[3]/wpml:actionGroup[0]/wpml:actionGroupId"},
      {"GroupStartIndex>1<", "GroupStartIndex>2<", "action-group-range",
       "Placemark[1]/wpml:actionGroup[0]/wpml:actionGroupEndIndex"},
      {"GroupEndIndex>1<", "GroupEndIndex>5<", "action-group-range", "actionGroupEndIndex"},
      {"sequence", "series", "enum", "actionGroupMode"},
      {"reachPoint", "arrive", "enum", "actionTrigger/wpml:actionTriggerType"},
      {"actionGroupId>1<", "actionGroupId>1e300<", "range", "actionGroupId"},
      {"reachPoint", "multipleTiming", "required", "actionTrigger/wpml:actionTriggerParam"},
      {"reachPoint", "betweenAdjacentPoints", "trigger", "Placemark[1]/wpml:actionGroup[0]"},
      {"<wpml:actionId>1<", "<wpml:actionId>0<", "action-id", "wpml:action[1]/wpml:actionId"},
      {"Func>rotateYaw<", "Func>turn<", "enum", "actionActuatorFunc"},
      {"aircraftHeading>0.00<", "aircraftHeading>181<", "range", "aircraftHeading"},
      {"clockwise", "left", "enum", "aircraftPathMode"},
      {"PitchRotateAngle>-35.25<", "PitchRotateAngle>-125<", "range", "gimbalPitchRotateAngle"},
      {"absoluteAngle", "absolute", "enum", "gimbalRotateMode"},
      {"<wpml:gimbalPitchRotateAngle>0.00</wpml:gimbalPitchRotateAngle>", "", "required",
       "gimbalPitchRotateAngle"},
      {"<wpml:gimbalYawRotateEnable>0<", "<wpml:gimbalYawRotateEnable>yes<", "enum",
       "gimbalYawRotateEnable"},
      {"hoverTime>1.5<", "hoverTime>0<", "hover-time", "hoverTime"},
      {"fileSuffix>h000v0<", "fileSuffix>h000/v0<", "file-suffix", "fileSuffix"},
      {"fileSuffix>h000v0<", "fileSuffix>fassadeä<", "file-suffix", "fileSuffix"},
      {"fileSuffix>h000v0<", "fileSuffix>h000v1<", "file-suffix-unique", "fileSuffix"},
      {"<wpml:fileSuffix>h000v0</wpml:fileSuffix>", "<wpml:fileSuffix></wpml:fileSuffix>", "unset",
       "fileSuffix"},
  };
  const std::string good = Waylines();
  std::set<std::string> rules;
  for (const Fault& fault : faults) {
    SCOPED_TRACE(std::string(fault.from) + " -> " + fault.to);
    const auto findings = LintWaylines(Replaced(good, fault.from, fault.to));
    EXPECT_TRUE(Has(findings, fault.rule, fault.element)) << Listed(findings);
    EXPECT_TRUE(Has(findings, fault.rule, "wpmz/waylines.wpml")) << Listed(findings);
    rules.insert(fault.rule);
  }
  EXPECT_GE(rules.size(), 17u);
}

TEST(WpmlLint, KnowsTheRulesOfTheTemplate) {
  const std::vector<Fault> faults = {
      {"<wpml:templateType>waypoint<", "<wpml:templateType>points<", "enum", "templateType"},
      {"<wpml:heightMode>relativeToStartPoint<", "<wpml:heightMode>ground<", "enum", "heightMode"},
      {"usePointSetting", "auto", "enum", "gimbalPitchMode"},
      {"imageFormat>visible<", "imageFormat>visible,xray<", "enum", "imageFormat"},
      {"<wpml:height>30.00</wpml:height>", "", "required", "Placemark[0]/wpml:height"},
      {"<wpml:useGlobalSpeed>1<", "<wpml:useGlobalSpeed>0<", "required",
       "Placemark[0]/wpml:waypointSpeed"},
      {"takeOffRefPoint>52.", "takeOffRefPoint>152.", "coordinates", "takeOffRefPoint"},
      {"takeOffRefPoint>52.", "takeOffRefPoint>52;", "coordinates", "takeOffRefPoint"},
      {"takeOffRefPoint>52.0", "takeOffRefPoint>4.0", "take-off", "Placemark[0]/Point/coordinates"},
      {"<wpml:gimbalPitchAngle>0.00<", "<wpml:gimbalPitchAngle>50<", "range", "gimbalPitchAngle"},
  };
  const std::string good = Template();
  for (const Fault& fault : faults) {
    SCOPED_TRACE(std::string(fault.from) + " -> " + fault.to);
    const auto findings = LintTemplate(Replaced(good, fault.from, fault.to));
    EXPECT_TRUE(Has(findings, fault.rule, fault.element)) << Listed(findings);
  }
}

TEST(WpmlLint, TakeOffMayBeBeyondTheDateLine) {
  std::string text = Template();
  const size_t home = text.find(",4.35", text.find("takeOffRefPoint>"));
  ASSERT_NE(home, std::string::npos);
  text.replace(home, 5, ",-179.99");
  EXPECT_TRUE(Has(LintTemplate(text), "take-off", "coordinates"));
  while (text.find("<coordinates>4.35") != std::string::npos) {
    text = Replaced(text, "<coordinates>4.35", "<coordinates>179.99");
  }
  EXPECT_EQ(Listed(LintTemplate(text)), "");
}

TEST(WpmlLint, TemplatesKeepToNoOrder) {
  const std::string moved =
      Replaced(Replaced(Template(), "<wpml:useGlobalHeight>0</wpml:useGlobalHeight>", ""),
               "<wpml:useStraightLine>1</wpml:useStraightLine>",
               "<wpml:useStraightLine>1</wpml:useStraightLine><wpml:useGlobalHeight>0</"
               "wpml:useGlobalHeight>");
  EXPECT_EQ(Listed(LintTemplate(moved)), "");
}

TEST(WpmlLint, CountsWaypoints) {
  Plan plan = test::MakePlan();
  std::vector<MissionRoute> routes = MissionRoutes(plan);
  routes[0].stops.resize(1);
  EXPECT_TRUE(Has(LintWaylines(WpmlWaylines(routes[0], test::Mavic3E())), "waypoint-count",
                  "Folder/Placemark"));
  routes[1].stops.push_back(routes[1].stops.back());
  EXPECT_TRUE(Has(LintWaylines(WpmlWaylines(routes[1], test::Mavic3E())), "leg", "Placemark"));
}

TEST(WpmlLint, RefusesWhatIsNoMission) {
  EXPECT_TRUE(Has(LintWaylines(""), "xml", ""));
  EXPECT_TRUE(Has(LintWaylines("<gpx/>"), "required", "kml"));
  const std::string empty =
      "<kml xmlns:wpml=\"http://www.dji.com/wpmz/1.0.2\"><Document></Document></kml>";
  EXPECT_TRUE(Has(LintWaylines(empty), "required", "wpml:missionConfig"));
  EXPECT_TRUE(Has(LintWaylines(empty), "required", "Folder"));
}

TEST(WpmlLint, LooksIntoTheArchive) {
  const TemporaryFolder folder;
  const auto with = [&](const std::vector<internal::ZipEntry>& entries, const std::string& name) {
    internal::WriteZip(folder / name, entries);
    return LintKmz(folder / name);
  };
  const internal::ZipEntry shown = {"wpmz/template.kml", Template()};
  const internal::ZipEntry flown = {"wpmz/waylines.wpml", Waylines()};
  EXPECT_EQ(Listed(with({shown, flown}, "m.kmz")), "");
  EXPECT_TRUE(Has(with({shown, flown}, "m.zip"), "file-name", "m.zip"));
  EXPECT_TRUE(Has(with({shown}, "m.kmz"), "zip-path", "waylines.wpml"));
  EXPECT_TRUE(Has(with({flown}, "m.kmz"), "zip-path", "template.kml"));
  EXPECT_TRUE(Has(with({shown, flown, {"readme", "x"}}, "m.kmz"), "zip-path", "readme"));
  EXPECT_TRUE(Has(with({shown, {"waylines.wpml", flown.bytes}}, "m.kmz"), "zip-path",
                  "wpmz/waylines.wpml"));
  EXPECT_THROW(LintKmz(folder / "none.kmz"), Error);
}

TEST(WpmlLint, TemplateAndWaylinesMustAgree) {
  const TemporaryFolder folder;
  const auto with = [&](const char* from, const char* to) {
    internal::WriteZip(folder / "m.kmz", {{"wpmz/template.kml", Replaced(Template(), from, to)},
                                          {"wpmz/waylines.wpml", Waylines()}});
    return LintKmz(folder / "m.kmz");
  };
  EXPECT_TRUE(Has(with("<coordinates>4.3", "<coordinates>4.4"), "agreement",
                  "Placemark[0]/Point/coordinates"));
  EXPECT_TRUE(Has(with("<wpml:height>8.00<", "<wpml:height>9.00<"), "agreement",
                  "Placemark[1]/wpml:height"));
  EXPECT_TRUE(Has(with("RTHHeight>30.00<", "RTHHeight>31.00<"), "agreement", "globalRTHHeight"));
  EXPECT_TRUE(Has(with("droneEnumValue>77<", "droneEnumValue>67<"), "agreement", "droneInfo"));
  Plan plan = test::MakePlan();
  std::vector<MissionRoute> routes = MissionRoutes(plan);
  routes[0].stops.pop_back();
  internal::WriteZip(folder / "m.kmz",
                     {{"wpmz/template.kml", Template()},
                      {"wpmz/waylines.wpml", WpmlWaylines(routes[0], test::Mavic3E())}});
  EXPECT_TRUE(Has(LintKmz(folder / "m.kmz"), "agreement", "Placemark[4]"));
}

// Damaged files give findings or an Error, whatever the damage.
TEST(WpmlLint, SurvivesDamage) {
  const std::string good = Waylines();
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    std::string bad = good;
    for (int k = 0; k < 4; ++k) {
      const size_t at = random() % bad.size();
      switch (random() % 3) {
        case 0:
          bad[at] = static_cast<char>(random());
          break;
        case 1:
          bad.erase(at, random() % 200);
          break;
        default:
          bad.insert(at, bad.substr(random() % bad.size(), random() % 200));
      }
    }
    LintWaylines(bad);
    LintTemplate(bad);
  }
  const TemporaryFolder folder;
  internal::WriteZip(folder / "good.kmz", {{"wpmz/waylines.wpml", good}});
  const std::string archive = ReadFile(folder / "good.kmz");
  for (int i = 0; i < 200; ++i) {
    std::string bad = archive;
    for (int k = 0; k < 3; ++k) bad[random() % bad.size()] = static_cast<char>(random());
    WriteFile(folder / "bad.kmz", bad);
    try {
      LintKmz(folder / "bad.kmz");
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("bad.kmz"), std::string::npos);
    }
  }
}

// Missions of other programs, which are not part of the repository: they are looked for in the
// folder that STUCCO_DATA names.
class MissionSamples : public testing::Test {
 protected:
  void SetUp() override {
    const char* named = std::getenv("STUCCO_DATA");
    folder_ = std::filesystem::path(named != nullptr ? named : STUCCO_ROOT "/../shared/data") /
              "mission_samples";
    if (!std::filesystem::is_directory(folder_)) GTEST_SKIP() << folder_ << " is not here";
  }

  static std::set<std::string> Rules(const std::vector<LintFinding>& findings) {
    std::set<std::string> rules;
    for (const LintFinding& finding : findings) {
      rules.insert(finding.rule + " " +
                   finding.element.substr(finding.element.find_last_of("/: ") + 1));
    }
    return rules;
  }

  std::filesystem::path folder_;
};

TEST_F(MissionSamples, DjiFlyMissionLacksOnlyItsFigures) {
  const auto findings = LintKmz(folder_ / "dji_wpml_waygen" / "waygen_zipped_by_us.kmz");
  EXPECT_EQ(Rules(findings), (std::set<std::string>{"required distance", "required duration"}))
      << Listed(findings);
}

TEST_F(MissionSamples, DocumentationExampleHasNoPlaces) {
  const auto findings = LintWaylines(ReadFile(folder_ / "dji_wpml_M30_template" / "waylines.wpml"));
  EXPECT_EQ(Rules(findings), (std::set<std::string>{"coordinates coordinates", "required distance",
                                                    "required duration"}))
      << Listed(findings);
}

}  // namespace
}  // namespace stucco::plan
