// SPDX-License-Identifier: GPL-3.0-or-later
// Processes that attack one model after the other, so a crash or a hang affects one model only.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "tests/attack/runner/subject.hpp"

namespace regulus::detail::attack {

struct Limits {
  double seconds = 20;                           ///< of processor time, for each stage
  std::uint64_t bytes = std::uint64_t{6} << 30;  ///< of address space
};

struct Job {
  std::uint64_t count = 0;                    ///< number of models
  std::function<Attack(std::uint64_t)> make;  ///< makes a model from its number
  std::function<void(std::uint64_t, const Outcome&)> done;
  unsigned processes = 2;
  Limits limits;
  Mutant mutant = Mutant::kNone;
  bool verify = true;
};

/// Attacks every model once; returns false if a signal stopped it. Throws std::runtime_error if it
/// cannot make processes.
[[nodiscard]] bool run_all(const Job& job);

}  // namespace regulus::detail::attack
