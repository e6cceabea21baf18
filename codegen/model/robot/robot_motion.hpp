// SPDX-License-Identifier: GPL-3.0-or-later
// A motion of a robot that is written in C++.
#pragma once

#include <string>

#include "codegen/model/exact/formula.hpp"
#include "codegen/model/file/written.hpp"

namespace regulus {

namespace detail {
class RobotText;
}  // namespace detail

/// A motion variety, made by Robot::motion. Every pose parameter gets either a range, or an
/// expression in the motion's own parameters (a number, if it has none).
class RobotMotion {
 public:
  using Place = SourcePlace;

  RobotMotion(std::string name, Place place) : name_(std::move(name)), place_(place) {}

  /// Sets a pose parameter that is free in [lo, hi].
  RobotMotion& range(const Formula& parameter, const Formula& lo, const Formula& hi,
                     Place place = Place::current());

  /// Sets a pose parameter that is a function of the motion's parameters, or constant.
  RobotMotion& pose(const Formula& parameter, const Formula& value, Place place = Place::current());

  /// Declares a parameter of this motion, in [lo, hi].
  Formula parameter(const std::string& name, const Formula& lo, const Formula& hi,
                    Place place = Place::current());
  /// Overload for a symbol of GiNaC expressions.
  Formula parameter(const GiNaC::symbol& symbol, const Formula& lo, const Formula& hi,
                    Place place = Place::current());

  /// Sets the control error ± of a pose parameter.
  RobotMotion& error(const Formula& parameter, const Formula& bound,
                     Place place = Place::current());

  /// Excludes the poses where the expression is > 0 from the variety.
  RobotMotion& constraint(const Formula& at_most_zero, Place place = Place::current());

  /// Sets the threshold that |det J⁻¹| must exceed.
  RobotMotion& alpha(const Formula& threshold, Place place = Place::current());

 private:
  RobotMotion& add(WrittenSection& section, const Formula& parameter, std::string value,
                   const Place& place);

  std::string name_;
  Place place_;
  WrittenSection poses_, parameters_, errors_, alpha_;
  std::vector<Formula> constraints_;
  Place constraints_place_;
  WrittenSymbols symbols_;

  friend class Robot;
  friend class detail::RobotText;
};

}  // namespace regulus
