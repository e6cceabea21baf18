// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a certificate is about a model file: its question is written anew from the file, and
// compared.
#pragma once

#include <string>
#include <vector>

#include "codegen/certificate/certificate_head.hpp"

namespace regulus::inline certificate {

struct ModelConfirmation {
  /// Why the question is not that of the file, whatever ranges, tolerances and threshold it has.
  std::string refusal;
  /// What it has instead of what the file says, as options of a command line may ask for.
  std::vector<std::string> differences;
};

/// Ensures   without a refusal every line of the question is the one that `--certificate` writes
///           for this file, the motion that the question names and the ranges, tolerances and
///           threshold that it states; but for conditions without names, of which it may have more.
///           Throws InputError and FileError for the model file.
[[nodiscard]] ModelConfirmation confirm_model(const CertificateHead& certificate,
                                              const std::string& model);

}  // namespace regulus::certificate
