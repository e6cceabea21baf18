// SPDX-License-Identifier: GPL-3.0-or-later
// Tests partial operations on lanes at the edge of their domain, and on bounds that no interval
// has.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "runtime/kernel/rounding_scope.hpp"
#include "tests/property/kernel/pack_workload.hpp"

namespace regulus::detail::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The bounds x and y of one lane, without changes.
struct Case {
  Tightest x, y;
  bool undefined;
};

class PackDomainTest : public ::testing::Test {
 protected:
  /// Puts the case into every lane in turn, with defined neighbours around it.
  static void check(PackOperation operation, const Case& one) {
    for (const Variant& variant : variants())
      for (std::size_t lane = 0; lane < REGULUS_LANES; ++lane) check(variant, operation, one, lane);
  }

 private:
  static void check(const Variant& variant, PackOperation operation, const Case& one,
                    std::size_t lane) {
    BoxBatch boxes(3);
    for (std::size_t v = 0; v < 3; ++v) boxes.set_all_lanes(v, {1, 2});
    boxes.data()[lane] = one.x.lo;
    boxes.data()[8 + lane] = one.x.hi;
    boxes.data()[16 + lane] = one.y.lo;
    boxes.data()[24 + lane] = one.y.hi;
    const PointRows points(2);
    Results results(1);
    {
      const RoundingScope scope(required_rounding(variant.isa));
      variant.evaluate(operation, 1, boxes.data(), points.data(), results.intervals.data(),
                       results.undefined.data());
    }
    ASSERT_EQ(results.undefined[0], one.undefined ? 1u << lane : 0u)
        << variant.name << ", lane " << lane << ", x = " << describe(one.x)
        << ", y = " << describe(one.y);
    const Tightest computed = results.bounds(lane);
    ASSERT_TRUE(std::isfinite(computed.lo) && std::isfinite(computed.hi))
        << variant.name << ": " << describe(computed);
  }
};

TEST_F(PackDomainTest, CheckedReportsBoundsThatAreNotFinite) {
  for (const Tightest x :
       {Tightest{kNan, 1}, Tightest{1, kNan}, Tightest{kNan, kNan}, Tightest{-kInfinity, 1},
        Tightest{1, kInfinity}, Tightest{-kInfinity, kInfinity}, Tightest{kInfinity, kInfinity}})
    check(PackOperation::check, {x, {1, 2}, true});
}

TEST_F(PackDomainTest, CheckedReportsBoundsInTheWrongOrder) {
  check(PackOperation::check, {{2, 1}, {1, 2}, true});
}

TEST_F(PackDomainTest, CheckedAcceptsEveryFiniteInterval) {
  for (const Tightest x : {Tightest{-kMaxDouble, kMaxDouble}, Tightest{0, 0}, Tightest{-0.0, 0.0},
                           Tightest{0.0, -0.0}, Tightest{kMaxDouble, kMaxDouble}})
    check(PackOperation::check, {x, {1, 2}, false});
}

TEST_F(PackDomainTest, DivisionReportsDivisorsThatContainZero) {
  for (const Tightest y :
       {Tightest{0, 1}, Tightest{-0.0, 1}, Tightest{-1, 0}, Tightest{-1, -0.0}, Tightest{0, 0},
        Tightest{-1, 1}, Tightest{-kMinSubnormal, kMinSubnormal}})
    for (const Tightest x : {Tightest{1, 2}, Tightest{0, 0}, Tightest{-1, 1}})
      check(PackOperation::divide, {x, y, true});
}

TEST_F(PackDomainTest, DivisionReportsQuotientsAbove2To128) {
  check(PackOperation::divide, {{1, 1}, {0x1p-129, 1}, true});
  check(PackOperation::divide, {{-1, -1}, {0x1p-129, 1}, true});
  check(PackOperation::divide, {{1, 1}, {-1, -kMinSubnormal}, true});
  check(PackOperation::divide, {{kMaxDouble, kMaxDouble}, {kMinSubnormal, 1}, true});
  check(PackOperation::divide, {{-1, 1}, {0x1p-127, 1}, false});
  check(PackOperation::divide, {{0, 0}, {kMinSubnormal, kMaxDouble}, false});
}

TEST_F(PackDomainTest, DivisionReportsNanAndInfiniteOperands) {
  for (const Tightest bad : {Tightest{kNan, 1}, Tightest{1, kNan}, Tightest{kNan, kNan}}) {
    check(PackOperation::divide, {bad, {1, 2}, true});
    check(PackOperation::divide, {{1, 2}, bad, true});
  }
  check(PackOperation::divide, {{1, kInfinity}, {1, 2}, true});
  check(PackOperation::divide, {{-kInfinity, 1}, {-2, -1}, true});
}

TEST_F(PackDomainTest, SquareRootReportsNegativeNumbers) {
  check(PackOperation::square_root, {{-kMinSubnormal, 1}, {1, 2}, true});
  check(PackOperation::square_root, {{-2, -1}, {1, 2}, true});
  check(PackOperation::square_root, {{kNan, 1}, {1, 2}, true});
  check(PackOperation::square_root, {{1, kNan}, {1, 2}, true});
  check(PackOperation::square_root, {{-0.0, 1}, {1, 2}, false});
  check(PackOperation::square_root, {{0, 0}, {1, 2}, false});
  check(PackOperation::square_root, {{0, 0x1p255}, {1, 2}, false});
  check(PackOperation::square_root, {{0, 0x1p257}, {1, 2}, true});
  check(PackOperation::square_root, {{0, kInfinity}, {1, 2}, true});
}

}  // namespace
}  // namespace regulus::detail::test
