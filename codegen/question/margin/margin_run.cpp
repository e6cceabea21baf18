// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/margin/margin_run.hpp"

#include <algorithm>
#include <utility>

#include "codegen/support/stopwatch.hpp"

namespace regulus::detail {
namespace {

/// Part of the time left that a search for the witness may take when no search is useful. It takes
/// tenths of a second.
constexpr double kWitnessShare = 0.5;

class MarginRun {
 public:
  MarginRun(Attempts& attempts, const MarginQuestion& question, const BracketSettings& settings)
      : attempts_(attempts),
        question_(question),
        settings_(settings),
        bracket_(question.low.approx, end_of(question), settings.limits) {}

  /// Looks at both ends first, because a witness makes some searches unnecessary.
  Margin run() {
    look([this] { return attempts_.beforehand(settings_.limits.seconds); });
    close_in();
    if (attempts_.can_look() && !bracket_.closed() && !interrupted()) {
      const double seconds = kWitnessShare * std::max(bracket_.seconds_left(), 0.0);
      look([&] { return attempts_.everywhere(seconds, bracket_.refuted()); });
      close_in();
      close_in_from_above();
    }
    prove_remembered();
    if (margin_.certified) margin_.gap = bracket_.gap();
    margin_.closed = bracket_.closed() && (margin_.certified || !bracket_.certified());
    margin_.interrupted = interrupted();
    return std::move(margin_);
  }

 private:
  [[nodiscard]] bool interrupted() const noexcept {
    return settings_.interrupt != nullptr && *settings_.interrupt;
  }

  void close_in() {
    while (!interrupted()) {
      const std::optional<PlannedAttempt> planned = bracket_.next();
      if (!planned) return;
      attempt(*planned);
    }
  }

  /// A search looks for a witness by descents from many places, which may find one below that of the
  /// witness search.
  void close_in_from_above() {
    while (!interrupted()) {
      const std::optional<PlannedAttempt> planned = bracket_.next_to_refute();
      if (!planned) return;
      attempt(*planned);
    }
  }

  void attempt(const PlannedAttempt& planned) {
    const MarginValue value = value_at(question_, planned.value);
    if (std::optional<Result> known = remembered(value, planned)) {
      is_remembered_ = is_remembered_ || known->verdict == Verdict::kNoSingularity;
      return note_search({value, std::move(*known), ""}, planned);
    }
    prove_remembered();
    if (interrupted()) return;
    MarginStep step = attempts_.at(value, planned);
    if (settings_.earlier != nullptr) settings_.earlier->keep(value, planned.boxes, step.result);
    note_search(std::move(step), planned);
  }

  [[nodiscard]] std::optional<Result> remembered(const MarginValue& value,
                                                 const PlannedAttempt& planned) const {
    return settings_.earlier == nullptr ? std::nullopt
                                        : settings_.earlier->find(value, planned.boxes);
  }

  /// Searches again at the certified end if an earlier run has certified it. Its boxes count in the
  /// place of those that the earlier run has counted.
  void prove_remembered() {
    if (!std::exchange(is_remembered_, false)) return;
    const MarginValue value = margin_.certified->value;
    const double seconds = std::max(bracket_.seconds_left(), 0.0);
    MarginStep step = attempts_.at(value, {value.approx, settings_.limits.boxes, seconds});
    const Result& result = step.result;
    spend(result.statistics.seconds);
    const bool is_stopped = result.stopped_by.has_value();
    if (result.verdict == Verdict::kNoSingularity && result.occupancy != Occupancy::kEmpty) {
      margin_.boxes -= margin_.certified->result.statistics.boxes;
      margin_.boxes += result.statistics.boxes;
      margin_.certified = std::move(step);
      return;
    }
    margin_.certified.reset();
    if (!is_stopped) settings_.earlier->refuse(value);
  }

  /// Looks for witnesses without a search.
  template <class Look>
  void look(const Look& find) {
    Stopwatch watch;
    for (MarginStep& step : find()) {
      bracket_.note_refuted(step.value.approx);
      keep(std::move(step));
    }
    spend(watch.lap());
  }

  void spend(double seconds) {
    bracket_.spend(seconds);
    margin_.seconds += seconds;
  }

  void note_search(MarginStep step, const PlannedAttempt& planned) {
    const Result result = step.result;
    margin_.seconds += result.statistics.seconds;
    margin_.boxes += result.statistics.boxes;
    bracket_.note({step.value.approx, result.verdict, result.reason, result.statistics.boxes,
                   result.statistics.seconds, planned.boxes});
    keep(std::move(step));
    const bool is_decided =
        result.verdict == Verdict::kNoSingularity || result.occupancy == Occupancy::kEmpty;
    if (attempts_.can_look() && !is_decided)
      look([&] { return attempts_.near(result, bracket_.refuted()); });
  }

  void keep(MarginStep step) {
    const Result& result = step.result;
    if (result.verdict == Verdict::kNoSingularity) margin_.certified = step;
    if (result.verdict == Verdict::kSingularity) margin_.refuted = step;
    if (result.occupancy == Occupancy::kEmpty) margin_.empty = step;
    if (settings_.listener) settings_.listener(step);
    margin_.steps.push_back(std::move(step));
  }

  static double end_of(const MarginQuestion& question) {
    return question.high ? question.high->approx : kInfinity;
  }

  Attempts& attempts_;
  const MarginQuestion& question_;
  const BracketSettings& settings_;
  bool is_remembered_ = false;  ///< the certified end is that of an earlier run
  Bracket bracket_;
  Margin margin_;
};

}  // namespace

std::vector<MarginStep> Attempts::beforehand(double) { return {}; }
bool Attempts::can_look() const noexcept { return false; }
std::vector<MarginStep> Attempts::near(const Result&, Refuted) { return {}; }
std::vector<MarginStep> Attempts::everywhere(double, Refuted) { return {}; }

Margin close_bracket(Attempts& attempts, const MarginQuestion& question,
                     const BracketSettings& settings) {
  return MarginRun(attempts, question, settings).run();
}

std::string obstacle_of(const Margin& margin) {
  const auto last = std::find_if(margin.steps.rbegin(), margin.steps.rend(), [](const auto& step) {
    return step.result.verdict == Verdict::kPossibleProblem;
  });
  if (last == margin.steps.rend() || last->result.stopped_by) return "";
  return describe(last->result.reason);
}

}  // namespace regulus::detail
