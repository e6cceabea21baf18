// SPDX-License-Identifier: GPL-3.0-or-later
// The cells of Tables IV–VII and of the series in the text that take a short time.
#include "tests/paper/engine/table_rows.hpp"

namespace regulus::test {
namespace {

constexpr std::uint64_t kFastBoxes = 2000;

class TableRows : public testing::TestWithParam<TableCell> {};

TEST_P(TableRows, ReachTheRecordedVerdictWithinTheRecordedBoxes) { expect_as_recorded(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Paper, TableRows, testing::ValuesIn(cells_of(1, kFastBoxes)), cell_name);

}  // namespace
}  // namespace regulus::test
