// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/box_forces.hpp"

namespace regulus::detail {

using cluster::ByteReader;
using cluster::ByteWriter;
using cluster::MalformedMessage;

BoxForces::BoxForces(const ForceQuestion& question)
    : test_(question.forces),
      matrices_(question.problem, question.scaling, question.problem.kernel->motion_variables) {}

void BoxForces::judge(std::span<const std::vector<Interval>> boxes, std::span<BoxOutcome> outcomes,
                      double) {
  matrices_.evaluate(boxes);
  for (std::size_t lane = 0; lane < boxes.size(); ++lane) outcomes[lane] = outcome(lane);
}

void BoxForces::put(ByteWriter& to, const BoxOutcome& outcome) {
  to.put(outcome.kind);
  to.put(outcome.is_hopeless);
  to.put(outcome.is_inhabited);
  to.put(outcome.is_undefined);
  to.put_list(std::span<const double>(outcome.impact));
  to.put(outcome.witness.has_value());
  if (!outcome.witness) return;
  const Shortage& shortage = outcome.witness->shortage;
  to.put_list(std::span<const Interval>(outcome.witness->variables));
  to.put_count(shortage.corner);
  to.put_list(std::span<const double>(shortage.direction));
  to.put(shortage.needed);
  to.put(shortage.possible);
}

BoxOutcome BoxForces::take(ByteReader& from, const ForceQuestion& question) {
  BoxOutcome outcome;
  outcome.kind = from.take<BoxOutcome::Kind>();
  if (outcome.kind > BoxOutcome::Kind::kUnknown) throw MalformedMessage();
  outcome.is_hopeless = from.take_flag();
  outcome.is_inhabited = from.take_flag();
  outcome.is_undefined = from.take_flag();
  outcome.impact = from.take_list<double>();
  const std::size_t parameters = question.problem.kernel->motion_variables;
  if (!outcome.impact.empty() && outcome.impact.size() != parameters) throw MalformedMessage();
  if (!from.take_flag()) return outcome;
  ForceWitness& witness = outcome.witness.emplace();
  witness.variables = from.take_list_of<Interval>(question.problem.outer.size());
  witness.shortage.corner = from.take_count();
  if (witness.shortage.corner >= question.forces.corners.size()) throw MalformedMessage();
  witness.shortage.direction = from.take_list_of<double>(question.forces.columns);
  witness.shortage.needed = from.take<Interval>();
  witness.shortage.possible = from.take<Interval>();
  return outcome;
}

BoxOutcome BoxForces::outcome(std::size_t lane) {
  BoxOutcome result;
  if (matrices_.is_outside(lane)) {
    result.kind = BoxOutcome::Kind::kOutside;
    return result;
  }
  result.is_inhabited = matrices_.is_inhabited(lane);
  const bool is_defined = matrices_.is_defined(lane);
  result.is_undefined = !is_defined;
  ForceDecision decision;
  if (is_defined) decision = test_.decide(matrices_.matrix(lane));
  using Kind = ForceDecision::Kind;
  if (decision.kind == Kind::kHeld) {
    result.kind = BoxOutcome::Kind::kHeld;
    return result;
  }
  look_at_center(lane, decision, result);
  if (decision.kind == Kind::kNotHeld) result.kind = BoxOutcome::Kind::kNotHeld;
  result.is_hopeless = is_defined && matrices_.has_slopes() && result.is_inhabited &&
                       decision.fails_at_center && !result.witness;
  result.impact = std::move(decision.impact);
  return result;
}

/// A box in which the load is not held has a witness only if one of its poses is certainly in the
/// variety.
void BoxForces::look_at_center(std::size_t lane, const ForceDecision& decision,
                               BoxOutcome& outcome) {
  if (!outcome.is_inhabited) return;
  const auto keep = [&](const ForceDecision& made) {
    if (made.shortage) outcome.witness.emplace(ForceWitness{matrices_.point(lane), *made.shortage});
  };
  keep(decision);
  if (!outcome.witness) keep(test_.decide({matrices_.matrix_at_point(lane), {}, {}}));
}

}  // namespace regulus::detail
