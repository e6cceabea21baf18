// SPDX-License-Identifier: GPL-3.0-or-later
// Converts a line and a column of a text to a position in its bytes.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace regulus::detail {

/// A UTF-8 text by lines and characters, as toml++ counts them: both from 1, a line ends with '\n',
/// a column is a code point, and a byte order mark at the start does not count.
class SourceLines {
 public:
  /// The text must outlive this.
  explicit SourceLines(std::string_view text);

  [[nodiscard]] std::string_view text() const noexcept { return text_; }

  /// Returns the byte where that character begins, or the size of the text for places beyond its
  /// end. The time does not depend on the place.
  [[nodiscard]] std::size_t offset(std::size_t line, std::size_t column) const noexcept;

 private:
  std::string_view text_;
  std::vector<std::size_t> first_of_line_;  // the number of each line's first character
  std::vector<std::size_t> bytes_;          // where every kStride-th character begins
};

}  // namespace regulus::detail
