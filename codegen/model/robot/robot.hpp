// SPDX-License-Identifier: GPL-3.0-or-later
// A robot that is written in C++. AUTHORS.md shows how; codegen/model/robot/examples has complete robots.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "codegen/model/exact/formula.hpp"
#include "codegen/model/file/written.hpp"
#include "codegen/model/model.hpp"
#include "codegen/model/robot/robot_motion.hpp"

namespace regulus {

namespace detail {
class RobotText;
}  // namespace detail

/// The inverse Jacobian of a robot, the names in it, and the robot's motions.
///
/// It collects the text of a model file, which is then read as such: the rules of model files
/// apply, and messages have the place in C++ instead of the file's line. A second call for the same
/// name or section is refused at once; other mistakes are refused when the robot is read.
class Robot {
 public:
  using Place = SourcePlace;

  explicit Robot(const std::string& name, Place place = Place::current());

  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  /// Names the source of the numbers.
  void source(const std::string& words, Place place = Place::current());

  /// Declares a pose parameter, in the order of the twist. The unit is a label, "1" for none.
  Formula pose(const std::string& name, const std::string& unit = "1",
               Place place = Place::current());
  /// Overload for a symbol of GiNaC expressions; there are more below.
  Formula pose(const GiNaC::symbol& symbol, const std::string& unit = "1",
               Place place = Place::current());

  /// Declares an exact constant of the robot.
  Formula constant(const std::string& name, const Formula& value, Place place = Place::current());
  Formula constant(const GiNaC::symbol& symbol, const Formula& value,
                   Place place = Place::current());

  /// Declares value ± tolerance; `--tolerance GROUP=E` sets the tolerance of a whole group.
  Formula uncertain(const std::string& name, const Formula& value, const Formula& tolerance,
                    const std::string& group = {}, Place place = Place::current());
  Formula uncertain(const GiNaC::symbol& symbol, const Formula& value, const Formula& tolerance,
                    const std::string& group = {}, Place place = Place::current());

  /// Declares a point with ± tolerance on each coordinate: name_1, name_2 …
  std::vector<Formula> point(const std::string& name, const std::vector<Formula>& value,
                             const Formula& tolerance = 0, const std::string& group = {},
                             Place place = Place::current());

  /// Declares a point within that radius of its nominal place: name_1, name_2 …
  std::vector<Formula> ball(const std::string& name, const std::vector<Formula>& value,
                            const Formula& radius, const std::string& group = {},
                            Place place = Place::current());

  /// Declares a name for a sub-expression.
  Formula let(const std::string& name, const Formula& meaning, Place place = Place::current());

  /// m rows of n entries, m ≥ n: a row of J⁻¹ for each leg, up to its row scale.
  void matrix(const std::vector<std::vector<Formula>>& rows, Place place = Place::current());
  template <std::same_as<GiNaC::matrix> Matrix>
  void matrix(const Matrix& entries, Place place = Place::current()) {
    matrix(rows_of(entries, place), place);
  }

  /// m positive factors: row of J⁻¹ = row_scale · row. They matter for α > 0.
  void row_scale(const std::vector<Formula>& factors, Place place = Place::current());

  /// Adds a motion variety without ranges; it lives as long as the robot.
  RobotMotion& motion(const std::string& name, Place place = Place::current());

  /// Returns the robot as a model file, which every command takes. The text is the same in every
  /// process. Throws InputError for GiNaC symbols that were not declared.
  [[nodiscard]] std::string model_file() const;

  /// Returns the model that the reader makes of this file. Throws InputError with file and line in
  /// C++.
  [[nodiscard]] Model model() const;

 private:
  static std::vector<std::vector<Formula>> rows_of(const GiNaC::matrix& entries,
                                                   const Place& place);

  Formula declare(WrittenSection& section, const std::string& name, const std::string& value,
                  const Place& place);
  std::vector<Formula> declare_point(const std::string& name, const std::vector<Formula>& value,
                                     const std::string& table, const Place& place);
  [[nodiscard]] std::string uncertain_table(const std::string& value, const char* kind,
                                            const Formula& tolerance, const std::string& group,
                                            const Place& place);
  void require_declared_symbols() const;

  std::string name_;
  Place place_;
  WrittenSection header_, pose_, geometry_, let_, matrix_;
  std::deque<RobotMotion> motions_;        // a deque does not move its elements
  std::map<std::string, Place> declared_;  // of pose, geometry and let
  WrittenSymbols symbols_;

  friend class detail::RobotText;
};

}  // namespace regulus

/// Defined by the author of a robot; the program that generates its kernel calls it.
regulus::Robot regulus_model();
