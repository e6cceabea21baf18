// SPDX-License-Identifier: GPL-3.0-or-later
// Tests how close the bounds are to the tightest ones, and that only undefined lanes are reported
// as undefined. Containment is tested only where both bounds must be the tightest.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/property/kernel/pack_workload.hpp"
#include "tests/support/ulps.hpp"

namespace regulus::detail::test {
namespace {

using Op = PackOperation;

/// Returns the number of roundings between the arguments and a bound.
int roundings(Op operation) {
  switch (operation) {
    case Op::power_3:
    case Op::power_4:
      return 2;
    case Op::power_5:
    case Op::power_6:
      return 3;
    case Op::power_11:
      return 5;
    default:
      return 1;
  }
}

bool is_exact(Op operation) {
  return operation == Op::negate || operation == Op::negate_point || operation == Op::absolute ||
         operation == Op::check;
}
bool is_sum(Op operation) {
  return operation == Op::add || operation == Op::subtract || operation == Op::add_point ||
         operation == Op::point_add || operation == Op::subtract_point ||
         operation == Op::point_subtract || operation == Op::points_add ||
         operation == Op::points_subtract;
}
bool is_mul_add(Op operation) {
  return operation == Op::mul_add_points || operation == Op::mul_add_point ||
         operation == Op::mul_add_by_point || operation == Op::mul_add_intervals;
}

bool is_never_negative(Op operation) {
  return operation == Op::square || operation == Op::power_2 || operation == Op::power_4 ||
         operation == Op::power_6 || operation == Op::absolute || operation == Op::square_root;
}

/// Returns how many doubles a bound may lie outside the tightest one; nullopt for no limit. With
/// directed rounding one operation is tightest; a power of k roundings loses what its first k − 1
/// lose, times the exponents that follow. A portable step is one double, or two near 2^-1021. A
/// portable mul_add rounds its product first, so cancellation may cost any number of doubles.
std::optional<std::int64_t> budget(const Variant& variant, Op operation) {
  const int count = roundings(operation);
  if (variant.isa != Isa::kPortable) return count == 1 ? 0 : 4 * (count - 1) + count * count;
  if (is_mul_add(operation)) return std::nullopt;
  if (is_exact(operation)) return 0;
  if (is_sum(operation)) return 1;
  return count == 1 ? 2 : 8 * count + 2 * count * count;
}

/// Returns the largest magnitude of the arguments. Portable sums use the error of a sum to avoid
/// steps, and close to overflow it is not known.
double limit(Op operation) { return is_sum(operation) ? 0x1p1000 : kMaxDouble; }

/// Returns whether packs must report undefined lanes: true or false if the tightest bounds decide
/// it, nullopt if the outward rounding of 2^128 may decide.
std::optional<bool> undefined_on(Op operation, const std::optional<Tightest>& tightest) {
  if (!tightest) return true;
  if (operation != Op::divide && operation != Op::square_root) return false;
  const double magnitude = std::max(std::fabs(tightest->lo), std::fabs(tightest->hi));
  if (magnitude > 0x1p128) return true;
  if (magnitude < 0x1.fffffffffff00p127) return false;
  return std::nullopt;
}

class PackTightnessTest : public ::testing::TestWithParam<Op> {
 protected:
  void check(const Variant& variant, const Workload& work,
             const std::vector<std::optional<Tightest>>& tightest) {
    const Results results = work.evaluate(variant, GetParam());
    const auto allowed = budget(variant, GetParam());
    for (std::size_t i = 0; i < work.size(); ++i) {
      const auto expected = undefined_on(GetParam(), tightest[i]);
      ASSERT_EQ(results.is_undefined(i), expected.value_or(results.is_undefined(i)))
          << variant.name << " for " << describe(work.arguments(i));
      if (results.is_undefined(i) || !allowed) continue;
      const Tightest computed = results.bounds(i);
      ASSERT_TRUE(computed.lo >= 0 || !is_never_negative(GetParam()))
          << variant.name << ": " << describe(computed) << " for " << describe(work.arguments(i));
      const std::int64_t below = ordinal(tightest[i]->lo) - ordinal(computed.lo);
      const std::int64_t above = ordinal(computed.hi) - ordinal(tightest[i]->hi);
      ASSERT_TRUE(0 <= below && below <= *allowed && 0 <= above && above <= *allowed)
          << variant.name << ": " << describe(computed) << ", tightest " << describe(*tightest[i])
          << " for " << describe(work.arguments(i));
    }
  }
};

/// This also makes the packs agree: AVX-512 and AVX2 compute the same bounds, and these lie inside
/// the portable ones.
TEST_P(PackTightnessTest, IsWithinItsBudget) {
  const double most = limit(GetParam());
  CornerInputs inputs(7 + static_cast<unsigned>(GetParam()), -most, most);
  const Workload work(1024, inputs);
  PackOracle oracle;
  std::vector<std::optional<Tightest>> tightest(work.size());
  for (std::size_t i = 0; i < work.size(); ++i)
    tightest[i] = oracle.on(GetParam(), work.arguments(i));
  for (const Variant& variant : variants()) {
    check(variant, work, tightest);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Packs, PackTightnessTest, ::testing::ValuesIn(arithmetic_operations()),
                         [](const ::testing::TestParamInfo<Op>& i) { return name_of(i.param); });

}  // namespace
}  // namespace regulus::detail::test
