// SPDX-License-Identifier: Apache-2.0
// Implements tracker.h: one test of Krawczyk in six unknowns, over the largest box that passes it.
#include "runtime/embedded/tracker.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/existence/branch_tube.hpp"
#include "runtime/interval/floating_point_scope.hpp"
#include "runtime/solutions/pose_narrowing.hpp"

namespace regulus {

using namespace detail;

namespace {

constexpr std::size_t kSize = LegsNearPose::kUnknowns;
using Radii = std::array<double, kSize>;  ///< of u in lengths, and of v

constexpr unsigned kNewtonSteps = 8, kShapings = 4, kSizes = 24, kSharpenings = 4;
static_assert(kNewtonSteps + 1 + kShapings + kSizes + kSharpenings <= REGULUS_TRACK_MOST_TESTS);
/// v is at most this, and Newton's steps are.
constexpr double kGreatest = 0.5;
/// The least part v of boxes that are tried, and of those by which a shape is found.
constexpr double kSmall = 0x1p-20;
/// The size that bounds of second order suggest is made less by this, and then by this again.
constexpr double kCaution = 0.875;
constexpr double kConverged = 0x1p-30;
constexpr double kLeastRadius = 0x1p-50;

double norm_ru(const double* v) {
  return sqrt(sqr(Interval(v[0])) + sqr(Interval(v[1])) + sqr(Interval(v[2]))).hi;
}

/// At least the angle of the quaternion 1 + v.
double angle_ru(const double* v) { return (Interval(2.0) * atan(Interval(norm_ru(v)))).hi; }

/// At most the angle of any quaternion 1 + v with some |v_k| > r.
double angle_rd(double r) { return (Interval(2.0) * atan(Interval(r))).lo; }

/// |x|, as upper bounds.
void set_magnitudes(const LegsNearPose::Unknowns& x, double* result) {
  for (std::size_t k = 0; k < 3; ++k) result[k] = mag(x[k]);
}

class Tracking {
 public:
  Tracking(const GoughLegs& legs, const regulus_pose& last)
      : legs_(legs), last_(last), pose_(last) {
    for (std::size_t i = 0; i < 6; ++i)
      for (const auto* anchors : {&legs.base, &legs.platform})
        for (const Interval& x : (*anchors)[i]) size_ = std::fmax(size_, mag(x));
    size_ = std::fmax(size_, 0x1p-500);
  }

  void track(regulus_track_report& report) {
    report.verdict = REGULUS_TRACK_NOT_SHOWN;
    report.pose = last_;
    if (approach() && find_radius()) {
      sharpen();
      tell(report);
    }
    report.tests = tests_;
  }

 private:
  [[nodiscard]] LegsNearPose near() const {
    std::array<double, 4> rotation;
    std::array<double, 3> position;
    std::copy_n(pose_.rotation, 4, rotation.begin());
    std::copy_n(pose_.position, 3, position.begin());
    return {legs_, rotation, position};
  }

  /// Newton's method, in doubles but for the evaluation. Leaves K and K times the values at the pose.
  bool approach() {
    double last = kInfinity;
    for (unsigned step = 0;; ++step) {
      const LegsNearPose legs = near();
      const LegsNearPose::Values at = legs.at({});
      ++tests_;
      std::array<double, kSize * kSize> matrix{};
      std::ranges::transform(at.by_unknown, matrix.begin(), [](Interval x) { return mid(x); });
      if (!approx_invert(matrix, inverse_, kSize)) return false;
      double largest = 0;
      for (std::size_t i = 0; i < kSize; ++i) {
        offset_[i] = Interval(0.0);
        for (std::size_t j = 0; j < kSize; ++j)
          offset_[i] += Interval(inverse_[i * kSize + j]) * at.value[j];
        largest = std::fmax(largest, std::fabs(mid(offset_[i])) / (i < 3 ? size_ : 1));
      }
      if (!(largest < kGreatest)) return false;
      const bool is_at_end = largest < kConverged && !(largest < last / 2);
      if (is_at_end || largest == 0 || step == kNewtonSteps) {
        note_spread(at);
        return true;
      }
      last = largest;
      LegsNearPose::Unknowns moved;
      for (std::size_t k = 0; k < kSize; ++k) moved[k] = Interval(-mid(offset_[k]));
      const GoughPose next = legs.pose_of(moved);
      std::ranges::transform(next.position, pose_.position, [](Interval x) { return mid(x); });
      std::ranges::transform(next.rotation, pose_.rotation, [](Interval x) { return mid(x); });
    }
  }

  /// Bounds |K·F′ − 1| at the pose.
  void note_spread(const LegsNearPose::Values& at) {
    for (std::size_t i = 0; i < kSize; ++i)
      for (std::size_t k = 0; k < kSize; ++k) {
        Interval sum(i == k ? -1.0 : 0.0);
        for (std::size_t j = 0; j < kSize; ++j)
          sum += Interval(inverse_[i * kSize + j]) * at.by_unknown[j * kSize + k];
        spread_[i * kSize + k] = mag(sum);
      }
  }

  /// Row i of K times a column of numbers, one for each leg.
  template <class ByLeg>
  [[nodiscard]] double combined(std::size_t i, const ByLeg& by_leg) const {
    Interval sum(0.0);
    for (std::size_t j = 0; j < kSize; ++j) sum += Interval(inverse_[i * kSize + j]) * by_leg(j);
    return mag(sum);
  }

  /// Bounds |K·F′ − 1|·r over a box: what it is at the pose, and K times all second derivatives over the box.
  [[nodiscard]] Radii change_over(const LegsNearPose& legs, const Radii& r) {
    ++tests_;
    LegsNearPose::Unknowns box;
    for (std::size_t k = 0; k < kSize; ++k) box[k] = Interval(-r[k], r[k]);
    const LegsNearPose::Bends bends = legs.bends(box);
    Radii change{};
    for (std::size_t i = 0; i < kSize; ++i) {
      const auto add = [&](double bound, double x, double y) {
        change[i] = add_ru(change[i], mul_ru(bound, mul_ru(x, y)));
      };
      for (std::size_t k = 0; k < kSize; ++k) add(spread_[i * kSize + k], r[k], 1);
      const double by_u = combined(i, [&](std::size_t) { return bends.by_u; });
      for (std::size_t j = 0; j < 3; ++j) {
        add(by_u, r[j], r[j]);
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t e = 3 * j + k;
          // Once in the row of u_j, and once in that of v_k.
          add(combined(i, [&](std::size_t leg) { return bends.by_u_and_v[leg][e]; }), 2 * r[j],
              r[3 + k]);
          if (k < j) continue;
          add(combined(i, [&](std::size_t leg) { return bends.by_v[leg][e]; }),
              (j == k ? 1 : 2) * r[3 + j], r[3 + k]);
        }
      }
    }
    return change;
  }

  /// Sets the left side of the test of Krawczyk for a box. Returns true if it passes.
  bool passes(const LegsNearPose& legs, const Radii& radius, Radii& image) {
    image = change_over(legs, radius);
    bool is_inside = true;
    for (std::size_t i = 0; i < kSize; ++i) {
      image[i] = add_ru(image[i], mag(offset_[i]));
      is_inside = is_inside && image[i] < radius[i];
    }
    return is_inside;
  }

  [[nodiscard]] static Radii radii(double u, double v) { return {u, u, u, v, v, v}; }

  /// Looks for the largest box: its shape by small ones, in which all grows with the square of the size, and
  /// then its size.
  bool find_radius() {
    const LegsNearPose legs = near();
    double u = kSmall * size_, greatest = 0;
    Radii change{};
    for (unsigned i = 0; i < kShapings; ++i) {
      change = change_over(legs, radii(u, kSmall));
      const double by_u = *std::max_element(change.begin(), change.begin() + 3) / u;
      const double by_v = *std::max_element(change.begin() + 3, change.end()) / kSmall;
      greatest = std::fmax(by_u, by_v);
      if (!(greatest < 1) || !(by_v > 0)) return false;
      if (i + 1 < kShapings) u *= std::sqrt(by_u / by_v);
    }
    double factor = std::fmin(kCaution / greatest, kGreatest / kSmall);
    for (unsigned i = 0; i < kSizes; ++i, factor *= i < kSizes / 2 ? kCaution : 0.25) {
      radius_ = radii(factor * u, factor * kSmall);
      if (passes(legs, radius_, image_)) return true;
    }
    return false;
  }

  /// A small box that passes has the same solution, if it is a part of the large one; and the solution is in
  /// the image of each box that contains it.
  void sharpen() {
    const LegsNearPose legs = near();
    Radii image;
    double factor = 1.5;
    for (unsigned i = 0; i < kSharpenings; ++i, factor *= 4) {
      Radii small;
      bool is_part = true;
      for (std::size_t k = 0; k < kSize; ++k) {
        small[k] = factor * mag(offset_[k]) + kLeastRadius * (k < 3 ? size_ : 1);
        is_part = is_part && small[k] <= radius_[k];
      }
      if (!is_part) return;
      if (passes(legs, small, image)) {
        image_ = image;
        return;
      }
    }
  }

  /// Poses within r and α of the last one are within r + d and α + β of `pose`, if the last one is at the
  /// distance d and the angle β from there.
  void tell(regulus_track_report& report) const {
    GoughPose last;
    std::copy_n(last_.position, 3, last.position.begin());
    std::copy_n(last_.rotation, 4, last.rotation.begin());
    const auto back = near().unknowns_of(last);
    if (!back) return;
    double u[3], v[3];
    set_magnitudes(*back, u);
    set_magnitudes({(*back)[3], (*back)[4], (*back)[5]}, v);
    const double distance = norm_ru(u), angle = angle_ru(v);
    report.distance_error = norm_ru(image_.data());
    report.angle_error = angle_ru(image_.data() + 3);
    report.distance_radius =
        sub_rd(*std::min_element(radius_.begin(), radius_.begin() + 3), distance);
    report.angle_radius =
        sub_rd(angle_rd(*std::min_element(radius_.begin() + 3, radius_.end())), angle);
    if (!(add_ru(distance, report.distance_error) <= report.distance_radius) ||
        !(add_ru(angle, report.angle_error) <= report.angle_radius))
      return;
    report.verdict = REGULUS_TRACK_ONE_POSE;
    report.pose = pose_;
  }

  const GoughLegs& legs_;
  const regulus_pose& last_;
  regulus_pose pose_;
  double size_ = 0;
  unsigned tests_ = 0;
  std::array<double, kSize * kSize> inverse_{}, spread_{};
  LegsNearPose::Unknowns offset_;
  Radii radius_{}, image_{};
};

bool is_sound(double x, bool is_error = false) {
  return std::isfinite(x) && std::fabs(x) < 0x1p300 && (!is_error || x >= 0);
}

/// Returns false if a number is bad.
bool read(const regulus_platform& robot, const double* lengths, const double* errors,
          GoughLegs& legs) {
  const auto around = [](double x, double error) { return Interval(x) + Interval(-error, error); };
  bool sound = true;
  for (std::size_t i = 0; i < 6; ++i) {
    sound = sound && is_sound(lengths[i], true) && is_sound(errors[i], true) &&
            is_sound(robot.base_error[i], true) && is_sound(robot.platform_error[i], true);
    for (std::size_t k = 0; k < 3; ++k)
      sound = sound && is_sound(robot.base[i][k]) && is_sound(robot.platform[i][k]);
    if (!sound) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      legs.base[i][k] = around(robot.base[i][k], robot.base_error[i]);
      legs.platform[i][k] = around(robot.platform[i][k], robot.platform_error[i]);
    }
    legs.length[i] = around(lengths[i], errors[i]);
  }
  return true;
}

bool is_sound(const regulus_pose& pose) {
  double largest = 0;
  for (const double x : pose.rotation) largest = std::fmax(largest, std::fabs(x));
  return std::ranges::all_of(pose.position, [](double x) { return is_sound(x); }) &&
         std::ranges::all_of(pose.rotation, [](double x) { return is_sound(x); }) &&
         largest > 0x1p-300;
}

}  // namespace
}  // namespace regulus

regulus_track_verdict regulus_track(const regulus_platform* robot, const regulus_pose* last,
                                    const double* lengths, const double* length_errors,
                                    regulus_track_report* report) {
  using namespace regulus;
  using namespace regulus::detail;
  const FloatingPointScope nearest(FloatingPointRounding::kNearest);
  regulus_track_report result = {};
  result.verdict = REGULUS_TRACK_BAD_INPUT;
  result.pose = *last;
  GoughLegs legs;
  if (is_sound(*last) && read(*robot, lengths, length_errors, legs))
    Tracking(legs, *last).track(result);
  if (report != nullptr) *report = result;
  return result.verdict;
}
