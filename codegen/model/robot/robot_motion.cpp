// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/robot/robot_motion.hpp"

#include "codegen/model/names.hpp"

namespace regulus {

using namespace detail;

RobotMotion& RobotMotion::add(WrittenSection& section, const Formula& parameter, std::string value,
                              const Place& place) {
  const std::string& name = parameter.text();
  if (!is_name(name))
    throw mistake(place,
                  in_quotes(name) + " in the motion " + name_ + " is an expression, not a name",
                  "give the name of a parameter");
  symbols_.use(parameter, place);
  write_once(section, in_quotes(name) + " of the motion " + name_, {name, std::move(value), place});
  return *this;
}

RobotMotion& RobotMotion::range(const Formula& parameter, const Formula& lo, const Formula& hi,
                                Place place) {
  symbols_.use({lo, hi}, place);
  return add(poses_, parameter, written({lo, hi}), place);
}

RobotMotion& RobotMotion::pose(const Formula& parameter, const Formula& value, Place place) {
  symbols_.use(value, place);
  return add(poses_, parameter, written(value), place);
}

Formula RobotMotion::parameter(const std::string& name, const Formula& lo, const Formula& hi,
                               Place place) {
  symbols_.use({lo, hi}, place);
  const Formula parameter(name, place);
  add(parameters_, parameter, written({lo, hi}), place);
  return parameter;
}

Formula RobotMotion::parameter(const GiNaC::symbol& symbol, const Formula& lo, const Formula& hi,
                               Place place) {
  symbols_.declare(symbol);
  static_cast<void>(parameter(symbol.get_name(), lo, hi, place));
  return Formula(GiNaC::ex(symbol), place);
}

RobotMotion& RobotMotion::error(const Formula& parameter, const Formula& bound, Place place) {
  symbols_.use(bound, place);
  return add(errors_, parameter, written(bound), place);
}

RobotMotion& RobotMotion::constraint(const Formula& at_most_zero, Place place) {
  symbols_.use(at_most_zero, place);
  constraints_.push_back(at_most_zero);
  constraints_place_ = place;
  return *this;
}

RobotMotion& RobotMotion::alpha(const Formula& threshold, Place place) {
  symbols_.use(threshold, place);
  write_once(alpha_, "alpha of the motion " + name_, {"alpha", written(threshold), place});
  return *this;
}

}  // namespace regulus
