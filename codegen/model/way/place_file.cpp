// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/way/place_file.hpp"

#include <algorithm>

#include "codegen/model/file/read_file.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/way/gcode_file.hpp"
#include "codegen/model/way/waypoint_file.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus::detail {
namespace {

/// A column of numbers of the place.
struct PlaceColumn {
  std::size_t index;
  std::string name;
  GiNaC::ex factor;
};

class PlaceReader {
 public:
  PlaceReader(const Model& model, const std::string& file) : file_(file) {
    if (is_gcode_file(file))
      throw InputError::statement(file, 0, "moves in G-code are a path, and no single places",
                                  "give a table, with a line for each place");
    const std::string text = read_file(file, kLargestWaypointFile, Readable::kStream);
    table_ = read_table(text, file);
    result_.sha256 = sha256(text);
    if (table_.rows.empty())
      throw InputError::statement(file, table_.heading_line, "there are no places",
                                  "write a row of numbers for each");
    used_.assign(table_.columns.size(), false);
    std::vector<std::string> all;
    for (const auto& names : {pose_names(model), length_names(model), tool_names(model)})
      take(names, all);
    for (const char* name : {"t", "time"})
      if (const auto column = find(name); column && !time_) {
        used_[*column] = true;
        time_ = column;
        result_.time_unit = table_.columns[*column].unit;
      }
    note_unused(table_, used_, columns_.empty() ? all : missing_, "number of a place", file,
                result_.notes);
    if (columns_.empty())
      throw InputError::statement(file, table_.heading_line, "no column has a number of a place",
                                  "name columns " + enumeration(all));
  }

  PlaceFile read() {
    for (const TableRow& row : table_.rows) {
      PlaceRow& place = result_.rows.emplace_back();
      place.line = row.line;
      if (time_) place.time = row.cells[*time_].to_double();
      for (const PlaceColumn& column : columns_)
        place.numbers.push_back({column.name, "", column.factor * row.cells[column.index]});
    }
    return std::move(result_);
  }

 private:
  /// Returns the column of that name that is not used yet.
  [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const {
    for (std::size_t c = 0; c < table_.columns.size(); ++c)
      if (!used_[c] && table_.columns[c].name == name) return c;
    return std::nullopt;
  }

  /// Those that are missing count if the file has some of them.
  void take(const std::vector<PlaceName>& names, std::vector<std::string>& all) {
    std::vector<std::string> missing;
    for (const PlaceName& name : names) {
      all.push_back(name.name);
      const auto column = find(name.name);
      if (!column) {
        missing.push_back(name.name);
        continue;
      }
      used_[*column] = true;
      columns_.push_back({*column, name.name, column_factor(table_, *column, name.unit, file_)});
    }
    if (missing.size() < names.size())
      missing_.insert(missing_.end(), missing.begin(), missing.end());
  }

  const std::string& file_;
  WaypointTable table_;
  std::vector<bool> used_;
  std::optional<std::size_t> time_;
  std::vector<PlaceColumn> columns_;
  std::vector<std::string> missing_;
  PlaceFile result_;
};

}  // namespace

PlaceFile read_places(const Model& model, const std::string& file) {
  return PlaceReader(model, file).read();
}

}  // namespace regulus::detail
