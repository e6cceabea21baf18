// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/load_comparison.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "runtime/verifier/quantity_lines.hpp"

namespace regulus::verifier {
namespace {

std::string at(std::size_t i) { return '[' + std::to_string(i) + ']'; }

/// The parts of a load and of a set of twists: all components, or those of one kind.
struct PartNames {
  const char *table, *whole, *linear, *angular;
};
constexpr PartNames kLoad{"load", "wrench", "force", "moment"};
constexpr PartNames kTwist{"twist", "twist", "velocity", "rotation"};

class LoadComparison {
 public:
  LoadComparison(Question& q, const WrittenValues& values, const LoadComparer& comparer)
      : q_(q), values_(values), comparer_(comparer) {}

  bool run() {
    if (!compare_set(*q_.load, kLoad)) return false;
    require_known_units();
    compare_limits(q_.load->least);
    return true;
  }

  bool compare_quantity() {
    const QuantityLines& quantity = *q_.quantity;
    if (q_.closure) require_radians(quantity);
    require_known_units();
    if (q_.closure) require_order_of_motors();
    compare_of_motors("error", "motor-error ", quantity.errors);
    compare_of_motors("speed", "motor-speed ", quantity.speeds);
    compare_of_motors("stiffness", "stiffness ", quantity.stiffness);
    compare_factors(quantity.factors);
    compare_limits(quantity.least);
    return !quantity.set ||
           compare_set(*quantity.set, quantity.set_kind == "load" ? kLoad : kTwist);
  }

 private:
  /// Returns a place at or below this one; nullopt if the file has none.
  [[nodiscard]] std::optional<std::string> first_in(const std::string& place) const {
    for (const char* next : {".", "["})
      if (const auto at = values_.lower_bound(place + next);
          at != values_.end() && at->first.starts_with(place + next))
        return at->first;
    return std::nullopt;
  }

  /// The moments and lengths of the file are of radians, and J is by the numbers of the coordinates. A
  /// determinant is by those of the unknowns.
  void require_radians(const QuantityLines& quantity) const {
    const bool has_determinant = quantity.kind.starts_with(format::kDeterminant);
    if (!quantity.set && quantity.factors.empty() && !has_determinant) return;
    for (const auto& [place, value] : values_)
      if (((place.starts_with("pose.") && quantity.set) ||
           place.starts_with("closure.unknowns.")) &&
          (value.text == "deg" || value.text == "°"))
        throw Unfinished(place +
                         " is in degrees: loads, a characteristic length and determinants "
                         "are of radians");
  }

  /// What the file leaves out is 0.
  bool compare_set(const VectorSetLines& set, const PartNames& names) {
    const std::string table = std::string(names.table) + '.' + set.name;
    if (set.name.find_first_of(".[") != std::string::npos || !first_in(table)) return false;
    set_ = &set;
    std::vector<std::size_t> all;
    for (std::size_t j = 0; j < q_.columns; ++j) all.push_back(j);
    const std::vector<std::size_t> linear = columns_of('v'), angular = columns_of('w');
    compare_part(table + '.' + names.whole, all);
    compare_part(table + '.' + names.linear, linear);
    compare_part(table + '.' + names.angular, angular);
    if (first_in(table + '.' + names.whole) || linear.size() + angular.size() == q_.columns)
      require_no_more();
    return true;
  }

  /// Refuses a component, a spread or a ball that no value of the file is about.
  void require_no_more() const {
    for (const auto& [key, stated] : q_.stated)
      if (key.starts_with("wrench") && !comparer_.is_compared(key) &&
          !is_zero_number(q_.graph, stated.node))
        comparer_.refuse(key);
  }

  /// Returns how many of `count` rows are those of motors; they come first.
  [[nodiscard]] std::size_t motors_of(std::size_t count) const {
    if (q_.closure) return count;
    std::size_t motors = count;
    if (comparer_.section != nullptr)
      motors = comparer_.section->motors().value_or(count);
    else if (const auto given = values_.find("matrix.motors"); given != values_.end())
      motors = std::size_t(std::atoi(given->second.text.c_str()));
    if (motors > count) throw Unfinished("the file has more motors than rows");
    return motors;
  }

  /// The labels that the front end takes: of a closure those of the pose, of other robots no degrees.
  void require_known_units() const {
    const std::string table = "actuators.unit";
    for (auto unit = values_.lower_bound(table);
         unit != values_.end() && unit->first.starts_with(table); ++unit) {
      const bool is_of_pose = std::any_of(values_.begin(), values_.end(), [&](const auto& value) {
        return value.first.starts_with("pose.") && value.second.text == unit->second.text;
      });
      const bool has_degrees = unit->second.text.find("eg") != std::string::npos ||
                               unit->second.text.find("°") != std::string::npos;
      if (q_.closure ? !is_of_pose : has_degrees)
        throw Unfinished(unit->first + " is a unit that the numbers of motors do not have");
    }
  }

  /// Lists of the file are in the order of its pose parameters, and so must be the certificate's.
  void require_order_of_motors() const {
    if (comparer_.section != nullptr) return;
    std::map<std::size_t, std::string> by_place;
    for (auto pose = values_.lower_bound("pose.");
         pose != values_.end() && pose->first.starts_with("pose."); ++pose)
      by_place.emplace(pose->second.number, pose->first.substr(5));
    std::vector<std::string> names;
    for (const auto& [number, name] : by_place) names.push_back(name);
    if (names != q_.closure->poses) throw Unfinished("the motors of the file have another order");
  }

  /// One value for all motors, a list with one for each, or a list with one for each row.
  void compare_of_motors(const std::string& key, const std::string& stated,
                         const std::vector<NodeId>& rows) {
    if (rows.empty()) return;  // the quantity has no such lines
    const std::string place = "actuators." + key;
    const bool is_list = values_.contains(place + "[0]");
    const std::size_t motors = motors_of(rows.size());
    const std::size_t given = given_rows(place, "", rows.size(), motors);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i >= given) {
        expect_none(stated + std::to_string(i), rows[i], key == "stiffness");
        continue;
      }
      const std::string one = is_list ? place + at(i) : place;
      if (rows[i] == kNoNode) comparer_.refuse_row(key, i);
      if (!values_.contains(one)) comparer_.refuse(stated + std::to_string(i));
      compare(one, stated + std::to_string(i));
    }
  }

  /// Returns how many rows, the first ones, the file gives a value.
  [[nodiscard]] std::size_t given_rows(const std::string& place, const std::string& below,
                                       std::size_t rows, std::size_t motors) const {
    if (!values_.contains(place + "[0]" + below)) return motors;
    std::size_t given = 0;
    while (values_.contains(place + at(given) + below)) ++given;
    if (given != motors && given != rows)
      throw Unfinished(place + " is a list of neither all motors nor all rows");
    return given;
  }

  /// A constraint has no error, and gives way to no force.
  void expect_none(const std::string& stated, NodeId value, bool is_stiffness) {
    if (is_stiffness ? value != kNoNode : !is_zero_number(q_.graph, value))
      comparer_.refuse(stated);
    if (!is_stiffness) comparer_.note(stated);
  }

  /// The factor of a velocity is 1, that of an angular velocity is 1/L.
  void compare_factors(const std::vector<NodeId>& factors) {
    const std::string place = "characteristic_length";
    const NodeId one = q_.graph.number("1");
    const std::vector<std::size_t> linear = columns_of('v'), angular = columns_of('w');
    const bool has_length = values_.contains(place);
    for (std::size_t j = 0; j < factors.size(); ++j) {
      const std::string stated = "factor " + std::to_string(j);
      const bool is_one = factors[j] == one;
      const auto is_in = [j](const auto& list) {
        return std::find(list.begin(), list.end(), j) != list.end();
      };
      if (!is_one && (!has_length || is_in(linear))) comparer_.refuse(stated);
      if (has_length && (!is_one || is_in(angular))) {
        const StatedValue& line = q_.stated.at(stated);
        const std::string length = "length " + std::to_string(j);
        q_.stated.emplace(length, StatedValue{q_.graph.add(Op::kDivide, one, line.node), line.line,
                                              "1/(" + line.text + ')'});
        compare(place, length);
      }
      comparer_.note(stated);
    }
  }

  /// The limits are one range for all motors, or a list of ranges; a constraint has none.
  void compare_limits(const std::vector<NodeId>& least) {
    if (least.empty()) return;
    const std::string force = "actuators.force";
    const bool is_list = values_.contains(force + "[0][0]");
    const std::size_t motors = motors_of(least.size());
    const std::size_t given = is_list ? given_rows(force, "[0]", least.size(), motors) : motors;
    for (std::size_t i = 0; i < least.size(); ++i) {
      const std::string place = is_list ? force + at(i) : force;
      if (i >= given) {
        if (least[i] != kNoNode) comparer_.refuse("least " + std::to_string(i));
        continue;
      }
      if (least[i] == kNoNode) comparer_.refuse_row("force", i);
      if (!values_.contains(place + "[0]")) comparer_.refuse("least " + std::to_string(i));
      if (!values_.contains(place + "[1]")) comparer_.refuse("largest " + std::to_string(i));
      compare(place + "[0]", "least " + std::to_string(i));
      compare(place + "[1]", "largest " + std::to_string(i));
    }
  }

  /// Returns the columns of velocities ('v') or of angular velocities ('w'); empty if they are not
  /// known here.
  [[nodiscard]] std::vector<std::size_t> columns_of(char letter) const {
    std::vector<std::size_t> columns;
    for (std::size_t j = 0; j < q_.columns; ++j)
      if (kind_of_column(j) == letter) columns.push_back(j);
    return columns;
  }

  /// By its name; of a platform by its place; or by the unit of its pose parameter.
  [[nodiscard]] char kind_of_column(std::size_t j) const {
    if (const auto named = values_.find("matrix.twist" + at(j)); named != values_.end())
      return named->second.text.empty() ? ' ' : named->second.text.front();
    if (comparer_.section != nullptr && q_.columns == 6) return j < 3 ? 'v' : 'w';
    const std::vector<std::string> units = units_of_pose();
    if (units.size() != q_.columns) return ' ';
    const std::string& unit = units[j];
    return unit == "rad" || unit == "deg" || unit == "°" ? 'w' : 'v';
  }

  /// Returns the units of the pose parameters, or of the unknowns of a closure, in their order.
  [[nodiscard]] std::vector<std::string> units_of_pose() const {
    std::vector<std::string> units;
    if (q_.closure) {
      for (const std::string& name : q_.closure->names)
        if (const auto unit = values_.find("closure.unknowns." + name); unit != values_.end())
          units.push_back(unit->second.text);
      return units;
    }
    if (comparer_.section != nullptr) {
      for (const SectionPose& pose : comparer_.section->pose()) units.push_back(pose.unit);
      return units;
    }
    std::map<std::size_t, std::string> by_place;
    for (auto pose = values_.lower_bound("pose.");
         pose != values_.end() && pose->first.starts_with("pose."); ++pose)
      by_place.emplace(pose->second.number, pose->second.text);
    for (const auto& [number, unit] : by_place) units.push_back(unit);
    return units;
  }

  void compare_part(const std::string& part, const std::vector<std::size_t>& columns) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::string number = std::to_string(columns[c]);
      compare_component(part + at(c), columns[c]);
      compare(part + ".value" + at(c), "wrench " + number);
      compare(part + ".tolerance", "wrench-spread " + number);
    }
    compare(part + ".radius", "wrench-ball " + ball_of(columns));
    if (const auto place = first_in(part); place && columns.empty()) comparer_.leave_out(*place);
  }

  /// Returns the number of the ball of these components; a number that no ball has, if there is none.
  [[nodiscard]] std::string ball_of(const std::vector<std::size_t>& columns) const {
    std::size_t b = 0;
    while (b < set_->balls.size() && set_->balls[b].members != columns) ++b;
    return std::to_string(b);
  }

  void compare(const std::string& place, const std::string& stated) const {
    comparer_.compare(place, stated);
  }

  void compare_component(const std::string& place, std::size_t column) {
    const std::string number = std::to_string(column);
    if (!values_.contains(place + "[0]")) return compare(place, "wrench " + number);
    const NodeId middle = set_->middle[column], spread = set_->spread[column];
    const StatedValue& line = q_.stated.at("wrench " + number);
    const std::string text = line.text + " +- " + q_.stated.at("wrench-spread " + number).text;
    q_.stated.emplace("wrench-lower " + number,
                      StatedValue{q_.graph.add(Op::kSubtract, middle, spread), line.line, text});
    q_.stated.emplace("wrench-upper " + number,
                      StatedValue{q_.graph.add(Op::kAdd, middle, spread), line.line, text});
    compare(place + "[0]", "wrench-lower " + number);
    compare(place + "[1]", "wrench-upper " + number);
    comparer_.note("wrench " + number);
    comparer_.note("wrench-spread " + number);
  }

  Question& q_;
  const WrittenValues& values_;
  const LoadComparer& comparer_;
  const VectorSetLines* set_ = nullptr;
};

}  // namespace

bool compare_load(Question& question, const WrittenValues& values, const LoadComparer& comparer) {
  return LoadComparison(question, values, comparer).run();
}

bool compare_quantity(Question& question, const WrittenValues& values,
                      const LoadComparer& comparer) {
  return LoadComparison(question, values, comparer).compare_quantity();
}

}  // namespace regulus::verifier
