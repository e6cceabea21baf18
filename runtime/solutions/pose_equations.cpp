// SPDX-License-Identifier: Apache-2.0
#include "runtime/solutions/pose_equations.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/interval/isa.hpp"
#include "runtime/kernel/isa.hpp"
#include "runtime/kernel/rounding_scope.hpp"

namespace regulus::detail {

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

/// The coefficients of r, s, t and of R on the left side, and the right side; then the coefficients of
/// the deviations on the right side.
using Row = std::array<Interval, kConstant + 1 + kLegs>;
using Point = std::array<Interval, 3>;

double middle_of(const GoughLegs::Anchors& anchors, std::size_t axis) {
  double sum = 0;
  for (const auto& anchor : anchors) sum += mid(anchor[axis]) / kLegs;
  return std::isfinite(sum) ? sum : 0;
}

Interval square_of(const Point& point) { return sqr(point[0]) + sqr(point[1]) + sqr(point[2]); }

Row row_of(const Point& a, const Point& b, const Interval& length, std::size_t leg) {
  Row row{};
  row[0] = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    row[1 + i] = Interval(2.0) * b[i];
    row[4 + i] = Interval(-2.0) * a[i];
    for (std::size_t j = 0; j < 3; ++j) row[kNumbers + 3 * i + j] = Interval(-2.0) * (a[i] * b[j]);
  }
  row[kConstant] = sqr(length) - square_of(a) - square_of(b);
  row[kConstant + 1 + leg] = 1.0;
  return row;
}

}  // namespace

/// Elimination by Gauss and Jordan in intervals, the largest pivot next, or in a given order.
class PoseEquations::Elimination {
 public:
  Elimination(const std::array<Row, kLegs>& rows, const std::vector<Pivot>& order) : rows_(rows) {
    if (!order.empty()) {
      for (const Pivot& pivot : order) eliminate(pivot);
      return;
    }
    // Every coefficient of r is 1.
    eliminate({0, 0});
    double largest = 0;
    while (const auto pivot = next_pivot()) {
      const double size = mig(rows_[pivot->row][pivot->number]);
      largest = std::max(largest, size);
      if (size < kLeastPivot * largest) break;
      eliminate(*pivot);
    }
  }

  /// The row that gives a number; nullptr: none does.
  [[nodiscard]] const Row* row_of(std::size_t number) const {
    for (const Pivot& pivot : order_)
      if (pivot.number == number) return &rows_[pivot.row];
    return nullptr;
  }
  [[nodiscard]] std::vector<Row> left() const {
    std::vector<Row> result;
    for (std::size_t i = 0; i < kLegs; ++i)
      if (!is_used(i)) result.push_back(rows_[i]);
    return result;
  }
  [[nodiscard]] const std::vector<Pivot>& order() const { return order_; }

 private:
  [[nodiscard]] bool is_used(std::size_t row) const {
    return std::ranges::any_of(order_, [row](const Pivot& p) { return p.row == row; });
  }

  [[nodiscard]] std::optional<Pivot> next_pivot() const {
    Pivot best;
    double size = 0;
    for (std::size_t i = 0; i < kLegs; ++i)
      for (std::size_t c = 0; !is_used(i) && c < kNumbers; ++c)
        if (row_of(c) == nullptr && mig(rows_[i][c]) > size) best = {i, c}, size = mig(rows_[i][c]);
    return size > 0 ? std::optional(best) : std::nullopt;
  }

  /// A pivot that may be 0 makes the row unbounded.
  void eliminate(const Pivot& pivot) {
    order_.push_back(pivot);
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
  std::vector<Pivot> order_;
};

namespace {

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
  for (std::size_t c = 0; c < kConstant; ++c) largest = std::max(largest, mag(row[c]));
  return std::isnormal(largest) ? std::ldexp(1, -std::ilogb(largest)) : 1;
}

bool is_finite(const PoseForm& form) {
  const auto all = [](const auto& list) {
    return std::ranges::all_of(list, [](const auto& x) { return is_bounded(get(x)); });
  };
  return is_bounded(get(form.constant)) && all(form.by_rotation) && all(form.by_free);
}

}  // namespace

PoseEquations::PoseEquations(const GoughLegs& legs, const std::array<Interval, 6>& deviations,
                             const PoseEquations* like)
    : exponent_(like != nullptr ? like->exponent_ : exponent_of_size(legs)) {
  const auto scaled = [&](Interval x) { return times_power_of_two(x, -exponent_); };
  for (std::size_t k = 0; k < 3; ++k) {
    base_center_[k] = like != nullptr ? like->base_center_[k] : middle_of(legs.base, k);
    platform_center_[k] = like != nullptr ? like->platform_center_[k] : middle_of(legs.platform, k);
  }
  std::array<Row, kLegs> rows;
  double reach = kInfinity;
  for (std::size_t i = 0; i < kLegs; ++i) {
    Point a, b;
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = scaled(legs.base[i][k] - Interval(base_center_[k]));
      b[k] = scaled(legs.platform[i][k] - Interval(platform_center_[k]));
    }
    const Interval length = scaled(legs.length[i]);
    rows[i] = row_of(a, b, length, i);
    deviations_[i] = times_power_of_two(deviations[i], -2 * exponent_);
    have_deviations_ = have_deviations_ || deviations[i] != Interval(0.0);
    const Interval longest = sqrt(Interval(mag(sqr(length) + deviations_[i])));
    reach = std::fmin(reach, (longest + sqrt(square_of(a)) + sqrt(square_of(b))).hi);
  }
  forms_.reach = reach;
  make_forms(Elimination(rows, like != nullptr ? like->pivots_ : std::vector<Pivot>()));
}

void PoseEquations::make_forms(const Elimination& elimination) {
  pivots_ = elimination.order();
  for (std::size_t c = 0; c < kNumbers; ++c)
    if (elimination.row_of(c) == nullptr) free_.push_back(c);
  bool is_sound = free_.size() <= kMostFreeNumbers && std::isfinite(forms_.reach);
  forms_.free = static_cast<int>(is_sound ? free_.size() : 0);
  for (std::size_t c = 0; is_sound && c < kNumbers; ++c) {
    if (const Row* row = elimination.row_of(c)) {
      forms_.number[c] = form_of(*row, -1, free_);
      std::copy_n(row->end() - kLegs, kLegs, number_by_deviation_[c].begin());
    } else {
      const auto k = std::ranges::find(free_, c) - free_.begin();
      set(forms_.number[c].by_free[k], Interval(1.0));
    }
    is_sound = is_finite(forms_.number[c]);
  }
  const std::vector<Row> left = elimination.left();
  for (std::size_t i = 0; is_sound && i < left.size(); ++i) {
    const double scale = scale_of(left[i]);
    forms_.left[i] = form_of(left[i], scale, free_);
    for (std::size_t k = 0; k < kLegs; ++k)
      left_by_deviation_[i][k] = Interval(-scale) * left[i][kConstant + 1 + k];
    is_sound = is_finite(forms_.left[i]);
  }
  if (!is_sound) free_.clear();
  exact_ = forms_;
  const auto add = [this](PoseForm& form, const std::array<Interval, kLegs>& by_deviation) {
    Interval sum = get(form.constant);
    for (std::size_t k = 0; k < kLegs; ++k) sum += by_deviation[k] * deviations_[k];
    set(form.constant, sum);
  };
  for (std::size_t c = 0; c < kNumbers; ++c) add(forms_.number[c], number_by_deviation_[c]);
  for (std::size_t i = 0; i + 1 < free_.size(); ++i) add(forms_.left[i], left_by_deviation_[i]);
}

std::vector<Interval> PoseEquations::ranges() const {
  std::vector<Interval> result(3, Interval(-1 - kRoom, 1 + kRoom));
  const double reach = mul_ru(forms_.reach, 1 + kRoom);
  result.resize(unknowns(), Interval(-reach, reach));
  return result;
}

namespace {

void evaluate_forms(const PoseForms& forms, int chart, const double* boxes, double* out,
                    bool has_rates) {
  const Isa isa = best_isa();
  const RoundingScope rounding(required_rounding(isa));
#if defined(__x86_64__)
  if (isa == Isa::kAvx512) return evaluate_poses_avx512(forms, chart, boxes, out, has_rates);
  if (isa == Isa::kAvx2) return evaluate_poses_avx2(forms, chart, boxes, out, has_rates);
#endif
  evaluate_poses_portable(forms, chart, boxes, out, has_rates);
}

std::array<Interval, 4> unit(const std::array<Interval, 4>& x) {
  const Interval square = sqr(x[0]) + sqr(x[1]) + sqr(x[2]) + sqr(x[3]);
  const auto leading = std::ranges::find_if_not(x, contains_zero);
  const Interval norm = certain_negative(*leading) ? -sqrt(square) : sqrt(square);
  std::array<Interval, 4> result;
  std::ranges::transform(x, result.begin(), [&](const Interval& part) { return part / norm; });
  return result;
}

Interval value_of(const PoseForm& form, const std::array<Interval, kPartsOfR>& R,
                  std::span<const Interval> free) {
  Interval value = get(form.constant);
  for (std::size_t e = 0; e < kPartsOfR; ++e) value += get(form.by_rotation[e]) * R[e];
  for (std::size_t k = 0; k < free.size(); ++k) value += get(form.by_free[k]) * free[k];
  return value;
}

}  // namespace

void PoseEquations::evaluate(int chart, const double* boxes, double* out, bool has_rates) const {
  evaluate_forms(forms_, chart, boxes, out, has_rates);
}
void PoseEquations::evaluate_exact(int chart, const double* boxes, double* out,
                                   bool has_rates) const {
  evaluate_forms(exact_, chart, boxes, out, has_rates);
}

/// With N = number_by_deviation_ and deviations e, s − Rᵀt changes by (N_s − RᵀN_t)e, and r − |t|² by
/// (N_r − 2t·N_t)e − |N_t e|².
PoseEquations::Spread PoseEquations::spread_at(int chart, std::span<const Interval> point) const {
  const auto R = rotation_matrix(unit(quaternion_of(chart, point)));
  Spread spread;
  for (std::size_t i = 0; i + 1 < free_.size(); ++i)
    spread.by_deviation.insert(spread.by_deviation.end(), left_by_deviation_[i].begin(),
                               left_by_deviation_[i].end());
  std::array<Interval, kLegs> last = number_by_deviation_[0];
  spread.bend = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval t = value_of(exact_.number[4 + i], R, point.subspan(3));
    Interval moved(0.0);
    for (std::size_t k = 0; k < kLegs; ++k) {
      Interval turned = number_by_deviation_[1 + i][k];
      for (std::size_t j = 0; j < 3; ++j) turned -= R[3 * j + i] * number_by_deviation_[4 + j][k];
      spread.by_deviation.push_back(turned);
      last[k] -= Interval(2.0) * t * number_by_deviation_[4 + i][k];
      moved += number_by_deviation_[4 + i][k] * deviations_[k];
    }
    spread.bend -= sqr(moved);
  }
  spread.by_deviation.insert(spread.by_deviation.end(), last.begin(), last.end());
  return spread;
}

std::array<Interval, 4> PoseEquations::quaternion_of(int chart, std::span<const Interval> values) {
  std::array<Interval, 4> x;
  std::size_t k = 0;
  for (std::size_t i = 0; i < 4; ++i)
    x[i] = i == static_cast<std::size_t>(chart) ? Interval(1.0) : values[k++];
  return x;
}

GoughPose PoseEquations::pose_of(int chart, std::span<const Interval> values) const {
  GoughPose pose;
  pose.rotation = unit(quaternion_of(chart, values));
  const std::array<Interval, kPartsOfR> R = rotation_matrix(pose.rotation);
  for (std::size_t i = 0; i < 3; ++i) {
    const Interval t = value_of(forms_.number[4 + i], R, values.subspan(3));
    Interval moved(0.0);
    for (std::size_t j = 0; j < 3; ++j) moved += R[3 * i + j] * Interval(platform_center_[j]);
    pose.position[i] = times_power_of_two(t, exponent_) + Interval(base_center_[i]) - moved;
  }
  return pose;
}

}  // namespace regulus::detail
