// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/branch_margin.hpp"

#include <utility>

#include "codegen/question/bound/bound_run.hpp"
#include "codegen/question/closure/branch_bound.hpp"
#include "codegen/question/margin/attempts.hpp"
#include "codegen/question/margin/margin_certificates.hpp"
#include "codegen/question/margin/prepared_margin.hpp"
#include "codegen/question/way/path_attempts.hpp"
#include "codegen/support/stopwatch.hpp"

namespace regulus::detail {
namespace {

/// At a value that is not safe the component exceeds the limit, or the branch ends.
class LimitAttempts final : public Attempts {
 public:
  LimitAttempts(const MarginRequest& request, const Component& component,
                const BoundSettings& settings, EndProofs proofs)
      : request_(request), component_(component), settings_(settings), proofs_(std::move(proofs)) {}

  [[nodiscard]] MarginStep at(const MarginValue& value, const PlannedAttempt& planned) override {
    BoundSettings settings = settings_;
    if (planned.boxes < kAnyBoxes) settings.search.max_boxes = planned.boxes;
    const TimeBudget budget(planned.seconds);
    Stopwatch watch;
    const ComponentBound found =
        BranchBounds(value.approx).bound(request_.at(value), component_, settings, budget);
    seconds_ += found.seconds;
    MarginStep step{value, {}, ""};
    step.result.statistics.boxes = found.boxes;
    step.result.statistics.seconds = watch.lap();
    if (found.is_empty) step.result.occupancy = Occupancy::kEmpty;
    switch (found.verdict) {
      case LimitVerdict::kWithin:
        step.result.verdict = Verdict::kNoSingularity;
        step.result.reason = Reason::kAllBoxesCertified;
        keep(found.proofs.safe(), true, value);
        break;
      case LimitVerdict::kExceeded:
        step.result.verdict = Verdict::kSingularity;
        step.result.reason = Reason::kLostRank;
        exceeded_ = found.place;
        keep(found.proofs.singular(), false, value);
        break;
      case LimitVerdict::kUndecided:
        step.result.reason = budget.is_over() ? Reason::kTimeBudget : Reason::kWidth;
        if (budget.is_over()) step.result.stopped_by = Reason::kTimeBudget;
    }
    return step;
  }

  [[nodiscard]] const std::optional<AttainedPlace>& exceeded() const { return exceeded_; }
  [[nodiscard]] const StageSeconds& seconds() const { return seconds_; }
  [[nodiscard]] const EndProofs& proofs() const { return proofs_; }

 private:
  void keep(const EndProof& written, bool is_safe, const MarginValue& value) {
    if (!proofs_.are_wanted()) return;
    if (written.file.empty())
      return is_safe ? proofs_.set_no_safe(written.words) : proofs_.set_no_singular(written.words);
    is_safe ? proofs_.set_safe("within at " + value.text)
            : proofs_.set_singular("exceeded at " + value.text);
  }

  const MarginRequest& request_;
  const Component& component_;
  const BoundSettings& settings_;
  EndProofs proofs_;
  std::optional<AttainedPlace> exceeded_;
  StageSeconds seconds_;
};

}  // namespace

ComponentMargin margin_over_branch(const Request& request, const Component& component,
                                   const MarginQuestion& question,
                                   const LimitMarginSettings& settings,
                                   const BracketSettings& bracket, const TimeBudget& budget) {
  BoundSettings bound;
  bound.limit = settings.limit;
  bound.search = settings.search;
  bound.search.time_limit = TimeBudget::option(budget.left());
  bound.output = settings.output;
  bound.certificate = settings.certificate;
  bound.placing = settings.placing;
  bound.interrupt = settings.interrupt;
  const MarginRequest growing(request, question);
  const std::string& path = settings.certificate;
  LimitAttempts attempts(
      growing, component, bound,
      margin_proofs(path.empty() ? path : path + certificate_suffix(component), settings.placing));
  BracketSettings limits = bracket;
  limits.limits = limits_of(bound.search, settings.gap);
  ComponentMargin result{component, close_bracket(attempts, question, limits), {}, {}, {}};
  if (result.margin.refuted) result.exceeded = attempts.exceeded();
  result.seconds = attempts.seconds();
  result.proofs = attempts.proofs();
  return result;
}

}  // namespace regulus::detail
