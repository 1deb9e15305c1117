// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/escape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stucco {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(EscapeHtml, MakesMarkupText) {
  EXPECT_EQ(EscapeHtml("<script>alert('x')</script>"),
            "&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;");
  EXPECT_EQ(EscapeHtml("\" onerror=\"x"), "&quot; onerror=&quot;x");
  EXPECT_EQ(EscapeHtml("a & b &amp; c"), "a &amp; b &amp;amp; c");
  EXPECT_EQ(EscapeHtml("straße 😀 שלום"), "straße 😀 שלום");
  EXPECT_EQ(EscapeHtml(""), "");
}

TEST(CleanUtf8, ReplacesWhatIsNotText) {
  EXPECT_EQ(CleanUtf8("a\xff"
                      "b"),
            "a\xEF\xBF\xBD"
            "b");
  EXPECT_EQ(CleanUtf8("cut \xe6\xbc"), "cut \xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(CleanUtf8("\xc0\xaf"), "\xEF\xBF\xBD\xEF\xBF\xBD");  // an overlong slash
  EXPECT_EQ(CleanUtf8("\x1b[2J\t\n"), "\xEF\xBF\xBD[2J\t\n");
  EXPECT_EQ(CleanUtf8(std::string("a\0b", 3)),
            "a\xEF\xBF\xBD"
            "b");
}

TEST(IsolatedHtml, KeepsDirectionInside) {
  EXPECT_EQ(IsolatedHtml("\u202egpj.<b>"), "<bdi>\u202egpj.&lt;b&gt;</bdi>");
}

TEST(CsvField, QuotesOnlyWhatNeedsIt) {
  EXPECT_EQ(CsvField("plain"), "plain");
  EXPECT_EQ(CsvField("a,b"), "\"a,b\"");
  EXPECT_EQ(CsvField("say \"hi\""), "\"say \"\"hi\"\"\"");
  EXPECT_EQ(CsvField("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(CsvField(""), "");
}

TEST(UrlPath, EncodesAllButPlainCharacters) {
  EXPECT_EQ(UrlPath("textures/B0001_W03.png"), "textures/B0001_W03.png");
  EXPECT_EQ(UrlPath("a b\"#?%.png"), "a%20b%22%23%3F%25.png");
  EXPECT_EQ(UrlPath("ü"), "%C3%BC");
  EXPECT_THAT(UrlPath("javascript:alert(1)"), Not(HasSubstr(":")));
}

// The vectors of RFC 4648, section 10.
TEST(Base64, MatchesTheStandard) {
  EXPECT_EQ(Base64(""), "");
  EXPECT_EQ(Base64("f"), "Zg==");
  EXPECT_EQ(Base64("fo"), "Zm8=");
  EXPECT_EQ(Base64("foo"), "Zm9v");
  EXPECT_EQ(Base64("foob"), "Zm9vYg==");
  EXPECT_EQ(Base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(Base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(Base64(std::string("\xff\xff\xfe", 3)), "///+");
}

}  // namespace
}  // namespace stucco
