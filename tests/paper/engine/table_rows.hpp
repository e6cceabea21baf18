// SPDX-License-Identifier: GPL-3.0-or-later
// The cells of the paper's tables as tests of the verdict and the boxes, never of the seconds.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/paper/tables/run_cell.hpp"
#include "tests/support/parameter_name.hpp"

namespace regulus::detail::test {

struct TableCell {
  const PaperTable* table;
  const PaperCell* cell;
};

/// The most boxes of a cell whose certificate the fast tests verify.
inline constexpr std::uint64_t kFewBoxes = 120;

/// Returns the cells that are decided in `least` to `most` boxes.
inline std::vector<TableCell> cells_of(std::uint64_t least, std::uint64_t most) {
  std::vector<TableCell> cells;
  for (const PaperTable& table : kPaperTables)
    for (const PaperRow& row : table.rows)
      for (const PaperCell& cell : row.cells)
        if (cell.boxes >= least && cell.boxes <= most) cells.push_back({&table, &cell});
  return cells;
}

inline std::string cell_name(const testing::TestParamInfo<TableCell>& info) {
  const auto& [table, cell] = info.param;
  return std::to_string(info.index) + "_" +
         name_of_words(std::string(table->model) + "_" + cell->motion + "_" + cell->tolerance +
                       "_" + cell->uncertainty + "_" + cell->method);
}

/// Instruction sets sometimes round differently, so their boxes differ by a few.
inline void expect_as_recorded(const Result& result, const PaperCell& cell) {
  EXPECT_EQ(result.verdict, cell.found) << describe(result.reason);
  EXPECT_LE(result.statistics.boxes, cell.boxes + cell.boxes / 50 + 1);
}

}  // namespace regulus::detail::test
