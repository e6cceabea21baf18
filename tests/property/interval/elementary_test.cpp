// SPDX-License-Identifier: GPL-3.0-or-later
// The elementary functions on many doubles and on intervals.
#include "tests/property/interval/elementary_suite.hpp"
#include "tests/support/trials.hpp"

namespace regulus::detail::test {
namespace {

using Elementary = ElementarySuite;

TEST_P(Elementary, EnclosesTheFunctionAtDoubles) {
  CornerInputs inputs = GetParam().inputs;
  check_batches(trials(250'000, 1'000'000), [&] { return Interval(inputs.number()); });
}

TEST_P(Elementary, EnclosesTheFunctionOverIntervals) {
  CornerInputs inputs = GetParam().inputs;
  check_batches(100'000, [&] { return inputs.interval(); });
}

INSTANTIATE_TEST_SUITE_P(Functions, Elementary, ::testing::ValuesIn(elementary_cases(100)),
                         [](const auto& suite) { return suite.param.name; });

}  // namespace
}  // namespace regulus::detail::test
