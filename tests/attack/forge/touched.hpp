// SPDX-License-Identifier: GPL-3.0-or-later
// Which lines of the format a change touches.
#pragma once

#include <set>
#include <string>

namespace regulus::detail::attack {

/// Returns the first words of the lines that only one of two certificates has; of `quantity` also the
/// second.
[[nodiscard]] std::set<std::string> words_touched(const std::string& before,
                                                  const std::string& after);
/// Returns the first words of the lines of a certificate up to `proof`.
[[nodiscard]] std::set<std::string> words_of_question(const std::string& certificate);
/// Returns the verdict of a certificate.
[[nodiscard]] std::string verdict_of(const std::string& certificate);
/// Returns the verdicts that FORMAT.md describes.
[[nodiscard]] std::set<std::string> verdicts_of_format(const std::string& page);
/// Returns the first words of the lines that FORMAT.md describes in its tables.
[[nodiscard]] std::set<std::string> words_of_format(const std::string& page);

}  // namespace regulus::detail::attack
