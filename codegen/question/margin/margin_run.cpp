// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/margin/margin_run.hpp"

#include <algorithm>
#include <array>

#include "codegen/answer/report/progress.hpp"
#include "codegen/answer/report/report.hpp"
#include "codegen/question/engine/search_run.hpp"
#include "runtime/problem/observers.hpp"

namespace regulus {
namespace {

/// Part of the time left that a search for the witness may take, before the first search and again
/// when no search is useful. It takes tenths of a second.
constexpr double kWitnessShare = 0.5;
constexpr int kFirstStarts = 64;
constexpr int kMoreStarts = 192;
constexpr int kStartsEach = 8;  ///< while the upper end is not known
constexpr int kDoublings = 20;

/// A witness is certified at a value slightly above the value where the determinant vanishes.
constexpr std::array<double, 4> kAbove{0, 1e-5, 1e-4, 1e-3};

double end_of(const MarginQuestion& question) {
  return question.high ? question.high->approx : kInfinity;
}

}  // namespace

MarginRun::MarginRun(PreparedSearch& preparation, const MarginQuestion& question,
                     const MarginRequest& request, const SearchOptions& search,
                     const OutputOptions& output, const Settings& settings, double gap,
                     MarginCertificates& certificates, Listener listener, EarlierSearches* earlier)
    : preparation_(preparation),
      question_(question),
      request_(request),
      search_(search),
      output_(output),
      settings_(settings),
      certificates_(certificates),
      listener_(std::move(listener)),
      earlier_(earlier),
      bracket_(question.low.approx, end_of(question),
               {gap, settings.time_limit, settings.max_boxes}) {}

bool MarginRun::interrupted() const noexcept {
  return settings_.interrupt != nullptr && *settings_.interrupt;
}

Problem MarginRun::problem_at(const MarginValue& value) {
  request_.replan(preparation_, value);
  return preparation_.problem();
}

/// Looks at both ends first, because a witness makes some searches unnecessary.
Margin MarginRun::run() {
  const double limit = settings_.time_limit;
  if (preparation_.labels.rows == preparation_.labels.columns) {
    if (question_.high)
      look_below(question_.high, limit);
    else if (question_.quantity == MarginQuantity::kAlpha)
      look_below(std::nullopt, limit);
    else
      for (double high = std::max(1.0, 2 * question_.low.approx);
           !(witness_ && witness_->found()) && high < std::ldexp(1.0, kDoublings); high *= 2)
        look_below(decimal_value(high), limit / kDoublings);
  }
  close_in();
  if (witness_ && !bracket_.closed() && !interrupted()) {
    look_for_witness(kWitnessShare * std::max(bracket_.seconds_left(), 0.0), kMoreStarts);
    close_in();
    close_in_from_above();
  }
  prove_remembered();
  if (margin_.certified) margin_.gap = bracket_.gap();
  margin_.closed = bracket_.closed() && (margin_.certified || !bracket_.certified());
  margin_.interrupted = interrupted();
  return std::move(margin_);
}

/// Looks for a witness in the set of `high` (without `high`, below any threshold), and for the
/// least value that has one.
void MarginRun::look_below(const std::optional<MarginValue>& high, double limit) {
  const bool threshold = question_.quantity == MarginQuantity::kAlpha;
  const Problem narrowest = problem_at(question_.low);
  widest_ = problem_at(high.value_or(decimal_value(1)));
  const double end = high ? high->approx : kInfinity;
  Growth growth = Growth::between(question_.low.approx, narrowest, end, widest_);
  witness_ = std::make_unique<LeastWitness>(widest_, settings_, std::move(growth), threshold);
  const double seconds = kWitnessShare * limit;
  look_for_witness(seconds, question_.high || threshold ? kFirstStarts : kStartsEach);
  if (!question_.high && witness_->found()) look_for_witness(seconds, kFirstStarts);
}

void MarginRun::look_for_witness(double seconds, int starts) {
  Stopwatch watch;
  witness_->search(seconds, starts, settings_.interrupt);
  refute_at_found();
  const double spent = watch.lap();
  bracket_.spend(spent);
  margin_.seconds += spent;
}

MarginValue MarginRun::value_of(double approx) const {
  if (approx == question_.low.approx) return question_.low;
  if (question_.high && approx == question_.high->approx) return *question_.high;
  return decimal_value(approx);
}

/// Certifies the result of the search for a witness, at a decimal slightly above it.
bool MarginRun::refute_at_found() {
  if (!witness_->found()) return false;
  const double least = witness_->found()->value;
  for (const double above : kAbove) {
    const double wanted = short_decimal_above(least * (1 + above));
    const double low = question_.low.approx;
    const MarginValue value =
        value_of(least <= low ? low : std::clamp(wanted, low, end_of(question_)));
    if (bracket_.refuted() && value.approx >= *bracket_.refuted()) return false;
    request_.replan(preparation_, value);
    const Result result =
        prove_between(preparation_, search_, settings_, witness_->points_at(value.approx));
    if (result.verdict != Verdict::kSingularity) continue;
    certificates_.finish(value, result);
    note({value, result, claim(preparation_, result)}, false);
    return true;
  }
  return false;
}

void MarginRun::close_in() {
  while (!interrupted()) {
    const std::optional<PlannedAttempt> planned = bracket_.next();
    if (!planned) return;
    attempt(*planned);
  }
}

/// A search looks for a witness by descents from many places, which may find one below that of the
/// witness search.
void MarginRun::close_in_from_above() {
  while (!interrupted()) {
    const std::optional<PlannedAttempt> planned = bracket_.next_to_refute();
    if (!planned) return;
    attempt(*planned);
  }
}

void MarginRun::attempt(const PlannedAttempt& planned) {
  const MarginValue value = value_of(planned.value);
  std::optional<Result> known;
  if (earlier_ != nullptr) known = earlier_->find(value, planned.boxes);
  if (!known) {
    prove_remembered();
    if (interrupted()) return;
  }
  const Result result = known ? *known : search_at(value, planned);
  if (!known && earlier_ != nullptr) earlier_->keep(value, planned.boxes, result);
  note({value, result, claim(preparation_, result)}, true, planned.boxes);
  if (result.verdict == Verdict::kNoSingularity) is_remembered_ = known.has_value();
  if (!witness_ || result.verdict == Verdict::kNoSingularity) return;
  if (result.occupancy == Occupancy::kEmpty) return;
  if (result.witness) look_near(result.witness->points[0].variables);
  if (result.blocking_box.size() == widest_.outer.size()) look_near(result.blocking_box);
}

Result MarginRun::search_at(const MarginValue& value, const PlannedAttempt& planned) {
  request_.replan(preparation_, value);
  Settings settings = settings_;
  settings.time_limit = planned.seconds;
  settings.max_boxes = planned.boxes;
  SearchDisplay display(output_);
  std::vector<Observer*> watching;
  for (Observer* observer : {certificates_.watch(value), display.observer()})
    if (observer != nullptr) watching.push_back(observer);
  Observers observers(std::move(watching));
  Result result = run_search(preparation_, search_, settings, &observers);
  certificates_.finish(value, result);
  return result;
}

/// Searches again at the certified end if an earlier run has certified it. Its boxes are those that
/// the earlier run has counted.
void MarginRun::prove_remembered() {
  if (!is_remembered_) return;
  is_remembered_ = false;
  const MarginValue value = margin_.certified->value;
  const double seconds = std::max(bracket_.seconds_left(), 0.0);
  const Result result = search_at(value, {value.approx, settings_.max_boxes, seconds});
  bracket_.spend(result.statistics.seconds);
  margin_.seconds += result.statistics.seconds;
  if (result.verdict == Verdict::kNoSingularity && result.occupancy != Occupancy::kEmpty) {
    margin_.certified = {value, result, claim(preparation_, result)};
    return;
  }
  margin_.certified.reset();
  if (!result.stopped_by) earlier_->refuse(value);
}

/// Looks for a witness near the box where a search failed.
void MarginRun::look_near(std::span<const Interval> box) {
  Stopwatch watch;
  witness_->search_from(box);
  refute_at_found();
  const double spent = watch.lap();
  bracket_.spend(spent);
  margin_.seconds += spent;
}

void MarginRun::note(MarginStep step, bool is_search, std::uint64_t most_boxes) {
  const Result& result = step.result;
  if (is_search) {
    margin_.seconds += result.statistics.seconds;
    margin_.boxes += result.statistics.boxes;
    bracket_.note({step.value.approx, result.verdict, result.reason, result.statistics.boxes,
                   result.statistics.seconds, most_boxes});
  } else {
    bracket_.note_refuted(step.value.approx);
  }
  if (result.verdict == Verdict::kNoSingularity) margin_.certified = step;
  if (result.verdict == Verdict::kSingularity) margin_.refuted = step;
  if (result.occupancy == Occupancy::kEmpty) margin_.empty = step;
  listener_(step);
  margin_.steps.push_back(std::move(step));
}

}  // namespace regulus
