// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/internal/json_file.h"

#include <fmt/format.h>

#include <limits>

#include "survey/error.h"
#include "survey/files.h"

namespace stucco {

using Json = nlohmann::json;

bool JsonPlace::Has(const std::string& member) const {
  return value_->is_object() && value_->contains(member);
}

JsonPlace JsonPlace::At(const std::string& member) const {
  if (!Has(member)) Fail(fmt::format("has no \"{}\"", member));
  return {value_->at(member), fmt::format("{}: {}", where_, member)};
}

std::vector<JsonPlace> JsonPlace::Elements() const {
  if (!value_->is_array()) Fail("is no list");
  std::vector<JsonPlace> elements;
  for (size_t i = 0; i < value_->size(); ++i) {
    elements.emplace_back((*value_)[i], fmt::format("{}: {}", where_, i));
  }
  return elements;
}

std::vector<std::pair<std::string, JsonPlace>> JsonPlace::Members() const {
  if (!value_->is_object()) Fail("is no object");
  std::vector<std::pair<std::string, JsonPlace>> members;
  for (auto each = value_->begin(); each != value_->end(); ++each) {
    members.emplace_back(each.key(),
                         JsonPlace(each.value(), fmt::format("{}: {}", where_, each.key())));
  }
  return members;
}

double JsonPlace::Number() const {
  if (!value_->is_number()) Fail("is no number");
  return value_->get<double>();
}

int JsonPlace::Pixels() const {
  const double pixels = Number();
  if (!(pixels >= 1) || !(pixels <= std::numeric_limits<int>::max()) ||
      pixels != static_cast<int>(pixels)) {
    Fail("is no number of pixels");
  }
  return static_cast<int>(pixels);
}

std::string JsonPlace::Text() const {
  if (!value_->is_string()) Fail("is no text");
  return value_->get<std::string>();
}

Eigen::Vector3d JsonPlace::Vector() const {
  const auto elements = Elements();
  if (elements.size() != 3) Fail("has not three numbers");
  return {elements[0].Number(), elements[1].Number(), elements[2].Number()};
}

void JsonPlace::Fail(const std::string& reason, const std::string& remedy) const {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", where_, reason), remedy);
}

JsonFile::JsonFile(const std::filesystem::path& path) : name_(path.string()) {
  try {
    content_ = Json::parse(ReadFile(path));
  } catch (const Json::exception& e) {
    // "... at line 3, column 7: ...", after the library's own number of the error.
    const std::string what = e.what();
    const size_t text = what.find("] ");
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is no whole JSON file: {}", name_,
                            text == std::string::npos ? what : what.substr(text + 2)),
                "export the model again");
  }
}

}  // namespace stucco
