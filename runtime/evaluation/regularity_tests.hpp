// SPDX-License-Identifier: Apache-2.0
// The regularity tests of a method, each on eight boxes at a time.
#pragma once

#include <memory>
#include <vector>

#include "runtime/evaluation/batch.hpp"
#include "runtime/problem/adaptive_threshold.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

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
  /// A test that costs much more than others runs once in a lane, if `budget` allows it.
  [[nodiscard]] virtual LaneMask certify(Batch& batch, LaneMask lanes,
                                         TestBudget& budget) noexcept = 0;

 private:
  Rule rule_;
};

using TestSequence = std::vector<std::unique_ptr<RegularityTest>>;

/// Returns the tests of settings.method in the order of their use, then settings.filters.
[[nodiscard]] TestSequence make_tests(const Problem& problem, const Settings& settings,
                                      const RowStructure& structure);

/// Returns tests for small boxes, at most kMaxEasyTests; each costs a fraction of the next one, and
/// the last one of the first of make_tests(). They use a batch for easy boxes.
[[nodiscard]] TestSequence make_easy_tests(const Problem& problem, const Settings& settings,
                                           const RowStructure& structure);

/// Returns true if one of these tests is tried or not, depending on how it did on earlier boxes.
[[nodiscard]] bool tests_learn(const Problem& problem, const Settings& settings,
                               const RowStructure& structure) noexcept;

}  // namespace regulus::detail
