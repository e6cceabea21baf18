// SPDX-License-Identifier: GPL-3.0-or-later
// Processes that attack one model after the other, so that a crash or a hang is that model's alone.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "tests/attack/runner/subject.hpp"

namespace regulus::attack {

struct Limits {
  double seconds = 20;                           ///< of processor time, for each stage
  std::uint64_t bytes = std::uint64_t{6} << 30;  ///< of address space
};

struct Job {
  std::uint64_t count = 0;                    ///< of models
  std::function<Attack(std::uint64_t)> make;  ///< by number
  std::function<void(std::uint64_t, const Outcome&)> done;
  unsigned processes = 2;
  Limits limits;
  Mutant mutant = Mutant::kNone;
  bool verify = true;
};

/// Every model once; false where a signal stopped it before. Throws std::runtime_error where
/// processes cannot be made.
[[nodiscard]] bool run_all(const Job& job);

}  // namespace regulus::attack
