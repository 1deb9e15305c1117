// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/realitycapture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/exchange/row_of_photos.h"

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr char kPose[] =
    "<xcr:Rotation>0 -1 0 0 0 -1 1 0 0</xcr:Rotation><xcr:Position>1 2 3</xcr:Position>";
// 18 mm of 36 mm are half of the longer side: 100 pixels.
constexpr char kLens[] = "xcr:FocalLength35mm=\"18\" xcr:Skew=\"0\" xcr:AspectRatio=\"1\" ";

std::string Xmp(const std::string& attributes, const std::string& elements) {
  return "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF "
         "xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\"><rdf:Description "
         "xcr:Version=\"3\" xcr:Coordinates=\"absolute\" " +
         attributes + " xmlns:xcr=\"http://www.capturingreality.com/ns/xcr/1.1#\">" + elements +
         "</rdf:Description></rdf:RDF></x:xmpmeta>";
}

class RealityCaptureTest : public testing::Test {
 protected:
  ExchangedModel Read() { return ReadRealityCapture(photos.root / "xmp", photos.Index()); }
  Eigen::Vector2d SeenBy(const std::string& attributes, const std::string& elements = "") {
    photos.Write("xmp/a.xmp", Xmp(attributes, kPose + elements));
    return PixelIn(Read().model, "a.jpg", kSeen);
  }
  std::string Refusal(const std::string& attributes, const std::string& elements) {
    photos.Write("xmp/a.xmp", Xmp(attributes, elements));
    const Error error = RefusalOf([&] { Read(); });
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_FALSE(error.remedy().empty());
    return error.what();
  }

  RowOfPhotos photos;
};

TEST_F(RealityCaptureTest, APointIsWhereTheDocumentSays) {
  EXPECT_LT((SeenBy(kLens) - kSeenAt).norm(), 1e-12);
  // Principal points are from the middle, over the longer side.
  EXPECT_LT(
      (SeenBy(std::string(kLens) + "xcr:PrincipalPointU=\"0.01\" xcr:PrincipalPointV=\"-0.02\"") -
       Eigen::Vector2d(112, 26))
          .norm(),
      1e-12);
}

TEST_F(RealityCaptureTest, DistortionIsThatOfTheDocument) {
  const double s = 0.05;
  const double r = 1 + 0.5 * s + 0.25 * s * s + 0.125 * s * s * s;
  EXPECT_LT((SeenBy(std::string(kLens) + "xcr:DistortionModel=\"brown3\"",
                    "<xcr:DistortionCoeficients>0.5 0.25 0.125 0 0 0</xcr:DistortionCoeficients>") -
             Eigen::Vector2d(100 + 10 * r, 50 - 20 * r))
                .norm(),
            1e-12);
  // t1 (r^2 + 2 x^2) + 2 t2 x y bends x.
  const double x = 0.1 + 0.1 * (s + 2 * 0.01) + 2 * 0.01 * 0.1 * -0.2;
  const double y = -0.2 + 0.01 * (s + 2 * 0.04) + 2 * 0.1 * 0.1 * -0.2;
  EXPECT_LT((SeenBy(std::string(kLens) + "xcr:DistortionModel=\"brown3t2\" "
                                         "xcr:DistortionCoeficients=\"0 0 0 0 0.1 0.01\"") -
             Eigen::Vector2d(100 + 100 * x, 50 + 100 * y))
                .norm(),
            1e-12);
}

TEST_F(RealityCaptureTest, EverySidecarIsOfThePhotoOfItsName) {
  const std::string attributes =
      std::string(kLens) + "xcr:Rotation=\"0 -1 0 0 0 -1 1 0 0\" xcr:Position=\"1 2 3\"";
  photos.Write("xmp/a.xmp", Xmp(attributes, ""));
  photos.Write("xmp/sub/c.XMP", Xmp(attributes, ""));
  photos.Write("xmp/b.xmp", Xmp(kLens, ""));                           // could not be aligned
  photos.Write("xmp/d.xmp", "<x:xmpmeta>of a developer</x:xmpmeta>");  // none of its own
  const ExchangedModel read = Read();
  ASSERT_EQ(read.model.photos.size(), 2u);
  EXPECT_EQ(read.model.photos.at(PhotoId{2}).name, "sub/c.jpg");
  EXPECT_EQ(read.model.cameras.size(), 1u);
  EXPECT_THAT(read.notes, ElementsAre("1 of its XMP files have no pose"));
  EXPECT_FALSE(read.georef);
}

TEST_F(RealityCaptureTest, RefusesWhatItCannotRead) {
  const std::string bent = "<xcr:DistortionCoeficients>0.1 0 0 0.1 0 0</xcr:DistortionCoeficients>";
  EXPECT_THAT(Refusal(std::string(kLens) + "xcr:DistortionModel=\"division\"", kPose + bent),
              HasSubstr("a.xmp: xcr:DistortionModel: division is not supported"));
  EXPECT_THAT(Refusal(std::string(kLens) + "xcr:DistortionModel=\"brown4\"", kPose + bent),
              HasSubstr("fourth radial term"));
  EXPECT_THAT(Refusal("", kPose), HasSubstr("xcr:FocalLength35mm: is missing"));
  EXPECT_THAT(Refusal("xcr:FocalLength35mm=\"nan\"", kPose), HasSubstr("\"nan\" is not"));
  EXPECT_THAT(Refusal(kLens,
                      "<xcr:Rotation>0 -1 0</xcr:Rotation><xcr:Position>1 2 3"
                      "</xcr:Position>"),
              HasSubstr("xcr:Rotation"));
  EXPECT_THAT(Refusal(kLens, ""), HasSubstr("none of its 1 XMP files"));
  photos.Write("xmp/z.xmp", Xmp(kLens, kPose));
  EXPECT_THAT(Refusal(kLens, kPose), HasSubstr("1 of 2 photos of the model are not in"));
  photos.Write("xmp/z.xmp", Xmp(kLens, kPose).substr(0, 300));
  EXPECT_THAT(Refusal(kLens, kPose), HasSubstr("is no whole XML file"));
}

}  // namespace
}  // namespace stucco
