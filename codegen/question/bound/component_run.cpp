// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/component_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "codegen/model/exact/ginac_text.hpp"
#include "codegen/question/bound/bound_certificate.hpp"
#include "codegen/question/bound/bracket_question.hpp"
#include "codegen/question/bound/reference.hpp"
#include "codegen/question/quantity/negligible.hpp"

namespace regulus::detail {
namespace {

constexpr int kMostRefinements = 3;
/// No gap is smaller where values count as 0: so few digits more can doubles prove of 0.
constexpr double kLeastGap = 0x1p-10;
constexpr const char* kNoTime = "no search was likely to end within the time left";

}  // namespace

ComponentRun::ComponentRun(const Request& request, const Component& component,
                           const BoundSettings& settings, const TimeBudget& budget)
    : request_(request), settings_(settings), budget_(budget) {
  result_.component = component;
}

ComponentBound ComponentRun::bracket() {
  MarginQuestion question = choose_question();
  if (is_zero_everywhere()) {
    set_zero(result_);
    return std::move(result_);
  }
  Ends ends;
  double gap = settings_.gap;
  for (int round = 0; round <= kMostRefinements; ++round) {
    ends = close(question, gap);
    set_ends(ends);
    // A proof of any bound shows that everything is defined at every pose.
    if (result_.proved && is_zero_where_defined()) {
      set_zero(result_);
      break;
    }
    const std::optional<double> width = relative_gap(&result_, &result_);
    result_.is_closed =
        (width && *width <= settings_.gap) || is_negligible() || result_.attains_zero();
    if (result_.is_closed || !width || !ends.is_closed) break;
    // The gap of 1/r is relative to q − y, that of the bracket to q.
    gap *= 0.8 * settings_.gap / *width;
    question.low = *ends.certified;
    question.high = ends.refuted;
  }
  const bool has_ended = result_.is_closed || result_.is_unbounded || ends.is_closed;
  result_.reason = is_interrupted()                             ? "the run was interrupted"
                   : has_ended                                  ? ""
                   : ends.obstacle.empty() || budget_.is_over() ? kNoTime
                                                                : ends.obstacle;
  finish();
  if (!result_.proved) result_.proofs.set_no_safe("no bound was proved");
  if (!result_.attained && is_negligible()) result_.proofs.set_no_singular(kNothingAtZero);
  return std::move(result_);
}

ComponentBound ComponentRun::compare() {
  bordered_ = border_at_limit(request_, component(), *settings_.limit);
  MarginQuestion question = question_at_limit(bordered_);
  question.certified = [this](const Request& grown) { return certified(grown, bordered_); };
  const Result result = search_at(question, *question.high).result;
  result_.is_empty = result.occupancy == Occupancy::kEmpty;
  EndProofs& proofs = result_.proofs;
  const std::string limit = formula_text(*settings_.limit);
  switch (result.verdict) {
    case Verdict::kNoSingularity:
      result_.verdict = LimitVerdict::kWithin;
      if (!proofs.safe().file.empty()) proofs.set_safe("within " + limit);
      break;
    case Verdict::kSingularity:
      result_.verdict = LimitVerdict::kExceeded;
      if (!proofs.singular().file.empty()) proofs.set_singular("exceeds " + limit);
      break;
    case Verdict::kPossibleProblem:
      proofs.set_no_safe(kNothingClaimed);
      proofs.set_no_singular(kNothingClaimed);
  }
  return std::move(result_);
}

MarginQuestion ComponentRun::choose_question() {
  bordered_ = border(request_, component());
  std::optional<double> sampled;
  if (!bordered_.parameter.empty()) {
    const Reference reference = choose_reference(component(), samples(), least_that_counts());
    sampled = reference.sampled;
    reference_ = reference.approx;
    if (reference_ != 0) bordered_ = border(request_, component(), reference.value());
  }
  MarginQuestion question = question_beyond(bordered_, sampled);
  question.certified = [this](const Request& grown) { return certified(grown, bordered_); };
  return question;
}

/// There is no certificate of a bound of 0.
bool ComponentRun::is_zero_where_defined() const {
  return !are_proofs_wanted() && detail::is_zero_where_defined(bordered_, component());
}

double ComponentRun::least_that_counts() const {
  return std::max(settings_.gap, kLeastGap) * negligible(request_.model, component());
}

/// Both ends are nearly 0, beside what causes the quantity or beside its reference. That a magnitude
/// attains 0 says nothing.
bool ComponentRun::is_negligible() const {
  const double most =
      std::max(least_that_counts(), settings_.gap * kNegligiblePart * std::fabs(reference_));
  if (!result_.proved || result_.is_unbounded) return false;
  if (!result_.attained && !component().is_absolute) return false;
  const double attained = result_.attained ? result_.attained->approx : 0;
  return std::fabs(result_.proved->approx) <= most && std::fabs(attained) <= most;
}

/// Nothing can be undefined.
bool ComponentRun::is_zero_everywhere() const {
  return is_zero_where_defined() && bordered_.request.motion.must_be_defined.empty() &&
         bordered_.request.model.must_be_defined.empty();
}

void ComponentRun::set_ends(const Ends& ends) {
  result_.is_empty = ends.is_empty;
  const auto is_zero = [this](const MarginValue& value) {
    return bordered_.is_reciprocal && value.exact.is_zero();
  };
  if (ends.certified && !is_zero(*ends.certified)) {
    const BoundEnd end = end_at(bound_at(bordered_, component(), *ends.certified));
    if (std::isfinite(end.approx)) result_.proved = end;
  }
  if (!ends.refuted) return;
  result_.place = ends.place;
  result_.is_unbounded = is_zero(*ends.refuted);
  if (!result_.is_unbounded)
    result_.attained = end_at(bound_at(bordered_, component(), *ends.refuted));
}

SearchTopic ComponentRun::topic_of(const MarginQuestion& question) const {
  SearchTopic topic{settings_.part, component().label, reference_, question.low.approx};
  if (question.high) topic.high = question.high->approx;
  return topic;
}

EndProofs ComponentRun::proofs(const char* no_safe, const char* no_singular) const {
  const std::string path =
      are_proofs_wanted() ? settings_.certificate + certificate_suffix(component()) : "";
  return EndProofs(path, settings_.placing, no_safe, no_singular);
}

CertifiedMotion ComponentRun::certified(const Request& grown, Bordered bordered) const {
  const Motion& motion = grown.motion;
  const GiNaC::ex end =
      bordered.parameter.empty() ? motion.alpha : motion.parameters.back().range.hi;
  return {request_, [this, end, bordered = std::move(bordered)](
                        const Request& about, const std::set<std::string>& uncertain) {
            return certified_bound(about, component(), bordered, end, uncertain);
          }};
}

}  // namespace regulus::detail
