// SPDX-License-Identifier: GPL-3.0-or-later
// The command, in this process: the one file here that knows the project.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/attack/oracle/attack.hpp"
#include "tests/attack/runner/outcome.hpp"

namespace regulus::attack {

/// A verdict or a text that is falsified on purpose, to see that it is noticed.
enum class Mutant {
  kNone,
  kFlipped,  ///< NO SINGULARITY for SINGULARITY and the reverse; NO SINGULARITY where it is open
  kRounded,  ///< numbers of the model rounded to doubles
};

/// The words of the command line that checks the model: options of the attack, and others by
/// chance.
[[nodiscard]] std::vector<std::string> check_words(const Attack& attack,
                                                   const std::string& model_path,
                                                   const std::string& certificate_path);

struct Run {
  std::string folder;  ///< for the model and its certificate
  Mutant mutant = Mutant::kNone;
  bool verify = true;
  /// Is called at the beginning of each stage, with the exit code of the check if there is one yet.
  std::function<void(Stage, int)> entering;
};

/// Checks the model as `regulus check` does, and the certificate as `regulus verify` does.
[[nodiscard]] Outcome attack_with(const Attack& attack, const Run& run);

}  // namespace regulus::attack
