// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/way/waypoint_table.hpp"

#include <algorithm>

#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/way/waypoint_file.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

constexpr std::size_t kMostColumns = 256;

std::string_view unquoted(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text.remove_prefix(1);
    text.remove_suffix(1);
  }
  return text;
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    cells.push_back(unquoted(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  // Some programs end each line with a separator.
  if (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  return cells;
}

class TableReader {
 public:
  TableReader(std::string_view text, const std::string& file) : rest_(text), file_(file) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
    if (rest_.find('\0') != std::string_view::npos)
      fail("the file is not text in UTF-8 (it has a byte 0)", "save it as CSV in UTF-8");
  }

  WaypointTable read() {
    if (!next_line()) fail("the file is empty", "begin with a line of column names, then rows");
    read_heading();
    while (next_line()) read_row();
    return std::move(table_);
  }

 private:
  /// Goes to the next line that has a meaning.
  bool next_line() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      text_ = trimmed_end(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++line_;
      const std::string_view content = unquoted(text_);
      if (!content.empty() && content.front() != '#') return true;
    }
    return false;
  }

  static std::string_view trimmed_end(std::string_view line) {
    return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
  }

  void read_heading() {
    separator_ =
        text_.find(';') != std::string_view::npos ? ';'
        : text_.find(',') == std::string_view::npos && text_.find('\t') != std::string_view::npos
            ? '\t'
            : ',';
    table_.heading_line = line_;
    for (const std::string_view cell : cells_of(text_, separator_))
      table_.columns.push_back(column(cell));
    if (table_.columns.size() > kMostColumns)
      fail("there are " + std::to_string(table_.columns.size()) + " columns",
           "write at most " + std::to_string(kMostColumns));
  }

  /// Reads "psi [deg]", "psi (deg)" or "psi".
  TableColumn column(std::string_view cell) {
    TableColumn result;
    const std::size_t open = cell.find_first_of("[(");
    result.name = unquoted(cell.substr(0, open));
    if (open != std::string_view::npos) {
      const char close = cell[open] == '[' ? ']' : ')';
      if (cell.back() != close)
        fail("the column " + in_quotes(cell) + " has an open bracket", "write NAME [UNIT]");
      result.unit = unquoted(cell.substr(open + 1, cell.size() - open - 2));
    }
    if (signed_decimal(cell))
      fail("the first line has a number, " + in_quotes(cell),
           "begin the file with a line of column names, such as x [mm], y [mm], psi [deg]");
    if (!is_name(result.name))
      fail("the column " + in_quotes(cell) + " has no name",
           "write a letter, then letters, digits and underscores, such as x [mm]");
    for (const TableColumn& other : table_.columns)
      if (other.name == result.name)
        fail("two columns are named " + in_quotes(result.name), "rename or remove one of them");
    return result;
  }

  void read_row() {
    const auto cells = cells_of(text_, separator_);
    if (cells.size() != table_.columns.size()) refuse_count(cells);
    TableRow row{line_, {}};
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto number = signed_decimal(cells[i]);
      if (!number) refuse_cell(cells[i], table_.columns[i].name);
      row.cells.push_back(*number);
    }
    if (table_.rows.size() == kMostWaypoints)
      fail("there are more than " + std::to_string(kMostWaypoints) + " rows",
           "cut the trajectory into several files");
    table_.rows.push_back(std::move(row));
  }

  [[noreturn]] void refuse_count(const std::vector<std::string_view>& cells) {
    const std::string found = "this line has " + std::to_string(cells.size()) + " cells, and the " +
                              std::to_string(table_.columns.size()) + " columns of line " +
                              std::to_string(table_.heading_line) + " need as many";
    if (separator_ == ',' && cells.size() == 2 * table_.columns.size())
      fail(found + "; the numbers may have decimal commas",
           "write decimal points: 1.5 and not 1,5");
    fail(found, "write one number for each column");
  }

  [[noreturn]] void refuse_cell(std::string_view cell, const std::string& column) {
    const std::string found =
        "the cell " + in_quotes(cell) + " of column " + in_quotes(column) + " is not a number";
    if (cell.find(',') != std::string_view::npos)
      fail("the cell " + in_quotes(cell) + " of column " + in_quotes(column) +
               " has a decimal comma",
           "write a decimal point: 1.5 and not 1,5");
    if (cell.empty())
      fail("the cell of column " + in_quotes(column) + " is empty", "write a number");
    fail(found, "write a finite decimal number, such as -1.5 or 2e-3");
  }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw InputError::statement(file_, line_, problem, remedy);
  }

  std::string_view rest_, text_;
  const std::string& file_;
  int line_ = 0;
  char separator_ = ',';
  WaypointTable table_;
};

}  // namespace

WaypointTable read_table(std::string_view text, const std::string& file) {
  return TableReader(text, file).read();
}

}  // namespace regulus::detail
