// SPDX-License-Identifier: Apache-2.0
// Reads a certificate and proves its claim anew.
#pragma once

#include <cstdint>
#include <istream>
#include <string>

#include "regulus/certificate/verifier/question.hpp"

namespace regulus::verifier {

enum class Outcome {
  kVerified,    ///< the claim is true
  kRejected,    ///< not a certificate, incomplete, or its claim has been shown to be false
  kUnfinished,  ///< neither has been shown
};

struct Options {
  std::uint64_t max_boxes = 1 << 22;  ///< that all leaves together may be cut into
  std::uint64_t max_boxes_per_leaf = 1 << 16;
  long max_bits = 4096;  ///< where doubles do not tell the sign of a determinant
};

struct Verification {
  Outcome outcome = Outcome::kUnfinished;
  std::string reason;  ///< of kRejected and kUnfinished
  std::string claim;   ///< empty if it could not be read
  std::string model, sha256, motion;
  std::uint64_t leaves = 0;
  std::uint64_t boxes = 0;  ///< that the leaves were cut into
};

/// Ensures   kVerified only if the claim of the file is true (PROOF.md). Throws nothing but
///           std::bad_alloc, and std::runtime_error when the file cannot be read, the rounding
///           mode is not to nearest, or small numbers are flushed to zero.
[[nodiscard]] Verification verify(std::istream& file, const Options& options = {});

/// What a certificate says, as one text for a person: outcome, claim, counts.
[[nodiscard]] std::string describe(const Verification& verification);

[[nodiscard]] const char* name(Outcome outcome) noexcept;

}  // namespace regulus::verifier
