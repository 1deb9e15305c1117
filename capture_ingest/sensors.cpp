// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/sensors.h"

#include <array>
#include <cctype>
#include <string>

#include "survey/text.h"

namespace stucco {
namespace {

struct Sensor {
  std::string_view model;  // lower case; the beginning of a word of the EXIF model
  double width_mm;
};

// From the makers' published data sheets (sensor class or pixel pitch times pixels); accurate to a
// few percent, which is enough for the starting point of self-calibration.
constexpr std::array kSensors = {
    // DJI
    Sensor{"fc220", 6.17},
    Sensor{"fc230", 6.17},
    Sensor{"fc300", 6.17},
    Sensor{"fc330", 6.17},
    Sensor{"fc350", 6.17},
    Sensor{"fc550", 17.3},
    Sensor{"fc1102", 6.17},
    Sensor{"fc2103", 6.17},
    Sensor{"fc2204", 6.17},
    Sensor{"fc2403", 6.17},
    Sensor{"fc3170", 6.4},
    Sensor{"fc3411", 13.2},
    Sensor{"fc3582", 9.7},
    Sensor{"fc6310", 13.2},
    Sensor{"fc6360", 4.87},
    Sensor{"fc6510", 13.2},
    Sensor{"fc6520", 17.3},
    Sensor{"fc6540", 23.5},
    Sensor{"fc7203", 6.17},
    Sensor{"fc7303", 6.17},
    Sensor{"fc8282", 9.7},
    Sensor{"fc8482", 9.7},
    Sensor{"l1d-20c", 13.2},
    Sensor{"l2d-20c", 17.3},
    Sensor{"m3e", 17.3},
    Sensor{"m3m", 17.3},
    Sensor{"m3t", 6.4},
    Sensor{"m30", 6.4},
    Sensor{"zenmusep1", 35.9},
    Sensor{"zh20", 6.17},
    // Autel, Parrot, Skydio, senseFly, GoPro
    Sensor{"xt701", 6.4},
    Sensor{"xt705", 13.2},
    Sensor{"xt706", 13.2},
    Sensor{"xb015", 6.17},
    Sensor{"anafi", 5.92},
    Sensor{"sequoia", 6.17},
    Sensor{"skydio", 6.29},
    Sensor{"s.o.d.a.", 12.75},
    Sensor{"hero", 6.17},
    // Canon
    Sensor{"eos 5d", 35.9},
    Sensor{"eos 6d", 35.8},
    Sensor{"eos r5", 36},
    Sensor{"eos r6", 35.9},
    Sensor{"eos d60", 22.7},
    Sensor{"eos", 22.3},
    Sensor{"powershot s100", 7.44},
    Sensor{"powershot s110", 7.44},
    Sensor{"powershot g", 7.44},
    Sensor{"powershot g9 x", 13.2},
    Sensor{"powershot g7 x", 13.2},
    Sensor{"powershot", 6.17},
    Sensor{"ixus", 6.17},
    // Kodak, Nikon, Olympus, Panasonic, Ricoh, Sony
    Sensor{"z612", 5.75},
    Sensor{"z712", 5.75},
    Sensor{"d3", 23.5},
    Sensor{"d5", 23.5},
    Sensor{"d7", 23.5},
    Sensor{"d600", 35.9},
    Sensor{"d610", 35.9},
    Sensor{"d750", 35.9},
    Sensor{"d780", 35.9},
    Sensor{"d800", 35.9},
    Sensor{"d810", 35.9},
    Sensor{"d850", 35.9},
    Sensor{"e-m", 17.3},
    Sensor{"e-p", 17.3},
    Sensor{"dmc-g", 17.3},
    Sensor{"dc-g", 17.3},
    Sensor{"gr", 23.5},
    Sensor{"ilce-5", 23.5},
    Sensor{"ilce-6", 23.5},
    Sensor{"ilce-7", 35.8},
    Sensor{"nex", 23.5},
    Sensor{"dsc-rx1r", 35.9},
    Sensor{"dsc-rx1", 35.8},
    Sensor{"dsc-rx100", 13.2},
    Sensor{"dsc", 6.17},
    // Phones, main camera
    Sensor{"iphone 4", 4.54},
    Sensor{"iphone 5", 4.54},
    Sensor{"iphone 5s", 4.89},
    Sensor{"iphone 6", 4.89},
    Sensor{"iphone 7", 4.92},
    Sensor{"iphone 8", 4.92},
    Sensor{"iphone x", 5.64},
    Sensor{"iphone 11", 5.64},
    Sensor{"iphone 12", 5.64},
    Sensor{"iphone 13", 6.85},
    Sensor{"iphone 14", 7.66},
    Sensor{"iphone 15", 8.2},
    Sensor{"sm-g9", 5.64},
    Sensor{"pixel 6", 9.8},
    Sensor{"pixel 7", 9.8},
    Sensor{"pixel", 5.64},
};

// Where `word` stands in `text` at the beginning of a word.
bool HasWord(const std::string& text, std::string_view word) {
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    if (at == 0 || !std::isalnum(static_cast<unsigned char>(text[at - 1]))) return true;
  }
  return false;
}

}  // namespace

std::optional<double> SensorWidth_mm(std::string_view model) {
  const std::string lower = LowerCase(model);
  const Sensor* best = nullptr;  // the longest name is the most specific
  for (const Sensor& sensor : kSensors) {
    const bool longer = best == nullptr || sensor.model.size() > best->model.size();
    if (longer && HasWord(lower, sensor.model)) best = &sensor;
  }
  if (best == nullptr) return std::nullopt;
  return best->width_mm;
}

}  // namespace stucco
