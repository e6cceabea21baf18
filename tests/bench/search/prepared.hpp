// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "codegen/question/engine/options.hpp"
#include "codegen/question/engine/pipeline.hpp"
#include "runtime/search/solver.hpp"
#include "tests/bench/measure/rounds.hpp"

namespace regulus::detail::bench {

/// A question, in words of the command line.
struct SearchCase {
  const char* title;
  const char* model;  ///< a path, or a name below models/ without .toml
  const char* motion;
  const char* tolerance = "";    ///< of base and platform
  double most_microseconds = 0;  ///< target for the search on the best instruction set
};

/// A search that is ready to start: its kernel is compiled.
class TimedSearch {
 public:
  TimedSearch(const SearchCase& which, const SearchOptions& options);

  Settings& settings() noexcept { return settings_; }
  /// Uses one solver for all runs: it knows the question.
  void run();
  /// Uses a new one: it must be set up, and knows nothing.
  void run_anew();

  /// Returns those of the last run. Throws std::logic_error if that run proved nothing, because a
  /// time without a verdict cannot be compared.
  [[nodiscard]] const Statistics& statistics() const;

 private:
  PreparedSearch preparation_;
  Settings settings_;
  Solver solver_;
  Result result_;
};

}  // namespace regulus::detail::bench
