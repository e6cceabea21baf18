// SPDX-License-Identifier: GPL-3.0-or-later
// Verifies a certificate file, and that it is about a model.
#pragma once

#include <string>
#include <vector>

#include "runtime/verifier/verify.hpp"

namespace regulus {

struct VerificationRequest {
  std::string path;
  std::string model{};      ///< the model file it must be about; empty: any
  std::string waypoints{};  ///< the file of way-points that check took; empty: none
  /// Ranges, tolerances, alpha and larger control errors may be other than the file's; they are listed.
  bool allows_options = false;
  verifier::Options options{};  ///< its path, model and overridden values are set by verify_file
};

struct Verified {
  verifier::Verification verification;
  std::vector<std::string> differences;  ///< from the model file
};

/// Throws    FileError if a file cannot be read, InputError for the model file.
[[nodiscard]] Verified verify_file(const VerificationRequest& request);

}  // namespace regulus
