// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/metadata.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <exiv2/exiv2.hpp>
#include <mutex>
#include <utility>
#include <vector>

#include "survey/attitude.h"
#include "survey/error.h"
#include "survey/escape.h"

namespace stucco::simulate {
namespace {

constexpr char kSoftware[] = "Stucco simulated flight";

// The XMP toolkit inside Exiv2 keeps global tables, so one photo is written at a time.
std::mutex& ExivMutex() {
  static std::mutex mutex;
  return mutex;
}

std::string DegreesMinutesSeconds(double degrees) {
  // In ten-thousandths of a second, so that rounding never gives 60.
  const auto units = std::llround(std::abs(degrees) * 3600 * 10000);
  constexpr long long kMinute = 60 * 10000;
  return fmt::format("{}/1 {}/1 {}/10000", units / (60 * kMinute), units / kMinute % 60,
                     units % kMinute);
}

double Tenths(double degrees) {
  return std::round(degrees * 10) / 10;
}

// In (-180, 180].
using TagList = std::vector<std::pair<const char*, std::string>>;

TagList ExifTags(const PhotoMetadata& m) {
  const auto sub_second = fmt::format("{:03d}", m.milliseconds);
  const auto speed = std::max(1LL, std::llround(1 / m.shutter.time_s));
  return {
      {"Exif.Image.ImageDescription", "default"},
      {"Exif.Image.Make", "DJI"},
      {"Exif.Image.Model", m.model},
      {"Exif.Image.Orientation", "1"},
      {"Exif.Image.XResolution", "72/1"},
      {"Exif.Image.YResolution", "72/1"},
      {"Exif.Image.ResolutionUnit", "2"},
      {"Exif.Image.Software", kSoftware},
      {"Exif.Image.DateTime", m.exif_time},
      {"Exif.Image.YCbCrPositioning", "1"},
      {"Exif.Photo.ExposureTime", fmt::format("1/{}", speed)},
      {"Exif.Photo.FNumber", "28/10"},
      {"Exif.Photo.ExposureProgram", "2"},
      {"Exif.Photo.ISOSpeedRatings", fmt::format("{}", m.shutter.iso)},
      {"Exif.Photo.ExifVersion", "48 50 51 48"},
      {"Exif.Photo.DateTimeOriginal", m.exif_time},
      {"Exif.Photo.DateTimeDigitized", m.exif_time},
      {"Exif.Photo.SubSecTimeOriginal", sub_second},
      {"Exif.Photo.ApertureValue", "297/100"},
      {"Exif.Photo.ExposureBiasValue", "0/32"},
      {"Exif.Photo.MeteringMode", "2"},
      {"Exif.Photo.LightSource", "1"},
      {"Exif.Photo.Flash", "32"},
      {"Exif.Photo.FocalLength", fmt::format("{}/100", std::llround(m.focal_mm * 100))},
      {"Exif.Photo.FocalLengthIn35mmFilm", fmt::format("{}", m.focal_35mm_mm)},
      {"Exif.Photo.ColorSpace", "1"},
      {"Exif.Photo.PixelXDimension", fmt::format("{}", m.width_px)},
      {"Exif.Photo.PixelYDimension", fmt::format("{}", m.height_px)},
      {"Exif.Photo.ExposureMode", "0"},
      {"Exif.Photo.WhiteBalance", "0"},
      {"Exif.Photo.DigitalZoomRatio", "1/1"},
      {"Exif.Photo.BodySerialNumber", "STUCCO0000001"},
      {"Exif.GPSInfo.GPSVersionID", "2 3 0 0"},
      {"Exif.GPSInfo.GPSLatitudeRef", m.latitude_deg < 0 ? "S" : "N"},
      {"Exif.GPSInfo.GPSLatitude", DegreesMinutesSeconds(m.latitude_deg)},
      {"Exif.GPSInfo.GPSLongitudeRef", m.longitude_deg < 0 ? "W" : "E"},
      {"Exif.GPSInfo.GPSLongitude", DegreesMinutesSeconds(m.longitude_deg)},
      {"Exif.GPSInfo.GPSAltitudeRef", m.height_m < 0 ? "1" : "0"},
      {"Exif.GPSInfo.GPSAltitude",
       fmt::format("{}/1000", std::llround(std::abs(m.height_m) * 1000))},
      {"Exif.GPSInfo.GPSStatus", "A"},
      {"Exif.GPSInfo.GPSMapDatum", "WGS-84"},
  };
}

TagList XmpAttributes(const PhotoMetadata& m) {
  const std::string date =
      m.exif_time.substr(0, 4) + "-" + m.exif_time.substr(5, 2) + "-" + m.exif_time.substr(8, 2);
  const auto degrees = [](double value) { return fmt::format("{:+.2f}", Tenths(value)); };
  const double yaw = WrappedDegrees(Tenths(m.gimbal.yaw_deg));
  TagList list = {
      {"xmp:ModifyDate", date},
      {"xmp:CreateDate", date},
      {"tiff:Make", "DJI"},
      {"tiff:Model", m.model},
      {"dc:format", "image/jpg"},
      {"drone-dji:Version", "1.5"},
      {"drone-dji:ImageSource", "WideCamera"},
      {"drone-dji:GpsStatus", m.rtk ? "RTK" : "GPS"},
      {"drone-dji:AltitudeType", m.rtk ? "RtkAlt" : "GpsFusionAlt"},
      {"drone-dji:GpsLatitude", fmt::format("{:+.9f}", m.latitude_deg)},
      {"drone-dji:GpsLongitude", fmt::format("{:+.9f}", m.longitude_deg)},
      {"drone-dji:AbsoluteAltitude", fmt::format("{:+.3f}", m.height_m)},
      {"drone-dji:RelativeAltitude", fmt::format("{:+.3f}", m.above_takeoff_m)},
      {"drone-dji:GimbalRollDegree", degrees(m.gimbal.roll_deg)},
      {"drone-dji:GimbalYawDegree", degrees(yaw)},
      {"drone-dji:GimbalPitchDegree", degrees(m.gimbal.pitch_deg)},
      {"drone-dji:FlightRollDegree", "+0.00"},
      {"drone-dji:FlightYawDegree", degrees(yaw)},
      {"drone-dji:FlightPitchDegree", "+0.00"},
      {"drone-dji:FlightXSpeed", "+0.0"},
      {"drone-dji:FlightYSpeed", "+0.0"},
      {"drone-dji:FlightZSpeed", "+0.0"},
      {"drone-dji:CamReverse", "0"},
      {"drone-dji:GimbalReverse", "0"},
      {"drone-dji:SelfData", kSoftware},
      {"drone-dji:RtkFlag", m.rtk ? "50" : "0"},
  };
  if (m.rtk) {
    list.emplace_back("drone-dji:RtkStdLon", fmt::format("{:.5f}", m.rtk_sigma_m.x()));
    list.emplace_back("drone-dji:RtkStdLat", fmt::format("{:.5f}", m.rtk_sigma_m.y()));
    list.emplace_back("drone-dji:RtkStdHgt", fmt::format("{:.5f}", m.rtk_sigma_m.z()));
  }
  list.emplace_back("drone-dji:CaptureUUID", m.uuid);
  return list;
}

std::string XmpPacket(const PhotoMetadata& metadata) {
  std::string text =
      "<?xpacket begin=\"\xEF\xBB\xBF\" id=\"W5M0MpCehiHzreSzNTczkc9d\"?>\n"
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">\n"
      " <rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">\n"
      "  <rdf:Description rdf:about=\"DJI Meta Data\"\n"
      "    xmlns:tiff=\"http://ns.adobe.com/tiff/1.0/\"\n"
      "    xmlns:xmp=\"http://ns.adobe.com/xap/1.0/\"\n"
      "    xmlns:dc=\"http://purl.org/dc/elements/1.1/\"\n"
      "    xmlns:drone-dji=\"http://www.dji.com/drone-dji/1.0/\"";
  for (const auto& [name, value] : XmpAttributes(metadata)) {
    text += fmt::format("\n   {}=\"{}\"", name, EscapeHtml(value));
  }
  return text + "/>\n </rdf:RDF>\n</x:xmpmeta>\n<?xpacket end=\"w\"?>";
}

std::string BytesOf(Exiv2::Image& image) {
  Exiv2::BasicIo& io = image.io();
  io.open();
  io.seek(0, Exiv2::BasicIo::beg);
  const Exiv2::DataBuf buffer = io.read(static_cast<long>(io.size()));
  io.close();
  return {reinterpret_cast<const char*>(buffer.pData_), static_cast<size_t>(buffer.size_)};
}

}  // namespace

std::string ExifModel(const std::string& camera) {
  constexpr std::array<std::pair<std::string_view, const char*>, 4> kModels = {
      {{"mavic-3e", "M3E"},
       {"phantom-4-rtk", "FC6310R"},
       {"m300-p1-35", "ZenmuseP1"},
       {"mini-3-pro", "FC3582"}}};
  for (const auto& [name, model] : kModels) {
    if (camera == name) return model;
  }
  return camera.empty() ? "virtual" : camera;
}

std::string WithMetadata(std::string_view jpeg, const PhotoMetadata& metadata) {
  const std::lock_guard lock(ExivMutex());
  try {
    const auto image = Exiv2::ImageFactory::open(reinterpret_cast<const Exiv2::byte*>(jpeg.data()),
                                                 static_cast<long>(jpeg.size()));
    image->readMetadata();
    Exiv2::ExifData exif;
    for (const auto& [key, value] : ExifTags(metadata)) exif[key] = value;
    image->setExifData(exif);
    image->writeXmpFromPacket(true);
    image->setXmpPacket(XmpPacket(metadata));
    image->writeMetadata();
    return BytesOf(*image);
  } catch (const Exiv2::Error& error) {
    throw Error(ErrorKind::kStageFailed,
                fmt::format("metadata cannot be written: {}", error.what()));
  }
}

}  // namespace stucco::simulate
