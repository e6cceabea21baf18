// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the lines of a program in G-code as words: the grammar, and the closed list of the words that
// are known, of RS274/NGC (NISTIR 6556) and LinuxCNC ("G Codes", "M Codes").
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace regulus::detail {

/// The modal groups of RS274/NGC: a line has at most one word of each.
enum class GcodeGroup {
  kDwell,
  kMotion,
  kPlane,
  kDistance,
  kCentres,
  kFeed,
  kUnits,
  kRadius,
  kLength,
  kOrigin,
  kPathControl,
  kSpindleMode,
  kStop,
  kSpindle,
  kCoolant,
  kOverrides
};

/// The words of a line. They act in the order of execution of RS274/NGC, whatever their order is.
struct GcodeBlock {
  int line = 0;
  std::map<GcodeGroup, std::string> modes;  ///< such as "G90.1" and "M3"
  std::map<char, GiNaC::numeric> numbers;   ///< of the other letters, but N
  std::set<std::string> without_effect;     ///< words that change no path

  [[nodiscard]] bool has(char letter) const { return numbers.contains(letter); }
  /// Returns the word of the group; empty: there is none.
  [[nodiscard]] std::string mode(GcodeGroup group) const;
};

/// A program as its lines.
class GcodeText {
 public:
  /// `text` must outlive this object. `file` is named in errors.
  GcodeText(std::string file, std::string_view text);

  /// Returns the words of the next line; nullopt behind the last line and behind the second `%`.
  ///
  /// Errors    InputError with the line for every word and character that is not known, and for
  ///           words that cannot be on one line.
  [[nodiscard]] std::optional<GcodeBlock> next();

 private:
  [[nodiscard]] std::string_view take_line();
  [[nodiscard]] bool is_end(std::string_view line);

  std::string file_;
  std::string_view rest_;
  int line_ = 0;
  bool is_framed_ = false;  ///< the program began with a line `%`
  bool has_begun_ = false;  ///< a line that is not blank was read
};

}  // namespace regulus::detail
