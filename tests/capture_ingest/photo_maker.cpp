// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/capture_ingest/photo_maker.h"

#include <fmt/format.h>

#include <cmath>
#include <exiv2/exiv2.hpp>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

namespace stucco {
namespace {

const std::map<std::string, std::string> kNamespaces = {
    {"drone-dji", "http://www.dji.com/drone-dji/1.0/"},
    {"drone", "http://www.autelrobotics.com/drone/1.0/"},
    {"drone-parrot", "http://www.parrot.com/drone-parrot/1.0/"},
    {"drone-skydio", "https://www.skydio.com/drone-skydio/1.0/"},
    {"Camera", "http://pix4d.com/camera/1.0/"},
};

std::string Packet(const std::map<std::string, std::string>& attributes) {
  std::string text =
      "<?xpacket begin=\"\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">"
      "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
      "<rdf:Description rdf:about=\"\"";
  for (const auto& [prefix, uri] : kNamespaces) {
    text += fmt::format(" xmlns:{}=\"{}\"", prefix, uri);
  }
  for (const auto& [name, value] : attributes) text += fmt::format(" {}=\"{}\"", name, value);
  return text + "/></rdf:RDF></x:xmpmeta>\n<?xpacket end=\"w\"?>";
}

std::string Bytes(Exiv2::Image& image) {
  Exiv2::BasicIo& io = image.io();
  io.open();
  io.seek(0, Exiv2::BasicIo::beg);
  const Exiv2::DataBuf buffer = io.read(static_cast<long>(io.size()));
  io.close();
  return {reinterpret_cast<const char*>(buffer.pData_), static_cast<size_t>(buffer.size_)};
}

auto Opened(const std::string& jpeg) {
  auto image = Exiv2::ImageFactory::open(reinterpret_cast<const Exiv2::byte*>(jpeg.data()),
                                         static_cast<long>(jpeg.size()));
  image->readMetadata();
  return image;
}

// "45/1 1/1 537444/10000"
std::string DegreesMinutesSeconds(double degrees) {
  const double magnitude = std::abs(degrees);
  const int whole = static_cast<int>(magnitude);
  const int minutes = static_cast<int>((magnitude - whole) * 60);
  const double seconds = (magnitude - whole - minutes / 60.0) * 3600;
  return fmt::format("{}/1 {}/1 {}/10000", whole, minutes, std::lround(seconds * 10000));
}

}  // namespace

std::string MakeJpeg(int seed, int width_px, int height_px) {
  cv::Mat small(12, 16, CV_8UC3);
  cv::RNG random(static_cast<uint64_t>(seed) + 1);
  random.fill(small, cv::RNG::UNIFORM, 0, 256);
  cv::Mat picture;
  cv::resize(small, picture, {width_px, height_px}, 0, 0, cv::INTER_NEAREST);
  std::vector<uchar> bytes;
  cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, 90});
  return {bytes.begin(), bytes.end()};
}

std::string WithMetadata(const std::string& jpeg, const std::map<std::string, std::string>& exif,
                         const std::map<std::string, std::string>& xmp_attributes) {
  const auto image = Opened(jpeg);
  for (const auto& [key, value] : exif) {
    Exiv2::Exifdatum& datum = image->exifData()[key];
    if (datum.setValue(value) != 0) throw std::runtime_error("bad EXIF value for " + key);
  }
  image->writeMetadata();
  const std::string bytes = Bytes(*image);
  return xmp_attributes.empty() ? bytes : WithXmpPacket(bytes, Packet(xmp_attributes));
}

std::string WithXmpPacket(const std::string& jpeg, const std::string& packet) {
  const auto image = Opened(jpeg);
  image->setXmpPacket(packet);
  image->writeXmpFromPacket(true);
  image->writeMetadata();
  return Bytes(*image);
}

std::string MakeDjiPhoto(int seed, double latitude_deg, double longitude_deg, double height_m) {
  return WithMetadata(
      MakeJpeg(seed),
      {{"Exif.Image.Make", "DJI"},
       {"Exif.Image.Model", "FC6310R"},
       {"Exif.Photo.DateTimeOriginal", "2025:03:01 12:00:00"},
       {"Exif.Photo.FocalLength", "880/100"},
       {"Exif.Photo.FocalLengthIn35mmFilm", "24"},
       {"Exif.GPSInfo.GPSLatitudeRef", latitude_deg < 0 ? "S" : "N"},
       {"Exif.GPSInfo.GPSLatitude", DegreesMinutesSeconds(latitude_deg)},
       {"Exif.GPSInfo.GPSLongitudeRef", longitude_deg < 0 ? "W" : "E"},
       {"Exif.GPSInfo.GPSLongitude", DegreesMinutesSeconds(longitude_deg)},
       {"Exif.GPSInfo.GPSAltitudeRef", "0"},
       {"Exif.GPSInfo.GPSAltitude", fmt::format("{}/1000", std::lround(height_m * 1000))}},
      {{"drone-dji:GimbalYawDegree", "+30.10"},
       {"drone-dji:GimbalPitchDegree", "-20.00"},
       {"drone-dji:GimbalRollDegree", "+0.00"},
       {"drone-dji:FlightYawDegree", "-77.00"},
       {"drone-dji:AbsoluteAltitude", fmt::format("{:+.2f}", height_m)},
       {"drone-dji:RelativeAltitude", "+40.00"}});
}

void TempFolder::Write(const std::string& name, const std::string& bytes) const {
  const std::filesystem::path file = path() / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace stucco
