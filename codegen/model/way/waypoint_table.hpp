// SPDX-License-Identifier: GPL-3.0-or-later
// A table of numbers in a text: comma, semicolon or tab between the cells, names in the first line.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <string_view>
#include <vector>

namespace regulus::detail {

/// A heading such as "psi [deg]".
struct TableColumn {
  std::string name;
  std::string unit;  ///< empty: none is given
};

struct TableRow {
  int line = 0;
  std::vector<GiNaC::numeric> cells;  ///< one for each column
};

struct WaypointTable {
  int heading_line = 0;
  std::vector<TableColumn> columns;
  std::vector<TableRow> rows;
};

/// Reads the text. Blank lines, and lines that begin with #, have no meaning; a byte order mark,
/// carriage returns and quotes around a cell are allowed. Numbers are exact decimals.
///
/// Errors    InputError with the line, for a text without headings, a line with more or fewer cells
///           than headings, a cell that is not a finite number, and a decimal comma.
[[nodiscard]] WaypointTable read_table(std::string_view text, const std::string& file);

}  // namespace regulus::detail
