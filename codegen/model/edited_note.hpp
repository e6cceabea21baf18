// SPDX-License-Identifier: GPL-3.0-or-later
// A matrix that the shell has edited says so in a note. Nothing is known of a robot that has it.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace regulus::detail {

/// The beginning of that note, among Model::matrix_notes.
inline constexpr std::string_view kEdited = "edited: ";

[[nodiscard]] inline bool is_edited(const std::vector<std::string>& matrix_notes) {
  return std::ranges::any_of(matrix_notes,
                             [](const std::string& note) { return note.starts_with(kEdited); });
}

}  // namespace regulus::detail
