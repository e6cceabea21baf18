// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the command and the verifier on files in a folder.
#pragma once

#include <optional>
#include <string>

#include "runtime/certificate/verifier/verify.hpp"
#include "tests/attack/forge/bases.hpp"

namespace regulus::attack {

/// Returns the text of the base's model file.
[[nodiscard]] std::string model_of(const Base& base);

/// Returns the first certificate that the base's command writes about this model text; nullopt if it
/// writes none.
[[nodiscard]] std::optional<std::string> certificate_of(const Base& base, const std::string& model,
                                                        const std::string& folder);

/// Proves a certificate, and that it is about this model text.
[[nodiscard]] verifier::Verification verify_about(const Base& base, const std::string& certificate,
                                                  const std::string& model,
                                                  const std::string& folder);

}  // namespace regulus::attack
