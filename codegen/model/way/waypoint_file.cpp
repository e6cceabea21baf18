// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/way/waypoint_file.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "codegen/model/degrees.hpp"
#include "codegen/model/exact/decimal.hpp"
#include "codegen/model/exact/expression_parser.hpp"
#include "codegen/model/exact/sign.hpp"
#include "codegen/model/file/read_file.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/units.hpp"
#include "codegen/model/way/waypoint_table.hpp"
#include "codegen/support/errors.hpp"
#include "runtime/files/sha256.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

/// The numbers of one pose parameter, exactly as written; times `factor` in the model's unit.
struct Course {
  bool is_held = false;  ///< the file has no column: it has `factor` as its value
  ex factor = 1;
  std::vector<numeric> values, slopes;  ///< slopes per unit of time; empty if linear
};

class WaypointReader {
 public:
  WaypointReader(const Model& model, const Motion& motion, const std::string& file)
      : model_(model), motion_(motion), file_(file) {}

  Trajectory read() {
    const std::string text = read_file(file_, kLargestWaypointFile, Readable::kStream);
    table_ = read_table(text, file_);
    if (table_.rows.size() < 2)
      fail(table_.rows.empty() ? table_.heading_line : table_.rows[0].line,
           table_.rows.empty() ? "there are no way-points" : "there is only one way-point",
           "write at least two rows of numbers");
    result_.file = motion_.waypoints->shown.empty() ? file_ : motion_.waypoints->shown;
    result_.sha256 = sha256(text);
    result_.interpolation = motion_.waypoints->interpolation;
    read_time();
    for (std::size_t i = 0; i < model_.pose.size(); ++i) courses_.push_back(course(i));
    note_others();
    for (std::size_t k = 0; k + 1 < table_.rows.size(); ++k) add_piece(k);
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::optional<std::size_t> find_column(const std::string& name) {
    for (std::size_t c = 0; c < table_.columns.size(); ++c)
      if (table_.columns[c].name == name) return used_[c] = true, c;
    return std::nullopt;
  }

  [[nodiscard]] bool is_hermite() const { return result_.interpolation == "hermite"; }

  void read_time() {
    used_.assign(table_.columns.size(), false);
    std::optional<std::size_t> column;
    for (const char* name : {"t", "time"})
      if (!column && !is_pose_parameter(name)) column = find_column(name);
    if (!column && is_hermite())
      fail(table_.heading_line, "hermite needs the times of the way-points",
           "add a column such as t [s]");
    result_.has_time = column.has_value();
    if (column) result_.time_unit = table_.columns[*column].unit;
    for (std::size_t k = 0; k < table_.rows.size(); ++k) {
      times_.push_back(column ? table_.rows[k].cells[*column]
                              : exact_integer(static_cast<std::int64_t>(k)));
      if (k > 0 && !(times_[k] > times_[k - 1])) refuse_time(k);
    }
  }

  [[noreturn]] void refuse_time(std::size_t k) const {
    fail(table_.rows[k].line,
         times_[k] == times_[k - 1]
             ? "the time is that of line " + std::to_string(table_.rows[k - 1].line)
             : "the time is before that of line " + std::to_string(table_.rows[k - 1].line),
         "write increasing times, or remove the column of times");
  }

  [[nodiscard]] bool is_pose_parameter(const std::string& name) const {
    return std::ranges::find(model_.pose, name, &PoseParameter::name) != model_.pose.end();
  }

  Course course(std::size_t i) {
    const PoseParameter& p = model_.pose[i];
    Course course;
    const auto column = find_column(p.name);
    if (!column) {
      course.is_held = true;
      course.factor =
          held_value(model_, motion_, i, file_, table_.heading_line,
                     "add a column " + in_quotes(p.name) + ", or give its value in the motion");
      return course;
    }
    course.factor = column_factor(table_, *column, p.unit, file_);
    for (const TableRow& row : table_.rows) course.values.push_back(row.cells[*column]);
    note_jumps(p, course);
    if (is_hermite())
      course.slopes = given_slopes(p, course);
    else if (result_.interpolation == "cubic")
      course.slopes = spline_slopes(course.values);
    return course;
  }

  /// The column "dx [mm/s]" has the derivative of x.
  std::vector<numeric> given_slopes(const PoseParameter& p, const Course& course) {
    const std::string name = "d" + p.name;
    const auto column = find_column(name);
    if (!column)
      fail(table_.heading_line, "hermite needs the derivative of " + in_quotes(p.name),
           "add a column " + in_quotes(name));
    const std::string& unit = table_.columns[*column].unit;
    const std::string& of_value = table_.columns[*find_column(p.name)].unit;
    const std::string per_time = (of_value.empty() ? p.unit : of_value) + "/" +
                                 (result_.time_unit.empty() ? "s" : result_.time_unit);
    if (!unit.empty() && unit != per_time)
      fail(table_.heading_line,
           "the column " + in_quotes(name) + " is in " + in_quotes(unit) +
               ", and its parameter in " + in_quotes(per_time),
           "write it in " + in_quotes(per_time));
    std::vector<numeric> slopes;
    for (std::size_t k = 0; k < course.values.size(); ++k)
      slopes.push_back(table_.rows[k].cells[*column]);
    return slopes;
  }

  /// Returns the slopes of the natural cubic spline, rounded: the trajectory is the cubic with
  /// exactly these slopes.
  [[nodiscard]] std::vector<numeric> spline_slopes(const std::vector<numeric>& values) const {
    const std::size_t n = values.size();
    std::vector<double> h(n - 1), d(n - 1), upper(n), slope(n);
    for (std::size_t k = 0; k + 1 < n; ++k) {
      h[k] = numeric(times_[k + 1] - times_[k]).to_double();
      d[k] = numeric(values[k + 1] - values[k]).to_double() / h[k];
    }
    // Thomas' algorithm for 2m₀ + m₁ = 3d₀, m_{k−1}/h_{k−1} + 2(1/h_{k−1} + 1/h_k)m_k + m_{k+1}/h_k = 3(…).
    upper[0] = 0.5;
    slope[0] = 1.5 * d[0];
    for (std::size_t k = 1; k < n; ++k) {
      const double before = 1 / h[k - 1], after = k + 1 < n ? 1 / h[k] : 0;
      const double right = 3 * (d[k - 1] * before + (k + 1 < n ? d[k] * after : 0));
      const double pivot = 2 * (before + after) - before * upper[k - 1];
      upper[k] = after / pivot;
      slope[k] = (right - before * slope[k - 1]) / pivot;
    }
    for (std::size_t k = n - 1; k-- > 0;) slope[k] -= upper[k] * slope[k + 1];
    std::vector<numeric> slopes;
    for (const double m : slope) {
      if (!std::isfinite(m))
        fail(table_.heading_line, "the spline has slopes beyond the range of doubles",
             "use interpolation = \"linear\"");
      slopes.push_back(exact_value(m));
    }
    return slopes;
  }

  /// An angle that is reported between −180 and 180 degrees jumps where the robot does not.
  void note_jumps(const PoseParameter& p, const Course& course) {
    const bool degrees = is_in_degrees(p.unit);
    if (!degrees && p.unit != "rad") return;
    const double half_turn = degrees ? 180 : M_PI;
    const double scale = approx_value(course.factor).value_or(1);
    warn_about_turns(p, course, half_turn / scale);
    for (std::size_t k = 0; k + 1 < course.values.size(); ++k) {
      const double step = numeric(course.values[k + 1] - course.values[k]).to_double() * scale;
      if (std::abs(step) < half_turn) continue;
      result_.notes.push_back(p.name + " changes by more than half a turn between lines " +
                              std::to_string(table_.rows[k].line) + " and " +
                              std::to_string(table_.rows[k + 1].line) +
                              "; the trajectory turns all the way");
      return;
    }
  }

  /// Warns of the first angle of a column that is beyond a turn, or of a column wider than one.
  void warn_about_turns(const PoseParameter& p, const Course& course, double half_turn) {
    const std::size_t before = result_.warnings.size();
    for (std::size_t k = 0; k < course.values.size() && result_.warnings.size() == before; ++k) {
      if (std::abs(course.values[k].to_double()) < 2 * half_turn) continue;
      const ex value = course.values[k] * course.factor;
      warn_about_angle(result_.warnings, {value, value}, p.unit,
                       {result_.file, table_.rows[k].line, p.name});
    }
    if (result_.warnings.size() != before) return;
    const auto [least, most] = std::minmax_element(course.values.begin(), course.values.end());
    warn_about_angle(result_.warnings, {*least * course.factor, *most * course.factor}, p.unit,
                     {result_.file, table_.heading_line, p.name}, model_.arm != nullptr);
  }

  void note_others() {
    std::vector<std::string> held;
    for (std::size_t i = 0; i < model_.pose.size(); ++i)
      if (courses_[i].is_held) held.push_back(model_.pose[i].name);
    note_unused(table_, used_, held, "pose parameter", file_, result_.notes);
  }

  void add_piece(std::size_t k) {
    TrajectoryPiece piece;
    piece.first_line = table_.rows[k].line;
    piece.last_line = table_.rows[k + 1].line;
    piece.begin = times_[k];
    piece.end = times_[k + 1];
    const numeric step = times_[k + 1] - times_[k];
    for (const Course& course : courses_) {
      PieceOfPose& p = piece.pose.emplace_back();
      if (course.is_held) {
        p.power[0] = course.factor;
        continue;
      }
      const numeric rise = course.values[k + 1] - course.values[k];
      p.power[0] = course.factor * course.values[k];
      if (course.slopes.empty()) {
        p.power[1] = course.factor * rise;
        continue;
      }
      const numeric first = step * course.slopes[k], last = step * course.slopes[k + 1];
      p.power[1] = course.factor * first;
      p.power[2] = course.factor * (3 * rise - 2 * first - last);
      p.power[3] = course.factor * (first + last - 2 * rise);
    }
    result_.pieces.push_back(std::move(piece));
  }

  [[noreturn]] void fail(int line, const std::string& problem, const std::string& remedy) const {
    throw InputError::statement(file_, line, problem, remedy);
  }

  const Model& model_;
  const Motion& motion_;
  const std::string& file_;
  WaypointTable table_;
  std::vector<bool> used_;  ///< by column
  std::vector<numeric> times_;
  std::vector<Course> courses_;
  Trajectory result_;
};

}  // namespace

ex column_factor(const WaypointTable& table, std::size_t column, const std::string& unit,
                 const std::string& file) {
  const auto& [name, given] = table.columns[column];
  if (given.empty()) return 1;
  const auto found = unit_factor(given, unit);
  if (!found)
    throw InputError::statement(
        file, table.heading_line,
        "the column " + in_quotes(name) + " is in " + in_quotes(given) + ", and the model has " +
            in_quotes(unit),
        "write the numbers in the unit of the model, or in another unit of the same kind");
  return *found;
}

void note_unused(const WaypointTable& table, const std::vector<bool>& used,
                 const std::vector<std::string>& missing, const std::string& noun,
                 const std::string& file, std::vector<std::string>& notes) {
  std::vector<std::string> others;
  for (std::size_t c = 0; c < used.size(); ++c) {
    if (used[c]) continue;
    const std::string& name = table.columns[c].name;
    others.push_back(name);
    for (const std::string& one : missing)
      if (name.size() > 1 && nearest(name, {&one, 1}) == one)
        throw InputError::statement(
            file, table.heading_line, "no " + noun + " is named " + in_quotes(name),
            "did you mean " + in_quotes(one) + "? Otherwise remove the column");
  }
  if (!others.empty()) notes.push_back("columns not used: " + enumeration(others));
}

Trajectory read_waypoints(const Model& model, const Motion& motion, const std::string& file) {
  return WaypointReader(model, motion, file).read();
}

ex held_value(const Model& model, const Motion& motion, std::size_t parameter,
              const std::string& file, int line, const std::string& remedy) {
  const ex value = motion.pose.empty() ? ex() : motion.pose[parameter];
  const bool is_given = !motion.pose.empty() && !GiNaC::is_a<GiNaC::symbol>(value);
  if (!is_given || !approx_value(value))
    throw InputError::statement(
        file, line,
        "nothing gives the pose parameter " + in_quotes(model.pose[parameter].name) + " a value",
        remedy);
  return value;
}

}  // namespace regulus::detail
