// SPDX-License-Identifier: Apache-2.0
// The equations of poses over eight boxes, for the instruction set that the including file is compiled
// for. REGULUS_POSE_LANES names the function.
#pragma once

#include "runtime/kernel/pack.hpp"
#include "runtime/solutions/pose_forms.hpp"

namespace regulus::detail {

/// Shape     boxes: the unknowns of a chart; out: PoseRows. Interval layout (runtime/interval/lanes.hpp).
/// Ensures   enclosures over the boxes. Rates are written if `has_rates`.
/// Rounding  outward; MXCSR as the packs need it.
void REGULUS_POSE_LANES(const PoseForms& forms, int chart, const double* boxes, double* out,
                        bool has_rates);

namespace {

using pack::I;
using pack::P;

constexpr int kLanesOfPack = 8;

I constant(const double (&bounds)[2]) { return pack::constant(bounds[0], bounds[1]); }

/// part/(part + rest), which increases with part and decreases with rest.
I share(I part, I rest) {
  alignas(64) double a[2 * kLanesOfPack], b[2 * kLanesOfPack], least[2 * kLanesOfPack],
      greatest[2 * kLanesOfPack];
  pack::store(a, 0, part);
  pack::store(b, 0, rest);
  const auto quotient = [](const double* of, const double* with, double* result) {
    alignas(64) double x[2 * kLanesOfPack], y[2 * kLanesOfPack];
    for (int l = 0; l < kLanesOfPack; ++l)
      x[l] = x[kLanesOfPack + l] = of[l], y[l] = y[kLanesOfPack + l] = with[l];
    unsigned undefined = 0;  // the sum is at least 1
    const I numerator = pack::load(x, 0);
    pack::store(result, 0, pack::div(numerator, numerator + pack::load(y, 0), undefined));
  };
  quotient(a, b + kLanesOfPack, least);
  quotient(a + kLanesOfPack, b, greatest);
  for (int l = 0; l < kLanesOfPack; ++l) least[kLanesOfPack + l] = greatest[kLanesOfPack + l];
  return pack::load(least, 0);
}

/// The vector of conj(p)·q for the units p and q of quaternions: ±1 in one place, or 0.
struct UnitProduct {
  int place = -1;
  double sign = 0;
};
constexpr UnitProduct kUnitProducts[4][4] = {{{-1, 0}, {0, 1}, {1, 1}, {2, 1}},
                                             {{0, -1}, {-1, 0}, {2, -1}, {1, 1}},
                                             {{1, -1}, {2, 1}, {-1, 0}, {0, -1}},
                                             {{2, -1}, {1, -1}, {0, 1}, {-1, 0}}};

/// R(x) with x_chart = 1, and its derivatives by the other parts of x: R·[ω]×, where ω is twice the
/// vector of x̄·e/(x·x), e the unit of that part.
struct Turn {
  I R[9];
  I rate[3][9];
  I second[3][3][9];
};

/// Rows of R times [ω]×.
void turn_rows(const I* R, const I* omega, I* result) {
  for (int i = 0; i < 9; i += 3) {
    result[i] = R[i + 1] * omega[2] - R[i + 2] * omega[1];
    result[i + 1] = R[i + 2] * omega[0] - R[i] * omega[2];
    result[i + 2] = R[i] * omega[1] - R[i + 1] * omega[0];
  }
}

void find_turn(int chart, const I* parts, bool has_second, Turn& turn) {
  I x[4], square[4];
  int unit[3] = {};
  for (int i = 0, k = 0; i < 4; ++i) {
    if (i != chart) unit[k] = i;
    x[i] = i == chart ? pack::constant(1.0, 1.0) : parts[k++];
    square[i] = pack::sqr(x[i]);
  }
  const I norm = square[0] + square[1] + square[2] + square[3];
  unsigned undefined = 0;
  const I twice = pack::div(pack::constant(2.0, 2.0), norm, undefined);
  const auto diagonal = [&](int i, int j, int k) {
    return P(1.0) - P(2.0) * share(square[j] + square[k], square[0] + square[i]);
  };
  turn.R[0] = diagonal(1, 2, 3), turn.R[4] = diagonal(2, 3, 1), turn.R[8] = diagonal(3, 1, 2);
  const auto sides = [&](int i, int j, int k, I& lower, I& upper) {
    const I symmetric = x[i] * x[j], turned = x[0] * x[k];
    lower = (symmetric + turned) * twice;
    upper = (symmetric - turned) * twice;
  };
  sides(1, 2, 3, turn.R[3], turn.R[1]);
  sides(2, 3, 1, turn.R[7], turn.R[5]);
  sides(3, 1, 2, turn.R[2], turn.R[6]);

  I omega[3][3];
  for (int l = 0; l < 3; ++l) {
    for (int i = 0; i < 4; ++i) {
      const UnitProduct product = kUnitProducts[i][unit[l]];
      if (product.place >= 0) omega[l][product.place] = P(product.sign) * (x[i] * twice);
    }
    turn_rows(turn.R, omega[l], turn.rate[l]);
  }
  for (int l = 0; has_second && l < 3; ++l)
    for (int m = l; m < 3; ++m) {
      // The derivative of ω by part m.
      const UnitProduct product = kUnitProducts[unit[m]][unit[l]];
      const I change = x[unit[m]] * twice;
      I rate[3], more[9];
      for (int i = 0; i < 3; ++i) {
        rate[i] = -(omega[l][i] * change);
        if (product.place == i) rate[i] = rate[i] + P(product.sign) * twice;
      }
      turn_rows(turn.rate[m], omega[l], turn.second[l][m]);
      turn_rows(turn.R, rate, more);
      for (int e = 0; e < 9; ++e)
        turn.second[m][l][e] = turn.second[l][m][e] = turn.second[l][m][e] + more[e];
    }
}

/// The sum of coefficients times parts of R, or of its derivative.
I by_rotation(const PoseForm& form, const I* R) {
  I sum = constant(form.by_rotation[0]) * R[0];
  for (int e = 1; e < 9; ++e) sum = pack::mul_add(constant(form.by_rotation[e]), R[e], sum);
  return sum;
}

class PoseLanes {
 public:
  PoseLanes(const PoseForms& forms, int chart, const double* boxes, bool has_rates)
      : forms_(forms), n_(3 + forms.free) {
    for (int k = 0; k < n_; ++k) unknown_[k] = pack::load(boxes, k);
    find_turn(chart, unknown_, has_rates, turn_);
    for (int c = 0; c < 7; ++c) {
      number_[c] = value(forms.number[c]);
      for (int l = 0; l < n_; ++l) rate_[c][l] = rate(forms.number[c], l);
    }
  }

  void put(double* out, bool has_rates) const {
    const PoseRows rows{n_};
    const int left = forms_.free - 1;
    const auto put_derivative = [&](int equation, int l, I x) {
      pack::store(out, rows.derivatives() + equation * n_ + l, x);
    };
    for (int e = 0; e < left; ++e) {
      pack::store(out, e, value(forms_.left[e]));
      for (int l = 0; l < n_; ++l) put_derivative(e, l, rate(forms_.left[e], l));
    }
    for (int j = 0; j < 3; ++j) {
      pack::store(out, left + j, gap_of_s(j));
      for (int l = 0; l < n_; ++l) put_derivative(left + j, l, rate_of_s(j, l));
    }
    pack::store(out, left + 3, gap_of_r(t()));
    for (int l = 0; l < n_; ++l) put_derivative(left + 3, l, rate_of_r(l));
    put_extras(out, rows.extras());
    if (!has_rates) return;
    for (int l = 0; l < n_; ++l)
      for (int m = l; m < n_; ++m)
        for (int e = 0; e < n_; ++e) {
          const I x = e < left       ? second(forms_.left[e], l, m)
                      : e < left + 3 ? second_of_s(e - left, l, m)
                                     : second_of_r(l, m);
          pack::store(out, rows.rates() + (l * n_ + e) * n_ + m, x);
          pack::store(out, rows.rates() + (m * n_ + e) * n_ + l, x);
        }
  }

 private:
  [[nodiscard]] const I& r() const { return number_[0]; }
  [[nodiscard]] const I* s() const { return number_ + 1; }
  [[nodiscard]] const I* t() const { return number_ + 4; }
  [[nodiscard]] const I& R(int i, int j) const { return turn_.R[3 * i + j]; }
  [[nodiscard]] I rate_of_R(int l, int i, int j) const { return turn_.rate[l][3 * i + j]; }

  [[nodiscard]] I value(const PoseForm& form) const {
    I sum = by_rotation(form, turn_.R) + constant(form.constant);
    for (int k = 0; k < forms_.free; ++k)
      sum = pack::mul_add(constant(form.by_free[k]), unknown_[3 + k], sum);
    return sum;
  }
  [[nodiscard]] I rate(const PoseForm& form, int l) const {
    return l < 3 ? by_rotation(form, turn_.rate[l]) : constant(form.by_free[l - 3]);
  }
  /// By two unknowns; l ≤ m.
  [[nodiscard]] I second(const PoseForm& form, int l, int m) const {
    return m < 3 ? by_rotation(form, turn_.second[l][m]) : pack::constant(0.0, 0.0);
  }

  /// s − Rᵀt
  [[nodiscard]] I gap_of_s(int j) const {
    I sum = s()[j];
    for (int i = 0; i < 3; ++i) sum = sum - R(i, j) * t()[i];
    return sum;
  }
  [[nodiscard]] I rate_of_s(int j, int l) const {
    I sum = rate_[1 + j][l];
    for (int i = 0; i < 3; ++i) {
      sum = sum - R(i, j) * rate_[4 + i][l];
      if (l < 3) sum = sum - rate_of_R(l, i, j) * t()[i];
    }
    return sum;
  }
  [[nodiscard]] I second_of_s(int j, int l, int m) const {
    I sum = second(forms_.number[1 + j], l, m);
    for (int i = 0; i < 3; ++i) {
      if (m < 3)
        sum = sum - turn_.second[l][m][3 * i + j] * t()[i] -
              R(i, j) * second(forms_.number[4 + i], l, m);
      if (l < 3) sum = sum - rate_of_R(l, i, j) * rate_[4 + i][m];
      if (m < 3) sum = sum - rate_of_R(m, i, j) * rate_[4 + i][l];
    }
    return sum;
  }

  /// r − |t|², or the same of s.
  [[nodiscard]] I gap_of_r(const I* t) const {
    return r() - (pack::sqr(t[0]) + pack::sqr(t[1]) + pack::sqr(t[2]));
  }
  [[nodiscard]] I rate_of_r(int l) const {
    I sum = rate_[0][l];
    for (int i = 0; i < 3; ++i) sum = sum - P(2.0) * (t()[i] * rate_[4 + i][l]);
    return sum;
  }
  [[nodiscard]] I second_of_r(int l, int m) const {
    I sum = second(forms_.number[0], l, m);
    for (int i = 0; i < 3; ++i)
      sum = sum - P(2.0) * (rate_[4 + i][l] * rate_[4 + i][m] +
                            t()[i] * second(forms_.number[4 + i], l, m));
    return sum;
  }

  /// Puts what tells that s or t is too long, and the gaps of t = Rs and r = |s|².
  void put_extras(double* out, int row) const {
    const I within = pack::constant(-forms_.reach, forms_.reach);
    for (int i = 0; i < 3; ++i) {
      pack::store(out, row++, s()[i] - within);
      pack::store(out, row++, t()[i] - within);
      I sum = t()[i];
      for (int j = 0; j < 3; ++j) sum = sum - R(i, j) * s()[j];
      pack::store(out, row++, sum);
    }
    pack::store(out, row, gap_of_r(s()));
  }

  const PoseForms& forms_;
  const int n_;
  I unknown_[kMostPoseUnknowns];
  Turn turn_;
  I number_[7];
  I rate_[7][kMostPoseUnknowns];
};

}  // namespace

void REGULUS_POSE_LANES(const PoseForms& forms, int chart, const double* boxes, double* out,
                        bool has_rates) {
  PoseLanes(forms, chart, boxes, has_rates).put(out, has_rates);
}

}  // namespace regulus::detail
