// SPDX-License-Identifier: GPL-3.0-or-later
// Decides if a certificate is about a model file: the question is written anew from the file, and
// compared.
#pragma once

#include <string>
#include <vector>

#include "codegen/answer/certificate/certificate_head.hpp"
#include "codegen/model/request.hpp"

namespace regulus {

struct ModelConfirmation {
  /// Why the question is not that of the file, for any ranges, tolerances and threshold.
  std::string refusal;
  /// The values that differ from those of the file, as options of a command line may set them.
  std::vector<std::string> differences;
  /// The options of a command line that asks the question, without a path; empty after a refusal.
  ModelOptions options;
};

/// Ensures   without a refusal, every line of the question up to a line `quantity` is the one that `--certificate` writes
///           for this file, with the motion that the question names and the ranges, tolerances and
///           threshold that it states. It may only have more conditions without names.
///           `waypoints`: the file that the option --waypoints named; empty: none.
///           Throws InputError and FileError for the model file and the way-points.
[[nodiscard]] ModelConfirmation confirm_model(const CertificateHead& certificate,
                                              const std::string& model,
                                              const std::string& waypoints = {});

}  // namespace regulus
