// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "survey/error.h"

// Structs to JSON and back. The names of a struct's fields are listed once, for both directions:
//
//   template <typename Archive, internal::Is<GimbalAngles> T>
//   static void Fields(Archive& archive, T& angles) {
//     archive.Required("yaw_deg", angles.yaw_deg);
//     archive.Optional("roll_deg", angles.roll_deg);  // keeps its default when the file has none
//   }
namespace stucco::internal {

using Json = nlohmann::ordered_json;  // keeps the order in which fields were written

inline constexpr int kJsonVersion = 1;

// `Fields` takes the struct as const when writing.
template <typename T, typename Struct>
concept Is = std::same_as<std::remove_const_t<T>, Struct>;

// Parses a file and checks its "version". Throws Error (kBadInput) with line and column.
Json LoadJson(const std::filesystem::path& path);
void SaveJson(const Json& json, const std::filesystem::path& path);

// Reads the fields of one JSON object; complaints name the file and the field.
class JsonReader {
 public:
  static constexpr bool kReads = true;

  JsonReader(const Json& object, const std::string& file, std::string where)
      : object_(object), file_(file), where_(std::move(where)) {
    if (!object_.is_object()) FailAt(where_, "must be an object");
  }

  template <typename T>
  void Required(const char* name, T& field) const {
    const auto found = object_.find(name);
    if (found == object_.end()) FailAt(Inside(name), "is missing");
    Get(*found, Inside(name), field);
  }

  template <typename T>
  void Optional(const char* name, T& field) const {
    if (object_.contains(name)) Required(name, field);
  }

  // Fields that live in an object of their own inside this one.
  template <typename List>
  void Group(const char* name, const List& list) const {
    const auto found = object_.find(name);
    if (found == object_.end()) FailAt(Inside(name), "is missing");
    JsonReader group(*found, file_, Inside(name));
    list(group);
  }

  [[noreturn]] void Fail(const char* name, std::string_view reason) const {
    FailAt(Inside(name), reason);
  }

 private:
  std::string Inside(std::string_view name) const {
    return where_.empty() ? std::string(name) : fmt::format("{}.{}", where_, name);
  }

  [[noreturn]] void FailAt(std::string_view where, std::string_view reason) const {
    throw Error(ErrorKind::kBadInput, where.empty()
                                          ? fmt::format("{}: {}", file_, reason)
                                          : fmt::format("{}: \"{}\" {}", file_, where, reason));
  }

  template <typename T>
  void Get(const Json& json, const std::string& where, T& field) const {
    if constexpr (std::same_as<T, bool>) {
      if (!json.is_boolean()) FailAt(where, "must be true or false");
      field = json.get<bool>();
    } else if constexpr (std::integral<T>) {
      GetInteger(json, where, field);
    } else if constexpr (std::same_as<T, double>) {
      if (!json.is_number()) FailAt(where, "must be a number");
      field = json.get<double>();
    } else if constexpr (std::same_as<T, std::string>) {
      if (!json.is_string()) FailAt(where, "must be a text");
      field = json.get<std::string>();
    } else {
      JsonReader reader(json, file_, where);
      Fields(reader, field);
    }
  }

  template <typename T>
  void GetInteger(const Json& json, const std::string& where, T& field) const {
    if (!json.is_number_integer()) FailAt(where, "must be a whole number");
    const bool fits = json.is_number_unsigned() ? std::in_range<T>(json.get<uint64_t>())
                                                : std::in_range<T>(json.get<int64_t>());
    if (!fits) FailAt(where, "is out of range");
    field = json.get<T>();
  }

  template <int N>
  void Get(const Json& json, const std::string& where, Eigen::Matrix<double, N, 1>& field) const {
    if (!json.is_array() || json.size() != N) {
      FailAt(where, fmt::format("must be a list of {} numbers", N));
    }
    for (int i = 0; i < N; ++i) Get(json[i], fmt::format("{}[{}]", where, i), field[i]);
  }

  template <typename T>
  void Get(const Json& json, const std::string& where, std::optional<T>& field) const {
    if (json.is_null()) {
      field.reset();
    } else {
      Get(json, where, field.emplace());
    }
  }

  template <typename T>
  void Get(const Json& json, const std::string& where, std::vector<T>& field) const {
    if (!json.is_array()) FailAt(where, "must be a list");
    field.clear();
    field.reserve(json.size());
    for (size_t i = 0; i < json.size(); ++i) {
      Get(json[i], fmt::format("{}[{}]", where, i), field.emplace_back());
    }
  }

  void Get(const Json& json, const std::string& where, std::map<std::string, double>& field) const {
    if (!json.is_object()) FailAt(where, "must be an object");
    field.clear();
    for (const auto& [key, value] : json.items()) {
      Get(value, fmt::format("{}.{}", where, key), field[key]);
    }
  }

  const Json& object_;
  const std::string& file_;
  std::string where_;
};

// Writes the fields of one JSON object. JSON knows no NaN: such a number is an Error here and not a
// null that fails in whoever reads it.
class JsonWriter {
 public:
  static constexpr bool kReads = false;

  JsonWriter(Json& object, const std::string& file) : object_(object), file_(file) {}

  template <typename T>
  void Required(const char* name, const T& field) {
    object_[name] = Put(name, field);
  }

  template <typename T>
  void Optional(const char* name, const T& field) {
    Required(name, field);
  }

  template <typename T>
  void Optional(const char* name, const std::optional<T>& field) {
    if (field) Required(name, *field);
  }

  template <typename List>
  void Group(const char* name, const List& list) {
    object_[name] = Json::object();
    JsonWriter group(object_[name], file_);
    list(group);
  }

 private:
  template <typename T>
  Json Put(const char* name, const T& field) const {
    if constexpr (std::same_as<T, double>) {
      if (!std::isfinite(field)) {
        throw Error(ErrorKind::kStageFailed,
                    fmt::format("{}: \"{}\" would be {}, which is no number", file_, name, field));
      }
      return field;
    } else if constexpr (std::integral<T> || std::same_as<T, std::string>) {
      return field;
    } else {
      Json object = Json::object();
      JsonWriter writer(object, file_);
      Fields(writer, field);
      return object;
    }
  }

  template <int N>
  Json Put(const char* name, const Eigen::Matrix<double, N, 1>& field) const {
    Json array = Json::array();
    for (const double number : field) array.push_back(Put(name, number));
    return array;
  }

  template <typename T>
  Json Put(const char* name, const std::vector<T>& field) const {
    Json array = Json::array();
    for (const T& element : field) array.push_back(Put(name, element));
    return array;
  }

  Json Put(const char* name, const std::map<std::string, double>& field) const {
    Json object = Json::object();
    for (const auto& [key, value] : field) object[key] = Put(name, value);
    return object;
  }

  Json& object_;
  const std::string& file_;
};

template <typename Struct>
Struct ReadJsonFile(const std::filesystem::path& path) {
  const Json json = LoadJson(path);
  const std::string file = path.string();
  JsonReader reader(json, file, "");
  Struct result;
  Fields(reader, result);
  return result;
}

template <typename Struct>
void WriteJsonFile(const Struct& value, const std::filesystem::path& path) {
  Json json = Json::object();
  json["version"] = kJsonVersion;
  const std::string file = path.string();
  JsonWriter writer(json, file);
  Fields(writer, value);
  SaveJson(json, path);
}

}  // namespace stucco::internal
