// SPDX-License-Identifier: Apache-2.0
// The values of a model file, exactly as they are written: a reader of TOML that shares nothing
// with the front end. It knows no defaults and changes no number.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "runtime/verifier/expression.hpp"

namespace regulus::verifier {

struct WrittenValue {
  std::string text;      ///< a number as it is written; for a string, the text between its quotes
  std::size_t line = 0;  ///< from 1
  bool is_string = false;
  std::size_t number = 0;  ///< in the order of the file
};

/// The values by their keys: "motion.work.x[0]" is the first element of x in [motion.work].
using WrittenValues = std::map<std::string, WrittenValue, std::less<>>;

/// Throws Unfinished, with the line, for a text that it does not understand.
[[nodiscard]] WrittenValues read_model_values(std::string_view text);

/// Returns the number that a TOML number denotes; underscores, signs and 0x, 0o, 0b are allowed.
/// Throws Unfinished for another text.
[[nodiscard]] NodeId number_of_toml(std::string_view text, Graph& graph);

using Names = std::set<std::string, std::less<>>;

/// Returns the pose parameters whose unit is degrees.
[[nodiscard]] Names poses_in_degrees(const WrittenValues& values);

}  // namespace regulus::verifier
