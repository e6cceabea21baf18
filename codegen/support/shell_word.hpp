// SPDX-License-Identifier: GPL-3.0-or-later
// Commands that a reader copies into a shell.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace regulus::detail {

/// Returns the word as a POSIX shell reads it: in single quotes, unless every character is plain.
[[nodiscard]] std::string shell_word(std::string_view word);

/// Returns the command line that has these words.
[[nodiscard]] std::string shell_command(std::span<const std::string> words);

/// Returns the words of a command line that shell_command made.
[[nodiscard]] std::vector<std::string> words_of_command(std::string_view command);

}  // namespace regulus::detail
