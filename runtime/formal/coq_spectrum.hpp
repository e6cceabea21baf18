// SPDX-License-Identifier: Apache-2.0
// The certificate of singular values, or of the condition number in the 2-norm: SingularValues.v has
// its proof. The question is that of the robot; the scales of the rows and the factors of the columns
// stand beside it.
#pragma once

#include <string>
#include <vector>

#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

struct SpectrumQuestion {
  std::string question;           ///< about the matrix
  std::vector<std::string> more;  ///< lines for coq_question: `scale` and `factor`
  std::string limit;
  std::string claim;  ///< `condition_2_below`, …
};

/// Returns true for a bound of the singular values of the matrix of a question, or of their ratio; not
/// for those of a closure.
[[nodiscard]] bool is_about_spectrum(const Question& question);

/// Takes the quantity out of the lines of a certificate, which are those of `question`. Throws
/// Unfinished if its claim is that a value is attained.
///
/// Requires  is_about_spectrum(question).
[[nodiscard]] SpectrumQuestion split_spectrum(const Question& question,
                                              const std::vector<std::string>& lines);

}  // namespace regulus::verifier
