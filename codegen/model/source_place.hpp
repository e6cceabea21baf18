// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace regulus {

/// A place in a C++ program. It replaces std::source_location, which Clang has only from version
/// 15.
class SourcePlace {
 public:
  constexpr SourcePlace() noexcept = default;

  /// Returns the place of the call; as a default argument, the place of the call of that function.
  static constexpr SourcePlace current(const char* file = __builtin_FILE(),
                                       unsigned line = __builtin_LINE()) noexcept {
    SourcePlace place;
    place.file_ = file;
    place.line_ = line;
    return place;
  }

  [[nodiscard]] constexpr const char* file_name() const noexcept { return file_; }
  [[nodiscard]] constexpr unsigned line() const noexcept { return line_; }

 private:
  const char* file_ = "";
  unsigned line_ = 0;
};

}  // namespace regulus
