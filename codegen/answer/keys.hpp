// SPDX-License-Identifier: GPL-3.0-or-later
// The table of keys: every key of the JSON reports, the kind of its value, and what it means. The
// schema of the reports and their types for the page and Python are made from it (schema.hpp).
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace regulus::detail {

/// A key of an object.
struct Key {
  std::string_view name;  ///< with "?" behind it: it may be missing
  /// A value is one of
  ///   text, flag, count (a whole number, not negative),
  ///   exact (the text of an exact constant, as model files and options take it),
  ///   enclosure ([lower, upper], rounded outward; an infinite end is null), range (the
  ///   same without infinite ends),
  ///   rounded (a number, rounded to the side that claims less), approx (a number without a claim),
  ///   sha256, the name of an object of object_kinds(), or words of which it is one: "a|b";
  /// and behind that "[]" for a list, "{}" for an object of such values, "?" for null as well.
  std::string_view type;
  std::string_view meaning = "";
};

/// A kind of report, or of an object within one: its keys, in groups that it shares with others.
struct ObjectKind {
  std::string_view name;
  std::string_view meaning;
  std::vector<std::span<const Key>> keys;
  std::string_view verdicts = "";  ///< of a report: the words of its verdict
};

/// Returns the keys that every report begins with.
[[nodiscard]] std::span<const Key> head_keys();
/// Returns the kinds of reports, without their head.
[[nodiscard]] const std::vector<ObjectKind>& report_kinds();
/// Returns the kinds of objects within reports.
[[nodiscard]] const std::vector<ObjectKind>& object_kinds();

/// The reason in `proof` when none was wanted.
inline constexpr const char* kNoProofAsked = "no certificate was asked for";

}  // namespace regulus::detail
