// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>

namespace stucco {

// An XML file, as it is or alone in a zip archive (.xmlz).
class XmlFile {
 public:
  // Throws Error (kBadInput) with the place where it is damaged.
  explicit XmlFile(std::filesystem::path path);

  pugi::xml_node root() const { return document_; }
  const std::filesystem::path& path() const { return path_; }

  // "file.xml: Photogroup 2/FocalLength", where `of` stands in the file by names of elements.
  std::string Where(const pugi::xml_node& of) const;
  [[noreturn]] void Fail(const pugi::xml_node& at, const std::string& reason,
                         const std::string& remedy = "export the block again") const;

  // What a child holds. Nothing where there is no such child; throws Error (kBadInput) where it is
  // not what it should be, or is required and missing.
  std::optional<double> FindNumber(const pugi::xml_node& parent, const char* child) const;
  double Number(const pugi::xml_node& parent, const char* child) const;
  std::optional<int64_t> FindInteger(const pugi::xml_node& parent, const char* child) const;
  int64_t Integer(const pugi::xml_node& parent, const char* child) const;
  // Children x, y, z.
  Eigen::Vector3d Vector(const pugi::xml_node& node) const;

 private:
  std::filesystem::path path_;
  pugi::xml_document document_;
};

// Text of an element, without blanks around it; empty where it is missing.
std::string TextOf(const pugi::xml_node& parent, const char* child);

}  // namespace stucco
