// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

namespace stucco {
namespace {

class OptionsTest : public ::testing::Test {
 protected:
  OptionsTest() {
    table_.Add("max_features", features_, 100, 1000000, "How many.");
    table_.Add("ratio", ratio_, 0, 1, "Ratio test.");
    table_.Add("use_gps", gps_, "Positions.");
    table_.Add("method", method_, {"fast", "exact"}, "Which one.");
    table_.Add("note", note_, {}, "Any text.");
    table_.Add("focal_px", focal_, "List.");
    table_.Add("verbosity", verbosity_, 0, 3, "Chatter.").affects_result = false;
  }

  int features_ = 8000;
  double ratio_ = 0.8;
  bool gps_ = true;
  std::string method_ = "fast";
  std::string note_;
  std::vector<double> focal_;
  int verbosity_ = 1;
  OptionTable table_{"calib"};
};

TEST_F(OptionsTest, SetsEveryType) {
  EXPECT_EQ(SetOption(table_, "max_features", int64_t{100}), "");
  EXPECT_EQ(SetOption(table_, "ratio", 0.5), "");
  EXPECT_EQ(SetOption(table_, "use_gps", false), "");
  EXPECT_EQ(SetOption(table_, "method", std::string("exact")), "");
  EXPECT_EQ(SetOption(table_, "note", std::string("hello")), "");
  EXPECT_EQ(SetOption(table_, "focal_px", std::vector<double>{1, 2.5}), "");
  EXPECT_EQ(features_, 100);
  EXPECT_EQ(ratio_, 0.5);
  EXPECT_FALSE(gps_);
  EXPECT_EQ(method_, "exact");
  EXPECT_EQ(note_, "hello");
  EXPECT_EQ(focal_, (std::vector<double>{1, 2.5}));
  EXPECT_EQ(SetOption(table_, "ratio", int64_t{1}), "");  // an integer where a double is meant
  EXPECT_EQ(ratio_, 1);
}

TEST_F(OptionsTest, SaysWhatIsWrongAndChangesNothing) {
  EXPECT_EQ(SetOption(table_, "max_features", int64_t{3}),
            "calib.max_features = 3 must be in [100, 1000000]");
  EXPECT_EQ(SetOption(table_, "max_features", int64_t{1} << 40),
            "calib.max_features = 1099511627776 must be in [100, 1000000]");
  EXPECT_EQ(SetOption(table_, "max_features", 500.0),
            "calib.max_features = 500.0 must be a whole number");
  EXPECT_EQ(SetOption(table_, "ratio", 1.5), "calib.ratio = 1.5 must be in [0, 1]");
  EXPECT_EQ(SetOption(table_, "ratio", std::numeric_limits<double>::quiet_NaN()),
            "calib.ratio = nan must be in [0, 1]");
  EXPECT_EQ(SetOption(table_, "ratio", true), "calib.ratio = true must be a number");
  EXPECT_EQ(SetOption(table_, "use_gps", int64_t{1}), "calib.use_gps = 1 must be true or false");
  EXPECT_EQ(SetOption(table_, "method", std::string("slow")),
            "calib.method = \"slow\" must be one of fast, exact");
  EXPECT_EQ(SetOption(table_, "note", false), "calib.note = false must be a text");
  EXPECT_EQ(SetOption(table_, "focal_px", std::vector<double>{1, INFINITY}),
            "calib.focal_px = [1.0, inf] must be a list of numbers");
  EXPECT_EQ(features_, 8000);
  EXPECT_EQ(ratio_, 0.8);
  EXPECT_EQ(method_, "fast");
  EXPECT_TRUE(focal_.empty());
}

TEST_F(OptionsTest, SuggestsTheNearestName) {
  EXPECT_EQ(SetOption(table_, "max_faetures", int64_t{500}),
            "calib.max_faetures: unknown option; did you mean calib.max_features?");
  EXPECT_EQ(SetOptionFromText(table_, "ratoi", "0.5"),
            "calib.ratoi: unknown option; did you mean calib.ratio?");
  EXPECT_EQ(SetOption(table_, "colour", true), "calib.colour: unknown option");
  EXPECT_EQ(table_.Suggestion(""), "");
  EXPECT_EQ(table_.Find("ratio")->help, "Ratio test.");
  EXPECT_EQ(table_.Find("Ratio"), nullptr);
}

TEST_F(OptionsTest, TakesText) {
  EXPECT_EQ(SetOptionFromText(table_, "max_features", "500"), "");
  EXPECT_EQ(SetOptionFromText(table_, "ratio", " +2.5e-1"), "");
  EXPECT_EQ(SetOptionFromText(table_, "use_gps", "0"), "");
  EXPECT_EQ(SetOptionFromText(table_, "note", " 12 "), "");
  EXPECT_EQ(SetOptionFromText(table_, "focal_px", "1, -2.5,3"), "");
  EXPECT_EQ(features_, 500);
  EXPECT_EQ(ratio_, 0.25);
  EXPECT_FALSE(gps_);
  EXPECT_EQ(note_, " 12 ");
  EXPECT_EQ(focal_, (std::vector<double>{1, -2.5, 3}));
  EXPECT_EQ(SetOptionFromText(table_, "focal_px", ""), "");
  EXPECT_TRUE(focal_.empty());
}

TEST_F(OptionsTest, RefusesTextOfAnotherType) {
  EXPECT_EQ(SetOptionFromText(table_, "max_features", "5e2"),
            "calib.max_features = \"5e2\" must be a whole number");
  EXPECT_EQ(SetOptionFromText(table_, "max_features", ""),
            "calib.max_features = \"\" must be a whole number");
  EXPECT_EQ(SetOptionFromText(table_, "max_features", "99999999999999999999"),
            "calib.max_features = \"99999999999999999999\" must be a whole number");
  EXPECT_EQ(SetOptionFromText(table_, "ratio", "0.5x"), "calib.ratio = \"0.5x\" must be a number");
  EXPECT_EQ(SetOptionFromText(table_, "ratio", "+-0.5"),
            "calib.ratio = \"+-0.5\" must be a number");
  EXPECT_EQ(SetOptionFromText(table_, "ratio", "nan"), "calib.ratio = nan must be in [0, 1]");
  EXPECT_EQ(SetOptionFromText(table_, "use_gps", "maybe"),
            "calib.use_gps = \"maybe\" must be true or false");
  EXPECT_EQ(SetOptionFromText(table_, "focal_px", "1,,2"),
            "calib.focal_px = \"1,,2\" must be a list of numbers");
}

TEST_F(OptionsTest, TomlDoublesReadBackExactly) {
  double value = 0;
  OptionTable table("t");
  const Option& option = table.Add("x", value, -1e300, 1e300, "");
  const auto toml = [&](double number) {
    value = number;
    return ValueAsToml(option);
  };
  EXPECT_EQ(toml(5), "5.0");
  EXPECT_EQ(toml(-0.0), "-0.0");
  EXPECT_EQ(toml(0.1), "0.1");
  for (const double number : {1.0 / 3, 1e300, 123456789.0, 5e-324, -2.5e-17, 1e22}) {
    const std::string text = toml(number);
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), number) << text;
    EXPECT_NE(text.find_first_of(".e"), std::string::npos) << text;
  }
}

TEST_F(OptionsTest, WritesEveryTypeAsToml) {
  note_ = "a \"b\"\\\n\t\x01 ü";
  focal_ = {1, 0.5};
  EXPECT_EQ(ValueAsToml(*table_.Find("max_features")), "8000");
  EXPECT_EQ(ValueAsToml(*table_.Find("use_gps")), "true");
  EXPECT_EQ(ValueAsToml(*table_.Find("note")), R"("a \"b\"\\\n\t\u0001 ü")");
  EXPECT_EQ(ValueAsToml(*table_.Find("focal_px")), "[1.0, 0.5]");
  focal_.clear();
  EXPECT_EQ(ValueAsToml(*table_.Find("focal_px")), "[]");
}

TEST_F(OptionsTest, CanonicalTextHoldsWhatAffectsResults) {
  EXPECT_EQ(CanonicalText(table_),
            "max_features = 8000\nratio = 0.8\nuse_gps = true\nmethod = \"fast\"\nnote = \"\"\n"
            "focal_px = []\n");
  const std::string before = CanonicalText(table_);
  verbosity_ = 3;
  EXPECT_EQ(CanonicalText(table_), before);
  ratio_ = 0.81;
  EXPECT_NE(CanonicalText(table_), before);
}

TEST(EditDistance, CountsSlips) {
  EXPECT_EQ(EditDistance("", ""), 0);
  EXPECT_EQ(EditDistance("", "abc"), 3);
  EXPECT_EQ(EditDistance("abc", ""), 3);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
  EXPECT_EQ(EditDistance("calib", "calib"), 0);
  EXPECT_EQ(EditDistance("flaw", "lawn"), 2);
}

TEST(OptionsDeathTest, RequireNamesOfTheirOwn) {
  OptionTable table("calib");
  bool value = false;
  table.Add("fast", value, "Fast.");
  EXPECT_DEATH(table.Add("fast", value, "Fast, too."), "Find");
}

}  // namespace
}  // namespace stucco
