// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/regularity_judge.hpp"

namespace regulus::detail {
namespace {

/// Any number may come in a message.
std::uint32_t depth_of(double number) noexcept {
  return number >= 0 && number < 0x1p32 ? std::uint32_t(number) : 0;
}

/// What a decision of another kind has left must not differ between two answers.
PathStep step_of(const Decision& decision) {
  if (decision.kind == Decision::Kind::kSplit)
    return {PathStep::Kind::kSplit, Rule::kBlocked, decision.variable};
  if (decision.rule == Rule::kBlocked) return {};
  return {PathStep::Kind::kCertified, decision.rule, 0};
}

}  // namespace

RegularityJudge::RegularityJudge(const RegularityQuestion& question)
    : structure_(find_row_structure(question.problem, question.settings)),
      decider_(question.problem, question.settings, structure_),
      decisions_(*question.problem.kernel, decider_.order()) {}

void RegularityJudge::judge(std::span<const std::vector<Interval>> boxes,
                            std::span<RegularityFinding> findings, double threshold) {
  decisions_.clear();
  decisions_.budget.threshold = AdaptiveThreshold(threshold);
  for (const std::vector<Interval>& box : boxes)
    decisions_.add({0, depth_of(box.back().lo), std::span(box).first(box.size() - 1)});
  decider_.decide(decisions_, false);
  for (std::size_t lane = 0; lane < boxes.size(); ++lane)
    findings[lane] = {true, step_of(decisions_.decision[lane])};
  const TestBudget& budget = decisions_.budget;
  findings[0].trials.assign(budget.trial, budget.trial + budget.trials);
}

void RegularityJudge::put(cluster::ByteWriter& to, const RegularityFinding& finding) {
  to.put(finding.step.kind);
  to.put(finding.step.rule);
  to.put_count(finding.step.variable);
  to.put_each(finding.trials, [&to](const TrialOutcome& trial) {
    to.put(trial.distance);
    to.put(trial.certified);
  });
}

RegularityFinding RegularityJudge::take(cluster::ByteReader& from,
                                        const RegularityQuestion& question) {
  RegularityFinding finding{true};
  PathStep& step = finding.step;
  step.kind = from.take<PathStep::Kind>();
  step.rule = from.take<Rule>();
  step.variable = from.take_count();
  from.take_each([&] {
    const auto distance = from.take<double>();
    finding.trials.push_back({distance, from.take_flag()});
  });
  // A witness is of an exhaustive search, and a motion along way-points has no filters.
  const bool is_claim = step.rule != Rule::kWitness && step.rule != Rule::kFilter;
  const bool is_certified = step.kind == PathStep::Kind::kCertified;
  if (step.kind > PathStep::Kind::kLost || !is_claim || step.rule > Rule::kBlocked ||
      is_certified == (step.rule == Rule::kBlocked) ||
      step.variable >= question.problem.kernel->motion_variables || finding.trials.size() > kLanes)
    throw cluster::MalformedMessage();
  return finding;
}

}  // namespace regulus::detail
