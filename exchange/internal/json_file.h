// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace stucco {

// A value in a JSON file of another program, which knows its place: complaints, all of them Error
// (kBadInput), name it. It must not outlive its file.
class JsonPlace {
 public:
  JsonPlace(const nlohmann::json& value, std::string where)
      : value_(&value), where_(std::move(where)) {}

  bool Has(const std::string& member) const;
  JsonPlace At(const std::string& member) const;
  std::vector<JsonPlace> Elements() const;                         // of a list
  std::vector<std::pair<std::string, JsonPlace>> Members() const;  // of an object, by name

  double Number() const;
  int Pixels() const;  // a whole number above 0
  std::string Text() const;
  Eigen::Vector3d Vector() const;  // a list of three numbers

  [[noreturn]] void Fail(const std::string& reason,
                         const std::string& remedy = "export the model again") const;

 private:
  const nlohmann::json* value_;
  std::string where_;  // "file.json: points.12.color"
};

class JsonFile {
 public:
  // Throws Error (kBadInput) with line and column.
  explicit JsonFile(const std::filesystem::path& path);

  JsonPlace root() const { return {content_, name_}; }

 private:
  std::string name_;
  nlohmann::json content_;
};

}  // namespace stucco
