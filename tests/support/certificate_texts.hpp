// SPDX-License-Identifier: GPL-3.0-or-later
// Certificates written by hand, as FORMAT.md says.
#pragma once

#include <sstream>
#include <string>

#include "runtime/verifier/verify.hpp"

namespace regulus::detail::test {

inline const char* const kFullRank1 =
    "verdict NO SINGULARITY\nclaim the full 1x1 matrix of the model is defined and has full rank "
    "at "
    "every pose of the variety\n";
inline const char* const kSingular1 =
    "verdict SINGULARITY\nclaim the full 1x1 matrix of the model is singular at some pose of the "
    "variety\n";

/// Returns a question about a matrix of one entry, over x in `range`.
inline std::string scalar_question(const std::string& entry, const std::string& range = "1 : 2",
                                   const std::string& claim = kFullRank1) {
  return "regulus-certificate 1\n" + claim +
         "model by hand\nsha256 -\nmotion only\nalpha 0\nparameter x in " + range +
         "\npose x = x\nmatrix 1 1\nentry " + entry + "\n";
}

inline const char* const kOneLeaf = "proof\nl 0 mean-value\nend 1\n";

inline verifier::Verification verify_text(const std::string& text,
                                          const verifier::Options& options = {}) {
  std::istringstream stream(text);
  return verifier::verify(stream, options);
}

}  // namespace regulus::detail::test
