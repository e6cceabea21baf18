// SPDX-License-Identifier: Apache-2.0
// Decides if a question is that of a model file. The verifier's own reader reads every value and
// every expression of the file; each is compared with the value that the certificate states for it.
#pragma once

#include "runtime/certificate/verifier/question.hpp"
#include "runtime/certificate/verifier/verify.hpp"

namespace regulus::verifier {

/// The certificate is about another model file.
class OtherModel : public Rejection {
 public:
  using Rejection::Rejection;
};

/// Counts in `result` the compared values; lists the values that options may have changed, and
/// those that could not be compared. `compared`: keys of Question::stated that are compared elsewhere.
/// Throws OtherModel for any other difference, with both texts
/// and their lines; Unfinished if the file cannot be read.
void compare_with_model(Question& question, const Options& options, Verification& result,
                        const std::vector<std::string>& compared = {});

}  // namespace regulus::verifier
