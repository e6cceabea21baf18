// SPDX-License-Identifier: Apache-2.0
// A table of places: each row takes the place of the numbers that a motion of the model file has.
#pragma once

#include <string>
#include <vector>

#include "runtime/verifier/model/model_file.hpp"
#include "runtime/verifier/model/waypoints.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

class PlaceTable {
 public:
  /// Throws Unfinished if the file cannot be read, is a program, or names two columns alike.
  explicit PlaceTable(std::string file);

  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  [[nodiscard]] std::size_t rows() const noexcept { return table_.rows.size(); }
  /// Returns "line 3 of lengths.csv".
  [[nodiscard]] std::string describe(std::size_t row) const;

  /// The model file with one row of the table.
  struct AtRow {
    WrittenValues values;
    /// Options whose numbers the table gives: the certificate may have no other ones.
    std::set<std::string> fixed;
    /// True if the table has all numbers of the place: nothing can have come from elsewhere.
    bool is_whole = false;
    std::size_t numbers = 0;  ///< of the table
  };
  /// Returns what the model says at a row, for the motion of the question. Throws Unfinished if this
  /// reader does not know what a column means.
  [[nodiscard]] AtRow at(std::size_t row, const Question& question, WrittenValues model) const;

 private:
  std::string file_;
  WaypointTable table_;
};

/// Returns the table of a motion along way-points, which is beside the model file; "": it names none.
[[nodiscard]] std::string table_of_motion(const WrittenValues& model, const std::string& motion,
                                          const std::string& model_name);

}  // namespace regulus::verifier
