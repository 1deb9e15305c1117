// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/internal/xml_file.h"

#include <fmt/format.h>
#include <zip.h>

#include <cmath>
#include <cstring>
#include <string_view>

#include "survey/error.h"
#include "survey/files.h"
#include "survey/text.h"

namespace stucco {
namespace {

constexpr char kAgain[] = "export the block again";

struct CloseZip {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};

[[noreturn]] void FailZip(const std::filesystem::path& path, const std::string& reason) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", path.string(), reason),
              "unpack it and import the XML file that is in it");
}

// The one XML file of an archive.
std::string ReadZipped(const std::filesystem::path& path) {
  int code = 0;
  const std::unique_ptr<zip_t, CloseZip> archive(zip_open(path.c_str(), ZIP_RDONLY, &code));
  if (!archive) FailZip(path, "is a damaged zip file");
  std::optional<zip_uint64_t> entry;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive.get(), 0); ++i) {
    const char* name = zip_get_name(archive.get(), static_cast<zip_uint64_t>(i), 0);
    if (name == nullptr || !std::string_view(name).ends_with(".xml")) continue;
    if (entry) FailZip(path, "holds more than one XML file");
    entry = static_cast<zip_uint64_t>(i);
  }
  if (!entry) FailZip(path, "holds no XML file");
  const std::unique_ptr<zip_file_t, CloseZip> file(zip_fopen_index(archive.get(), *entry, 0));
  if (!file) FailZip(path, "cannot be unpacked");
  // By what there is and not by what the archive says, which may be wrong on purpose.
  std::string text;
  std::string part(1 << 20, '\0');
  for (;;) {
    const zip_int64_t size = zip_fread(file.get(), part.data(), part.size());
    if (size < 0) FailZip(path, "cannot be unpacked");
    if (size == 0) return text;
    text.append(part, 0, static_cast<size_t>(size));
  }
}

// The line that a byte of a text lies in.
size_t LineOf(std::string_view text, ptrdiff_t offset) {
  const auto end = text.begin() + std::min<ptrdiff_t>(offset, std::ssize(text));
  return static_cast<size_t>(std::count(text.begin(), end, '\n')) + 1;
}

}  // namespace

XmlFile::XmlFile(std::filesystem::path path) : path_(std::move(path)) {
  std::string text = ReadFile(path_);
  if (text.starts_with("PK\x03\x04")) text = ReadZipped(path_);
  const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size());
  if (!result) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}:{}: is no whole XML file: {}", path_.string(),
                            LineOf(text, result.offset), result.description()),
                kAgain);
  }
}

std::string XmlFile::Where(const pugi::xml_node& of) const {
  std::string place;
  for (pugi::xml_node node = of; node && node.parent(); node = node.parent()) {
    int number = 1;
    for (auto before = node.previous_sibling(node.name()); before;
         before = before.previous_sibling(node.name())) {
      ++number;
    }
    const bool is_one_of_many = number > 1 || node.next_sibling(node.name());
    std::string step = is_one_of_many ? fmt::format("{} {}", node.name(), number) : node.name();
    if (!place.empty()) step += "/" + place;
    place = std::move(step);
  }
  return fmt::format("{}: {}", path_.string(), place);
}

void XmlFile::Fail(const pugi::xml_node& at, const std::string& reason,
                   const std::string& remedy) const {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", Where(at), reason), remedy);
}

std::optional<double> XmlFile::FindNumber(const pugi::xml_node& parent, const char* child) const {
  const pugi::xml_node node = parent.child(child);
  if (!node) return std::nullopt;
  const auto number = ParseNumber<double>(Trim(node.child_value()));
  if (!number || !std::isfinite(*number)) {
    Fail(node, fmt::format("\"{}\" is not a number", node.child_value()));
  }
  return number;
}

double XmlFile::Number(const pugi::xml_node& parent, const char* child) const {
  const auto number = FindNumber(parent, child);
  if (!number) Fail(parent, fmt::format("{} is missing", child));
  return *number;
}

std::optional<int64_t> XmlFile::FindInteger(const pugi::xml_node& parent, const char* child) const {
  const pugi::xml_node node = parent.child(child);
  if (!node) return std::nullopt;
  const auto number = ParseNumber<int64_t>(Trim(node.child_value()));
  if (!number) Fail(node, fmt::format("\"{}\" is not a whole number", node.child_value()));
  return number;
}

int64_t XmlFile::Integer(const pugi::xml_node& parent, const char* child) const {
  const auto number = FindInteger(parent, child);
  if (!number) Fail(parent, fmt::format("{} is missing", child));
  return *number;
}

Eigen::Vector3d XmlFile::Vector(const pugi::xml_node& node) const {
  return {Number(node, "x"), Number(node, "y"), Number(node, "z")};
}

std::string TextOf(const pugi::xml_node& parent, const char* child) {
  return std::string(Trim(parent.child_value(child)));
}

}  // namespace stucco
