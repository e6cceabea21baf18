// SPDX-License-Identifier: Apache-2.0
#include "runtime/solutions/pose_equations.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/interval/isa.hpp"
#include "runtime/kernel/isa.hpp"
#include "runtime/kernel/rounding_scope.hpp"

namespace regulus {

void evaluate_poses_portable(const PoseForms&, int, const double*, double*, bool);
#if defined(__x86_64__)
void evaluate_poses_avx2(const PoseForms&, int, const double*, double*, bool);
void evaluate_poses_avx512(const PoseForms&, int, const double*, double*, bool);
#endif

namespace {

constexpr std::size_t kLegs = 6, kNumbers = 7, kPartsOfR = 9;
constexpr std::size_t kConstant = kNumbers + kPartsOfR;
/// A pivot that is smaller, relative to the largest, is none.
constexpr double kLeastPivot = 0.02;
/// So that no pose is on the border of a chart.
constexpr double kRoom = 0x1p-20;

/// The coefficients of r, s, t and of R on the left side, and the right side.
using Row = std::array<Interval, kConstant + 1>;
using Point = std::array<Interval, 3>;

double middle_of(const GoughLegs::Anchors& anchors, std::size_t axis) {
  double sum = 0;
  for (const auto& anchor : anchors) sum += mid(anchor[axis]) / kLegs;
  return std::isfinite(sum) ? sum : 0;
}

Interval square_of(const Point& point) { return sqr(point[0]) + sqr(point[1]) + sqr(point[2]); }

Row row_of(const Point& a, const Point& b, const Interval& length) {
  Row row{};
  row[0] = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    row[1 + i] = Interval(2.0) * b[i];
    row[4 + i] = Interval(-2.0) * a[i];
    for (std::size_t j = 0; j < 3; ++j) row[kNumbers + 3 * i + j] = Interval(-2.0) * (a[i] * b[j]);
  }
  row[kConstant] = sqr(length) - square_of(a) - square_of(b);
  return row;
}

/// Elimination by Gauss and Jordan in intervals, the largest pivot next.
class Elimination {
 public:
  explicit Elimination(const std::array<Row, kLegs>& rows) : rows_(rows) {
    // Every coefficient of r is 1.
    eliminate({0, 0, 1});
    double largest = 0;
    while (const auto pivot = next_pivot()) {
      largest = std::max(largest, pivot->size);
      if (pivot->size < kLeastPivot * largest) break;
      eliminate(*pivot);
    }
  }

  /// The row that gives a number; nullptr: none does.
  [[nodiscard]] const Row* row_of(std::size_t number) const {
    return row_of_[number] ? &rows_[*row_of_[number]] : nullptr;
  }
  [[nodiscard]] std::vector<Row> left() const {
    std::vector<Row> result;
    for (std::size_t i = 0; i < kLegs; ++i)
      if (!is_used_[i]) result.push_back(rows_[i]);
    return result;
  }

 private:
  struct Pivot {
    std::size_t row = 0, number = 0;
    double size = 0;
  };

  [[nodiscard]] std::optional<Pivot> next_pivot() const {
    Pivot best;
    for (std::size_t i = 0; i < kLegs; ++i)
      for (std::size_t c = 0; !is_used_[i] && c < kNumbers; ++c)
        if (!row_of_[c] && mig(rows_[i][c]) > best.size) best = {i, c, mig(rows_[i][c])};
    return best.size > 0 ? std::optional(best) : std::nullopt;
  }

  void eliminate(const Pivot& pivot) {
    is_used_[pivot.row] = true;
    row_of_[pivot.number] = pivot.row;
    Row& row = rows_[pivot.row];
    const Interval divisor = row[pivot.number];
    for (Interval& x : row) x /= divisor;
    row[pivot.number] = 1.0;
    for (std::size_t i = 0; i < kLegs; ++i) {
      if (i == pivot.row) continue;
      const Interval factor = rows_[i][pivot.number];
      for (std::size_t c = 0; c < row.size(); ++c) rows_[i][c] -= factor * row[c];
      rows_[i][pivot.number] = 0.0;
    }
  }

  std::array<Row, kLegs> rows_;
  std::array<std::optional<std::size_t>, kNumbers> row_of_;
  std::array<bool, kLegs> is_used_{};
};

void set(double (&bounds)[2], const Interval& x) { bounds[0] = x.lo, bounds[1] = x.hi; }
Interval get(const double (&bounds)[2]) { return {bounds[0], bounds[1]}; }

/// `sign` times the row without its pivot, the right side on the left.
PoseForm form_of(const Row& row, double sign, const std::vector<std::size_t>& free) {
  PoseForm form{};
  set(form.constant, Interval(-sign) * row[kConstant]);
  for (std::size_t e = 0; e < kPartsOfR; ++e)
    set(form.by_rotation[e], Interval(sign) * row[kNumbers + e]);
  for (std::size_t k = 0; k < free.size(); ++k) set(form.by_free[k], Interval(sign) * row[free[k]]);
  return form;
}

/// One over a power of two near the largest coefficient.
double scale_of(const Row& row) {
  double largest = 0;
  for (const Interval& x : row) largest = std::max(largest, mag(x));
  return std::isnormal(largest) ? std::ldexp(1, -std::ilogb(largest)) : 1;
}

bool is_finite(const PoseForm& form) {
  const auto all = [](const auto& list) {
    return std::ranges::all_of(list, [](const auto& x) { return is_bounded(get(x)); });
  };
  return is_bounded(get(form.constant)) && all(form.by_rotation) && all(form.by_free);
}

}  // namespace

PoseEquations::PoseEquations(const GoughLegs& legs) : exponent_(exponent_of_size(legs)) {
  const auto scaled = [&](Interval x) { return times_power_of_two(x, -exponent_); };
  for (std::size_t k = 0; k < 3; ++k) {
    base_center_[k] = middle_of(legs.base, k);
    platform_center_[k] = middle_of(legs.platform, k);
  }
  std::array<Row, kLegs> rows;
  Interval reach(kInfinity);
  for (std::size_t i = 0; i < kLegs; ++i) {
    Point a, b;
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = scaled(legs.base[i][k] - Interval(base_center_[k]));
      b[k] = scaled(legs.platform[i][k] - Interval(platform_center_[k]));
    }
    const Interval length = scaled(legs.length[i]);
    rows[i] = row_of(a, b, length);
    const Interval longest = abs(length) + sqrt(square_of(a)) + sqrt(square_of(b));
    reach = Interval(std::min(reach.hi, longest.hi));
  }
  const Elimination elimination(rows);
  for (std::size_t c = 0; c < kNumbers; ++c)
    if (elimination.row_of(c) == nullptr) free_.push_back(c);
  bool is_sound = free_.size() <= kMostFreeNumbers && std::isfinite(reach.hi);
  if (!is_sound) {
    free_.clear();
    return;
  }
  forms_.free = static_cast<int>(free_.size());
  forms_.reach = reach.hi;
  for (std::size_t c = 0; c < kNumbers; ++c) {
    if (const Row* row = elimination.row_of(c)) {
      forms_.number[c] = form_of(*row, -1, free_);
    } else {
      const auto k = std::ranges::find(free_, c) - free_.begin();
      set(forms_.number[c].by_free[k], Interval(1.0));
    }
    is_sound = is_sound && is_finite(forms_.number[c]);
  }
  PoseForm* next = forms_.left;
  for (const Row& row : elimination.left()) {
    *next = form_of(row, scale_of(row), free_);
    is_sound = is_sound && is_finite(*next++);
  }
  if (!is_sound) free_.clear();
}

std::vector<Interval> PoseEquations::ranges() const {
  std::vector<Interval> result(3, Interval(-1 - kRoom, 1 + kRoom));
  const double reach = mul_ru(forms_.reach, 1 + kRoom);
  result.resize(unknowns(), Interval(-reach, reach));
  return result;
}

void PoseEquations::evaluate(int chart, const double* boxes, double* out, bool has_rates) const {
  const Isa isa = best_isa();
  const RoundingScope rounding(required_rounding(isa));
#if defined(__x86_64__)
  if (isa == Isa::kAvx512) return evaluate_poses_avx512(forms_, chart, boxes, out, has_rates);
  if (isa == Isa::kAvx2) return evaluate_poses_avx2(forms_, chart, boxes, out, has_rates);
#endif
  evaluate_poses_portable(forms_, chart, boxes, out, has_rates);
}

std::array<Interval, 4> PoseEquations::quaternion_of(int chart, std::span<const Interval> values) {
  std::array<Interval, 4> x;
  std::size_t k = 0;
  for (std::size_t i = 0; i < 4; ++i)
    x[i] = i == static_cast<std::size_t>(chart) ? Interval(1.0) : values[k++];
  return x;
}

GoughPose PoseEquations::pose_of(int chart, std::span<const Interval> values) const {
  const auto x = quaternion_of(chart, values);
  const Interval square = sqr(x[0]) + sqr(x[1]) + sqr(x[2]) + sqr(x[3]);
  const auto leading = std::ranges::find_if_not(x, contains_zero);
  const Interval norm = certain_negative(*leading) ? -sqrt(square) : sqrt(square);
  GoughPose pose;
  std::ranges::transform(x, pose.rotation.begin(),
                         [&](const Interval& part) { return part / norm; });
  const std::array<Interval, 9> R = rotation_matrix(pose.rotation);
  for (std::size_t i = 0; i < 3; ++i) {
    const PoseForm& form = forms_.number[4 + i];
    Interval t = get(form.constant), moved(0.0);
    for (std::size_t e = 0; e < kPartsOfR; ++e) t += get(form.by_rotation[e]) * R[e];
    for (std::size_t k = 0; k < free_.size(); ++k) t += get(form.by_free[k]) * values[3 + k];
    for (std::size_t j = 0; j < 3; ++j) moved += R[3 * i + j] * Interval(platform_center_[j]);
    pose.position[i] = times_power_of_two(t, exponent_) + Interval(base_center_[i]) - moved;
  }
  return pose;
}

}  // namespace regulus
