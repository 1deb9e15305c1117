// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/blocks_exchange.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zip.h>

#include "tests/exchange/row_of_photos.h"

namespace stucco {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Focal length and principal point as the document counts: the centre of the upper-left pixel is
// (0, 0), so that the middle of the photo is (99.5, 49.5).
constexpr char kLens[] =
    "<FocalLength>18</FocalLength><SensorSize>36</SensorSize>"
    "<PrincipalPoint><x>99.5</x><y>49.5</y></PrincipalPoint>";
constexpr char kRightDown[] = "0 -1 0 0 0 -1 1 0 0";

std::string Rotation(const std::string& numbers) {
  std::istringstream in(numbers);
  std::string text = "<Rotation>";
  for (int i = 0; i < 9; ++i) {
    std::string number;
    in >> number;
    text += fmt::format("<M_{}{}>{}</M_{}{}>", i / 3, i % 3, number, i / 3, i % 3);
  }
  return text + "</Rotation>";
}

std::string PhotoXml(int id, const std::string& path, const std::string& rotation) {
  return fmt::format(
      "<Photo><Id>{}</Id><ImagePath>{}</ImagePath><Pose>{}"
      "<Center><x>1</x><y>2</y><z>3</z></Center></Pose></Photo>",
      id, path, rotation);
}

std::string Measured(int photo, double x, double y) {
  return fmt::format("<Measurement><PhotoId>{}</PhotoId><x>{}</x><y>{}</y></Measurement>", photo, x,
                     y);
}

struct BlockText {
  std::string lens = kLens;
  std::string orientation = "XRightYDown";
  std::string rotation = Rotation(kRightDown);
  std::string srs;      // definition
  std::string points =  // the same pixel in the document's count
      "<TiePoint><Position><x>11</x><y>1</y><z>5</z></Position>"
      "<Color><Red>1</Red><Green>0.2</Green><Blue>0</Blue></Color>" +
      Measured(7, 109.5, 29.5) + Measured(9, 109.5, 29.5) + "</TiePoint>";

  std::string Text() const {
    const std::string systems = srs.empty()
                                    ? ""
                                    : "<SpatialReferenceSystems><SRS><Id>4</Id><Definition>" + srs +
                                          "</Definition></SRS></SpatialReferenceSystems>";
    return "<?xml version=\"1.0\" encoding=\"utf-8\"?><BlocksExchange version=\"2.1\">" + systems +
           "<Block>" + (srs.empty() ? "" : "<SRSId>4</SRSId>") +
           "<Photogroups><Photogroup><ImageDimensions><Width>200</Width><Height>100</Height>"
           "</ImageDimensions><CameraOrientation>" +
           orientation + "</CameraOrientation>" + lens +
           PhotoXml(7, "D:\\survey\\a.jpg", rotation) + PhotoXml(9, "sub/c.jpg", rotation) +
           "</Photogroup></Photogroups><TiePoints>" + points +
           "</TiePoints></Block></BlocksExchange>";
  }
};

class BlocksExchangeTest : public testing::Test {
 protected:
  ExchangedModel Read(const std::string& text) {
    return ReadBlocksExchange(photos.Write("block.xml", text), photos.Index());
  }
  ExchangedModel Read() { return Read(block.Text()); }
  Error Refused(const std::string& text) {
    Error error = RefusalOf([&] { Read(text); });
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_FALSE(error.remedy().empty());
    EXPECT_THAT(error.what(), HasSubstr("block.xml"));
    return error;
  }
  std::string Refusal() { return Refused(block.Text()).what(); }

  RowOfPhotos photos;
  BlockText block;
};

TEST_F(BlocksExchangeTest, APointIsWhereTheDocumentSays) {
  const ExchangedModel read = Read();
  EXPECT_EQ(read.format, "BlocksExchange 2.1");
  EXPECT_FALSE(read.georef);
  EXPECT_THAT(read.crs, IsEmpty());
  EXPECT_LT((PixelIn(read.model, "a.jpg", kSeen) - kSeenAt).norm(), 1e-12);
  ASSERT_EQ(read.model.points.size(), 1u);
  const TrackPoint& point = read.model.points.begin()->second;
  EXPECT_EQ(point.position, kSeen);
  EXPECT_THAT(point.rgb, ElementsAre(255, 51, 0));
  EXPECT_EQ(read.model.photos.at(point.track[1].photo).name, "sub/c.jpg");
  EXPECT_LT((read.model.photos.begin()->second.observations[0].pixel - kSeenAt).norm(), 1e-12);
}

TEST_F(BlocksExchangeTest, FocalLengthsOfEveryKindAreTheSame) {
  for (const char* focal : {"<FocalLengthPixels>100</FocalLengthPixels>",
                            "<FocalLength>5</FocalLength><PixelSize>0.05</PixelSize>"}) {
    block.lens = focal;  // without principal point: the middle
    EXPECT_LT((PixelIn(Read().model, "a.jpg", kSeen) - kSeenAt).norm(), 1e-12) << focal;
  }
  block.lens = std::string(kLens) + "<AspectRatio>1.5</AspectRatio>";
  EXPECT_LT((PixelIn(Read().model, "a.jpg", kSeen) - Eigen::Vector2d(110, 20)).norm(), 1e-12);
}

// Brown's model: x' = x (1 + K1 r^2 + ...) + P1 (r^2 + 2 x^2) + 2 P2 x y, and y' with P1 and P2
// exchanged; here x = 0.1, y = -0.2, r^2 = 0.05.
TEST_F(BlocksExchangeTest, DistortionIsBrowns) {
  block.lens = std::string(kLens) +
               "<Distortion><K1>0.1</K1><K2>0.2</K2><K3>0.4</K3><P1>0</P1><P2>0</P2></Distortion>";
  const double r = 1 + 0.1 * 0.05 + 0.2 * 0.0025 + 0.4 * 0.000125;
  EXPECT_LT(
      (PixelIn(Read().model, "a.jpg", kSeen) - Eigen::Vector2d(100 + 10 * r, 50 - 20 * r)).norm(),
      1e-12);
  block.lens = std::string(kLens) +
               "<Distortion><K1>0</K1><K2>0</K2><K3>0</K3><P1>0.1</P1><P2>0.01</P2></Distortion>";
  const double x = 0.1 + 0.1 * (0.05 + 2 * 0.01) + 2 * 0.01 * 0.1 * -0.2;
  const double y = -0.2 + 0.01 * (0.05 + 2 * 0.04) + 2 * 0.1 * 0.1 * -0.2;
  EXPECT_LT(
      (PixelIn(Read().model, "a.jpg", kSeen) - Eigen::Vector2d(100 + 100 * x, 50 + 100 * y)).norm(),
      1e-12);
}

// The same camera with its axes called otherwise: rows of the matrix are its x, y and their cross
// product in the world, where right is -y, down is -z and forward +x.
TEST_F(BlocksExchangeTest, EveryCameraOrientationIsTheSameCamera) {
  const std::vector<std::pair<std::string, std::string>> all = {
      {"XRightYUp", "0 -1 0 0 0 1 -1 0 0"}, {"XLeftYDown", "0 1 0 0 0 -1 -1 0 0"},
      {"XLeftYUp", "0 1 0 0 0 1 1 0 0"},    {"XDownYRight", "0 0 -1 0 -1 0 -1 0 0"},
      {"XDownYLeft", "0 0 -1 0 1 0 1 0 0"}, {"XUpYRight", "0 0 1 0 -1 0 1 0 0"},
      {"XUpYLeft", "0 0 1 0 1 0 -1 0 0"}};
  for (const auto& [name, matrix] : all) {
    block.orientation = name;
    block.rotation = Rotation(matrix);
    EXPECT_LT((PixelIn(Read().model, "a.jpg", kSeen) - kSeenAt).norm(), 1e-12) << name;
  }
}

TEST_F(BlocksExchangeTest, SaysWhereItsFrameLies) {
  block.srs = "ENU:52.01,4.36";
  ExchangedModel read = Read();
  ASSERT_TRUE(read.georef);
  EXPECT_EQ(read.georef->frame, "enu");
  EXPECT_EQ(read.georef->origin_latitude_deg, 52.01);
  EXPECT_EQ(read.georef->origin_longitude_deg, 4.36);
  EXPECT_EQ(read.georef->origin_height_m, 0);
  block.srs = "EPSG:25832";
  read = Read();
  EXPECT_FALSE(read.georef);
  EXPECT_EQ(read.crs, "EPSG:25832");
  block.srs = "LOCAL_CS[&quot;here&quot;]";
  read = Read();
  EXPECT_FALSE(read.georef);
  EXPECT_THAT(read.crs, IsEmpty());
  block.srs = "zone.prj";
  photos.Write("zone.prj", "PROJCS[]");
  EXPECT_EQ(Read().crs, "PROJCS[]");
  block.srs = "ENU:north";
  EXPECT_THAT(Refusal(), HasSubstr("is no place on the earth"));
}

TEST_F(BlocksExchangeTest, PointsWithoutPositionComeFromTheirRays) {
  std::string text = block.Text();
  const std::string position = "<Position><x>11</x><y>1</y><z>5</z></Position>";
  text.erase(text.find(position), position.size());
  // The second camera moves 2 to its right, and sees the point so much further left.
  text.replace(text.rfind("<y>2</y>"), 8, "<y>0</y>");
  text.replace(text.rfind("<x>109.5</x>"), 12, "<x>89.5</x>");
  const ExchangedModel read = Read(text);
  ASSERT_EQ(read.model.points.size(), 1u);
  EXPECT_LT((read.model.points.begin()->second.position - kSeen).norm(), 1e-9);
  block.points.erase(0, block.points.find("<Color>"));
  block.points = "<TiePoint>" + block.points;  // from one place: no depth
  EXPECT_THAT(Read().notes, Contains("1 tie points have no position and are left out"));
}

TEST_F(BlocksExchangeTest, TiePointsMayLieInAFileOfTheirOwn) {
  photos.Write("ties.xml", block.points + block.points);
  block.points = "<Path>ties.xml</Path>";
  EXPECT_EQ(Read().model.points.size(), 2u);
  block.points = "<Path>gone.xml</Path>";
  const Error error = RefusalOf([&] { Read(); });
  EXPECT_THAT(error.what(), HasSubstr("gone.xml"));
}

TEST_F(BlocksExchangeTest, ReadsAnArchive) {
  const std::string text = block.Text();
  const auto path = photos.root / "block.xmlz";
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE, nullptr);
  zip_file_add(archive, "block.xml", zip_source_buffer(archive, text.data(), text.size(), 0), 0);
  zip_close(archive);
  EXPECT_EQ(ReadBlocksExchange(path, photos.Index()).model.photos.size(), 2u);
}

TEST_F(BlocksExchangeTest, PhotosThatCouldNotBeConnectedStayOut) {
  std::string text = block.Text();
  text.replace(text.rfind("</Photo>"), 8, "<Component>0</Component></Photo>");
  const ExchangedModel read = Read(text);
  EXPECT_EQ(read.model.photos.size(), 1u);
  EXPECT_THAT(read.notes, ElementsAre("1 photos in it have no pose"));
  block.lens += "<ManualPose>false</ManualPose>";
  EXPECT_THAT(Refusal(), HasSubstr("no photo in it has a pose"));
}

TEST_F(BlocksExchangeTest, OfSeveralBlocksTheFullestCounts) {
  std::string text = block.Text();
  text.replace(text.find("<Block>"), 7, "<Block><Photogroups/></Block><Block>");
  const ExchangedModel read = Read(text);
  EXPECT_EQ(read.model.photos.size(), 2u);
  EXPECT_THAT(read.notes, Contains(HasSubstr("of its 2 blocks the one with the most poses")));
}

TEST_F(BlocksExchangeTest, RefusesLensesThatAreNoneOfOurs) {
  block.lens = std::string(kLens) + "<CameraModelType>Fisheye</CameraModelType>";
  EXPECT_THAT(Refusal(), HasSubstr("camera model Fisheye is not supported"));
  block.lens = std::string(kLens) + "<Skew>0.01</Skew>";
  EXPECT_THAT(Refusal(), HasSubstr("skew"));
  block.lens = "<FocalLength>18</FocalLength>";
  EXPECT_THAT(Refusal(), HasSubstr("SensorSize is missing"));
  block.lens = "<FocalLengthPixels>-5</FocalLengthPixels>";
  EXPECT_THAT(Refusal(), HasSubstr("focal length is not positive"));
}

TEST_F(BlocksExchangeTest, RefusesWhatItCannotKnow) {
  block.rotation = "<Rotation><Omega>1</Omega><Phi>2</Phi><Kappa>3</Kappa></Rotation>";
  EXPECT_THAT(Refused(block.Text()).remedy(), HasSubstr("rotations as matrices"));
  block.rotation = Rotation("0 -1 0 0 0 1 1 0 0");  // mirrored
  EXPECT_THAT(Refusal(), HasSubstr("is no rotation"));
  block.rotation = Rotation(kRightDown);
  block.orientation = "XForward";
  EXPECT_THAT(Refusal(), HasSubstr("CameraOrientation \"XForward\" is not known"));
}

TEST_F(BlocksExchangeTest, RefusesDamagedFilesWithTheirElement) {
  const std::string whole = block.Text();
  EXPECT_THAT(Refused(whole.substr(0, whole.size() / 2)).what(), HasSubstr("is no whole XML file"));
  block.rotation = Rotation("0 nan 0 0 0 -1 1 0 0");
  EXPECT_THAT(Refusal(), HasSubstr("Photo 1/Pose/Rotation/M_01: \"nan\" is not a number"));
  block = {};
  block.points = "<TiePoint>" + Measured(8, 1, 1) + "</TiePoint>";
  EXPECT_THAT(Refusal(), HasSubstr("there is no photo with the Id 8"));
  EXPECT_THAT(Refused("<Report/>").what(), HasSubstr("is no BlocksExchange file"));
  std::string twice = whole;
  twice.replace(twice.find("<Id>9"), 5, "<Id>7");
  EXPECT_THAT(Refused(twice).what(), HasSubstr("two photos have the Id 7"));
}

}  // namespace
}  // namespace stucco
