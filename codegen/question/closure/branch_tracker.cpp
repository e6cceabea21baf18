// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/closure/branch_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/existence/branch_tube.hpp"

namespace regulus::detail {
namespace {

constexpr double kLeastStep = 0x1p-24;
constexpr int kMostEvaluations = 1 << 14, kMostCorrections = 12;
/// The first correction is at most this part of the step, and each is this part of the one before.
constexpr double kPartOfStep = 0x1p-4, kPartOfCorrection = 0x1p-2;
/// Newton's method has ended, relative to 1 or to the unknown.
constexpr double kSmall = 0x1p-42;
/// Rounding keeps corrections as large as that where the system is nearly singular.
constexpr double kNoise = 0x1p-24;
constexpr int kCorrectionsBeforeNoise = 3;
/// A step is looked at once for so much that an unknown moves: it may end at another solution by chance.
constexpr double kMoveOfLook = 0.25;
constexpr int kMostLooks = 16;
/// No fraction of a turn, and none of the place that is asked for.
constexpr double kPartOfLook = 0.381966;

std::vector<double> middles(std::span<const Interval> values) {
  std::vector<double> result;
  for (const Interval& value : values) result.push_back(mid(value));
  return result;
}

/// Returns the n×m product of an n×n and an n×m matrix.
std::vector<double> product(std::span<const double> a, std::span<const double> b, std::size_t n,
                            std::size_t m) {
  std::vector<double> result(n * m, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < m; ++k) result[i * m + k] += a[i * n + j] * b[j * m + k];
  return result;
}

/// A way from the start to one place. It asks for one evaluation after another.
class Way {
 public:
  Way(const ClosedShape& shape, const BranchPoint& start, const std::vector<double>& end)
      : shape_(shape), start_(start), end_(end), at_(start.unknowns), trial_(start.unknowns) {}

  [[nodiscard]] bool is_over() const { return is_lost_ || is_found_; }
  [[nodiscard]] SystemBoxes::Box trial() const {
    const bool is_look = looks_ > 0;
    SystemBoxes::Box box;
    for (const double x : place(part_ + (is_look ? part_of_look() : 1) * step_))
      box.emplace_back(x);
    for (const double p : is_look ? between(part_of_look()) : trial_) box.emplace_back(p);
    return box;
  }

  void take(const std::optional<SystemBoxes::System>& system) {
    if (!system) return shorten();
    const std::size_t n = shape_.unknowns;
    const auto inverse = approx_inverse_of(middles(system->by_unknown), n);
    if (!inverse) return shorten();
    const std::vector<double> correction = product(*inverse, middles(system->value), n, 1);
    const double size = size_of(correction);
    if (!std::isfinite(size)) return shorten();
    const double small = std::fmin(kNoise, std::fmax(kSmall, rounding_of(*inverse, *system)));
    if (looks_ > 0) return look(size, small);
    const bool is_noise = corrections_ >= kCorrectionsBeforeNoise && size <= kNoise;
    const bool is_bad = is_noise            ? false
                        : corrections_ == 0 ? size > kPartOfStep * predicted_ + small
                                            : size > kPartOfCorrection * last_ + small;
    if (is_bad && has_begun_) return shorten();
    if (corrections_ >= kMostCorrections) return shorten();
    for (std::size_t i = 0; i < n; ++i) trial_[i] -= correction[i];
    last_ = size, ++corrections_;
    if (!(size <= kSmall || is_noise)) return;
    next_inverse_ = *inverse;
    next_slopes_ = product(*inverse, middles(system->by_variable), n, shape_.variables);
    for (double& slope : next_slopes_) slope = -slope;
    if (!has_begun_) return accept();
    looks_ = std::clamp(int(predicted_ / kMoveOfLook) + 1, 1, kMostLooks);
    looked_ = 0;
  }

  [[nodiscard]] std::optional<TrackedPoint> result() const {
    if (!is_found_) return std::nullopt;
    return TrackedPoint{{end_, at_}, inverse_, slopes_};
  }

  [[nodiscard]] std::optional<LostWay> last() const {
    if (!has_begun_) return std::nullopt;
    return LostWay{part_, {{place(part_), at_}, inverse_, slopes_}};
  }

 private:
  [[nodiscard]] std::vector<double> place(double part) const {
    if (part >= 1) return end_;
    std::vector<double> x(end_.size());
    for (std::size_t k = 0; k < x.size(); ++k)
      x[k] = start_.variables[k] + part * (end_[k] - start_.variables[k]);
    return x;
  }

  /// Relative to 1 or to the unknown.
  [[nodiscard]] double size_of(std::span<const double> correction) const {
    double size = 0;
    for (std::size_t i = 0; i < correction.size(); ++i)
      size = std::fmax(size, std::fabs(correction[i]) / std::fmax(1.0, std::fabs(trial_[i])));
    return size;
  }

  /// The size of a correction that rounding alone may make.
  [[nodiscard]] double rounding_of(std::vector<double> inverse,
                                   const SystemBoxes::System& system) const {
    for (double& entry : inverse) entry = std::fabs(entry);
    std::vector<double> radii;
    for (const Interval& value : system.value) radii.push_back(rad_ru(value));
    return size_of(product(inverse, radii, shape_.unknowns, 1));
  }

  /// Returns the part of the step at which it is looked at next.
  [[nodiscard]] double part_of_look() const { return (looked_ + kPartOfLook) / looks_; }

  /// The unknowns at a part of the step by the solutions at both ends and the slopes there: the cubic.
  [[nodiscard]] std::vector<double> between(double t) const {
    std::vector<double> p(at_.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double rise = trial_[i] - at_[i], begin = move_of(slopes_, i) - rise,
                   end = rise - move_of(next_slopes_, i);
      p[i] = at_[i] + t * rise + t * (1 - t) * (begin * (1 - t) + end * t);
    }
    return p;
  }

  /// How far an unknown moves in the step with these slopes.
  [[nodiscard]] double move_of(const std::vector<double>& slopes, std::size_t i) const {
    double move = 0;
    for (std::size_t k = 0; k < shape_.variables; ++k)
      move += slopes[i * shape_.variables + k] * step_ * (end_[k] - start_.variables[k]);
    return move;
  }

  /// Between both ends there must be solutions near the cubic, too.
  void look(double size, double small) {
    if (size > kPartOfStep * std::fmin(predicted_, 1.0) + small) return shorten();
    if (++looked_ == looks_) accept();
  }

  void shorten() {
    is_lost_ = !has_begun_ || step_ <= kLeastStep;
    step_ /= 2;
    predict();
  }

  void accept() {
    at_ = trial_, inverse_ = next_inverse_, slopes_ = next_slopes_;
    part_ += step_;
    is_found_ = part_ >= 1;
    step_ = std::fmin(has_begun_ ? 2 * step_ : 1, 1 - part_);
    has_begun_ = true;
    predict();
  }

  void predict() {
    corrections_ = 0, last_ = 0, predicted_ = 0, looks_ = 0;
    trial_ = at_;
    if (slopes_.empty()) return;
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const double move = move_of(slopes_, i);
      trial_[i] += move;
      predicted_ = std::fmax(predicted_, std::fabs(move) / std::fmax(1.0, std::fabs(at_[i])));
    }
  }

  const ClosedShape& shape_;
  const BranchPoint& start_;
  const std::vector<double>& end_;
  std::vector<double> at_, trial_, inverse_, slopes_;
  std::vector<double> next_inverse_, next_slopes_;  ///< at the end of the step
  double part_ = 0, step_ = 0, predicted_ = 0, last_ = 0;
  int corrections_ = 0;
  int looks_ = 0, looked_ = 0;  ///< 0: the end of the step is not found
  bool has_begun_ = false, is_lost_ = false, is_found_ = false;
};

std::vector<std::optional<TrackedPoint>> follow(SystemBoxes& system, std::vector<Way>& ways) {
  for (int count = 0; count < kMostEvaluations; ++count) {
    std::vector<SystemBoxes::Box> boxes;
    std::vector<Way*> asking;
    for (Way& way : ways)
      if (!way.is_over()) boxes.push_back(way.trial()), asking.push_back(&way);
    if (asking.empty()) break;
    system.evaluate(boxes);
    for (std::size_t lane = 0; lane < asking.size(); ++lane) asking[lane]->take(system.at(lane));
  }
  std::vector<std::optional<TrackedPoint>> results;
  for (const Way& way : ways) results.push_back(way.result());
  return results;
}

}  // namespace

std::vector<std::optional<TrackedPoint>> track(SystemBoxes& system, const ClosedShape& shape,
                                               const BranchPoint& start,
                                               std::span<const std::vector<double>> places) {
  std::vector<Way> ways;
  for (const std::vector<double>& place : places) ways.emplace_back(shape, start, place);
  return follow(system, ways);
}

std::optional<LostWay> track_until_lost(SystemBoxes& system, const ClosedShape& shape,
                                        const BranchPoint& start,
                                        const std::vector<double>& place) {
  std::vector<Way> ways{Way(shape, start, place)};
  static_cast<void>(follow(system, ways));
  return ways.front().last();
}

std::vector<std::optional<TrackedPoint>> settle(SystemBoxes& system, const ClosedShape& shape,
                                                std::span<const BranchPoint> near) {
  std::vector<Way> ways;
  for (const BranchPoint& point : near) ways.emplace_back(shape, point, point.variables);
  return follow(system, ways);
}

}  // namespace regulus::detail
