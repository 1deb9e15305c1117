// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/text.h"

#include <gtest/gtest.h>

namespace stucco {
namespace {

TEST(ParseNumber, TakesWholeTextsOnly) {
  EXPECT_EQ(ParseNumber<double>("+4.5e1"), 45);
  EXPECT_EQ(ParseNumber<int>("-7"), -7);
  for (const char* text : {"", " 1", "1 ", "1,5", "+-1", "++1", "one"}) {
    EXPECT_FALSE(ParseNumber<double>(text)) << text;
  }
  EXPECT_FALSE(ParseNumber<int>("99999999999"));
}

TEST(Trim, TakesBlanksOffBothEnds) {
  EXPECT_EQ(Trim(" \t a b\r\n"), "a b");
  EXPECT_EQ(Trim(" \n"), "");
}

TEST(LowerCase, LeavesOtherLettersAlone) {
  EXPECT_EQ(LowerCase("IMG_Ä.JPG"), "img_Ä.jpg");
}

TEST(TakeWord, EmptiesTheLine) {
  std::string_view line = "  one\ttwo ";
  EXPECT_EQ(TakeWord(line), "one");
  EXPECT_EQ(TakeWord(line), "two");
  EXPECT_EQ(TakeWord(line), "");
  EXPECT_EQ(line, "");
}

TEST(TakeLine, KnowsBothLineEndsAndTheLastLine) {
  std::string_view text = "one\r\n\ntwo";
  EXPECT_EQ(TakeLine(text), "one");
  EXPECT_EQ(TakeLine(text), "");
  EXPECT_EQ(TakeLine(text), "two");
  EXPECT_EQ(TakeLine(text), std::nullopt);
}

}  // namespace
}  // namespace stucco
