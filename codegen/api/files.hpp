// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus verify`, `regulus import` and `regulus list` for a program.
#pragma once

#include <string>
#include <vector>

#include "codegen/api/question.hpp"
#include "codegen/certificate/verify_file.hpp"
#include "codegen/import/import.hpp"

namespace regulus::inline api {

struct Confirmation {
  verifier::Outcome outcome = verifier::Outcome::kUnfinished;
  std::string claim;   ///< what is proved, if it is verified
  std::string reason;  ///< why it is not verified
  std::string json;    ///< the report that --json prints
};

/// Proves the claim of a certificate again, by separate code; and that it is about
/// `request.model`, if this is not empty. Threads and errors as check().
[[nodiscard]] Confirmation verify(const VerificationRequest& request);

/// Reads a URDF, MJCF or SDF file as a model. Throws InputError, UsageError and FileError.
[[nodiscard]] Imported import_file(const std::string& path, const ImportOptions& options = {});

/// Returns the names of a model as JSON: motions with their ranges, tolerance groups, loads,
/// twists. The motion of the question and its changes do not matter. Threads and errors as check().
[[nodiscard]] std::string describe_model(const Question& question);

}  // namespace regulus::api
