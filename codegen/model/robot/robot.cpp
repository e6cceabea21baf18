// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/robot/robot.hpp"

#include "codegen/model/file/model_file.hpp"
#include "codegen/model/names.hpp"
#include "codegen/model/robot/robot_text.hpp"

namespace regulus {

using namespace detail;

Robot::Robot(const std::string& name, Place place) : name_(name), place_(place) {
  header_ = {{"regulus", "1", place}, {"name", written(std::string_view(name)), place}};
}

void Robot::source(const std::string& words, Place place) {
  write_once(header_, "source", {"source", written(std::string_view(words)), place});
}

/// All sections share the names.
Formula Robot::declare(WrittenSection& section, const std::string& name, const std::string& value,
                       const Place& place) {
  const auto [first, inserted] = declared_.emplace(name, place);
  if (!inserted)
    throw mistake(place,
                  in_quotes(name) + " is declared twice, first at line " +
                      std::to_string(first->second.line()),
                  "choose another name", name);
  section.push_back({name, value, place});
  // A text that is not a name is refused later, when the robot is read.
  return is_name(name) && !is_reserved(name) ? Formula(name, place) : Formula();
}

Formula Robot::pose(const std::string& name, const std::string& unit, Place place) {
  return declare(pose_, name, written(std::string_view(unit)), place);
}

Formula Robot::pose(const GiNaC::symbol& symbol, const std::string& unit, Place place) {
  symbols_.declare(symbol);
  static_cast<void>(pose(symbol.get_name(), unit, place));
  return Formula(GiNaC::ex(symbol), place);
}

Formula Robot::constant(const std::string& name, const Formula& value, Place place) {
  symbols_.use(value, place);
  return declare(geometry_, name, written(value), place);
}

Formula Robot::constant(const GiNaC::symbol& symbol, const Formula& value, Place place) {
  symbols_.declare(symbol);
  static_cast<void>(constant(symbol.get_name(), value, place));
  return Formula(GiNaC::ex(symbol), place);
}

std::string Robot::uncertain_table(const std::string& value, const char* kind,
                                   const Formula& tolerance, const std::string& group,
                                   const Place& place) {
  symbols_.use(tolerance, place);
  std::string table = "{ value = " + value + ", " + kind + " = " + written(tolerance);
  if (!group.empty()) table += ", group = " + written(std::string_view(group));
  return table + " }";
}

Formula Robot::uncertain(const std::string& name, const Formula& value, const Formula& tolerance,
                         const std::string& group, Place place) {
  symbols_.use(value, place);
  return declare(geometry_, name,
                 uncertain_table(written(value), "tolerance", tolerance, group, place), place);
}

Formula Robot::uncertain(const GiNaC::symbol& symbol, const Formula& value,
                         const Formula& tolerance, const std::string& group, Place place) {
  symbols_.declare(symbol);
  static_cast<void>(uncertain(symbol.get_name(), value, tolerance, group, place));
  return Formula(GiNaC::ex(symbol), place);
}

std::vector<Formula> Robot::declare_point(const std::string& name,
                                          const std::vector<Formula>& value,
                                          const std::string& table, const Place& place) {
  symbols_.use(value, place);
  static_cast<void>(declare(geometry_, name, table, place));
  std::vector<Formula> coordinates;
  for (std::size_t i = 1; i <= value.size() && is_name(name); ++i)
    coordinates.emplace_back(name + "_" + std::to_string(i), place);
  return coordinates;
}

std::vector<Formula> Robot::point(const std::string& name, const std::vector<Formula>& value,
                                  const Formula& tolerance, const std::string& group, Place place) {
  return declare_point(
      name, value, uncertain_table(written(value), "tolerance", tolerance, group, place), place);
}

std::vector<Formula> Robot::ball(const std::string& name, const std::vector<Formula>& value,
                                 const Formula& radius, const std::string& group, Place place) {
  return declare_point(name, value, uncertain_table(written(value), "radius", radius, group, place),
                       place);
}

Formula Robot::let(const std::string& name, const Formula& meaning, Place place) {
  symbols_.use(meaning, place);
  return declare(let_, name, written(meaning), place);
}

void Robot::matrix(const std::vector<std::vector<Formula>>& rows, Place place) {
  std::string text = "[\n";
  for (const std::vector<Formula>& row : rows) {
    symbols_.use(row, place);
    text += "  " + written(row) + ",\n";
  }
  write_once(matrix_, "the matrix", {"rows", text + "]", place});
}

std::vector<std::vector<Formula>> Robot::rows_of(const GiNaC::matrix& entries, const Place& place) {
  std::vector<std::vector<Formula>> rows(entries.rows());
  for (unsigned i = 0; i < entries.rows(); ++i)
    for (unsigned j = 0; j < entries.cols(); ++j) rows[i].emplace_back(entries(i, j), place);
  return rows;
}

void Robot::row_scale(const std::vector<Formula>& factors, Place place) {
  symbols_.use(factors, place);
  write_once(matrix_, "the row scale", {"row_scale", written(factors), place});
}

RobotMotion& Robot::motion(const std::string& name, Place place) {
  for (const RobotMotion& motion : motions_)
    if (motion.name_ == name)
      throw mistake(place,
                    "the motion " + in_quotes(name) + " is declared twice, first at line " +
                        std::to_string(motion.place_.line()),
                    "choose another name", name);
  return motions_.emplace_back(name, place);
}

void Robot::require_declared_symbols() const {
  symbols_.require_declared();
  for (const RobotMotion& motion : motions_) motion.symbols_.require_declared(&symbols_);
}

std::string Robot::model_file() const {
  require_declared_symbols();
  return RobotText(*this).text();
}

Model Robot::model() const {
  require_declared_symbols();
  const RobotText written(*this);
  try {
    return parse_model(written.text(), name_);
  } catch (const InputError& error) {
    const Place place = written.place_of(error.line());
    throw error.at(place.file_name(), static_cast<int>(place.line()));
  }
}

}  // namespace regulus
