// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/formulation/substitution.hpp"

#include <algorithm>
#include <sstream>
#include <unordered_set>
#include <utility>

#include "codegen/support/errors.hpp"

namespace regulus::detail {
namespace {

void require_size(const Model& model, const std::string& what, std::size_t found,
                  std::size_t expected) {
  if (found == expected) return;
  throw InputError(model.path, 0, std::to_string(found) + " " + what, std::to_string(expected));
}

void check_shapes(const Model& model, const Motion& motion) {
  if (model.matrix.cols() < 1 || model.matrix.rows() < model.matrix.cols())
    throw InputError(model.path, 0,
                     "a matrix of " + std::to_string(model.matrix.rows()) + " rows and " +
                         std::to_string(model.matrix.cols()) + " columns",
                     "at least one column and no fewer rows than columns");
  require_size(model, "pose parameters in motion '" + motion.name + "'", motion.pose.size(),
               model.pose.size());
  if (!motion.error.empty())
    require_size(model, "control errors in motion '" + motion.name + "'", motion.error.size(),
                 model.pose.size());
  if (!model.row_scale.empty())
    require_size(model, "row scales", model.row_scale.size(), model.matrix.rows());
}

/// True if the operation of this node is undefined for some values of its operands.
bool is_partial_operation(const Expression& e) {
  if (e.kind() == ExpressionKind::kPower) return e.exponent() < 0;
  if (e.kind() != ExpressionKind::kCall || e.is_total()) return false;
  switch (e.function()) {
    case Call::kSin:
    case Call::kCos:
    case Call::kAtan:
    case Call::kExp:
    case Call::kAbs:
      return false;
    default:
      return true;
  }
}

void collect_partial(const Expression& e, std::unordered_set<const void*>& seen,
                     Expressions& found) {
  if (e.is_total() || !seen.insert(e.identity()).second) return;
  for (const Expression& operand : e.operands()) collect_partial(operand, seen, found);
  if (is_partial_operation(e)) found.push_back(e);
}

/// Returns true if substitution has left a complex number, or an approximate one, which is what
/// GiNaC makes of the magnitude of a complex number.
bool has_inexact_number(const GiNaC::ex& e) {
  return std::any_of(e.preorder_begin(), e.preorder_end(), [](const GiNaC::ex& part) {
    return GiNaC::is_a<GiNaC::numeric>(part) && !GiNaC::ex_to<GiNaC::numeric>(part).is_rational();
  });
}

}  // namespace

Expressions partial_nodes(const Expression& e) {
  std::unordered_set<const void*> seen;
  Expressions found;
  collect_partial(e, seen, found);
  return found;
}

Substitution::Substitution(const Model& model, const Motion& motion, WorkMeter* meter)
    : meter_(meter) {
  check_shapes(model, motion);
  for (const PoseParameter& p : model.pose) reserved_.push_back(p.name);
  for (const GeometryParameter& g : model.geometry) reserved_.push_back(g.name);
  for (const MotionParameter& p : motion.parameters) {
    reserved_.push_back(p.name);
    add_variable({p.name, p.unit, VariableKind::kMotion, p.range, -1}, p.symbol);
  }
  add_geometry(model);
  add_pose(model, motion);
}

void Substitution::add_variable(Variable new_variable, const GiNaC::ex& symbol) {
  for (const Variable& known : variables_)
    if (known.name == new_variable.name)
      throw InputError::statement("", 0, "two variables have the name '" + known.name + "'",
                                  "rename one of them", known.name);
  symbols_.emplace(symbol, variable(new_variable.name));
  variables_.push_back(std::move(new_variable));
}

void Substitution::add_geometry(const Model& model) {
  for (const GeometryParameter& g : model.geometry) {
    const bool in_ball = g.ball >= 0;
    const GiNaC::ex spread =
        in_ball ? model.balls.at(static_cast<std::size_t>(g.ball)).radius : g.tolerance;
    if (spread.is_zero()) {
      replaced_[g.symbol] = g.value;
    } else {
      add_variable({g.name,
                    "1",
                    VariableKind::kGeometry,
                    {g.value - spread, g.value + spread},
                    in_ball ? g.ball : -1},
                   g.symbol);
    }
  }
  commanded_ = replaced_;
}

void Substitution::add_pose(const Model& model, const Motion& motion) {
  if (motion.waypoints)
    throw InputError::statement("", 0, "the motion '" + motion.name + "' is along way-points",
                                "regulus check, locate and margin take such a motion", motion.name);
  const GiNaC::exmap geometry = replaced_;
  for (std::size_t i = 0; i < model.pose.size(); ++i) {
    const PoseParameter& p = model.pose[i];
    const GiNaC::ex commanded = motion.pose[i].subs(geometry, GiNaC::subs_options::no_pattern);
    const GiNaC::ex error = motion.error.empty() ? GiNaC::ex(0) : motion.error[i];
    GiNaC::ex actual = commanded;
    if (!error.is_zero()) {
      const std::string name = unused_name(p.name + "_error");
      const GiNaC::realsymbol symbol(name);
      reserved_.push_back(name);
      add_variable({name, p.unit, VariableKind::kControl, {-error, error}, -1}, symbol);
      actual = commanded + symbol;
    }
    if (!commanded.is_equal(p.symbol)) commanded_[p.symbol] = commanded;
    if (!actual.is_equal(p.symbol)) replaced_[p.symbol] = actual;
  }
  GinacReader reader(symbols_, meter_);
  written_ = symbols_;
  for (const auto& [symbol, value] : replaced_)
    written_.insert_or_assign(symbol, reader.read(value));
}

std::string Substitution::unused_name(const std::string& wish) const {
  std::string name = wish;
  while (std::find(reserved_.begin(), reserved_.end(), name) != reserved_.end()) name += "_";
  return name;
}

std::vector<std::string> Substitution::names() const {
  std::vector<std::string> result;
  for (const Variable& v : variables_) result.push_back(v.name);
  return result;
}

Expression Substitution::apply(const GiNaC::ex& e) { return apply(e, replaced_); }

Expression Substitution::apply_commanded(const GiNaC::ex& e) { return apply(e, commanded_); }

Expression Substitution::apply(const GiNaC::ex& e, const GiNaC::exmap& replaced) {
  const auto undefined = [&e](const std::string& why) {
    std::ostringstream text;
    text << e;
    return InputError::statement(
        "", 0, "'" + text.str() + "' is undefined at every pose of the motion: " + why,
        "correct the expression or the motion");
  };
  GiNaC::ex value;
  try {
    value = e.subs(replaced, GiNaC::subs_options::no_pattern);
    return GinacReader(symbols_, meter_).read(value);
  } catch (const GiNaC::pole_error& error) {
    throw undefined(error.what());
  } catch (const InputError&) {
    if (has_inexact_number(value)) throw undefined("it has no real value there");
    throw;
  }
}

Expressions Substitution::partial_operations(const GiNaC::ex& e) {
  return partial_nodes(GinacReader(written_, meter_).read(e));
}

}  // namespace regulus::detail
