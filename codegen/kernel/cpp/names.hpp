// SPDX-License-Identifier: GPL-3.0-or-later
// Names of a model in generated code. A model file is untrusted.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace regulus::detail {

/// Returns the text as a part of an identifier: letters, digits and single underscores; any other
/// character becomes "_". Not injective: NameTable makes results distinct.
[[nodiscard]] std::string identifier_part(std::string_view text);

/// True if the text is a C identifier of ASCII letters, digits and underscores.
[[nodiscard]] bool is_identifier(std::string_view text);

/// The names taken in one scope of generated code.
class NameTable {
 public:
  /// Returns `wanted`, or `wanted` with the first free number after it.
  ///
  /// Requires  `wanted` starts with a prefix that is not a keyword and not a name of pack.hpp: v_,
  ///           t_ …
  [[nodiscard]] std::string take(const std::string& wanted);

 private:
  std::set<std::string> taken_;
};

}  // namespace regulus::detail
