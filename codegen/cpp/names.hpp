// SPDX-License-Identifier: GPL-3.0-or-later
// What names of a model may become in generated code. A model file is untrusted.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace regulus::inline cpp {

/// The text as a part of an identifier: letters, digits and single underscores; anything else
/// becomes "_". Not injective: NameTable keeps results apart.
[[nodiscard]] std::string identifier_part(std::string_view text);

/// Whether the text is a C identifier of ASCII letters, digits and underscores.
[[nodiscard]] bool is_identifier(std::string_view text);

/// The names taken in one scope of generated code.
class NameTable {
 public:
  /// `wanted`, or `wanted` with the first free number behind it.
  ///
  /// Requires  `wanted` starts with a prefix that is no keyword and no name of pack.hpp: v_, t_ …
  [[nodiscard]] std::string take(const std::string& wanted);

 private:
  std::set<std::string> taken_;
};

}  // namespace regulus::inline cpp
