// SPDX-License-Identifier: Apache-2.0
// The regularity tests a method is made of, each on eight boxes at a time.
#pragma once

#include <memory>
#include <vector>

#include "runtime/evaluation/batch.hpp"
#include "runtime/problem/adaptive_threshold.hpp"
#include "runtime/problem/result.hpp"

namespace regulus {

class RegularityTest {
 public:
  explicit RegularityTest(Rule rule) noexcept : rule_(rule) {}
  RegularityTest(const RegularityTest&) = delete;
  RegularityTest& operator=(const RegularityTest&) = delete;
  virtual ~RegularityTest() = default;

  [[nodiscard]] Rule rule() const noexcept { return rule_; }

  /// Ensures   in each returned lane, a subset of `lanes`: at every point of the box J⁻¹ is defined
  ///           and has full column rank, and |det J⁻¹| > α if α > 0.
  ///
  /// A test that costs much more than others is tried where `budget` says, once in a lane.
  [[nodiscard]] virtual LaneMask certify(Batch& batch, LaneMask lanes,
                                         TestBudget& budget) noexcept = 0;

 private:
  Rule rule_;
};

using TestSequence = std::vector<std::unique_ptr<RegularityTest>>;

/// The tests of settings.method in the order in which they are to be tried, then settings.filters.
[[nodiscard]] TestSequence make_tests(const Problem& problem, const Settings& settings,
                                      const RowStructure& structure);

}  // namespace regulus
