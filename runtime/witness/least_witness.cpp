// SPDX-License-Identifier: Apache-2.0
#include "runtime/witness/least_witness.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {
namespace {

/// Steps of the pattern search, as parts of a range. After the first step the uncertain quantities
/// are at their ends: the determinant is mostly linear in each.
constexpr double kFirstStep = 1.0;
constexpr double kLastStep = 0x1p-14;
constexpr double kNextStep = 0.25;
constexpr int kMaxSweeps = 24;
constexpr int kMaxRounds = 12;
constexpr int kHalvings = 48;
/// If a value falls by less than this part of itself, it is taken as the least from that start.
constexpr double kWorthAnotherRound = 1e-7;
/// Packs of points for one call. 64 starts need some thousands, and 10⁵ where many quantities are
/// uncertain. A number of packs, not of seconds, so that the result does not depend on the machine.
constexpr std::uint64_t kMostPacks = 1 << 18;

Interval range_of(const Problem& problem, std::size_t k) {
  return problem.inner[k] ? *problem.inner[k] : Interval(mid(problem.outer[k]));
}

}  // namespace

Growth::Growth(double low, std::vector<Interval> at_low, double high, std::vector<Interval> at_high)
    : low_(low), high_(high), at_low_(std::move(at_low)), at_high_(std::move(at_high)) {}

Growth Growth::between(double low, const Problem& at_low, double high, const Problem& at_high) {
  std::vector<Interval> lower, upper;
  for (std::size_t k = 0; k < at_low.outer.size(); ++k) {
    lower.push_back(range_of(at_low, k));
    upper.push_back(range_of(at_high, k));
  }
  return {low, std::move(lower), high, std::move(upper)};
}

double Growth::at(double value, std::size_t k, double t) const noexcept {
  const double share = (value - low_) / (high_ - low_);
  const double lo = (1 - share) * at_low_[k].lo + share * at_high_[k].lo;
  const double hi = (1 - share) * at_low_[k].hi + share * at_high_[k].hi;
  return lo >= hi ? lo : std::clamp((1 - t) * lo + t * hi, lo, hi);
}

std::vector<double> Growth::point(double value, std::span<const double> parts) const {
  std::vector<double> result;
  for (std::size_t k = 0; k < parts.size(); ++k) result.push_back(at(value, k, parts[k]));
  return result;
}

LeastWitness::LeastWitness(const Problem& problem, const Settings& settings, Growth growth,
                           bool threshold_grows)
    : problem_(problem),
      growth_(std::move(growth)),
      threshold_grows_(threshold_grows),
      motion_variables_(problem.kernel->motion_variables),
      batch_(problem, settings, no_structure_),
      box_(problem.outer.size()),
      trial_(problem.outer.size()),
      least_(growth_.high()) {}

bool LeastWitness::must_stop() const noexcept {
  return packs_left_ == 0 || Clock::now() >= end_ || (interrupt_ != nullptr && *interrupt_);
}

void LeastWitness::evaluate(std::size_t points) {
  batch_.seal(points);
  if (packs_left_ > 0) --packs_left_;
}

bool LeastWitness::search(double seconds, int starts, const std::atomic<bool>* interrupt) {
  const std::chrono::duration<double> time(std::min(seconds, 1e6));
  end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(time);
  interrupt_ = interrupt;
  packs_left_ = kMostPacks;
  for (int i = 0; i < starts && !must_stop(); ++i) improve_from(start(next_start_++));
  return found_.has_value();
}

bool LeastWitness::search_from(std::span<const Interval> box) {
  end_ = Clock::time_point::max();
  packs_left_ = kMostPacks;
  Parts parts(growth_.variables(), 0.5);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const double lo = growth_.at(widest(), k, 0), hi = growth_.at(widest(), k, 1);
    if (lo < hi) parts[k] = std::clamp((mid(box[k]) - lo) / (hi - lo), 0.0, 1.0);
  }
  improve_from(std::move(parts));
  return found_.has_value();
}

/// Chooses motion parameters; uncertain quantities start in the middle. First the middle, then
/// alternately corners and places inside; the same in every run.
LeastWitness::Parts LeastWitness::start(int number) {
  Parts parts(growth_.variables(), 0.5);
  if (number == 0) return parts;
  for (std::size_t k = 0; k < motion_variables_; ++k) {
    const double part = double(random_() - random_.min()) / double(random_.max() - random_.min());
    parts[k] = number % 2 == 0 ? part : std::round(part);
  }
  return parts;
}

/// Each round minimises the determinant at the least known value, and then finds the value at which
/// the determinant vanishes. The next round starts there.
void LeastWitness::improve_from(Parts parts) {
  if (!set_out_from(parts)) return;
  for (int round = 0; round < kMaxRounds && !must_stop(); ++round) {
    const double lowest = minimise(least_, parts);
    const double value = threshold_grows_ ? std::max(lowest, growth_.low())
                         : lowest <= 0    ? root(least_, parts)
                                          : kInfinity;
    if (!(value < least_) && (found_ || !(value <= least_))) return;
    const bool worthwhile = value < least_ * (1 - kWorthAnotherRound);
    keep(value, parts);
    if (!worthwhile || threshold_grows_) return;
  }
}

/// All starts search for the sign opposite to that of the first start; they are joined with it.
/// Constraints may separate them; then each searches for the sign opposite to its own.
bool LeastWitness::set_out_from(const Parts& parts) {
  const bool known = sign_ != 0 && problem_.kernel->constraints == 0;
  if (!known) sign_ = 1;
  const double first = objective_at(growth_.low(), parts);
  if (!std::isfinite(first)) {
    if (!known) sign_ = 0;
    return false;
  }
  if (known) return true;
  start_ = parts;
  const double determinant = threshold_grows_ ? first : first + problem_.alpha.lo;
  sign_ = determinant < 0 ? -1 : 1;
  return true;
}

void LeastWitness::keep(double value, const Parts& parts) {
  least_ = value;
  const bool starts_apart = threshold_grows_ || value <= growth_.low();
  found_ = Place{value, parts, starts_apart ? start_ : parts};
}

std::vector<std::vector<double>> LeastWitness::points_at(double value) const {
  if (!found_) return {};
  const double at = threshold_grows_ ? growth_.low() : value;
  return {growth_.point(at, found_->parts), growth_.point(growth_.low(), found_->from)};
}

/// Returns the value between low and `value` from which the objective is ≤ 0 at these parts.
double LeastWitness::root(double value, const Parts& parts) {
  double below = growth_.low(), above = value;
  if (objective_at(below, parts) <= 0) return below;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * below + 0.5 * above;
    (objective_at(middle, parts) <= 0 ? above : below) = middle;
  }
  return above;
}

double LeastWitness::minimise(double value, Parts& parts) {
  double best = objective_at(value, parts);
  for (double step = kFirstStep; step >= kLastStep; step *= kNextStep)
    for (int i = 0; i < kMaxSweeps && !must_stop(); ++i) {
      const Parts before = parts;
      if (!sweep(value, parts, step, best)) break;
      while (leap(value, parts, before, best)) {
      }
    }
  return best;
}

/// Lists moves. A variable that is not at an end moves one step in both directions; an uncertain
/// quantity at one end may change to the other.
void LeastWitness::list_moves(const Parts& parts, double step) {
  moves_.clear();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (growth_.at(widest(), k, 0) == growth_.at(widest(), k, 1)) continue;
    const bool at_end = parts[k] == 0 || parts[k] == 1;
    const double far = k >= motion_variables_ && at_end ? 1.0 : step;
    for (const double part : {std::max(parts[k] - far, 0.0), std::min(parts[k] + far, 1.0)})
      if (part != parts[k]) moves_.push_back({k, part});
  }
}

/// Tries the moves eight at a time. Makes the best of each eight if it lowers the objective.
bool LeastWitness::sweep(double value, Parts& parts, double step, double& best) {
  list_moves(parts, step);
  bool moved = false;
  for (std::size_t first = 0; first < moves_.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, moves_.size() - first);
    batch_.clear();
    for (std::size_t lane = 0; lane < count; ++lane) {
      trial_ = parts;
      trial_[moves_[first + lane].variable] = moves_[first + lane].part;
      load(lane, value, trial_);
    }
    evaluate(count);
    std::size_t chosen = count;
    for (std::size_t lane = 0; lane < count; ++lane)
      if (const double f = objective(lane); f < best) best = f, chosen = lane;
    if (chosen == count) continue;
    parts[moves_[first + chosen].variable] = moves_[first + chosen].part;
    moved = true;
  }
  return moved;
}

/// Repeats the total move of the last sweep: good along a valley that is oblique to the axes.
bool LeastWitness::leap(double value, Parts& parts, const Parts& before, double& best) {
  Parts further = parts;
  for (std::size_t k = 0; k < parts.size(); ++k)
    further[k] = std::clamp(2 * parts[k] - before[k], 0.0, 1.0);
  if (further == parts) return false;
  const double f = objective_at(value, further);
  if (!(f < best)) return false;
  best = f;
  parts = std::move(further);
  return true;
}

double LeastWitness::objective_at(double value, const Parts& parts) {
  batch_.clear();
  load(0, value, parts);
  evaluate(1);
  return objective(0);
}

void LeastWitness::load(std::size_t lane, double value, const Parts& parts) {
  const double at = threshold_grows_ ? growth_.low() : value;
  for (std::size_t k = 0; k < box_.size(); ++k) box_[k] = Interval(growth_.at(at, k, parts[k]));
  batch_.load(lane, box_);
}

/// Returns the value to minimise: ±det J⁻¹, positive where the search started, less a fixed
/// threshold; +∞ if it is not defined or not in the variety.
double LeastWitness::objective(std::size_t lane) {
  if (!has_lane(batch_.midpoint_defined() & batch_.midpoint_inside(), lane)) return kInfinity;
  if (!has_lane(batch_.preconditioned(), lane)) return threshold_grows_ ? 0 : -problem_.alpha.lo;
  const bool scaled = problem_.alpha.hi > 0;
  const double scale = scaled ? batch_.approx_row_scale(lane) : 1;
  const double determinant = sign_ * batch_.approx_determinant(lane) * scale;
  return threshold_grows_ ? determinant : determinant - problem_.alpha.lo;
}

}  // namespace regulus::detail
