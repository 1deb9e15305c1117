// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/manifest.h"

#include <fmt/format.h>

#include "pipeline/engine/internal/json.h"
#include "survey/error.h"
#include "survey/files.h"

namespace stucco {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kManifestVersion = 1;
constexpr int kFailureVersion = 1;

// The checksum over everything else makes a changed byte that still parses visible.
std::string Checksum(Json json) {
  json.erase("checksum");
  return HashBytes(Dump(json));
}

Json UsageToJson(const Usage& usage) {
  return {{"wall_s", Rounded(usage.wall_s)},
          {"cpu_s", Rounded(usage.cpu_s)},
          {"peak_memory_mb", Rounded(usage.peak_memory_mb, 0.1)},
          {"cores", usage.cores}};
}

Usage UsageFromJson(const Json& json) {
  // Programs before this one left out the cores.
  return {json.at("wall_s"), json.at("cpu_s"), json.at("peak_memory_mb"), json.value("cores", 0)};
}

Fingerprint FingerprintFromJson(const Json& json) {
  Fingerprint fingerprint;
  fingerprint.stage_version = json.at("stage_version");
  json.at("options").get_to(fingerprint.options);
  json.at("inputs").get_to(fingerprint.inputs);
  return fingerprint;
}

Manifest ManifestFromJson(const Json& json) {
  Manifest manifest;
  manifest.stage = json.at("stage");
  manifest.program = json.at("program");
  manifest.fingerprint = FingerprintFromJson(json);
  json.at("outputs").get_to(manifest.outputs);
  manifest.usage = UsageFromJson(json.at("usage"));
  for (const auto& [kind, count] : json.at("units").items()) {
    manifest.units[kind] = {count.at("computed"), count.at("reused")};
  }
  manifest.imported_from = json.at("imported_from");
  return manifest;
}

}  // namespace

std::string ProgramVersion() {
  return STUCCO_VERSION;
}

ManifestFile ReadManifest(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    return {};
  }
  const std::string name = path.filename().string();
  try {
    const Json json = Json::parse(ReadFile(path));
    if (json.at("version") != kManifestVersion) {
      return {std::nullopt, fmt::format("its manifest {} is of another version of stucco", name)};
    }
    if (json.at("checksum") != Checksum(json)) {
      return {std::nullopt, fmt::format("its manifest {} is damaged", name)};
    }
    return {ManifestFromJson(json), {}};
  } catch (const Json::exception&) {
    return {std::nullopt, fmt::format("its manifest {} is damaged", name)};
  } catch (const Error& e) {
    return {std::nullopt, fmt::format("its manifest cannot be read ({})", e.what())};
  }
}

void WriteManifest(const Manifest& manifest, const std::filesystem::path& path) {
  Json units = Json::object();
  for (const auto& [kind, count] : manifest.units) {
    units[kind] = {{"computed", count.computed}, {"reused", count.reused}};
  }
  Json json = {{"version", kManifestVersion},
               {"stage", manifest.stage},
               {"program", manifest.program},
               {"stage_version", manifest.fingerprint.stage_version},
               {"imported_from", manifest.imported_from},
               {"options", manifest.fingerprint.options},
               {"inputs", manifest.fingerprint.inputs},
               {"outputs", manifest.outputs},
               {"usage", UsageToJson(manifest.usage)},
               {"units", units}};
  // Through text, so that the checksum is of what a reader will see.
  json = Json::parse(Dump(json));
  json["checksum"] = Checksum(json);
  std::filesystem::create_directories(path.parent_path());
  WriteFileAtomically(path, Dump(json, 1) + "\n");
}

std::optional<Failure> ReadFailure(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    return std::nullopt;
  }
  try {
    const Json json = Json::parse(ReadFile(path));
    if (json.at("version") != kFailureVersion) {
      return std::nullopt;
    }
    return Failure{json.at("stage"),
                   json.at("kind"),
                   json.at("why"),
                   json.at("remedy"),
                   UsageFromJson(json.at("usage")),
                   FingerprintFromJson(json)};
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

void WriteFailure(const Failure& failure, const std::filesystem::path& path) {
  const Json json = {{"version", kFailureVersion},
                     {"stage", failure.stage},
                     {"kind", failure.kind},
                     {"why", failure.why},
                     {"remedy", failure.remedy},
                     {"usage", UsageToJson(failure.usage)},
                     {"stage_version", failure.fingerprint.stage_version},
                     {"options", failure.fingerprint.options},
                     {"inputs", failure.fingerprint.inputs}};
  std::filesystem::create_directories(path.parent_path());
  WriteFileAtomically(path, Dump(json, 1) + "\n");
}

}  // namespace stucco
