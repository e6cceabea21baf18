// SPDX-License-Identifier: Apache-2.0
#include "runtime/witness/pose_search.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "runtime/kernel/call.hpp"
#include "runtime/regularity/aligned_buffer.hpp"
#include "runtime/regularity/lanes.hpp"

namespace regulus::detail {
namespace {

/// The number of boxes that are split before the search gives up.
constexpr std::size_t kMaxBoxes = 2048;

/// A box, and roughly the distance of its middle from satisfying the constraints.
struct Candidate {
  std::vector<Interval> box;
  double violation = 0.0;
  std::uint64_t number = 0;  ///< the order in which they were added
};

/// Orders the queue: the most promising box is on top, then the oldest.
struct LessPromising {
  bool operator()(const Candidate& a, const Candidate& b) const noexcept {
    return a.violation != b.violation ? a.violation > b.violation : a.number > b.number;
  }
};

/// Returns a number with few binary digits between 0 < lo and hi.
double simplest_positive(double lo, double hi) noexcept {
  for (int exponent = std::ilogb(hi); exponent > -1000; --exponent) {
    const double step = std::ldexp(1.0, exponent);
    const double value = std::ceil(lo / step) * step;
    if (lo <= value && value <= hi) return value;
  }
  return mid({lo, hi});
}

/// People often put the limits of constraints at simple numbers: 0, 1, 1/2.
double simplest_in(const Interval& x) noexcept {
  if (x.lo <= 0.0 && 0.0 <= x.hi) return 0.0;
  return x.lo > 0.0 ? simplest_positive(x.lo, x.hi) : -simplest_positive(-x.hi, -x.lo);
}

class PoseSearch {
 public:
  PoseSearch(const Problem& problem, const Settings& settings, bool defined)
      : problem_(problem),
        settings_(settings),
        kernel_(*problem.kernel),
        functions_(*problem.kernel),
        defined_(defined),
        variables_(functions_.variables),
        boxes_(2 * kLanes * std::max<std::size_t>(variables_, 1)),
        out_(2 * kLanes * largest_output(functions_)) {}

  Inhabitants run() {
    push(problem_.outer);
    for (std::size_t count = 0; count < kMaxBoxes && !waiting_.empty(); ++count) {
      if (settings_.interrupt != nullptr && *settings_.interrupt) return {};
      const Candidate candidate = waiting_.top();
      waiting_.pop();
      if (auto point = point_in(candidate.box)) return {Occupancy::kInhabited, std::move(point)};
      split(candidate.box);
    }
    if (waiting_.empty() && !undecided_) return {Occupancy::kEmpty, std::nullopt};
    return {};
  }

 private:
  static std::size_t largest_output(const regulus_kernel& f) noexcept {
    const std::size_t entries = std::size_t{f.rows} * f.columns;
    return std::max(
        {entries, std::size_t{f.constraints}, std::size_t{f.pose_parameters}, std::size_t{1}});
  }

  void load(std::size_t lane, std::size_t k, const Interval& x) noexcept {
    boxes_[lower_at(k, lane)] = x.lo;
    boxes_[upper_at(k, lane)] = x.hi;
  }

  void load_everywhere(std::span<const Interval> box) noexcept {
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      for (std::size_t k = 0; k < variables_; ++k) load(lane, k, box[k]);
  }

  /// Returns the lanes in which the function is defined.
  LaneMask call(regulus_function function) noexcept {
    return kAllLanes & ~kernel_.call(function, boxes_.get(), nullptr, out_.get());
  }

  Interval output(std::size_t entry, std::size_t lane) const noexcept {
    return {out_[lower_at(entry, lane)], out_[upper_at(entry, lane)]};
  }

  LaneMask call_constraints() noexcept {
    return functions_.constraints == 0 ? kAllLanes : call(functions_.constraint);
  }

  /// After call_constraints: true if every constraint is ≤ 0 all over the lane's box.
  bool all_satisfied(std::size_t lane) const noexcept {
    for (std::size_t h = 0; h < functions_.constraints; ++h)
      if (!(output(h, lane).hi <= 0.0)) return false;
    return true;
  }

  /// After call_constraints: true if some constraint is > 0 all over the lane's box.
  bool some_violated(std::size_t lane) const noexcept {
    for (std::size_t h = 0; h < functions_.constraints; ++h)
      if (output(h, lane).lo > 0.0) return true;
    return false;
  }

  /// Returns the values of a variable to test. A range without an inner one means a single value
  /// that is not a double, or all of its values at once.
  Interval within_inner(std::size_t k, double x) const noexcept {
    const auto& inner = problem_.inner[k];
    return inner ? Interval(std::clamp(x, inner->lo, inner->hi)) : problem_.outer[k];
  }

  bool can_split(std::size_t k, const Interval& x) const noexcept {
    return problem_.inner[k].has_value() && bisect(x).has_value();
  }

  /// Returns the middle, a place with few digits, or corners; they differ from box to box.
  double coordinate(std::size_t lane, std::size_t k, const Interval& x) const noexcept {
    if (lane == 0) return x.lo == x.hi ? x.lo : mid(x);
    if (lane == 1) return simplest_in(x);
    const std::size_t corner = lane - 2 + (kLanes - 2) * std::size_t(corners_);
    return ((corner >> (k % 6) ^ k / 6) & 1U) != 0 ? x.hi : x.lo;
  }

  std::optional<WitnessPoint> point_in(std::span<const Interval> box) {
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      for (std::size_t k = 0; k < variables_; ++k)
        load(lane, k, within_inner(k, coordinate(lane, k, box[k])));
    ++corners_;
    LaneMask good = call_constraints();
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      if (!all_satisfied(lane)) good &= ~(1U << lane);
    if (good != 0 && defined_) good &= defined_lanes();
    if (good == 0) return std::nullopt;
    std::size_t lane = 0;
    while ((good >> lane & 1U) == 0) ++lane;
    return point_of(lane);
  }

  /// Returns the lanes in which the matrix, row scales and pose are defined, the scales positive.
  LaneMask defined_lanes() noexcept {
    LaneMask good = call(functions_.matrix);
    if (functions_.row_scale != nullptr) {
      good &= call(functions_.row_scale);
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        if (!(output(0, lane).lo > 0.0)) good &= ~(1U << lane);
    }
    return functions_.pose != nullptr ? good & call(functions_.pose) : good;
  }

  WitnessPoint point_of(std::size_t lane) {
    WitnessPoint point;
    for (std::size_t k = 0; k < variables_; ++k)
      point.variables.emplace_back(boxes_[lower_at(k, lane)], boxes_[upper_at(k, lane)]);
    if (functions_.pose == nullptr || (call(functions_.pose) >> lane & 1U) == 0) return point;
    for (std::size_t e = 0; e < functions_.pose_parameters; ++e)
      point.pose.push_back(output(e, lane));
    return point;
  }

  void split(std::vector<Interval> box) {
    const std::optional<std::size_t> variable = variable_to_split(box);
    if (!variable) {
      undecided_ = true;
      return;
    }
    const Halves halves = *bisect(box[*variable]);
    for (const Interval& half : {halves.left, halves.right}) {
      box[*variable] = half;
      push(box);
    }
  }

  /// Keeps a box if the constraints do not exclude it.
  void push(const std::vector<Interval>& box) {
    load_everywhere(box);
    for (std::size_t k = 0; k < variables_; ++k)
      load(1, k, within_inner(k, coordinate(0, k, box[k])));
    const LaneMask known = call_constraints();
    if ((known & 1U) != 0 && some_violated(0)) return;
    double violation = functions_.constraints == 0 ? 0.0 : -kInfinity;
    for (std::size_t h = 0; h < functions_.constraints; ++h)
      violation = std::max(violation, (known & 2U) != 0 ? output(h, 1).hi : kInfinity);
    waiting_.push({box, violation, pushed_++});
  }

  /// Returns the variable with most effect on the constraints' widths; else the relatively widest.
  std::optional<std::size_t> variable_to_split(const std::vector<Interval>& box) {
    std::optional<std::size_t> best, widest;
    double most = 0.0, width = 0.0;
    for (std::size_t first = 0; first < variables_; first += kLanes - 1) {
      const std::size_t last = std::min(first + kLanes - 1, variables_);
      load_everywhere(box);
      for (std::size_t k = first; k < last; ++k) load(1 + k - first, k, Interval(mid(box[k])));
      const LaneMask known = call_constraints();
      for (std::size_t k = first; k < last; ++k) {
        if (!can_split(k, box[k])) continue;
        const double gain = approx_width(known, 0) - approx_width(known, 1 + k - first);
        if (gain > most) best = k, most = gain;
        const Interval& whole = problem_.outer[k];
        const double relative = (box[k].hi - box[k].lo) / (whole.hi - whole.lo);
        if (relative > width) widest = k, width = relative;
      }
    }
    return best ? best : widest;
  }

  /// Returns the sum of the widths of all constraints; an undefined one has the greatest width.
  double approx_width(LaneMask known, std::size_t lane) const noexcept {
    if ((known >> lane & 1U) == 0) return std::numeric_limits<double>::max();
    double sum = 0.0;
    for (std::size_t h = 0; h < functions_.constraints; ++h)
      sum += output(h, lane).hi - output(h, lane).lo;
    return std::min(sum, std::numeric_limits<double>::max());
  }

  const Problem& problem_;
  const Settings& settings_;
  const CheckedKernel kernel_;
  const regulus_kernel& functions_;
  const bool defined_;
  const std::size_t variables_;
  AlignedBuffer boxes_, out_;
  std::priority_queue<Candidate, std::vector<Candidate>, LessPromising> waiting_;
  std::uint64_t pushed_ = 0, corners_ = 0;
  bool undecided_ = false;  ///< a box was neither excluded nor split
};

}  // namespace

Inhabitants find_pose(const Problem& problem, const Settings& settings) {
  return PoseSearch(problem, settings, false).run();
}

Inhabitants find_defined_pose(const Problem& problem, const Settings& settings) {
  Inhabitants found = PoseSearch(problem, settings, true).run();
  if (found.occupancy != Occupancy::kInhabited) return {};
  return found;
}

}  // namespace regulus::detail
