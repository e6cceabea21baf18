// SPDX-License-Identifier: GPL-3.0-or-later
// Many arguments for one operation, in the layout that the variants use.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runtime/kernel/buffers.hpp"
#include "tests/property/kernel/pack_oracle.hpp"
#include "tests/property/kernel/pack_variants.hpp"
#include "tests/support/corner_inputs.hpp"

namespace regulus::detail::test {

/// The results of a variant for all arguments.
struct Results {
  explicit Results(std::size_t groups) : intervals(groups), undefined(groups) {}

  [[nodiscard]] bool is_undefined(std::size_t i) const { return undefined[i / 8] >> (i % 8) & 1; }
  /// Returns the bounds unchanged: not as an Interval, whose constructor would repair wrong ones.
  [[nodiscard]] Tightest bounds(std::size_t i) const {
    const double* const rows = intervals.data() + 16 * (i / 8);
    return {rows[i % 8], rows[8 + i % 8]};
  }

  OutputBatch intervals;
  std::vector<unsigned> undefined;
};

class Workload {
 public:
  Workload(std::size_t groups, CornerInputs& inputs);

  [[nodiscard]] std::size_t size() const { return 8 * groups_; }
  [[nodiscard]] Arguments arguments(std::size_t i) const;
  [[nodiscard]] Results evaluate(const Variant& variant, PackOperation operation) const;

 private:
  std::size_t groups_;
  BoxBatch boxes_;
  PointRows points_;
};

/// Returns a point of x, often a bound or 0.
[[nodiscard]] double point_of(Interval x, CornerInputs& inputs);

/// Formats every number in hexadecimal, for messages.
[[nodiscard]] std::string describe(const Arguments& arguments);
[[nodiscard]] std::string describe(Tightest bounds);

[[nodiscard]] const char* name_of(PackOperation operation);
[[nodiscard]] std::vector<PackOperation> arithmetic_operations();
[[nodiscard]] std::vector<PackOperation> elementary_functions();

}  // namespace regulus::detail::test
