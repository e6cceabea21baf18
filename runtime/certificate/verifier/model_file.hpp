// SPDX-License-Identifier: Apache-2.0
// The values of a model file, as they stand in it: a reader of TOML that shares nothing with the
// front end. It knows no defaults and changes no number.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "runtime/certificate/verifier/expression.hpp"

namespace regulus::verifier {

struct WrittenValue {
  std::string text;      ///< of a number as written; of a string what is between its quotes
  std::size_t line = 0;  ///< from 1
  bool is_string = false;
};

/// By their places: "motion.work.x[0]" is the first element of x in [motion.work].
using WrittenValues = std::map<std::string, WrittenValue, std::less<>>;

/// Throws Unfinished for what it does not understand, with the line.
[[nodiscard]] WrittenValues read_model_values(std::string_view text);

/// The number that a TOML number denotes; underscores, signs and 0x, 0o, 0b allowed. Throws
/// Unfinished for another text.
[[nodiscard]] NodeId number_of_toml(std::string_view text, Graph& graph);

}  // namespace regulus::verifier
