// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/position.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stucco {
namespace {

constexpr double kMetresPerDegree = 111320;  // of latitude, to the accuracy that is needed here
constexpr double kPi = std::numbers::pi;

// EXIF heights below the Dead Sea or above any aircraft with a camera are no heights.
constexpr double kLowestHeight_m = -500;
constexpr double kHighestHeight_m = 9500;

// A latitude and longitude and the size of their last digit.
struct Coordinates {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double resolution_m = 0;
};

struct Height {
  double height_m = 0;
  double resolution_m = 0;
};

// Denominator of the last fraction of "45/1 1/1 537444/10000"; 1 for anything else.
double LastDenominator(const std::string& text) {
  const size_t slash = text.rfind('/');
  if (slash == std::string::npos) return 1;
  const auto numbers = ParseNumbers(std::string_view(text).substr(slash + 1));
  return numbers && numbers->size() == 1 ? std::max(1.0, numbers->front()) : 1;
}

int Decimals(const std::string& text) {
  const size_t point = text.find('.');
  return point == std::string::npos ? 0 : static_cast<int>(text.size() - point - 1);
}

// Degrees, minutes and seconds, of which the last may be missing. `positive` is N or E; the
// hemisphere is assumed to be that one where the tag is missing, as other programs do.
std::optional<double> ExifAngle(const Tags& tags, const std::string& key, char positive,
                                std::vector<std::string>& doubts) {
  const auto parts = Numbers(tags, key);
  if (!parts) {
    if (tags.count(key) > 0) doubts.push_back(key + " is malformed");
    return std::nullopt;
  }
  if (parts->empty() || parts->size() > 3) return std::nullopt;
  double degrees = 0;
  double unit = 1;
  for (const double part : *parts) {
    degrees += part / unit;
    unit *= 60;
  }
  const std::string hemisphere = Text(tags, key + "Ref");
  if (hemisphere.empty()) {
    doubts.push_back(fmt::format("{}Ref is missing; {} assumed", key, positive));
    return degrees;
  }
  return std::toupper(static_cast<unsigned char>(hemisphere[0])) == positive ? degrees : -degrees;
}

std::optional<Coordinates> ExifCoordinates(const Tags& tags, std::vector<std::string>& doubts) {
  const auto latitude = ExifAngle(tags, "Exif.GPSInfo.GPSLatitude", 'N', doubts);
  const auto longitude = ExifAngle(tags, "Exif.GPSInfo.GPSLongitude", 'E', doubts);
  if (!latitude || !longitude) return std::nullopt;
  const auto parts = Numbers(tags, "Exif.GPSInfo.GPSLatitude");
  const double unit = std::pow(60, static_cast<double>(parts->size()) - 1);
  const double denominator = LastDenominator(Text(tags, "Exif.GPSInfo.GPSLatitude"));
  return Coordinates{*latitude, *longitude, kMetresPerDegree / unit / denominator};
}

// The prefixes of drone makers, then the spellings ("GpsLongtitude" is DJI's own, on early models).
std::optional<Coordinates> XmpCoordinates(const Tags& tags) {
  for (const char* prefix : {"drone-dji", "drone-skydio", "skydio", "drone-parrot", "drone"}) {
    const std::string base = fmt::format("Xmp.{}.", prefix);
    for (const char* latitude_name : {"GpsLatitude", "GPSLatitude", "Latitude"}) {
      const auto latitude = Number(tags, base + latitude_name);
      if (!latitude) continue;
      for (const char* name : {"GpsLongitude", "GpsLongtitude", "GPSLongitude", "Longitude"}) {
        const auto longitude = Number(tags, base + name);
        if (!longitude) continue;
        const int decimals = Decimals(Text(tags, base + latitude_name));
        return Coordinates{*latitude, *longitude, kMetresPerDegree * std::pow(10, -decimals)};
      }
    }
  }
  return std::nullopt;
}

std::optional<std::string> FindProblem(const Coordinates& at) {
  if (!(std::abs(at.latitude_deg) <= 90) || !(std::abs(at.longitude_deg) <= 180)) {
    return fmt::format("position {}, {} is not on Earth", at.latitude_deg, at.longitude_deg);
  }
  // Written by receivers that have no fix yet. Nobody surveys buildings in the Gulf of Guinea.
  if (std::abs(at.latitude_deg) < 1e-6 && std::abs(at.longitude_deg) < 1e-6) {
    return std::string("position 0, 0 is a placeholder");
  }
  return std::nullopt;
}

double Distance_m(const Coordinates& a, const Coordinates& b) {
  const double north = (a.latitude_deg - b.latitude_deg) * kMetresPerDegree;
  const double east =
      (a.longitude_deg - b.longitude_deg) * kMetresPerDegree * std::cos(a.latitude_deg * kPi / 180);
  return std::hypot(north, east);
}

void DropBad(std::optional<Coordinates>& at, const char* source, std::vector<std::string>& doubts) {
  if (!at) return;
  if (const auto problem = FindProblem(*at)) {
    doubts.push_back(fmt::format("{} {}", source, *problem));
    at.reset();
  }
}

std::optional<Coordinates> ReadCoordinates(const Tags& tags, std::vector<std::string>& doubts) {
  auto exif = ExifCoordinates(tags, doubts);
  auto xmp = XmpCoordinates(tags);
  DropBad(exif, "EXIF", doubts);
  DropBad(xmp, "XMP", doubts);
  if (!exif || !xmp) return exif ? exif : xmp;
  constexpr double kDisagreement_m = 100;
  if (Distance_m(*exif, *xmp) > kDisagreement_m) {
    // With the hemisphere missing the signed XMP knows better; else EXIF is what others would use.
    const bool assumed = Text(tags, "Exif.GPSInfo.GPSLatitudeRef").empty() ||
                         Text(tags, "Exif.GPSInfo.GPSLongitudeRef").empty();
    doubts.push_back(fmt::format("EXIF and XMP positions are {:.0f} m apart; {} used",
                                 Distance_m(*exif, *xmp), assumed ? "XMP" : "EXIF"));
    return assumed ? xmp : exif;
  }
  return xmp->resolution_m < exif->resolution_m ? xmp : exif;
}

bool IsPlausibleHeight(double height_m) {
  return height_m > kLowestHeight_m && height_m < kHighestHeight_m && height_m != 0;
}

std::optional<Height> ExifHeight(const Tags& tags) {
  const std::string key = "Exif.GPSInfo.GPSAltitude";
  const auto value = Number(tags, key);
  if (!value) return std::nullopt;
  // A byte; some ground stations write the character '1' instead.
  const std::string reference = Text(tags, "Exif.GPSInfo.GPSAltitudeRef");
  const bool below = reference == "1" || reference == "49";
  return Height{below ? -std::abs(*value) : *value, 1 / LastDenominator(Text(tags, key))};
}

std::optional<Height> XmpHeight(const Tags& tags) {
  for (const char* prefix : {"drone-dji", "drone-skydio", "skydio", "drone-parrot", "drone"}) {
    const std::string key = fmt::format("Xmp.{}.AbsoluteAltitude", prefix);
    if (const auto value = Number(tags, key)) {
      return Height{*value, std::pow(10, -Decimals(Text(tags, key)))};
    }
  }
  return std::nullopt;
}

void DropBad(std::optional<Height>& height, const char* source, std::vector<std::string>& doubts) {
  if (!height || IsPlausibleHeight(height->height_m)) return;
  doubts.push_back(height->height_m == 0
                       ? fmt::format("{} height of exactly 0 is a placeholder", source)
                       : fmt::format("{} height {:g} m is impossible", source, height->height_m));
  height.reset();
}

std::optional<Height> ReadHeight(const Tags& tags, std::vector<std::string>& doubts) {
  auto exif = ExifHeight(tags);
  auto xmp = XmpHeight(tags);
  DropBad(exif, "EXIF", doubts);
  DropBad(xmp, "XMP", doubts);
  if (!exif || !xmp) return exif ? exif : xmp;
  // XMP is signed and written by the flight controller; EXIF's reference byte is often wrong.
  constexpr double kDisagreement_m = 1;
  if (std::abs(exif->height_m - xmp->height_m) > kDisagreement_m) return xmp;
  return exif->resolution_m < xmp->resolution_m ? exif : xmp;
}

std::optional<double> ReadSigma(const Tags& tags, const std::string& key) {
  const auto sigma = Number(tags, key);
  if (!sigma || !(*sigma > 0) || *sigma > 1000) return std::nullopt;
  return sigma;
}

// DJI's RtkFlag: 50 fixed, 32 to 49 float, 16 single point, 0 none (manual of the Mavic 3M). The
// defaults are typical of each.
void ReadAccuracy(const Tags& tags, GeoPosition& position) {
  const int flag = static_cast<int>(Number(tags, "Xmp.drone-dji.RtkFlag").value_or(0));
  const bool is_float = flag >= 32 && flag < 50;
  position.rtk_fixed = flag == 50;
  if (position.rtk_fixed) {
    position.sigma_horizontal_m = 0.02;
    position.sigma_vertical_m = 0.04;
  } else if (is_float) {
    position.sigma_horizontal_m = 0.5;
    position.sigma_vertical_m = 1;
  }
  const auto north = ReadSigma(tags, "Xmp.drone-dji.RtkStdLat");
  const auto east = ReadSigma(tags, "Xmp.drone-dji.RtkStdLon");
  const auto up = ReadSigma(tags, "Xmp.drone-dji.RtkStdHgt");
  // Without a fix the receiver goes on writing the deviations of its last one.
  if (position.rtk_fixed || is_float) {
    if (north && east) position.sigma_horizontal_m = std::hypot(*north, *east) / std::sqrt(2.0);
    if (up) position.sigma_vertical_m = *up;
    return;
  }
  auto horizontal = ReadSigma(tags, "Xmp.Camera.GPSXYAccuracy");
  if (!horizontal) horizontal = ReadSigma(tags, "Exif.GPSInfo.GPSHPositioningError");
  if (horizontal) position.sigma_horizontal_m = *horizontal;
  if (const auto vertical = ReadSigma(tags, "Xmp.Camera.GPSZAccuracy")) {
    position.sigma_vertical_m = *vertical;
  }
}

std::optional<double> ReadHeightAboveTakeoff(const Tags& tags) {
  for (const char* prefix : {"drone-dji", "drone-skydio", "skydio", "drone"}) {
    if (const auto value = Number(tags, fmt::format("Xmp.{}.RelativeAltitude", prefix))) {
      return value;
    }
  }
  return Number(tags, "Xmp.Camera.AboveGroundAltitude");
}

}  // namespace

PositionReading ReadPosition(const Tags& tags) {
  PositionReading reading;
  const auto coordinates = ReadCoordinates(tags, reading.doubts);
  if (!coordinates) return reading;
  reading.height_above_takeoff_m = ReadHeightAboveTakeoff(tags);
  GeoPosition position;
  position.latitude_deg = coordinates->latitude_deg;
  position.longitude_deg = coordinates->longitude_deg;
  if (const auto height = ReadHeight(tags, reading.doubts)) {
    position.height_m = height->height_m;
    position.has_height = true;
  }
  ReadAccuracy(tags, position);
  reading.position = position;
  return reading;
}

}  // namespace stucco
