// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus verify`, `regulus import` and `regulus list` for a program.
#pragma once

#include <cstdint>
#include <string>

#include "codegen/model/import/import.hpp"
#include "codegen/use/api/question.hpp"

namespace regulus {

struct VerifyOptions {
  std::string model{};      ///< the model file that the certificate must be about; empty: any
  std::string waypoints{};  ///< the file of way-points that check() took; empty: none
  unsigned threads = 1;
  double time_limit = 0;        ///< seconds, 0: no bound
  std::uint64_t max_boxes = 0;  ///< into which all leaves may be cut; 0: as the command
  /// Ranges, tolerances, alpha and larger control errors may differ from the model file.
  bool allow_options = false;
};

enum class ProofOutcome { kVerified, kRejected, kUnfinished };

struct Confirmation {
  ProofOutcome outcome = ProofOutcome::kUnfinished;
  std::string claim;   ///< what is proved, if it is verified
  std::string reason;  ///< why it is not verified
  std::string json;    ///< the report that --json prints
};

/// Proves the claim of a certificate again, by separate code; and that it is about the model of the
/// options, if they name one. Threads and errors as check().
[[nodiscard]] Confirmation verify(const std::string& path, const VerifyOptions& options = {});

/// Reads a URDF, MJCF or SDF file as a model. Throws InputError, UsageError and FileError.
[[nodiscard]] Imported import_file(const std::string& path, const ImportOptions& options = {});

/// Returns the names of a model as JSON: motions with their ranges, tolerance groups, loads,
/// twists. The motion of the question and its changes do not matter. Threads and errors as check().
[[nodiscard]] std::string describe_model(const Question& question);

}  // namespace regulus
