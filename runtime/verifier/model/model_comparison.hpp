// SPDX-License-Identifier: Apache-2.0
// Decides if a question is that of a model file. The verifier's own readers read every value and
// every expression of the file; each is compared with the value that the certificate states for it.
#pragma once

#include "runtime/verifier/model/cut_sides.hpp"
#include "runtime/verifier/model/model_file.hpp"
#include "runtime/verifier/question.hpp"
#include "runtime/verifier/verify.hpp"

namespace regulus::verifier {

/// The certificate is about another model file.
class OtherModel : public Rejection {
 public:
  using Rejection::Rejection;
};

/// Compares all that the question states with all that the file says about this robot and this
/// motion. Counts in `result` the compared values, and lists those that options may have changed.
/// `compared`: keys of Question::stated that are compared elsewhere. `sides`: of the cuts of atan2
/// that the question is about; may be null.
/// Throws OtherModel for any other difference, with both texts and their lines; Unfinished if a value
/// of the file or a line of the certificate could not be compared.
void compare_with_model(Question& question, const WrittenValues& values, const Options& options,
                        Verification& result, const std::vector<std::string>& compared = {},
                        CutSides* sides = nullptr);

/// The same. Then throws OtherModel, also instead of Unfinished, unless the labels of the question are
/// those of the file: its name, and its SHA-256 or "-".
void compare_with_file(Question& question, const WrittenValues& values, const Options& options,
                       Verification& result, const std::vector<std::string>& compared = {},
                       CutSides* sides = nullptr);

}  // namespace regulus::verifier
