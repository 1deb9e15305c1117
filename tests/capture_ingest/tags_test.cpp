// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/tags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/capture_ingest/photo_maker.h"

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::Optional;

TEST(ParseNumbers, ReadsFractionsSignsAndLists) {
  EXPECT_THAT(ParseNumbers("45/1 1/1 537444/10000"), Optional(ElementsAre(45, 1, 53.7444)));
  EXPECT_THAT(ParseNumbers("+46.00"), Optional(ElementsAre(46)));
  EXPECT_THAT(ParseNumbers("-1.5, 2,3"), Optional(ElementsAre(-1.5, 2, 3)));
}

TEST(ParseNumbers, RefusesWhatIsNotANumber) {
  for (const char* text :
       {"1/0", "0/0 1/1", "abc", "1.5m", "nan", "inf", "1e999", "1/2/3", "--1"}) {
    EXPECT_EQ(ParseNumbers(text), std::nullopt) << text;
  }
}

TEST(ReadTags, ReadsExifAsStored) {
  const std::string jpeg = WithMetadata(
      MakeJpeg(1),
      {{"Exif.Image.Make", "DJI"}, {"Exif.GPSInfo.GPSLatitude", "45/1 1/1 537444/10000"}});
  const PhotoTags tags = ReadTags(jpeg);
  EXPECT_EQ(tags.problem, "");
  EXPECT_EQ(Text(tags.tags, "Exif.Image.Make"), "DJI");
  EXPECT_THAT(Numbers(tags.tags, "Exif.GPSInfo.GPSLatitude"),
              Optional(ElementsAre(45, 1, 53.7444)));
}

TEST(ReadTags, ReadsXmpAttributesAndElements) {
  const std::string attributes =
      WithMetadata(MakeJpeg(1), {}, {{"drone-dji:GimbalYawDegree", "+106.80"}});
  const std::string elements = WithXmpPacket(
      MakeJpeg(1),
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
      "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"><rdf:Description rdf:about=\"\" "
      "xmlns:drone-dji=\"http://www.dji.com/drone-dji/1.0/\">"
      "<drone-dji:GimbalYawDegree>+106.80</drone-dji:GimbalYawDegree>"
      "</rdf:Description></rdf:RDF></x:xmpmeta>");
  for (const std::string& jpeg : {attributes, elements}) {
    EXPECT_THAT(Number(ReadTags(jpeg).tags, "Xmp.drone-dji.GimbalYawDegree"), Optional(106.8));
  }
}

// senseFly and Pix4D both say Camera: for namespaces of their own.
TEST(ReadTags, GivesOnePrefixToTwoNamespaces) {
  for (const char* uri : {"http://pix4d.com/camera/1.0/", "http://ns.sensefly.com/Camera/1.0/"}) {
    const std::string jpeg = WithXmpPacket(
        MakeJpeg(1), std::string("<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
                                 "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
                                 "<rdf:Description rdf:about=\"\" xmlns:Camera=\"") +
                         uri + "\" Camera:Yaw=\"12.5\"/></rdf:RDF></x:xmpmeta>");
    EXPECT_THAT(Number(ReadTags(jpeg).tags, "Xmp.Camera.Yaw"), Optional(12.5)) << uri;
  }
}

TEST(ReadTags, SurvivesDamage) {
  const std::string jpeg = MakeDjiPhoto(1, 45, 7, 300);
  EXPECT_NE(ReadTags("").problem, "");
  EXPECT_NE(ReadTags("no picture at all").problem, "");
  for (size_t length = 0; length < 3000; length += 37) ReadTags(jpeg.substr(0, length));
  for (size_t at = 0; at < 2500; at += 11) {
    std::string damaged = jpeg;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x5a);
    ReadTags(damaged);
  }
}

TEST(Text, TrimsBlanksAndNuls) {
  const Tags tags = {{"a", std::string("  FC220 \0\0", 10)}, {"b", "   "}};
  EXPECT_EQ(Text(tags, "a"), "FC220");
  EXPECT_EQ(Text(tags, "b"), "");
  EXPECT_EQ(Text(tags, "c"), "");
}

}  // namespace
}  // namespace stucco
