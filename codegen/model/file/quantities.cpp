// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/file/quantities.hpp"

#include <algorithm>
#include <optional>

#include "codegen/model/constants.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/model/exact/sign.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// A constant of a group is not exact: --tolerance may make it uncertain.
bool is_exact(const GeometryParameter& g) { return g.tolerance.is_zero() && g.group.empty(); }

/// Returns nullopt if the expression has no value there.
std::optional<ex> replaced(const ex& expression, const GiNaC::exmap& values) try {
  return expression.subs(values, GiNaC::subs_options::no_pattern);
} catch (const GiNaC::pole_error&) {
  return std::nullopt;
}

bool is_undefined(const std::optional<ex>& value) {
  return !value || (symbols_of(*value).empty() && !approx_value(*value));
}

class QuantityReader {
 public:
  QuantityReader(const ModelReading& reading, const TomlEntry& entry)
      : reading_(reading), entry_(entry) {
    for (const GeometryParameter& g : reading.model.geometry)
      if (is_exact(g)) exact_[g.symbol] = g.value;
  }

  ParsedExpression with_exact_values(const ParsedExpression& term) const {
    ParsedExpression result = term;
    result.value = defined(replaced(term.value, exact_));
    result.must_be_defined.clear();
    for (const ex& condition : term.must_be_defined) {
      const ex remaining = defined(replaced(condition, exact_));
      if (!certain_defined(remaining)) result.must_be_defined.push_back(remaining);
    }
    const std::vector<ex> left = symbols_of(result.value);
    for (const ex& symbol : left) require_constant(symbol);
    result.constant = left.empty();
    return result;
  }

 private:
  ex defined(const std::optional<ex>& value) const {
    if (is_undefined(value))
      reading_.toml.reject(entry_, entry_.path + " has no value: it is not a finite real number",
                           "correct the expression, or the constants that it names");
    return *value;
  }

  /// A part of the robot is where it is at every pose; the rows of the matrix rest on that.
  void require_constant(const ex& symbol) const {
    const auto& geometry = reading_.model.geometry;
    if (std::ranges::none_of(geometry,
                             [&](const GeometryParameter& g) { return symbol.is_equal(g.symbol); }))
      reading_.toml.reject(entry_, entry_.path + " depends on the pose",
                           "write a number, or an expression of constants of [geometry]");
  }

  const ModelReading& reading_;
  const TomlEntry& entry_;
  GiNaC::exmap exact_;
};

}  // namespace

ParsedExpression read_angle(ModelReading& reading, const TomlEntry& entry, bool in_degrees) {
  ParsedExpression term =
      read_quantity(reading, entry, in_degrees ? NumberUnit::kDegrees : NumberUnit::kPlain);
  const ex nominal = nominal_value(reading.model, term.value);
  if (in_degrees && nominal.has(GiNaC::Pi))
    reading.toml.reject(entry,
                        entry.path + " is a number of degrees, and a name in it is one of radians",
                        "write the constants as numbers of degrees, too");
  warn_about_angle(reading.model.warnings, {nominal, nominal}, in_degrees ? "deg" : "rad",
                   reading.toml.place(entry));
  if (in_degrees) term.value *= one_degree();
  return term;
}

ParsedExpression read_quantity(ModelReading& reading, const TomlEntry& entry, NumberUnit unit) {
  ParsedExpression term = reading.toml.expression(entry, reading.names, unit);
  reading.count(term, entry);
  if (!term.constant) term = QuantityReader(reading, entry).with_exact_values(term);
  append(reading.model.must_be_defined, term.must_be_defined);
  return term;
}

ex nominal_value(const Model& model, const ex& value) {
  GiNaC::exmap nominal;
  for (const GeometryParameter& g : model.geometry) nominal[g.symbol] = g.value;
  return replaced(value, nominal).value_or(ex(0));
}

ParsedExpression declare_quantity(ModelReading& reading, const TomlEntry& entry,
                                  const std::string& name, const ParsedExpression& value,
                                  const DeclaredTolerance& tolerance) {
  const Place place = reading.toml.place(entry);
  const std::string parameter = value.constant ? name : name + "_error";
  const GiNaC::realsymbol symbol(parameter);
  const ParsedExpression variation = variable(symbol);
  reading.names.declare(parameter, variation, place);
  reading.model.geometry.push_back({symbol, parameter, value.constant ? value.value : ex(0),
                                    tolerance.value, tolerance.group, tolerance.ball});
  if (value.constant) return variation;
  const ParsedExpression result = sum({{value}, {variation}});
  reading.names.declare(name, result, place);
  return result;
}

void require_use(const TomlReader& toml, const TomlEntry& tolerance, const ex& value, bool is_used,
                 const std::string& quantities) {
  if (is_used || value.is_zero()) return;
  toml.reject(tolerance, tolerance.path + " applies to nothing: the file gives no " + quantities,
              "remove it, or give what it is the tolerance of");
}

}  // namespace regulus::detail
