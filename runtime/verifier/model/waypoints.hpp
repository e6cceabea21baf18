// SPDX-License-Identifier: Apache-2.0
// Compares the pieces of a trajectory with the table of way-points, or the program in G-code, that a
// model file names. The readers of both share nothing with the front end.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "runtime/verifier/model/gcode.hpp"
#include "runtime/verifier/model/model_file.hpp"
#include "runtime/verifier/question.hpp"

namespace regulus::verifier {

/// A table as it is written.
struct WaypointTable {
  struct Column {
    std::string name, unit;
  };
  struct Row {
    std::size_t line = 0;
    std::vector<std::string> cells;  ///< decimals
  };
  std::vector<Column> columns;
  std::vector<Row> rows;
};

/// Throws Unfinished, with the line, for a text that it does not understand.
[[nodiscard]] WaypointTable read_waypoint_table(std::string_view text);

/// Returns what takes the numbers of a column to the unit of the model, as an expression of model files:
/// "1000/25400"; "": nothing. Throws Unfinished if the units are not of one kind.
[[nodiscard]] std::string factor_of_column(const WaypointTable::Column& column,
                                           const std::string& unit);

class WaypointComparison {
 public:
  /// `file`: what the certificate should be about instead of the file that the motion names; empty:
  /// that one, which is beside `model_name`. Throws Unfinished if it cannot be read.
  WaypointComparison(const WrittenValues& model, const std::string& motion,
                     const std::string& model_name, const std::string& file);

  /// False if nothing names a file: the motion is not along way-points.
  [[nodiscard]] bool is_named() const noexcept { return !file_.empty(); }
  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  [[nodiscard]] std::size_t pieces() const noexcept {
    return is_program_ ? moves_.size() : table_.rows.size() - 1;
  }

  /// Compares the commanded poses of the question about a piece with the file, at every s of [0, 1].
  /// A spline's slopes are compared with those that approx_spline_slopes() finds. Throws OtherModel.
  ///
  /// Ensures   returns the number of compared pose parameters.
  std::size_t compare(Question& question, std::size_t piece) const;
  /// Throws OtherModel unless the question is about one of the pieces.
  void require_some_piece(Question& question) const;
  /// Returns the keys of Question::stated that compare() covers: of the parameter of a piece, which is
  /// the first, and of the poses of all columns, whether the file has such a pose parameter or not.
  [[nodiscard]] std::vector<std::string> compared_keys(const Question& question) const;

 private:
  [[nodiscard]] const std::size_t* column(const std::string& name) const;
  [[nodiscard]] std::string unit_of_model(const std::string& parameter) const;
  [[nodiscard]] NodeId cell(Graph& graph, std::size_t row, const std::string& parameter) const;
  [[nodiscard]] NodeId slope(Graph& graph, std::size_t row, const std::string& parameter) const;
  [[nodiscard]] NodeId scaled(Graph& graph, NodeId number, const std::string& parameter) const;
  [[nodiscard]] const std::size_t* time_column(const Question& question) const;
  [[nodiscard]] NodeId duration(Question& question, std::size_t piece) const;
  [[nodiscard]] NodeId expected(Question& question, std::size_t piece,
                                const std::string& parameter) const;
  [[nodiscard]] NodeId hermite(Question& question, std::size_t piece, const std::string& parameter,
                               NodeId first_slope, NodeId last_slope) const;
  [[nodiscard]] NodeId place_of_program(Graph& graph, std::size_t piece,
                                        const std::string& parameter) const;
  [[nodiscard]] const std::vector<double>& spline_slopes(const Question& question,
                                                         const std::string& parameter) const;
  [[nodiscard]] bool is_spline(Question& question, std::size_t piece,
                               const std::string& parameter) const;
  /// Returns the lines of the file between which the piece is: "line 3 to line 4".
  [[nodiscard]] std::string describe_lines(std::size_t piece) const;
  /// Returns the name of a pose parameter that differs; empty if none does.
  [[nodiscard]] std::string other_parameter(Question& question, std::size_t piece) const;
  [[nodiscard]] bool agrees(Question& question, std::size_t piece,
                            const std::string& parameter) const;
  void read(const std::string& text);
  void find_columns();

  const WrittenValues& model_;
  std::string file_, interpolation_ = "linear";
  WaypointTable table_;
  bool is_program_ = false;
  std::vector<ProgramMove> moves_;  ///< of a program
  /// The names in the file, and their columns in a table.
  std::vector<std::pair<std::string, std::size_t>> column_;
  /// By parameter, in the units of the table; found when they are asked for.
  mutable std::map<std::string, std::vector<double>> slopes_;
};

}  // namespace regulus::verifier
