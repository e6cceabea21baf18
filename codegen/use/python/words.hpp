// SPDX-License-Identifier: GPL-3.0-or-later
// The words of reports for what has a name in capitals.
#pragma once

#include <string>

namespace regulus::detail {

/// Returns "no-singularity" for NO SINGULARITY.
template <class Verdict>
[[nodiscard]] std::string word_of_verdict(Verdict verdict) {
  std::string word = name(verdict);
  for (char& c : word) c = c == ' ' ? '-' : static_cast<char>(c - 'A' + 'a');
  return word;
}

}  // namespace regulus::detail
