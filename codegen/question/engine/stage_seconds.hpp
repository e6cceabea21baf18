// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace regulus::detail {

/// Seconds spent in each stage.
struct StageSeconds {
  double model = 0;
  double symbolic = 0;
  double program =
      0;            ///< from expressions to the list of operations that is interpreted or compiled
  double emit = 0;  ///< of C++ text
  double compile = 0;  ///< by a compiler, or to find its code in the cache
  double search = 0;

  [[nodiscard]] double before_search() const noexcept {
    return model + symbolic + program + emit + compile;
  }

  StageSeconds& operator+=(const StageSeconds& other) noexcept {
    model += other.model;
    symbolic += other.symbolic;
    program += other.program;
    emit += other.emit;
    compile += other.compile;
    search += other.search;
    return *this;
  }
};

}  // namespace regulus::detail
