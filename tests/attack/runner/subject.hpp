// SPDX-License-Identifier: GPL-3.0-or-later
// Calls the command in this process. Only subject.cpp includes the project's code.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/attack/oracle/attack.hpp"
#include "tests/attack/runner/outcome.hpp"

namespace regulus::detail::attack {

/// A deliberately falsified verdict or text: a test that the judge notices it.
enum class Mutant {
  kNone,
  kFlipped,  ///< NO SINGULARITY and SINGULARITY exchanged; NO SINGULARITY if it is open
  kRounded,  ///< numbers of the model rounded to doubles
};

/// Returns the words of the command line that checks the model: options of the attack, and others
/// at random.
[[nodiscard]] std::vector<std::string> check_words(const Attack& attack,
                                                   const std::string& model_path,
                                                   const std::string& certificate_path);

struct Run {
  std::string folder;  ///< for the model and its certificate
  Mutant mutant = Mutant::kNone;
  bool verify = true;
  /// Callback at the beginning of each stage; receives the exit code of the check, if there is one.
  std::function<void(Stage, int)> entering;
};

/// Checks the model as `regulus check` does, and the certificate as `regulus verify` does.
[[nodiscard]] Outcome attack_with(const Attack& attack, const Run& run);

}  // namespace regulus::detail::attack
