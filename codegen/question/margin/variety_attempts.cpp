// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/margin/variety_attempts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/report.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus::detail {
namespace {

/// Part of the time that a search for the witness may take before the first search. It takes tenths
/// of a second.
constexpr double kFirstShare = 0.5;
constexpr int kFirstStarts = 64;
constexpr int kMoreStarts = 192;
constexpr int kStartsEach = 8;  ///< while the upper end is not known
constexpr int kDoublings = 20;

/// A witness is certified at a value slightly above the value where the determinant vanishes.
constexpr std::array<double, 4> kAbove{0, 1e-5, 1e-4, 1e-3};

}  // namespace

VarietyAttempts::VarietyAttempts(PreparedMargin& margin, const MarginQuestion& question,
                                 const OutputOptions& output, EndProofs proofs)
    : margin_(margin),
      question_(question),
      output_(output),
      certificates_(std::move(proofs), margin.request, margin.prepared.labels) {}

Problem VarietyAttempts::problem_at(const MarginValue& value) {
  margin_.request.replan(margin_.prepared, value);
  return margin_.prepared.problem();
}

double VarietyAttempts::end() const { return question_.high ? question_.high->approx : kInfinity; }

MarginStep VarietyAttempts::at(const MarginValue& value, const PlannedAttempt& planned) {
  margin_.request.replan(margin_.prepared, value);
  Settings settings = margin_.settings;
  settings.time_limit = planned.seconds;
  settings.max_boxes = planned.boxes;
  SearchDisplay display(output_);
  std::vector<Observer*> watching;
  for (Observer* observer : {certificates_.watch(value), display.observer()})
    if (observer != nullptr) watching.push_back(observer);
  Observers observers(std::move(watching));
  const Result result = run_search(margin_.prepared, margin_.search, settings, &observers);
  certificates_.finish(value, result);
  return {value, result, claim(margin_.prepared, result)};
}

std::vector<MarginStep> VarietyAttempts::beforehand(double seconds) {
  std::vector<MarginStep> found;
  const ReportLabels& labels = margin_.prepared.labels;
  if (labels.rows != labels.columns) return found;
  if (question_.high || question_.quantity == MarginQuantity::kAlpha) {
    look_up_to(question_.high, seconds, found);
    return found;
  }
  for (double high = std::max(1.0, 2 * question_.low.approx);
       !(witness_ && witness_->found()) && high < std::ldexp(1.0, kDoublings); high *= 2)
    look_up_to(decimal_value(high), seconds / kDoublings, found);
  return found;
}

/// Looks for a witness in the set of `high` (without `high`, below any threshold), and for the
/// least value that has one.
void VarietyAttempts::look_up_to(const std::optional<MarginValue>& high, double seconds,
                                 std::vector<MarginStep>& found) {
  const bool threshold = question_.quantity == MarginQuantity::kAlpha;
  const Problem narrowest = problem_at(question_.low);
  widest_ = problem_at(high.value_or(decimal_value(1)));
  Growth growth =
      Growth::between(question_.low.approx, narrowest, high ? high->approx : kInfinity, widest_);
  witness_ =
      std::make_unique<LeastWitness>(widest_, margin_.settings, std::move(growth), threshold);
  const double part = kFirstShare * seconds;
  look_everywhere(part, question_.high || threshold ? kFirstStarts : kStartsEach, found);
  if (!question_.high && witness_->found()) look_everywhere(part, kFirstStarts, found);
}

std::vector<MarginStep> VarietyAttempts::everywhere(double seconds, Refuted refuted) {
  std::vector<MarginStep> found;
  refuted_ = refuted;
  look_everywhere(seconds, kMoreStarts, found);
  return found;
}

void VarietyAttempts::look_everywhere(double seconds, int starts, std::vector<MarginStep>& found) {
  witness_->search(seconds, starts, margin_.settings.interrupt);
  refute_at_found(found);
}

std::vector<MarginStep> VarietyAttempts::near(const Result& ended, Refuted refuted) {
  std::vector<MarginStep> found;
  refuted_ = refuted;
  if (ended.witness) look_near(ended.witness->points[0].variables, found);
  if (ended.blocking_box.size() == widest_.outer.size()) look_near(ended.blocking_box, found);
  return found;
}

void VarietyAttempts::look_near(std::span<const Interval> box, std::vector<MarginStep>& found) {
  witness_->search_from(box);
  refute_at_found(found);
}

/// Certifies the result of the search for a witness, at a decimal slightly above it.
void VarietyAttempts::refute_at_found(std::vector<MarginStep>& found) {
  if (!witness_->found()) return;
  const double least = witness_->found()->value, low = question_.low.approx;
  for (const double above : kAbove) {
    const double wanted = short_decimal_above(least * (1 + above));
    const MarginValue value =
        value_at(question_, least <= low ? low : std::clamp(wanted, low, end()));
    if (refuted_ && value.approx >= *refuted_) return;
    margin_.request.replan(margin_.prepared, value);
    const Result result = prove_between(margin_.prepared, margin_.search, margin_.settings,
                                        witness_->points_at(value.approx));
    if (result.verdict != Verdict::kSingularity) continue;
    certificates_.finish(value, result);
    refuted_ = value.approx;
    found.push_back({value, result, claim(margin_.prepared, result)});
    return;
  }
}

Bracket::Limits limits_of(const Settings& settings, double gap) {
  return {gap, settings.time_limit, settings.max_boxes};
}

}  // namespace regulus::detail
