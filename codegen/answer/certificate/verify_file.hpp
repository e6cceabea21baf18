// SPDX-License-Identifier: GPL-3.0-or-later
// Verifies a certificate file, and that it is about a model.
#pragma once

#include <string>

#include "runtime/verifier/verify.hpp"

namespace regulus::detail {

struct VerificationRequest {
  std::string path;
  std::string model{};      ///< the model file it must be about; empty: any
  std::string waypoints{};  ///< the file of way-points that check took; empty: none
  /// Ranges, tolerances, alpha and larger control errors may be other than the file's; they are listed.
  bool allows_options = false;
  verifier::Options options{};  ///< its path, model and way-points are set by verify_file
};

/// Throws    FileError if a file cannot be read, InputError for the model file.
[[nodiscard]] verifier::Verification verify_file(const VerificationRequest& request);

}  // namespace regulus::detail
