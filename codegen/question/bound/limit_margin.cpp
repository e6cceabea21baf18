// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/limit_margin.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "codegen/answer/report/progress.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/way/trajectory.hpp"
#include "codegen/question/bound/bound_question.hpp"
#include "codegen/question/bound/bound_run.hpp"
#include "codegen/question/bound/bracket_question.hpp"
#include "codegen/question/bound/quantity_report.hpp"
#include "codegen/question/bound/way_place.hpp"
#include "codegen/question/margin/variety_attempts.hpp"
#include "codegen/question/way/path_attempts.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/time_budget.hpp"

namespace regulus::detail {
namespace {

bool is_below(const MarginValue& a, const MarginValue& b) {
  const CertainSign sign = certain_sign(b.exact - a.exact);
  return sign == CertainSign::kUnknown ? a.approx < b.approx : sign == CertainSign::kPositive;
}

void keep_lower(std::optional<MarginStep>& kept, const std::optional<MarginStep>& other) {
  if (other && (!kept || is_below(other->value, kept->value))) kept = other;
}

/// Brackets the components, each below the values at which an earlier one exceeds the limit.
class LimitMarginRun {
 public:
  LimitMarginRun(const Request& request, const MarginQuestion& question, Quantity quantity,
                 const LimitMarginSettings& settings, const StepListener& listener)
      : request_(request), question_(question), settings_(settings), listener_(listener) {
    found_.quantity = std::move(quantity);
    question_.limit = describe_limit(found_.quantity, settings.limit);
  }

  LimitMargin run() {
    const std::vector<Component>& components = found_.quantity.components;
    const TimeBudget all = TimeBudget::of_option(settings_.search.time_limit);
    for (std::size_t i = 0; i < components.size() && !ends(); ++i)
      found_.components.push_back(bracket(components[i], all.share(components.size() - i)));
    join(components.size());
    return std::move(found_);
  }

 private:
  /// True if the low end is refuted, or the run was interrupted.
  [[nodiscard]] bool ends() const {
    const auto& refuted = found_.whole.refuted;
    return (refuted && !is_below(question_.low, refuted->value)) ||
           (settings_.interrupt != nullptr && *settings_.interrupt);
  }

  ComponentMargin bracket(const Component& component, const TimeBudget& budget) {
    const bool has_branch = request_.model.closure.has_value();
    const MarginQuestion question =
        has_branch ? question_ : question_within_limit(question_, component, settings_.limit);
    std::unique_ptr<EarlierSearches> earlier;
    if (settings_.checkpoint != nullptr)
      earlier = settings_.checkpoint->searches_of(question, component.label, "0");
    const BracketSettings bracket{{}, settings_.interrupt, listener_, earlier.get()};
    ComponentMargin result =
        has_branch
            ? settings_.over_branch(request_, component, question, settings_, bracket, budget)
        : request_.motion.trajectory ? bracket_way(component, question, bracket, budget)
                                     : bracket_variety(component, question, bracket, budget);
    if (result.margin.refuted) question_.high = result.margin.refuted->value;
    keep_lower(found_.whole.refuted, result.margin.refuted);
    return result;
  }

  ComponentMargin bracket_variety(const Component& component, const MarginQuestion& question,
                                  BracketSettings bracket, const TimeBudget& budget) {
    SearchOptions search = settings_.search;
    search.time_limit = TimeBudget::option(budget.left());
    turn_to(search.workers, topic_of(component, question), request_.motion);
    PreparedMargin margin(question, request_, 0, search,
                          forming_watch(settings_.output, settings_.interrupt));
    margin.settings.interrupt = settings_.interrupt;
    VarietyAttempts attempts(margin, question, settings_.output, proofs_of(component));
    bracket.limits = limits_of(margin.settings, settings_.gap);
    ComponentMargin result{component, close_bracket(attempts, question, bracket), {}, {}, {}};
    if (const auto& refuted = result.margin.refuted) {
      margin.request.replan(margin.prepared, refuted->value);
      result.exceeded = attained_place(margin.prepared, refuted->result, parameter_of(component));
    }
    margin.prepared.seconds.search = result.margin.seconds;
    result.seconds = margin.prepared.seconds_spent();
    result.proofs = attempts.proofs();
    return result;
  }

  ComponentMargin bracket_way(const Component& component, const MarginQuestion& question,
                              BracketSettings bracket, const TimeBudget& budget) {
    SearchOptions search = settings_.search;
    search.time_limit = TimeBudget::option(budget.left());
    const MarginRequest request(request_, question);
    PathAttempts attempts(request, search, settings_.output, settings_.interrupt,
                          proofs_of(component), topic_of(component, question));
    bracket.limits = limits_of(search, settings_.gap);
    ComponentMargin result{component, close_bracket(attempts, question, bracket), {}, {}, {}};
    if (const std::optional<TrajectoryCheck> refuted = attempts.take_refuted()) {
      const DecidingPiece& piece = *refuted->deciding;
      result.exceeded = place_on_way(*request_.motion.trajectory, piece.index, *piece.preparation,
                                     piece.result, parameter_of(component));
    }
    result.seconds = attempts.seconds();
    result.proofs = attempts.proofs();
    return result;
  }

  [[nodiscard]] static SearchTopic topic_of(const Component& component,
                                            const MarginQuestion& question) {
    SearchTopic topic{"", component.label, 0, question.low.approx};
    if (question.high) topic.high = question.high->approx;
    return topic;
  }

  /// Returns the name of r.
  [[nodiscard]] std::string parameter_of(const Component& component) const {
    return border_at_limit(request_, component, settings_.limit).parameter;
  }

  [[nodiscard]] EndProofs proofs_of(const Component& component) const {
    const std::string& path = settings_.certificate;
    return margin_proofs(path.empty() ? path : path + certificate_suffix(component),
                         settings_.placing);
  }

  /// Joins the brackets: what is certified holds for every component.
  void join(std::size_t components) {
    Margin& whole = found_.whole;
    bool all = found_.components.size() == components;
    for (const ComponentMargin& c : found_.components) {
      all = all && c.margin.certified.has_value();
      keep_lower(whole.certified, c.margin.certified);
      keep_lower(whole.empty, c.margin.empty);
      whole.boxes += c.margin.boxes;
      whole.seconds += c.margin.seconds;
      whole.interrupted = whole.interrupted || c.margin.interrupted;
    }
    if (!all) whole.certified.reset();
    if (!whole.certified) return;
    if (whole.refuted) {
      const double high = whole.refuted->value.approx;
      whole.gap = (high - whole.certified->value.approx) / high;
    }
    whole.closed = whole.gap ? *whole.gap <= settings_.gap
                             : std::ranges::all_of(found_.components, [](const ComponentMargin& c) {
                                 return c.margin.closed;
                               });
  }

  const Request& request_;
  MarginQuestion question_;
  const LimitMarginSettings& settings_;
  const StepListener& listener_;
  LimitMargin found_;
};

/// Forces, speeds and errors to first order are those at a pose. Errors of the pose itself are none of a
/// platform on legs.
void require_errors_that_count(const Request& request, const MarginQuestion& question) {
  if (!request.model.closure) {
    if (request.motion.trajectory) return;
    throw UsageError(
        "--tube: a limit has no growing control error; let a tolerance, --scale or "
        "--grow grow");
  }
  const std::size_t legs = request.model.legs.size();
  if (legs == 0) return;
  const std::vector<GiNaC::ex> errors = grown(request, question, decimal_value(1)).motion.error;
  const auto is_zero = [](const GiNaC::ex& e) { return e.is_zero(); };
  if (!std::all_of(errors.begin(), errors.end() - std::ptrdiff_t(legs), is_zero))
    throw UsageError(fmt::format(
        "--tube: finite errors of a platform are those of its legs; name leg_1 to leg_{}", legs));
}

}  // namespace

LimitMargin limit_margin(const Request& request, const MarginQuestion& question, Quantity quantity,
                         const LimitMarginSettings& settings, const StepListener& listener) {
  if (quantity.kind == QuantityKind::kCondition2 && !request.model.closure)
    throw UsageError(
        "--norm 2: margin cannot use this condition number yet; compare with the limit at one size "
        "after another, by regulus bound --limit");
  if (question.quantity == MarginQuantity::kAlpha)
    throw UsageError("--alpha: a limit has no threshold; let a tolerance, --scale or --grow grow");
  if (question.quantity == MarginQuantity::kTube) require_errors_that_count(request, question);
  require_errors_in_ranges(
      grown(request, question, question.high ? *question.high : decimal_value(1)), quantity);
  return LimitMarginRun(request, question, std::move(quantity), settings, listener).run();
}

}  // namespace regulus::detail
