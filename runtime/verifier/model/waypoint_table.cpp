// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "runtime/verifier/model/waypoints.hpp"

namespace regulus::verifier {
namespace {

constexpr std::size_t kMostColumns = 256;
constexpr std::size_t kLongestNumber = 400;

std::string_view without_space(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  text = text.substr(first, text.find_last_not_of(kSpace) - first + 1);
  const bool is_quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    cells.push_back(without_space(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  if (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  return cells;
}

char separator_of(std::string_view heading) {
  const auto has = [heading](char c) { return heading.find(c) != std::string_view::npos; };
  return has(';') ? ';' : !has(',') && has('\t') ? '\t' : ',';
}

[[noreturn]] void stop(std::size_t line, const std::string& why) {
  throw Unfinished("line " + std::to_string(line) + " of the way-points: " + why);
}

WaypointTable::Column column_of(std::string_view heading, std::size_t line) {
  const std::size_t open = heading.find_first_of("[(");
  if (open == std::string_view::npos) return {std::string(heading), ""};
  if (!heading.ends_with(heading[open] == '[' ? ']' : ')')) stop(line, "a bracket is not closed");
  return {std::string(without_space(heading.substr(0, open))),
          std::string(without_space(heading.substr(open + 1, heading.size() - open - 2)))};
}

/// True for digits with at most one point and an exponent, and a sign before each.
bool is_decimal(std::string_view text) {
  const auto skip_sign = [&text] {
    if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  };
  const auto skip_digits = [&text] {
    const std::size_t end = std::min(text.find_first_not_of("0123456789"), text.size());
    text.remove_prefix(end);
    return end;
  };
  if (text.size() > kLongestNumber) return false;
  skip_sign();
  std::size_t digits = skip_digits();
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    digits += skip_digits();
  }
  if (digits == 0) return false;
  if (!text.starts_with('e') && !text.starts_with('E')) return text.empty();
  text.remove_prefix(1);
  skip_sign();
  const std::size_t exponent = skip_digits();
  return exponent > 0 && exponent < 4 && text.empty();
}

WaypointTable::Row row_of(const std::vector<std::string_view>& cells, std::size_t columns,
                          std::size_t line) {
  if (cells.size() != columns) stop(line, "there are not as many cells as columns");
  WaypointTable::Row row{line, {}};
  for (const std::string_view cell : cells) {
    if (!is_decimal(cell)) stop(line, "a cell is not a number");
    row.cells.emplace_back(cell);
  }
  return row;
}

}  // namespace

WaypointTable read_waypoint_table(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  WaypointTable table;
  char separator = ',';
  for (std::size_t begin = 0, line = 1; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view content = text.substr(begin, end - begin);
    begin = end + 1;
    const std::string_view trimmed = without_space(content);
    if (trimmed.empty() || trimmed.front() == '#') continue;
    const bool is_heading = table.columns.empty();
    if (is_heading) separator = separator_of(content);
    const std::vector<std::string_view> cells = cells_of(content, separator);
    if (cells.size() > kMostColumns) stop(line, "there are too many columns");
    if (is_heading)
      for (const std::string_view cell : cells) table.columns.push_back(column_of(cell, line));
    else
      table.rows.push_back(row_of(cells, table.columns.size(), line));
  }
  if (table.rows.empty()) stop(1, "there are no rows");
  return table;
}

}  // namespace regulus::verifier
