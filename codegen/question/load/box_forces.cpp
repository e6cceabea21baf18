// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/box_forces.hpp"

namespace regulus {

BoxForces::BoxForces(const ForceQuestion& question)
    : test_(question.forces),
      matrices_(question.problem, question.scaling, question.problem.kernel->motion_variables) {}

std::vector<BoxOutcome> BoxForces::decide(std::span<const std::vector<Interval>> boxes) {
  matrices_.evaluate(boxes);
  std::vector<BoxOutcome> outcomes;
  for (std::size_t lane = 0; lane < boxes.size(); ++lane) outcomes.push_back(outcome(lane));
  return outcomes;
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

}  // namespace regulus
