// SPDX-License-Identifier: GPL-3.0-or-later
// Prints for people, in the colours of a terminal.
#pragma once

#include <string>

namespace regulus::detail {

/// True if the file is a terminal that may be sent colours: TERM is set and not "dumb", and NO_COLOR
/// is not set, or empty (no-color.org).
[[nodiscard]] bool takes_colours(int file);

/// Returns a report as it is; for a terminal with its lines broken at blanks, to fit.
[[nodiscard]] std::string for_file(int file, const std::string& report);

/// Prints a report on standard error, with what a path in it could hide from a terminal.
void print_report(const std::string& text);

/// Prints the answer alone on a line of standard output. On a terminal it is green if the code is
/// that of a proof, red if it is that of a witness, otherwise yellow.
void print_answer(const std::string& text, int exit_code);

}  // namespace regulus::detail
