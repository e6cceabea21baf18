// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/variety_bound.hpp"

#include "codegen/answer/report/number_text.hpp"
#include "codegen/answer/report/progress.hpp"
#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/question/bound/component_run.hpp"
#include "codegen/question/bound/fastest_twist.hpp"
#include "codegen/question/margin/variety_attempts.hpp"
#include "codegen/question/quantity/approx_values.hpp"

namespace regulus::detail {
namespace {

constexpr int kPlaces = 8;  ///< where the quantity is evaluated beforehand

class VarietyBound final : public ComponentRun {
 public:
  VarietyBound(const Request& request, const Component& component, const BoundSettings& settings,
               const TimeBudget& budget)
      : ComponentRun(request, component, settings, budget),
        proofs_(proofs(kNoSafeProof, kNoSingularProof)) {}

 private:
  std::vector<double> samples() override { return approx_values(bordered_, kPlaces); }

  Ends close(const MarginQuestion& question, double gap) override {
    PreparedMargin margin = prepared(question);
    VarietyAttempts attempts(margin, question, settings_.output, proofs_);
    std::unique_ptr<EarlierSearches> earlier;
    if (settings_.checkpoint != nullptr)
      earlier = settings_.checkpoint->searches_of(question, settings_.part + component().label,
                                                  formula_text(bordered_.reference));
    const Margin found = close_bracket(attempts, question,
                                       {.limits = limits_of(margin.settings, gap),
                                        .interrupt = settings_.interrupt,
                                        .earlier = earlier.get()});
    margin.prepared.seconds.search = found.seconds;
    add(margin.prepared, found.boxes);
    result_.proofs = proofs_ = attempts.proofs();
    Ends ends{.is_closed = found.closed && found.certified && found.refuted,
              .is_empty = found.empty.has_value(),
              .obstacle = obstacle_of(found)};
    if (found.certified) ends.certified = found.certified->value;
    if (!found.refuted) return ends;
    ends.refuted = found.refuted->value;
    ends.place = place_of(margin, *found.refuted);
    // The robot is singular there under every load.
    if (bordered_.is_reciprocal && ends.refuted->exact.is_zero()) ends.place->values.clear();
    return ends;
  }

  MarginStep search_at(const MarginQuestion& question, const MarginValue& value) override {
    PreparedMargin margin = prepared(question);
    VarietyAttempts attempts(margin, question, settings_.output,
                             proofs("the limit is exceeded", "no pose exceeds the limit"));
    MarginStep step =
        attempts.at(value, {value.approx, margin.settings.max_boxes, margin.settings.time_limit});
    margin.prepared.seconds.search = step.result.statistics.seconds;
    add(margin.prepared, step.result.statistics.boxes);
    result_.proofs = attempts.proofs();
    if (step.result.verdict == Verdict::kSingularity) result_.place = place_of(margin, step);
    if (step.result.verdict == Verdict::kPossibleProblem)
      result_.reason = describe(step.result.reason);
    return step;
  }

  /// Forms the matrix in all of the time that is left: the component's part is for the search.
  [[nodiscard]] PreparedMargin prepared(const MarginQuestion& question) {
    SearchOptions forming = settings_.search;
    turn_to(forming.workers, topic_of(question), request_.motion);
    forming.time_limit = TimeBudget::option(budget_.all());
    PreparedMargin margin(question, bordered_.request, 0, forming,
                          forming_watch(settings_.output, settings_.interrupt));
    budget_.grant_least();
    margin.settings.interrupt = settings_.interrupt;
    margin.settings.time_limit = margin.prepared.stopped ? 0 : budget_.left();
    return margin;
  }

  [[nodiscard]] AttainedPlace place_of(PreparedMargin& margin, const MarginStep& step) const {
    margin.request.replan(margin.prepared, step.value);
    AttainedPlace place = attained_place(margin.prepared, step.result, bordered_.parameter);
    if (component().kind == QuantityKind::kSpeed) add_fastest_twist(place, request_, component());
    return place;
  }

  void add(const PreparedSearch& p, std::uint64_t boxes) {
    result_.boxes += boxes;
    result_.seconds += p.seconds_spent();
  }

  EndProofs proofs_;  ///< of the bracket
};

}  // namespace

ComponentBound bound_over_variety(const Request& request, const Component& component,
                                  const BoundSettings& settings, const TimeBudget& budget) {
  VarietyBound run(request, component, settings, budget);
  return settings.limit ? run.compare() : run.bracket();
}

}  // namespace regulus::detail
