// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plan/mission/lint_finding.h"

namespace stucco::plan::internal {

// The rule for one child of an element.
struct FieldRule {
  const char* name;
  bool required = false;
  enum Kind { kAny, kGroup, kNumber, kWhole, kFlag, kOneOf, kListOf } kind = kAny;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  std::vector<std::string_view> values = {};
};

// Collects what is wrong in one document.
class LintLog {
 public:
  explicit LintLog(std::string document) : document_(std::move(document)) {}
  void Add(const std::string& element, const char* rule, std::string text);
  std::vector<LintFinding> Take() { return std::move(findings_); }

 private:
  std::string document_;
  std::vector<LintFinding> findings_;
};

// A place in a document: where the node is and what to call it.
struct Place {
  pugi::xml_node node;
  std::string path;

  std::string Text(const char* name) const;
  std::optional<double> Number(const char* name) const;
  Place Child(const char* name) const;
  std::string Of(const char* name) const { return path + "/" + name; }
};

std::optional<double> ParseNumber(std::string_view text);
// The first two numbers of "a,b" or "a,b,c".
std::optional<std::pair<double, double>> ParsePair(std::string_view text);
// Children come in the order of their rules; templates of DJI's own programs keep to none.
enum class Order { kFixed, kFree };
void CheckFields(const Place& place, std::span<const FieldRule> rules, LintLog& log,
                 Order order = Order::kFixed);

// The parts of a document, each with all below it.
void CheckConfig(const Place& config, LintLog& log);
void CheckWaypoints(const Place& folder, bool is_template, double drone, LintLog& log);
// Group ids are unique in a document, so the checks of all waypoints share what they have seen.
struct ActionCensus {
  std::set<double> group_ids;
  std::set<std::string> suffixes;
};
void CheckActions(const Place& placemark, int waypoints, ActionCensus& census, LintLog& log);

}  // namespace stucco::plan::internal
