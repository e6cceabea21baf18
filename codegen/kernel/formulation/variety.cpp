// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/formulation/variety.hpp"

#include "codegen/kernel/program/enclose.hpp"
#include "codegen/kernel/symbolic/from_ginac.hpp"
#include "codegen/kernel/symbolic/lowering.hpp"
#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

Program constant_program(const GiNaC::ex& value) {
  const SymbolMeaning no_symbols;
  Lowering lowering({}, {});
  lowering.output(GinacReader(no_symbols).read(value));
  return std::move(lowering).finish();
}

InputError no_value(const std::string& what) {
  return InputError::statement("", 0, what + " has no finite value",
                               "write a constant expression that is defined and finite", what);
}

/// Returns the range of a witness on one axis of a ball. The largest cube inside the ball has
/// half-sides radius/√dimension; each of its points is in the ball, whatever the other axes are.
Range inside_ball(const Range& axis, std::size_t dimension) {
  const GiNaC::ex middle = (axis.lo + axis.hi) / 2;
  const GiNaC::ex half = (axis.hi - axis.lo) / (2 * GiNaC::sqrt(GiNaC::ex(int(dimension))));
  return {middle - half, middle + half};
}

std::optional<Interval> inward(const Model& model, const Variable& variable) {
  Range range = variable.range;
  if (variable.ball >= 0)
    range = inside_ball(range, model.balls[std::size_t(variable.ball)].members.size());
  return round_inward(constant_program(range.lo), constant_program(range.hi));
}

}  // namespace

Interval enclose_constant(const GiNaC::ex& value, const std::string& what) {
  const std::optional<Interval> enclosure = enclose(constant_program(value));
  if (!enclosure) throw no_value(what);
  return *enclosure;
}

Variety enclose_variety(const Model& model, const Motion& motion,
                        std::span<const Variable> variables) {
  Variety variety;
  for (const Variable& variable : variables) {
    const auto outer =
        enclose_outward(constant_program(variable.range.lo), constant_program(variable.range.hi));
    if (!outer) throw no_value("the range of " + variable.name);
    variety.outer.push_back(*outer);
    variety.inner.push_back(inward(model, variable));
  }
  variety.alpha = enclose_constant(motion.alpha, "alpha");
  return variety;
}

}  // namespace regulus::detail
