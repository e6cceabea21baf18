// SPDX-License-Identifier: GPL-3.0-or-later
// A comparison is only valid if all contenders compute the same. Values by Arb at the midpoints
// decide.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/kernel/program/arb_arithmetic.hpp"
#include "codegen/kernel/program/interpreter.hpp"
#include "tests/bench/kernel/ahead_of_time.hpp"
#include "tests/bench/kernel/batched.hpp"
#include "tests/bench/kernel/rival.hpp"

namespace regulus::detail::bench {
namespace {

class Rivals : public ::testing::Test {
 protected:
  /// Returns narrow enclosures of K·M at the midpoint of a box.
  [[nodiscard]] std::vector<Interval> values_at_midpoint(std::size_t box) const {
    constexpr long kPrecision = 200;
    std::vector<Ball> inputs, points;
    for (std::size_t v = 0; v < sample_.variables; ++v)
      inputs.emplace_back(mid(sample_.boxes[box * sample_.variables + v]));
    for (std::size_t p = 0; p < sample_.points; ++p)
      points.emplace_back(sample_.K[box * sample_.points + p]);
    ArbArithmetic arithmetic(kPrecision);
    std::vector<Interval> values;
    for (const Ball& value :
         evaluate<ArbArithmetic, Ball>(left_product_of(module_), inputs, points, arithmetic))
      values.push_back(value.enclosure());
    EXPECT_FALSE(arithmetic.undefined());
    return values;
  }

  template <class Entries>
  void expect_enclosures(Entries entries) const {
    for (std::size_t box = 0; box < Sample::kBoxes; ++box) {
      const std::vector<Interval> values = values_at_midpoint(box), found = entries(box);
      ASSERT_EQ(found.size(), values.size());
      for (std::size_t e = 0; e < values.size(); ++e)
        EXPECT_TRUE(certain_subset(values[e], found[e])) << "box " << box << ", entry " << e;
    }
  }

  Module module_ = kernel_subject();
  Sample sample_ = make_sample(module_);
};

TEST_F(Rivals, ThatEncloseContainTheValuesAtMidpoints) {
  for (const NamedRival& rival : make_rivals(sample_)) {
    if (!rival.encloses || !rival.rival) continue;
    SCOPED_TRACE(rival.name);
    expect_enclosures([&](std::size_t box) { return rival.rival->entries(box); });
  }
}

TEST_F(Rivals, KernelsAheadOfTimeContainTheValuesAtMidpoints) {
  for (const Isa isa : kAllIsas) {
    const regulus_kernel* kernel = ahead_of_time(isa);
    if (!kernel || !supported(isa)) continue;
    SCOPED_TRACE(name(isa));
    BatchedProduct product(*kernel, sample_);
    expect_enclosures([&](std::size_t box) { return product.entries(box); });
  }
}

TEST_F(Rivals, EncloseOverTheSameBoxesAsTheKernels) {
  BatchedProduct product(*ahead_of_time(Isa::kPortable), sample_);
  for (const NamedRival& rival : make_rivals(sample_)) {
    if (!rival.encloses || !rival.rival) continue;
    for (std::size_t box = 0; box < Sample::kBoxes; ++box) {
      const std::vector<Interval> ours = product.entries(box), theirs = rival.rival->entries(box);
      for (std::size_t e = 0; e < ours.size(); ++e) {
        // The operations and their order are the same: only the rounding of bounds differs.
        const double slack = 1e-9 * (mag(ours[e]) + 1);
        EXPECT_NEAR(theirs[e].lo, ours[e].lo, slack) << rival.name;
        EXPECT_NEAR(theirs[e].hi, ours[e].hi, slack) << rival.name;
      }
    }
  }
}

TEST_F(Rivals, PlainDoublesComeNearTheValuesAtMidpoints) {
  for (const NamedRival& rival : make_rivals(sample_)) {
    if (rival.encloses) continue;
    ASSERT_TRUE(rival.rival) << "plain doubles need no library";
    for (std::size_t box = 0; box < Sample::kBoxes; ++box) {
      const std::vector<Interval> values = values_at_midpoint(box);
      const std::vector<Interval> found = rival.rival->entries(box);
      for (std::size_t e = 0; e < values.size(); ++e)
        EXPECT_NEAR(mid(found[e]), mid(values[e]), 1e-9) << rival.name;
    }
  }
}

TEST_F(Rivals, WithoutTheirLibrarySayWhichOne) {
  for (const NamedRival& rival : make_rivals(sample_)) {
    EXPECT_EQ(rival.rival == nullptr, !rival.absent.empty()) << rival.name;
    if (!rival.rival) {
      EXPECT_THAT(rival.absent, ::testing::StartsWith("was built without lib"));
    }
  }
}

}  // namespace
}  // namespace regulus::detail::bench
