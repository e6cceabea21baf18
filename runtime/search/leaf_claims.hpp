// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "runtime/evaluation/box_lanes.hpp"
#include "runtime/search/paving.hpp"

namespace regulus::detail {

/// Tells the boxes out of reach from those that another constraint excludes.
class LeafClaims {
 public:
  /// The first `reach` constraints of the kernel are those of reach. The kernel must outlive this.
  ///
  /// Requires  boxes have at most as many ranges as the problem; the others are those of the problem.
  LeafClaims(const Problem& problem, std::size_t reach);

  [[nodiscard]] Claim of(std::span<const Interval> box, Rule rule) noexcept;

 private:
  const Problem problem_;
  const std::size_t reach_;
  std::vector<Interval> box_;
  BoxLanes lanes_;
  AlignedBuffer outputs_;
};

}  // namespace regulus::detail
