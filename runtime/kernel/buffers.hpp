// SPDX-License-Identifier: Apache-2.0
// Memory for the arguments of a kernel, with the alignment and layout of regulus_function.
#pragma once

#include <cstddef>
#include <vector>

#include "runtime/interval/lanes.hpp"
#include "runtime/interval/type.hpp"

namespace regulus::detail {

struct alignas(64) LaneRow {
  double lane[kLanes] = {};
};

/// Eight intervals for each of a number of variables or outputs; [0, 0] at first.
class IntervalRows {
 public:
  explicit IntervalRows(std::size_t count) : rows_(2 * count) {}

  void set(std::size_t index, std::size_t lane, Interval x) noexcept {
    rows_[2 * index].lane[lane] = x.lo;
    rows_[2 * index + 1].lane[lane] = x.hi;
  }
  void set_all_lanes(std::size_t index, Interval x) noexcept {
    for (std::size_t lane = 0; lane < kLanes; ++lane) set(index, lane, x);
  }
  [[nodiscard]] Interval get(std::size_t index, std::size_t lane) const noexcept {
    return {rows_[2 * index].lane[lane], rows_[2 * index + 1].lane[lane]};
  }
  [[nodiscard]] std::size_t size() const noexcept { return rows_.size() / 2; }
  [[nodiscard]] double* data() noexcept { return rows_.data()->lane; }
  [[nodiscard]] const double* data() const noexcept { return rows_.data()->lane; }

 private:
  std::vector<LaneRow> rows_;
};

/// Eight doubles for each entry of K; 0 at first.
class PointRows {
 public:
  explicit PointRows(std::size_t count) : rows_(count) {}

  void set(std::size_t index, std::size_t lane, double x) noexcept { rows_[index].lane[lane] = x; }
  void set_all_lanes(std::size_t index, double x) noexcept {
    for (double& value : rows_[index].lane) value = x;
  }
  [[nodiscard]] double get(std::size_t index, std::size_t lane) const noexcept {
    return rows_[index].lane[lane];
  }
  [[nodiscard]] std::size_t size() const noexcept { return rows_.size(); }
  [[nodiscard]] const double* data() const noexcept { return rows_.data()->lane; }

 private:
  std::vector<LaneRow> rows_;
};

using BoxBatch = IntervalRows;     ///< one interval per variable
using OutputBatch = IntervalRows;  ///< one interval per output

}  // namespace regulus::detail
