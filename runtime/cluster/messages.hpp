// SPDX-License-Identifier: Apache-2.0
// The messages between the supervisor of a search and its workers.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/cluster/unit.hpp"

namespace regulus::detail::cluster {

/// Supervisor to worker: decide these units and, while fewer boxes than the budget were evaluated,
/// the groups that they leave.
struct Grant {
  std::uint64_t number = 0;
  std::uint64_t budget = 0;
  std::vector<Unit> units;
};

/// The outcome of one unit. Units are counted from 0: those of the grant first; whenever a unit is
/// decided, its groups get the next numbers.
struct UnitResult {
  std::uint64_t unit = 0;
  std::string outcome;
};

/// Worker to supervisor.
struct Answer {
  std::uint64_t grant = 0;  ///< 0: the worker has nothing to do
  double seconds = 0;       ///< from the begin of the first unit to the end of the last
  std::vector<UnitResult> results;
};

[[nodiscard]] std::string write_grant(const Grant& grant);
[[nodiscard]] std::string write_answer(const Answer& answer);

/// Accept any bytes. Throw MalformedMessage.
[[nodiscard]] Grant read_grant(std::string_view bytes);
[[nodiscard]] Answer read_answer(std::string_view bytes);

}  // namespace regulus::detail::cluster
