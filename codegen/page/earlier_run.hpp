// SPDX-License-Identifier: GPL-3.0-or-later
// Files of earlier runs, which a page shows without running again.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "codegen/model/request.hpp"

namespace regulus::inline page {

enum class EarlierKind {
  kCertificate,  ///< of `check --certificate`
  kCheck,        ///< report of `check --json`
  kPaving,       ///< boxes of `locate --output`, or the report of `locate --json`
  kBound,        ///< report of `bound --json`
  kMargin,       ///< report of `margin --json`
};

/// Returns "certificate", "report of check", … for messages and pages.
[[nodiscard]] const char* name(EarlierKind kind);

struct EarlierRun {
  EarlierKind kind = EarlierKind::kCheck;
  std::string path;
  std::string sha256;  ///< of the file
  /// The report that --json printed; of a paving its summary; null for a certificate.
  nlohmann::ordered_json report;
  /// Hold the boxes of a paving: the line `regulus_paving`, and the tree (PavingTree::text()).
  nlohmann::ordered_json header;
  std::string tree;
  /// Holds a paving along way-points.
  nlohmann::ordered_json stretches;
};

/// Reads a file, which is on a disk.
///
/// Throws    FileError; InputError if it is not one of these, is not complete, or is the report of
///           an error.
[[nodiscard]] EarlierRun read_earlier_run(const std::string& path);

/// Sets the motion of the options if they have none. If they have no range, tolerance, threshold or
/// tube, sets those of the run that differ from the model file.
///
/// Requires  options.path is the model file.
/// Throws    as require_same_question; FileError and InputError for the model file.
void adopt_question(const EarlierRun& run, ModelOptions& options);

/// Throws    InputError unless the run is about the same model file, by name and SHA-256, and the
///           same motion, and asks the same question: ranges, way-points, and for all but margins,
///           which vary them, tolerances and threshold.
///
/// Requires  the run is not a certificate: verify_file() compares that.
void require_same_question(const EarlierRun& run, const Request& request);

}  // namespace regulus::page
