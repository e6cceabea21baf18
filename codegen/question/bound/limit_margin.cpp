// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/limit_margin.hpp"

#include <algorithm>

#include "codegen/answer/report/progress.hpp"
#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/question/bound/bound_run.hpp"
#include "codegen/question/bound/bracket_topic.hpp"
#include "codegen/support/stopwatch.hpp"

namespace regulus {
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
    double left = settings_.search.time_limit;
    Stopwatch watch;
    for (std::size_t i = 0; i < components.size() && !ends(); ++i) {
      bracket(i, left / double(components.size() - i));
      left -= watch.lap();
    }
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

  void bracket(std::size_t number, double seconds) {
    const Component& component = found_.quantity.components[number];
    ComponentMargin result{component, {}, {}, {}, {}};
    const ex& limit = settings_.limit;
    const std::string parameter = border_at_limit(request_, component, limit).parameter;
    SearchOptions search = settings_.search;
    search.time_limit = std::max(seconds, 1e-3);
    const MarginQuestion question = question_within_limit(question_, component, limit);
    std::unique_ptr<EarlierSearches> earlier;
    if (settings_.checkpoint != nullptr)
      earlier = settings_.checkpoint->searches_of(question, component.label, "0");
    if (search.workers != nullptr) {
      BracketTopic topic{number, 0, question.low.approx, {}};
      if (question.high) topic.high = question.high->approx;
      search.workers->turn_to(write_topic(topic));
    }
    PreparedMargin margin(question, request_, 0, search,
                          forming_watch(settings_.output, settings_.interrupt));
    margin.settings.interrupt = settings_.interrupt;
    MarginCertificates certificates(certificate_of(component), margin.request,
                                    margin.prepared.labels, settings_.held);
    MarginRun run(margin.prepared, question, margin.request, margin.search, settings_.output,
                  margin.settings, settings_.gap, certificates, listener_, earlier.get());
    result.margin = run.run();
    if (const auto& refuted = result.margin.refuted) {
      margin.request.replan(margin.prepared, refuted->value);
      result.exceeded = attained_place(margin.prepared, refuted->result, parameter);
      question_.high = refuted->value;
    }
    margin.prepared.seconds.search = result.margin.seconds;
    result.seconds = margin.prepared.seconds_spent();
    result.proofs = certificates.proofs();
    keep_lower(found_.whole.refuted, result.margin.refuted);
    found_.components.push_back(std::move(result));
  }

  [[nodiscard]] std::string certificate_of(const Component& component) const {
    return settings_.certificate.empty() ? ""
                                         : settings_.certificate + certificate_suffix(component);
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

  using ex = GiNaC::ex;

  const Request& request_;
  MarginQuestion question_;
  const LimitMarginSettings& settings_;
  const StepListener& listener_;
  LimitMargin found_;
};

}  // namespace

LimitMargin limit_margin(const Request& request, const MarginQuestion& question, Quantity quantity,
                         const LimitMarginSettings& settings, const StepListener& listener) {
  if (request.motion.trajectory)
    throw UsageError(
        "margin: a motion along way-points has no margin within a limit; give the "
        "motion a formula, or ranges");
  if (quantity.kind == QuantityKind::kCondition2)
    throw UsageError(
        "--norm 2: margin cannot use this condition number yet; compare with the limit at one size "
        "after another, by regulus bound --limit");
  if (question.quantity == MarginQuantity::kAlpha)
    throw UsageError("--alpha: a limit has no threshold; let a tolerance, --scale or --grow grow");
  if (question.quantity == MarginQuantity::kTube)
    throw UsageError(
        "--tube: a limit has no growing control error; let a tolerance, --scale or "
        "--grow grow");
  return LimitMarginRun(request, question, std::move(quantity), settings, listener).run();
}

}  // namespace regulus
