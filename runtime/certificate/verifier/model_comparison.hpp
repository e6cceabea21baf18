// SPDX-License-Identifier: Apache-2.0
// Whether a question is that of a model file: every value and every expression of the file, read by
// a reader of the verifier's own, against what the certificate says in its place.
#pragma once

#include "runtime/certificate/verifier/question.hpp"
#include "runtime/certificate/verifier/verify.hpp"

namespace regulus::verifier {

/// The certificate is about another model file.
class OtherModel : public Rejection {
 public:
  using Rejection::Rejection;
};

/// Counts in `result` what was compared, and lists what options may have changed and what could not
/// be compared. Throws OtherModel for what differs otherwise, with both texts and their lines;
/// Unfinished where the file cannot be read.
void compare_with_model(Question& question, const Options& options, Verification& result);

}  // namespace regulus::verifier
