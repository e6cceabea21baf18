// SPDX-License-Identifier: GPL-3.0-or-later
// The elementary functions on eight million doubles and on a million intervals.
#include "tests/property/interval/elementary_suite.hpp"

namespace regulus::detail::test {
namespace {

using ElementaryMillions = ElementarySuite;

TEST_P(ElementaryMillions, EnclosesTheFunctionAtDoubles) {
  CornerInputs inputs = GetParam().inputs;
  check_batches(8'000'000, [&] { return Interval(inputs.number()); });
}

TEST_P(ElementaryMillions, EnclosesTheFunctionOverIntervals) {
  CornerInputs inputs = GetParam().inputs;
  check_batches(1'000'000, [&] { return inputs.interval(); });
}

INSTANTIATE_TEST_SUITE_P(Functions, ElementaryMillions, ::testing::ValuesIn(elementary_cases(200)),
                         [](const auto& suite) { return suite.param.name; });

}  // namespace
}  // namespace regulus::detail::test
