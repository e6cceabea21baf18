// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/extreme_values.hpp"

#include <algorithm>
#include <cmath>

#include "codegen/question/condition/rotated_matrix.hpp"

namespace regulus::detail {
namespace {

constexpr int kWeightSteps = 5;
constexpr double kLeastWeight = 1e-12;

}  // namespace

ExtremeValues::ExtremeValues(const std::vector<double>& off, std::size_t rows, std::size_t columns,
                             const Reach& high, const Reach& low)
    : off_(off), m_(rows), n_(columns) {
  top_ = std::size_t(std::ranges::max_element(high.goal) - high.goal.begin());
  low_ = std::size_t(std::ranges::min_element(low.goal) - low.goal.begin());
  top_weights_ = choose(high, top_, true);
  low_weights_ = choose(low, low_, false);
  for (std::size_t i = 0; i < m_; ++i) highest_.push_back(row(i, top_weights_));
  for (std::size_t j = 0; j < n_; ++j) highest_.push_back(column(j, top_weights_, m_));
  for (std::size_t i = 0; i < n_; ++i) lowest_.push_back(row(i, low_weights_));
  for (std::size_t j = 0; j < n_; ++j) lowest_.push_back(column(j, low_weights_, n_));
}

ExtremeValues::Weights ExtremeValues::choose(const Reach& reach, std::size_t pivot,
                                             bool largest) const {
  Weights w{std::vector<double>(n_, 0.0), std::vector<double>(m_, 0.0)};
  w.y[pivot] = w.z[pivot] = 1;
  for (int step = 0; step < kWeightSteps; ++step) balance(w, reach, pivot, largest);
  for (std::size_t i = largest ? m_ : n_; i < m_; ++i) w.z[i] = 1;  // they are not used
  return w;
}

/// Chooses the weights beside the pivot so that their bounds are equal to that of the pivot: for each
/// j the two equations of row and column j.
void ExtremeValues::balance(Weights& w, const Reach& reach, std::size_t pivot, bool largest) const {
  const std::size_t rows = largest ? m_ : n_;
  const double beside = along_row(pivot, w.y), d = reach.goal[pivot];
  const double goal = largest ? d + beside : std::max(d - beside, 0.0);
  const double least = kLeastWeight * goal;
  for (std::size_t j = 0; j < rows; ++j) {
    if (j == pivot) continue;
    const double a = std::max(along_row(j, w.y), least);
    if (j >= n_) {
      const double z = a / goal;
      w.z[j] = z < 1 ? z : 1;
      continue;
    }
    const double b = std::max(along_column(j, w.z, rows), least), D = reach.farthest[j];
    const double gap = largest ? goal * goal - D * D : D * D - goal * goal;
    const double y = (D * a + goal * b) / gap, z = (D * b + goal * a) / gap;
    const bool is_small = D > 0 && gap > 0 && y < 1 && z < 1;
    w.y[j] = is_small ? y : 1;
    w.z[j] = is_small ? z : 1;
  }
}

double ExtremeValues::along_row(std::size_t i, const std::vector<double>& y) const {
  double sum = 0;
  for (std::size_t j = 0; j < n_; ++j) sum += off_[i * n_ + j] * y[j];
  return sum;
}

double ExtremeValues::along_column(std::size_t j, const std::vector<double>& z,
                                   std::size_t rows) const {
  double sum = 0;
  for (std::size_t i = 0; i < rows; ++i) sum += off_[i * n_ + j] * z[i];
  return sum;
}

Disc ExtremeValues::row(std::size_t i, const Weights& w) const {
  const double beta = enlarged(along_row(i, w.y) / w.z[i]);
  return i < n_ ? Disc{i, w.y[i] / w.z[i], beta} : Disc{0, 0, beta};
}

Disc ExtremeValues::column(std::size_t j, const Weights& w, std::size_t rows) const {
  return {j, w.z[j] / w.y[j], enlarged(along_column(j, w.z, rows) / w.y[j])};
}

std::pair<double, double> ExtremeValues::shares(const std::vector<double>& part) const {
  return {share(part, top_, top_weights_, m_), share(part, low_, low_weights_, n_)};
}

double ExtremeValues::share(const std::vector<double>& part, std::size_t pivot, const Weights& w,
                            std::size_t rows) const {
  double sum = 0;
  for (std::size_t j = 0; j < n_; ++j)
    if (j != pivot) sum += part[pivot * n_ + j] * w.y[j];
  for (std::size_t i = 0; i < rows; ++i)
    if (i != pivot) sum += part[i * n_ + pivot] * w.z[i];
  return sum;
}

}  // namespace regulus::detail
