// SPDX-License-Identifier: Apache-2.0
// From which link, and which point of it, the Jacobian of an arm looks like the matrix of a
// certificate. Numbers at some points suggest it; nothing is proved here.
#pragma once

#include <string>
#include <vector>

#include "runtime/formal/coq_arm.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

struct ArmView {
  std::size_t link = 0;            ///< as many joints are before it
  std::vector<std::string> point;  ///< three coordinates in its frame, in Coq
  std::vector<std::size_t> rows;   ///< of the Jacobian
  /// The determinant of these rows is so many times that of the matrix; "": the rows, or the columns
  /// if there are more joints than six, are those of the matrix.
  std::string ratio;
};

/// `names`: the variables of the question as identifiers or in parentheses. Throws Unfinished if no view
/// is found.
[[nodiscard]] ArmView find_arm_view(const Question& question, const WrittenValues& values,
                                    const std::vector<std::string>& names);

}  // namespace regulus::verifier
