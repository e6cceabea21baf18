// SPDX-License-Identifier: GPL-3.0-or-later
// Decides by values at points if two certificates ask the same question. It shares no code with the
// verifier or the front end.
#pragma once

#include <string>

namespace regulus::attack {

/// Returns the first difference; empty if the lines of both are the same, or have the same values at
/// some points. Labels, the order of conditions and lines that do not change the claim do not count.
[[nodiscard]] std::string difference(const std::string& one, const std::string& other);

}  // namespace regulus::attack
