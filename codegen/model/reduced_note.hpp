// SPDX-License-Identifier: GPL-3.0-or-later
// A model whose matrix lacks rows or columns of the robot's full one says so in a note, and why.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace regulus::detail {

/// The beginning of that note, among Model::matrix_notes.
inline constexpr std::string_view kReduced = "reduced: ";

/// Returns the word in claims: "the full 6×6 matrix", "the reduced 3×3 matrix".
[[nodiscard]] inline const char* full_or_reduced(const std::vector<std::string>& matrix_notes) {
  const auto is_reason = [](const std::string& note) { return note.starts_with(kReduced); };
  return std::ranges::any_of(matrix_notes, is_reason) ? "reduced" : "full";
}

}  // namespace regulus::detail
