// SPDX-License-Identifier: GPL-3.0-or-later
// A robot that is written in C++. AUTHORS.md shows how, codegen/robot/examples has whole ones.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "codegen/model/formula.hpp"
#include "codegen/model/model.hpp"
#include "codegen/model/written.hpp"
#include "codegen/robot/robot_motion.hpp"

namespace regulus::inline robot {

/// The inverse Jacobian of a robot, what it is written in, and the robot's motions.
///
/// It is the text of a model file in the making, and read as such: whatever a model file is refused
/// for is refused here, with the place in C++ instead of the file's line. A thing that is given
/// twice is refused by the second call, all else when the robot is read.
class Robot {
 public:
  using Place = SourcePlace;

  explicit Robot(const std::string& name, Place place = Place::current());

  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  /// Who published the numbers.
  void source(const std::string& words, Place place = Place::current());

  /// A pose parameter; in the order of the twist. The unit is a label, "1" for none.
  Formula pose(const std::string& name, const std::string& unit = "1",
               Place place = Place::current());
  /// The same for a symbol that a GiNaC expression is written in; so below.
  Formula pose(const GiNaC::symbol& symbol, const std::string& unit = "1",
               Place place = Place::current());

  /// A constant of the robot, exact.
  Formula constant(const std::string& name, const Formula& value, Place place = Place::current());
  Formula constant(const GiNaC::symbol& symbol, const Formula& value,
                   Place place = Place::current());

  /// value ± tolerance, which `--tolerance GROUP=E` sets for all of a group.
  Formula uncertain(const std::string& name, const Formula& value, const Formula& tolerance,
                    const std::string& group = {}, Place place = Place::current());
  Formula uncertain(const GiNaC::symbol& symbol, const Formula& value, const Formula& tolerance,
                    const std::string& group = {}, Place place = Place::current());

  /// A point each of whose coordinates is ± tolerance: name_1, name_2 …
  std::vector<Formula> point(const std::string& name, const std::vector<Formula>& value,
                             const Formula& tolerance = 0, const std::string& group = {},
                             Place place = Place::current());

  /// A point within that radius of its nominal place: name_1, name_2 …
  std::vector<Formula> ball(const std::string& name, const std::vector<Formula>& value,
                            const Formula& radius, const std::string& group = {},
                            Place place = Place::current());

  /// A name for a sub-expression.
  Formula let(const std::string& name, const Formula& meaning, Place place = Place::current());

  /// m rows of n entries, m ≥ n: a row of J⁻¹ for each leg, up to its row scale.
  void matrix(const std::vector<std::vector<Formula>>& rows, Place place = Place::current());
  template <std::same_as<GiNaC::matrix> Matrix>
  void matrix(const Matrix& entries, Place place = Place::current()) {
    matrix(rows_of(entries, place), place);
  }

  /// m positive factors: row of J⁻¹ = row_scale · row. It matters where α > 0.
  void row_scale(const std::vector<Formula>& factors, Place place = Place::current());

  /// A motion variety, to be given its ranges; it lives as long as the robot.
  RobotMotion& motion(const std::string& name, Place place = Place::current());

  /// The robot as a model file, which every command takes. The same text in every process. Throws
  /// InputError for GiNaC symbols that were not declared.
  [[nodiscard]] std::string model_file() const;

  /// The robot as its model file is read. Throws InputError with file and line in C++.
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
  std::deque<RobotMotion> motions_;        // which does not move what it holds
  std::map<std::string, Place> declared_;  // of pose, geometry and let
  WrittenSymbols symbols_;

  friend class RobotText;
};

}  // namespace regulus::inline robot

/// What a model in a file of its own defines, for the program that generates its kernel.
regulus::Robot regulus_model();
