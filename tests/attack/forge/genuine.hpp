// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the command and the verifier on files in a folder.
#pragma once

#include <optional>
#include <string>

#include "runtime/verifier/verify.hpp"
#include "tests/attack/forge/bases.hpp"

namespace regulus::detail::attack {

/// Returns the text of the base's model file.
[[nodiscard]] std::string model_of(const Base& base);

struct Answer {
  bool is_refused = false;                 ///< the text is not a model, or has no such question
  std::optional<std::string> certificate;  ///< the first that is written
};

/// Returns what the base's command answers about this model text.
[[nodiscard]] Answer answer_about(const Base& base, const std::string& model,
                                  const std::string& folder);

/// Proves a certificate, and that it is about this model text.
[[nodiscard]] verifier::Verification verify_about(const Base& base, const std::string& certificate,
                                                  const std::string& model,
                                                  const std::string& folder);

}  // namespace regulus::detail::attack
