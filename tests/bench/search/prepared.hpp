// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "codegen/engine/options.hpp"
#include "codegen/engine/pipeline.hpp"
#include "runtime/problem/result.hpp"
#include "tests/bench/measure/rounds.hpp"

namespace regulus::bench {

/// What to certify, in words of the command line.
struct SearchCase {
  const char* title;
  const char* model;  ///< a path, or below models/ without .toml
  const char* motion;
  const char* tolerance = "";    ///< of base and platform
  double most_microseconds = 0;  ///< the target for a box on the best instruction set; 0: none
};

/// A search that only has to be started: the kernel is compiled.
class TimedSearch {
 public:
  TimedSearch(const SearchCase& which, const SearchOptions& options);

  Settings& settings() noexcept { return settings_; }
  void run();

  /// Of the last run. Throws std::logic_error unless that proved NO SINGULARITY: a time without a
  /// verdict compares with nothing.
  [[nodiscard]] const Statistics& statistics() const;

 private:
  PreparedSearch preparation_;
  Settings settings_;
  Result result_;
};

}  // namespace regulus::bench
