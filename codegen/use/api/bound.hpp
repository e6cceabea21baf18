// SPDX-License-Identifier: GPL-3.0-or-later
// `regulus bound` for a program: the largest or least value of a force, an error or a speed.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "codegen/question/engine/options.hpp"
#include "codegen/question/quantity/quantity.hpp"
#include "codegen/use/api/margin.hpp"
#include "codegen/use/api/question.hpp"

namespace regulus {

struct BoundOptions {
  SearchOptions search = MarginOptions::for_a_minute();
  QuantityOptions quantity{};
  std::string limit{};  ///< compare with it; empty: bracket the value
  std::string gap =
      "0.01";  ///< the bracket is closed when it is at most this part of its larger end
  std::string certificate{};  ///< FILE of the proofs FILE.COMPONENT.safe and .singular; empty: none
  std::uint64_t shard_size = 0;  ///< of each proof, as for check()
};

enum class BoundVerdict { kBracket, kWithin, kExceeded, kUndecided };

struct BoundFinding {
  BoundVerdict verdict = BoundVerdict::kBracket;  ///< of the limit
  /// The value that is attained, rounded so that it claims no more than it should, and the value
  /// that is proved not to be passed, rounded away from it.
  std::optional<double> attained, proved;
  bool closed = false;  ///< as narrow as requested
  std::string unit;
  std::string result;                      ///< "BETWEEN 21.12 AND 21.29 N (leg 3)"
  std::string report;                      ///< the lines that precede the result on a terminal
  std::string json;                        ///< the report that --json prints
  std::vector<CertifiedEnd> certificates;  ///< two for each component, if they were wanted
};

/// Threads and errors as check().
[[nodiscard]] BoundFinding bound(const Question& question, const BoundOptions& options,
                                 const std::atomic<bool>* interrupt = nullptr);

}  // namespace regulus
