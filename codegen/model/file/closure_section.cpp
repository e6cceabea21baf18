// SPDX-License-Identifier: GPL-3.0-or-later
// [closure]: equations that tie unknowns (passive joints, or a pose) to the pose parameters.
#include <algorithm>
#include <array>

#include "codegen/model/constants.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/file/sections.hpp"
#include "codegen/model/mechanism/closure_matrix.hpp"
#include "codegen/model/names.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

constexpr std::size_t kMostUnknowns = 64;

bool is_angle(const std::string& unit) { return unit == "rad" || is_in_degrees(unit); }

/// An angle in the unit of an unknown.
ex in_unit(const ex& radians, const std::string& unit) {
  return is_in_degrees(unit) ? radians / one_degree() : radians;
}

bool is_certainly(CertainSign sign, const ex& constant) { return certain_sign(constant) == sign; }

/// max(1, |value|): the size of a number that is no angle. 1 if 4096 bits do not tell.
ex size_of(const ex& value) {
  const ex absolute = is_certainly(CertainSign::kNegative, value) ? -value : value;
  return is_certainly(CertainSign::kPositive, absolute - 1) ? absolute : ex(1);
}

ex default_radius(const std::string& unit, const ex& start) {
  const numeric hundredth(1, 100);
  return is_angle(unit) ? in_unit(hundredth, unit) : hundredth * size_of(start);
}

Range default_range(const std::string& unit, const ex& start) {
  const ex reach = is_angle(unit) ? in_unit(2 * GiNaC::Pi, unit) : 1000 * size_of(start);
  return {start - reach, start + reach};
}

class ClosureReader {
 public:
  ClosureReader(ModelReading& reading, const TomlEntry& entry)
      : reading_(reading),
        toml_(reading.toml),
        entry_(entry),
        closure_(*reading.model.closure),
        unknowns_(names_of(closure_.unknowns)) {}

  void read() {
    read_equations();
    read_start();
    read_ranges();
    read_radii();
    make_matrix();
  }

 private:
  static std::vector<std::string> names_of(const std::vector<PoseParameter>& parameters) {
    std::vector<std::string> names;
    for (const PoseParameter& p : parameters) names.push_back(p.name);
    return names;
  }

  void read_equations() {
    const TomlEntry list = toml_.required(entry_, "equations");
    const std::vector<TomlEntry> equations =
        toml_.elements(list, "a list of expressions, each 0 on the branch");
    if (equations.size() != unknowns_.size())
      toml_.refuse(list,
                   std::to_string(equations.size()) +
                       (equations.size() == 1 ? " equation for " : " equations for ") +
                       std::to_string(unknowns_.size()) +
                       (unknowns_.size() == 1 ? " unknown in " : " unknowns in ") + entry_.path,
                   equations.size() > unknowns_.size()
                       ? "as many; leave out those that follow from others"
                       : "as many; add what else holds the unknowns");
    for (const TomlEntry& equation : equations) read_equation(equation);
    for (const PoseParameter& u : closure_.unknowns)
      if (std::ranges::none_of(closure_.equations,
                               [&u](const ex& equation) { return equation.has(u.symbol); }))
        toml_.reject(list, "no equation depends on the unknown " + in_quotes(u.name),
                     "remove the unknown, or add the equation that it is in");
  }

  void read_equation(const TomlEntry& entry) {
    const ParsedExpression term = toml_.expression(entry, reading_.names);
    reading_.count(term, entry);
    append(reading_.model.must_be_defined, term.must_be_defined);
    closure_.equations.push_back(term.value);
    double size = 0;
    bool has_unknown = false;
    for (const PoseParameter& u : closure_.unknowns) {
      // The sizes are found by a walk through the expression.
      reading_.count({.value = 0, .size = term.size}, entry);
      size += derivative_size(term.value, u.symbol);
      has_unknown = has_unknown || term.value.has(u.symbol);
    }
    if (!has_unknown)
      toml_.reject(entry, entry.path + " depends on no unknown",
                   "write an equation of unknowns; a condition on the pose is a constraint of a "
                   "motion");
    reading_.count({.value = 0, .size = size}, entry);
  }

  void read_start() {
    const TomlEntry start = toml_.required(entry_, "start");
    std::vector<std::string> names = names_of(reading_.model.pose);
    names.insert(names.end(), unknowns_.begin(), unknowns_.end());
    (void)toml_.entries(start, names);
    for (const PoseParameter& p : reading_.model.pose)
      closure_.start_pose.push_back(constant(toml_.required(start, p.name), p.unit).value);
    for (const PoseParameter& u : closure_.unknowns)
      closure_.start.push_back(constant(toml_.required(start, u.name), u.unit).value);
  }

  void read_ranges() {
    const TomlEntry table = optional_table("range");
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const PoseParameter& u = closure_.unknowns[i];
      const TomlEntry given = optional_entry(table, u.name);
      closure_.ranges.push_back(given.node ? range(given, u.unit)
                                           : default_range(u.unit, closure_.start[i]));
      closure_.has_range.push_back(given.node ? 1 : 0);
      if (given.node) require_within(given, i);
    }
  }

  Range range(const TomlEntry& entry, const std::string& unit) {
    const auto ends = toml_.elements(entry, "a range [lower, upper]");
    if (ends.size() != 2)
      toml_.refuse(entry, std::to_string(ends.size()) + " numbers in " + entry.path,
                   "a range [lower, upper]");
    const ParsedExpression lo = plain_constant(ends[0], unit), hi = plain_constant(ends[1], unit);
    const Range range = checked_range(lo, hi, toml_.place(entry));
    if (!is_certainly(CertainSign::kPositive, range.hi - range.lo))
      toml_.reject(entry, entry.path + " is one number, where no unknown stays", "widen the range");
    warn_about_angle(reading_.model.warnings, range, unit, toml_.place(entry));
    return range;
  }

  void require_within(const TomlEntry& given, std::size_t i) const {
    const Range& range = closure_.ranges[i];
    for (const ex& distance : {closure_.start[i] - range.lo, range.hi - closure_.start[i]})
      if (!distance.is_zero() && !is_certainly(CertainSign::kPositive, distance))
        toml_.reject(given,
                     "the start of " + in_quotes(unknowns_[i]) + " is not within " + given.path,
                     "widen the range, or start elsewhere");
  }

  void read_radii() {
    const TomlEntry table = optional_table("radius");
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const PoseParameter& u = closure_.unknowns[i];
      const TomlEntry given = optional_entry(table, u.name);
      closure_.start_radius.push_back(given.node ? radius(given, u.unit)
                                                 : default_radius(u.unit, closure_.start[i]));
      closure_.is_radius_usual.push_back(given.node ? 0 : 1);
    }
  }

  ex radius(const TomlEntry& given, const std::string& unit) {
    const ex value = constant(given, unit).value;
    if (!is_certainly(CertainSign::kPositive, value))
      toml_.refuse(given, "a radius in " + given.path + " that is not above 0",
                   "how far from its start the unknown may be, a number above 0");
    return value;
  }

  /// Returns a table of unknowns; its node is null if there is none.
  TomlEntry optional_table(const std::string& key) const {
    const TomlEntry table = toml_.optional(entry_, key);
    if (!table.node) return table;
    if (toml_.entries(table, unknowns_).empty())
      toml_.refuse(table, "an empty table " + table.path,
                   "an entry for an unknown, or no such table");
    return table;
  }

  TomlEntry optional_entry(const TomlEntry& table, const std::string& key) const {
    return table.node ? toml_.optional(table, key) : table;
  }

  ParsedExpression plain_constant(const TomlEntry& entry, const std::string& unit) {
    ParsedExpression term = toml_.constant(entry, number_unit(unit));
    append(reading_.model.must_be_defined, term.must_be_defined);
    return term;
  }

  ParsedExpression constant(const TomlEntry& entry, const std::string& unit) {
    ParsedExpression term = plain_constant(entry, unit);
    warn_about_angle(reading_.model.warnings, {term.value, term.value}, unit, toml_.place(entry));
    return term;
  }

  void make_matrix() { reading_.model.matrix = closure_matrix(closure_); }

  ModelReading& reading_;
  const TomlReader& toml_;
  const TomlEntry& entry_;
  Closure& closure_;
  std::vector<std::string> unknowns_;
};

}  // namespace

bool depends_on_unknown(const Model& model, const ParsedExpression& term) {
  if (!model.closure) return false;
  return std::ranges::any_of(model.closure->unknowns, [&term](const PoseParameter& u) {
    return term.value.has(u.symbol) ||
           std::ranges::any_of(term.must_be_defined,
                               [&u](const ex& condition) { return condition.has(u.symbol); });
  });
}

void read_unknowns(ModelReading& reading, const TomlEntry& closure) {
  static const std::array<std::string, 5> kKeys = {"unknowns", "equations", "start", "radius",
                                                   "range"};
  const TomlReader& toml = reading.toml;
  (void)toml.entries(closure, kKeys);
  reading.model.closure.emplace();
  std::vector<PoseParameter>& unknowns = reading.model.closure->unknowns;
  const TomlEntry table = toml.required(closure, "unknowns");
  for (const TomlEntry& entry : toml.entries(table))
    unknowns.push_back(read_parameter(reading, entry, "an unknown"));
  if (unknowns.empty() || unknowns.size() > kMostUnknowns)
    toml.refuse(table, std::to_string(unknowns.size()) + " unknowns in " + table.path,
                "1 to " + std::to_string(kMostUnknowns) + ", each NAME = \"unit\"");
}

void read_closure(ModelReading& reading, const TomlEntry& closure) {
  ClosureReader(reading, closure).read();
}

}  // namespace regulus::detail
