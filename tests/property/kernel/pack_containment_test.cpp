// SPDX-License-Identifier: GPL-3.0-or-later
// Every operation of every pack encloses the exact result at points of its arguments.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/property/kernel/pack_workload.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

/// Groups of eight lanes that are made and evaluated by the oracle at a time.
constexpr std::size_t kGroups = 512;

/// Returns an exact result for each lane, at some point of its arguments.
std::vector<std::optional<Tightest>> exact_results(const Workload& work, PackOperation operation,
                                                   CornerInputs& inputs) {
  PackOracle oracle;
  std::vector<std::optional<Tightest>> exact(work.size());
  for (std::size_t i = 0; i < work.size(); ++i) {
    const Arguments on = work.arguments(i);
    exact[i] = oracle.at(operation, {point_of(on.x, inputs), point_of(on.y, inputs),
                                     point_of(on.z, inputs), on.p, on.q});
  }
  return exact;
}

bool is_total(PackOperation operation) {
#define REGULUS_IS(name, expression) || operation == PackOperation::name
  return false REGULUS_ARITHMETIC_OPERATIONS(REGULUS_IS) || operation == PackOperation::sine ||
         operation == PackOperation::cosine || operation == PackOperation::arctangent;
#undef REGULUS_IS
}

/// Returns which rule of the pack operations one lane breaks; empty if none.
std::string broken_promise(PackOperation operation, bool undefined, Tightest computed,
                           const std::optional<Tightest>& exact) {
  if (undefined) {
    if (is_total(operation)) return "is defined everywhere but reported undefined";
    if (!std::isfinite(computed.lo) || !std::isfinite(computed.hi)) return "is not finite";
    return "";
  }
  if (!exact) return "is undefined at a point but not reported";
  if (!(computed.lo <= exact->lo && exact->hi <= computed.hi)) return "misses the exact result";
  const bool bounded = std::fabs(computed.lo) <= 0x1p128 && std::fabs(computed.hi) <= 0x1p128;
  if (!bounded && !is_total(operation) && operation != PackOperation::check)
    return "exceeds 2^128 but is not reported";
  return "";
}

::testing::AssertionResult keeps_promises(const Variant& variant, PackOperation operation,
                                          const Workload& work,
                                          const std::vector<std::optional<Tightest>>& exact) {
  const Results results = work.evaluate(variant, operation);
  for (std::size_t i = 0; i < work.size(); ++i) {
    const std::string broken =
        broken_promise(operation, results.is_undefined(i), results.bounds(i), exact[i]);
    if (!broken.empty())
      return ::testing::AssertionFailure()
             << variant.name << ": " << describe(results.bounds(i)) << " " << broken << " "
             << (exact[i] ? describe(*exact[i]) : "") << " for " << describe(work.arguments(i));
  }
  return ::testing::AssertionSuccess();
}

/// Bounds are any doubles: sums, products and powers may overflow. The primary variants get every
/// sample, the others only the first chunks.
void check_containment(PackOperation operation, std::size_t samples, std::size_t chunks_for_all) {
  CornerInputs inputs(20070601 + static_cast<unsigned>(operation));
  const std::vector<Variant> all = variants();
  for (std::size_t chunk = 0; chunk * 8 * kGroups < samples; ++chunk) {
    const Workload work(kGroups, inputs);
    const auto exact = exact_results(work, operation, inputs);
    for (const Variant& variant : all) {
      if (!variant.primary && chunk >= chunks_for_all) continue;
      ASSERT_TRUE(keeps_promises(variant, operation, work, exact));
    }
  }
}

class PackOperationTest : public ::testing::TestWithParam<PackOperation> {};
class PackFunctionTest : public ::testing::TestWithParam<PackOperation> {};

TEST_P(PackOperationTest, EnclosesTheExactResult) {
  check_containment(GetParam(), std::size_t{1} << trials(19, 20), 8);
}
// The interval library ensures the accuracy; this tests that packs pass it the right bounds.
TEST_P(PackFunctionTest, EnclosesTheExactResult) {
  check_containment(GetParam(), std::size_t{1} << 14, 1);
}

std::string test_name(const ::testing::TestParamInfo<PackOperation>& info) {
  return name_of(info.param);
}
INSTANTIATE_TEST_SUITE_P(Packs, PackOperationTest, ::testing::ValuesIn(arithmetic_operations()),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Packs, PackFunctionTest, ::testing::ValuesIn(elementary_functions()),
                         test_name);

}  // namespace
}  // namespace regulus::detail::test
