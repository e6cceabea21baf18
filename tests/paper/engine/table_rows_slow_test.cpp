// SPDX-License-Identifier: GPL-3.0-or-later
// The cells of Tables IV–VII and of the series in the text that take longer.
#include "tests/paper/engine/table_rows.hpp"

namespace regulus::detail::test {
namespace {

constexpr std::uint64_t kFastBoxes = 2000;

class LongTableRows : public testing::TestWithParam<TableCell> {};

TEST_P(LongTableRows, ReachTheRecordedVerdictWithinTheRecordedBoxes) {
  expect_as_recorded(run(*GetParam().table, *GetParam().cell, 0), *GetParam().cell);
}

INSTANTIATE_TEST_SUITE_P(Paper, LongTableRows,
                         testing::ValuesIn(cells_of(kFastBoxes + 1, UINT64_MAX)), cell_name);

}  // namespace
}  // namespace regulus::detail::test
