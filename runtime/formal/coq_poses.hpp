// SPDX-License-Identifier: Apache-2.0
// The poses of a platform on three legs in the plane as configurations: each leg is an equation.
#pragma once

#include <string>
#include <vector>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// A list of configurations, and the lines of its certificate.
struct ListedConfigurations {
  Question question;
  std::vector<std::string> lines;
};

/// The squared lengths of the legs stand in the equations, or are constants beside them.
enum class SquaresOfLegs { kInEquations, kConstants };

/// Returns what a certificate lists, if that is configurations of a closure. The poses of a platform on
/// three legs in the plane become configurations with the unknowns x, y and phi, within ranges that have
/// all poses.
///
/// Requires: `lines`, the lines of `question`, have been read, and it has solutions.
/// Throws Rejection for a line `solution` with an angle that is too large; Unfinished if it lists
/// something else, or if a number of the legs is too large, or not certain.
[[nodiscard]] ListedConfigurations configurations_of(const Question& question,
                                                     const std::vector<std::string>& lines,
                                                     SquaresOfLegs squares);

}  // namespace regulus::verifier
