// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace regulus {

/// Seconds spent in each stage.
struct StageSeconds {
  double model = 0;
  double symbolic = 0;
  double emit = 0;
  double compile = 0;
  double search = 0;

  StageSeconds& operator+=(const StageSeconds& other) noexcept {
    model += other.model;
    symbolic += other.symbolic;
    emit += other.emit;
    compile += other.compile;
    search += other.search;
    return *this;
  }
};

}  // namespace regulus
