// SPDX-License-Identifier: GPL-3.0-or-later
// The cells of Tables IV–VII and of the series in the text that take a short time; those of few boxes with their
// certificates are in certificate_test.cpp.
#include "tests/paper/engine/table_rows.hpp"

namespace regulus::detail::test {
namespace {

constexpr std::uint64_t kFastBoxes = 2000;

class TableRows : public testing::TestWithParam<TableCell> {};

TEST_P(TableRows, ReachTheRecordedVerdictWithinTheRecordedBoxes) {
  expect_as_recorded(run(*GetParam().table, *GetParam().cell, 0), *GetParam().cell);
}

INSTANTIATE_TEST_SUITE_P(Paper, TableRows, testing::ValuesIn(cells_of(kFewBoxes + 1, kFastBoxes)),
                         cell_name);

}  // namespace
}  // namespace regulus::detail::test
