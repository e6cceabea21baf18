// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "runtime/kernel/buffers.hpp"
#include "runtime/kernel/call.hpp"
#include "tests/bench/kernel/subject.hpp"

namespace regulus::detail::bench {

/// Computes K·M of the sample by a kernel, eight boxes at a time, as the search calls it.
class BatchedProduct {
 public:
  /// Requires  `kernel` outlives this object; the processor can run it.
  BatchedProduct(const regulus_kernel& kernel, const Sample& sample);

  void pass() noexcept;

  /// Throws std::domain_error if an entry is undefined.
  [[nodiscard]] std::vector<Interval> entries(std::size_t box);

 private:
  unsigned evaluate(std::size_t batch) noexcept;

  CheckedKernel kernel_;
  std::vector<BoxBatch> boxes_;
  std::vector<PointRows> K_;
  OutputBatch out_;
};

}  // namespace regulus::detail::bench
