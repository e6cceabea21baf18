// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/rotated_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {
namespace {

using Doubles = std::vector<double>;

Doubles magnitudes(const Doubles& values) {
  Doubles result;
  for (const double value : values) result.push_back(std::fabs(value));
  return result;
}

/// Returns a bound of |QᵀQ − I| in the 2-norm: the greatest sum of a row.
double error_of(const Doubles& Q, std::size_t n) {
  double error = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) {
      Interval entry(i == j ? -1.0 : 0.0);
      for (std::size_t l = 0; l < n; ++l) entry += Interval(Q[l * n + i]) * Interval(Q[l * n + j]);
      sum = add_ru(sum, mag(entry));
    }
    error = std::max(error, sum);
  }
  return error;
}

}  // namespace

Rotation::Rotation(const SingularVectors& vectors, std::size_t rows, std::size_t columns)
    : m_(rows),
      n_(columns),
      U_(vectors.left),
      V_(vectors.right),
      size_of_U_(magnitudes(U_)),
      size_of_V_(magnitudes(V_)) {}

Doubles Rotation::product(const Doubles& U, const Doubles& S, const Doubles& V) const {
  Doubles result(m_ * n_, 0.0), image(n_);
  for (std::size_t row = 0; row < m_; ++row) {
    std::ranges::fill(image, 0.0);
    bool is_zero = true;
    for (std::size_t l = 0; l < n_; ++l) {
      const double s = S[row * n_ + l];
      if (s == 0) continue;
      is_zero = false;
      for (std::size_t j = 0; j < n_; ++j) image[j] += s * V[l * n_ + j];
    }
    if (is_zero) continue;
    for (std::size_t i = 0; i < m_; ++i) {
      const double u = U[row * m_ + i];
      for (std::size_t j = 0; j < n_; ++j) result[i * n_ + j] += u * image[j];
    }
  }
  return result;
}

/// With γ_k = k·2^-53/(1 − k·2^-53), the product of the middles M has an error of at most
/// ((1 + γ_m)(1 + γ_n) − 1)·|U|ᵀ|M||V|, and (m + n + 2)·2^-52 is more than that factor. The radii R
/// of S add |U|ᵀR|V|. Underflow adds less than 1e-300, which enlarged() has.
void Rotation::split(std::span<const Interval> S, Doubles& middle, Doubles& radius) const {
  const double unit = static_cast<double>(m_ + n_ + 2) * 0x1p-52;
  for (std::size_t e = 0; e < S.size(); ++e) {
    middle[e] = mid(S[e]);
    radius[e] = rad_ru(S[e]) + unit * std::fabs(middle[e]);
  }
}

RoundMatrix Rotation::apply(std::span<const Interval> S) const {
  Doubles middle(m_ * n_), radius(m_ * n_);
  split(S, middle, radius);
  RoundMatrix result{product(U_, middle, V_), product(size_of_U_, radius, size_of_V_)};
  for (double& error : result.error) error = enlarged(error);
  return result;
}

RoundMatrix Rotation::apply_right(std::span<const Interval> S) const {
  Doubles middle(m_ * n_), radius(m_ * n_);
  split(S, middle, radius);
  RoundMatrix result{Doubles(m_ * n_, 0.0), Doubles(m_ * n_, 0.0)};
  for (std::size_t i = 0; i < m_; ++i)
    for (std::size_t l = 0; l < n_; ++l) {
      const double s = middle[i * n_ + l], r = radius[i * n_ + l];
      if (s == 0 && r == 0) continue;
      for (std::size_t j = 0; j < n_; ++j) {
        result.middle[i * n_ + j] += s * V_[l * n_ + j];
        result.error[i * n_ + j] += r * size_of_V_[l * n_ + j];
      }
    }
  for (double& error : result.error) error = enlarged(error);
  return result;
}

Distortion Rotation::distortion() const {
  const double left = error_of(U_, m_), right = error_of(V_, n_);
  if (!(left < 0.5 && right < 0.5)) return {};
  const double above = mul_ru(add_ru(1, left), add_ru(1, right));
  const double below = mul_rd(sub_rd(1, left), sub_rd(1, right));
  return {sqrt_ru(div_ru(above, below)), sqrt_ru(div_ru(1, below)), sqrt_ru(above)};
}

}  // namespace regulus::detail
