// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/feasibility_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <new>
#include <thread>

#include "runtime/interval/floating_point_scope.hpp"

namespace regulus {
namespace {

/// The boxes of a round, whatever the number of threads.
constexpr std::size_t kBoxesOfRound = 256;
constexpr std::uint64_t kBoxesAfterProblem = 4096;

class ForceSearch {
 public:
  ForceSearch(const ForceQuestion& question, const FeasibilitySettings& settings,
              const ForceListener& listener, Observer* progress)
      : question_(question), settings_(settings), listener_(listener), progress_(progress) {
    const unsigned threads = std::clamp(settings.threads, 1U, unsigned(kBoxesOfRound / kLanes));
    for (unsigned t = 0; t < threads; ++t)
      workers_.push_back(std::make_unique<BoxForces>(question_));
    parameters_ = question.problem.kernel->motion_variables;
    for (std::size_t k = 0; k < parameters_; ++k)
      ranges_.push_back(width_ru(question.problem.outer[k]));
    open_.push_back({0, 0, question.problem.outer});
  }

  FeasibilityResult run() {
    announce();
    while (!open_.empty() && !must_stop()) {
      take_round();
      decide_round();
      for (std::size_t i = 0; i < round_.size(); ++i) conclude(i);
      for (std::size_t i = round_.size(); i-- > 0;) settle(i);
      if (progress_ != nullptr) progress_->on_progress(statistics(), open_.size());
      if (result_.witness && !settings_.paves) break;
    }
    finish();
    return std::move(result_);
  }

 private:
  using Box = std::vector<Interval>;
  struct NumberedBox {
    BoxId id;
    std::uint32_t depth;
    Box box;
  };
  using Clock = std::chrono::steady_clock;
  using Kind = BoxOutcome::Kind;

  void announce() {
    if (progress_ == nullptr) return;
    Settings settings;
    settings.time_limit = settings_.time_limit;
    progress_->on_start(question_.problem, settings);
  }

  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }
  [[nodiscard]] Statistics statistics() const {
    Statistics statistics;
    statistics.boxes = result_.boxes;
    statistics.seconds = seconds();
    return statistics;
  }

  [[nodiscard]] bool stop(Reason reason) {
    result_.stopped_by = reason;
    return true;
  }
  [[nodiscard]] bool must_stop() {
    if (is_out_of_memory_) return stop(Reason::kMemory);
    if (settings_.interrupt != nullptr && *settings_.interrupt) return stop(Reason::kInterrupted);
    if (result_.boxes >= settings_.max_boxes) return stop(Reason::kBoxBudget);
    if (seconds() >= settings_.time_limit) return stop(Reason::kTimeBudget);
    // After a problem only a witness is looked for.
    return is_blocked_ && !settings_.paves &&
           result_.boxes >= boxes_when_blocked_ + kBoxesAfterProblem;
  }

  void take_round() {
    const std::uint64_t budget = settings_.max_boxes - result_.boxes;
    round_.clear();
    numbers_.clear();
    while (!open_.empty() && round_.size() < std::min<std::uint64_t>(kBoxesOfRound, budget)) {
      round_.push_back(std::move(open_.back().box));
      numbers_.push_back({open_.back().id, open_.back().depth, {}});
      open_.pop_back();
    }
    outcomes_.assign(round_.size(), {});
    result_.boxes += round_.size();
  }

  void decide_round() {
    std::atomic<std::size_t> next = 0;
    const auto work = [&](BoxForces& forces) noexcept {
      const FloatingPointScope nearest(FloatingPointRounding::kNearest);
      for (std::size_t at; (at = kLanes * next++) < round_.size();) decide_batch(forces, at);
    };
    const std::size_t batches = (round_.size() + kLanes - 1) / kLanes;
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < std::min(workers_.size(), batches); ++t)
      others.emplace_back([&work, this, t] { work(*workers_[t]); });
    work(*workers_.front());
  }

  void decide_batch(BoxForces& forces, std::size_t at) noexcept {
    const std::size_t count = std::min(kLanes, round_.size() - at);
    try {
      auto outcomes = forces.decide(std::span<const Box>(round_).subspan(at, count));
      std::ranges::move(outcomes, outcomes_.begin() + std::ptrdiff_t(at));
    } catch (const std::bad_alloc&) {
      is_out_of_memory_ = true;
    }
  }

  void conclude(std::size_t i) {
    BoxOutcome& outcome = outcomes_[i];
    result_.is_inhabited = result_.is_inhabited || outcome.is_inhabited;
    if (outcome.witness && !result_.witness) result_.witness = std::move(outcome.witness);
  }

  void settle(std::size_t i) {
    const BoxOutcome& outcome = outcomes_[i];
    switch (outcome.kind) {
      case Kind::kOutside:
        return leaf(i, ForceClaim::kOutside);
      case Kind::kHeld:
        all_outside_ = false;
        return leaf(i, ForceClaim::kFeasible);
      case Kind::kNotHeld:
        all_outside_ = false;
        if (settings_.paves || outcome.is_inhabited) {
          has_infeasible_ = true;
          return leaf(i, ForceClaim::kInfeasible);
        }
        break;
      case Kind::kUnknown:
        break;
    }
    split(i, outcome);
  }

  void leaf(std::size_t i, ForceClaim claim) {
    leaf({numbers_[i].id, numbers_[i].depth, round_[i]}, claim);
  }

  void leaf(const OpenBox& box, ForceClaim claim) {
    listener_(box.box, claim);
    if (progress_ == nullptr) return;
    const Rule rule = claim == ForceClaim::kFeasible     ? Rule::kHMatrix
                      : claim == ForceClaim::kInfeasible ? Rule::kWitness
                      : claim == ForceClaim::kOutside    ? Rule::kOutside
                                                         : Rule::kBlocked;
    progress_->on_leaf(box, rule, {});
  }

  void block(std::size_t i, Reason reason) {
    all_outside_ = false;
    if (!is_blocked_) {
      result_.blocking_box = round_[i];
      result_.reason = reason;
      boxes_when_blocked_ = result_.boxes;
    }
    is_blocked_ = true;
    leaf(i, ForceClaim::kUndecided);
  }

  /// A paving goes on below a pose that defeats the test, because others of the box may not.
  void split(std::size_t i, const BoxOutcome& outcome) {
    if (outcome.is_hopeless && !settings_.paves) return block(i, reason_of(outcome));
    const std::optional<std::size_t> variable = choose(round_[i], outcome);
    if (!variable) return block(i, reason_of(outcome));
    const Halves halves = *bisect(round_[i][*variable]);
    const auto [id, depth, none] = numbers_[i];
    if (progress_ != nullptr)
      progress_->on_split({id, depth, round_[i]},
                          {id, static_cast<std::uint32_t>(*variable), halves.left.hi, next_id_});
    Box box = std::move(round_[i]), upper = box;
    box[*variable] = halves.left;
    upper[*variable] = halves.right;
    open_.push_back({next_id_ + 1, depth + 1, std::move(upper)});
    open_.push_back({next_id_, depth + 1, std::move(box)});
    next_id_ += 2;
  }

  [[nodiscard]] static Reason reason_of(const BoxOutcome& outcome) {
    if (outcome.is_undefined) return Reason::kUndefined;
    return outcome.is_hopeless ? Reason::kUncertainty : Reason::kWidth;
  }

  /// Returns the parameter with the greatest impact, or else with the widest part of its range.
  [[nodiscard]] std::optional<std::size_t> choose(const Box& box, const BoxOutcome& outcome) const {
    std::optional<std::size_t> best;
    double most = -1, most_width = 0;
    for (std::size_t k = 0; k < parameters_; ++k) {
      const double width = width_ru(box[k]) / ranges_[k];
      // Halves are rounded, so a small slack avoids one halving too many.
      const bool splits = width > settings_.min_relative_width * (1 + 0x1p-30) && bisect(box[k]);
      if (!splits) continue;
      const double impact =
          outcome.impact.empty() || std::isnan(outcome.impact[k]) ? width : outcome.impact[k];
      if (impact > most || (impact == most && width > most_width)) {
        best = k;
        most = impact;
        most_width = width;
      }
    }
    return best;
  }

  void finish() {
    for (const NumberedBox& open : open_)
      if (!result_.witness || settings_.paves)
        leaf({open.id, open.depth, open.box}, ForceClaim::kUndecided);
    result_.seconds = seconds();
    result_.is_empty = open_.empty() && all_outside_;
    if (result_.witness)
      result_.verdict = FeasibilityVerdict::kInfeasible;
    else if (open_.empty() && !is_blocked_ && !all_outside_ && !has_infeasible_)
      result_.verdict = FeasibilityVerdict::kFeasible;
    if (result_.verdict == FeasibilityVerdict::kPossibleProblem && !is_blocked_)
      result_.reason =
          result_.stopped_by.value_or(result_.is_empty ? Reason::kEmptyVariety : Reason::kWidth);
    if (progress_ == nullptr) return;
    Result result;
    result.statistics = statistics();
    progress_->on_finish(result);
  }

  const ForceQuestion question_;
  const FeasibilitySettings& settings_;
  const ForceListener& listener_;
  Observer* progress_;
  std::vector<std::unique_ptr<BoxForces>> workers_;
  std::size_t parameters_ = 0;
  std::vector<double> ranges_;
  std::vector<NumberedBox> open_;
  std::vector<Box> round_;
  std::vector<NumberedBox> numbers_;  ///< of the round, without the boxes
  BoxId next_id_ = 1;
  std::vector<BoxOutcome> outcomes_;
  bool all_outside_ = true, is_blocked_ = false, has_infeasible_ = false;
  std::atomic<bool> is_out_of_memory_ = false;
  std::uint64_t boxes_when_blocked_ = 0;
  const Clock::time_point start_ = Clock::now();
  FeasibilityResult result_;
};

}  // namespace

const char* name(FeasibilityVerdict verdict) noexcept {
  switch (verdict) {
    case FeasibilityVerdict::kFeasible:
      return "FEASIBLE";
    case FeasibilityVerdict::kInfeasible:
      return "INFEASIBLE";
    case FeasibilityVerdict::kPossibleProblem:
      return "POSSIBLE PROBLEM";
  }
  return "";
}

FeasibilityResult search_forces(const ForceQuestion& question, const FeasibilitySettings& settings,
                                const ForceListener& listener, Observer* progress) {
  return ForceSearch(question, settings, listener, progress).run();
}

}  // namespace regulus
