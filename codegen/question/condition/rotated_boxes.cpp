// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/rotated_boxes.hpp"

#include <algorithm>
#include <cmath>

namespace regulus::detail {
namespace {

using Doubles = std::vector<double>;
using Intervals = std::vector<Interval>;

std::optional<SingularVectors> vectors_at(std::span<const Interval> center, std::size_t rows,
                                          std::size_t columns) {
  Doubles middles;
  for (const Interval& a : center) middles.push_back(mid(a));
  return approx_singular_vectors(middles, rows, columns);
}

RotatedBox begin_box(const Intervals& center, const Rotation& rotation, std::size_t rows,
                     std::size_t columns) {
  RotatedBox box{rows, columns, rotation.apply(center), {}, {}, {}, rotation.distortion()};
  return box;
}

/// Adds |S|·factor to `to`.
void add_magnitudes(const RoundMatrix& S, double factor, Doubles& to) {
  for (std::size_t e = 0; e < to.size(); ++e)
    to[e] = enlarged(to[e] + (std::fabs(S.middle[e]) + S.error[e]) * factor);
}

/// Adds `error` times the sums of the columns to every component.
void add_column_sums(const Doubles& W, double error, std::size_t columns, Doubles& to) {
  for (std::size_t j = 0; j < columns; ++j) {
    double sum = 0;
    for (std::size_t e = j; e < W.size(); e += columns) sum += W[e];
    for (std::size_t e = j; e < W.size(); e += columns) to[e] = enlarged(to[e] + error * sum);
  }
}

}  // namespace

std::optional<RotatedBox> rotate(const BoxMatrix& box, std::size_t rows, std::size_t columns) {
  const auto vectors = vectors_at(box.center, rows, columns);
  if (!vectors) return std::nullopt;
  const Rotation rotation(*vectors, rows, columns);
  RotatedBox result = begin_box(box.center, rotation, rows, columns);
  const std::size_t size = rows * columns;
  for (std::size_t k = 0; k < box.radius.size(); ++k)
    result.slopes.push_back(rotation.apply(std::span(box.slopes).subspan(k * size, size)));
  result.radius = box.radius;
  return result;
}

RotatedBoxes::RotatedBoxes(const Problem& problem, const MatrixScaling& scaling)
    : scaling_(scaling),
      m_(problem.kernel->rows),
      n_(problem.kernel->columns),
      variables_(problem.kernel->variables),
      parts_((m_ + n_ - 1) / n_),
      matrices_(problem, scaling, variables_) {
  if (is_plain()) return;
  for (std::size_t part = 0; part < parts_; ++part) {
    K_.emplace_back(kLanes * m_ * n_);
    first_.emplace_back(2 * kLanes * std::max<std::size_t>(expansion().first.count, 1));
    second_.emplace_back(2 * kLanes * std::max<std::size_t>(expansion().second.count, 1));
  }
}

void RotatedBoxes::evaluate(std::span<const Box> boxes) {
  matrices_.evaluate(boxes);
  count_ = boxes.size();
  if (is_plain()) return;
  factors_.assign(kLanes, {});
  for (std::size_t lane = 0; lane < count_; ++lane) choose_factor(lane);
  call_parts();
}

/// Chooses Û. All lanes need some K.
void RotatedBoxes::choose_factor(std::size_t lane) {
  if (!matrices_.is_defined(lane)) return;
  Factor& factor = factors_[lane];
  factor.vectors = vectors_at(matrices_.matrix(lane).center, m_, n_);
  if (!factor.vectors) return;
  const Doubles K = on_grid(*factor.vectors);  // m×m, of the kernel's matrix
  double longest = 0, total = 0;
  for (std::size_t i = 0; i < m_; ++i) {
    double length = 0;
    for (std::size_t row = 0; row < m_; ++row) {
      const int e = scaling_.empty() ? 0 : scaling_.rows[row];
      const double u = factor.vectors->left[row * m_ + i];
      const double difference = std::fabs(std::ldexp(K[i * m_ + row], e) - u);
      length += difference;
      K_[i / n_][((i % n_) * m_ + row) * kLanes + lane] = K[i * m_ + row];
    }
    longest = std::max(longest, length);
    total += length;
  }
  // |Û⁻¹| ≤ |U⁻ᵀ|/(1 − |U⁻ᵀ|·|Uᵀ − Û|), and |U⁻ᵀ|² ≤ 2 unless the distortion is infinite.
  factor.error = total < 0.25 ? enlarged(3 * longest) : kInfinity;
}

/// Returns Û for the kernel's matrix, whose rows are 2^rows[i] times ours.
Doubles RotatedBoxes::on_grid(const SingularVectors& vectors) const {
  Doubles K(m_ * m_);
  for (std::size_t i = 0; i < m_; ++i) {
    double greatest = 0;
    for (std::size_t row = 0; row < m_; ++row) {
      const int e = scaling_.empty() ? 0 : -scaling_.rows[row];
      K[i * m_ + row] = std::ldexp(vectors.left[row * m_ + i], e);
      greatest = std::max(greatest, std::fabs(K[i * m_ + row]));
    }
    const double step = std::ldexp(1.0, std::ilogb(greatest) + 2 - REGULUS_POINT_BITS);
    for (std::size_t row = 0; row < m_; ++row)
      K[i * m_ + row] = std::nearbyint(K[i * m_ + row] / step) * step;
  }
  return K;
}

/// Derivatives that are zero have no function: then the matrix itself shows that it is defined.
void RotatedBoxes::call_parts() {
  const CheckedKernel& kernel = matrices_.kernel();
  defined_ = kAllLanes;
  if (expansion().second.function == nullptr) {
    AlignedBuffer entries(2 * kLanes * m_ * n_);
    defined_ &= ~kernel.call(kernel.functions().matrix, matrices_.box_lanes().get(), nullptr,
                             entries.get());
  }
  for (std::size_t part = 0; part < parts_; ++part) {
    const double* K = K_[part].get();
    if (expansion().first.function != nullptr)
      defined_ &= ~kernel.call(expansion().first.function, matrices_.center_lanes().get(), K,
                               first_[part].get());
    if (expansion().second.function != nullptr)
      defined_ &= ~kernel.call(expansion().second.function, matrices_.box_lanes().get(), K,
                               second_[part].get());
  }
}

/// Returns the enclosed derivatives ÛA', m×n: of each variable, or of each pair p·variables + q, with
/// no entries if it is zero.
std::vector<Intervals> RotatedBoxes::derivatives(const regulus_derivatives& of,
                                                 const std::vector<AlignedBuffer>& values,
                                                 std::size_t lane, bool second) const {
  std::vector<Intervals> result(second ? variables_ * variables_ : variables_);
  for (std::size_t part = 0; part < parts_; ++part)
    for (std::size_t output = 0; output < of.count; ++output) {
      const regulus_derivative& place = of.list[output];
      const std::size_t row = part * n_ + place.row;
      if (row >= m_) continue;
      Intervals& matrix = result[second ? place.first * variables_ + place.second : place.first];
      if (matrix.empty()) matrix.assign(m_ * n_, Interval(0.0));
      Interval value(values[part][lower_at(output, lane)], values[part][upper_at(output, lane)]);
      if (!scaling_.empty()) value = times_power_of_two(value, -scaling_.columns[place.column]);
      matrix[row * n_ + place.column] = value;
    }
  return result;
}

std::optional<RotatedBox> RotatedBoxes::rotated(std::size_t lane) const {
  if (!matrices_.is_defined(lane)) return std::nullopt;
  if (is_plain()) return rotate(matrices_.matrix(lane), m_, n_);
  const Factor& factor = factors_[lane];
  if (!has_lane(defined_, lane) || !factor.vectors || !std::isfinite(factor.error))
    return std::nullopt;
  const Rotation rotation(*factor.vectors, m_, n_);
  RotatedBox box = begin_box(matrices_.matrix(lane).center, rotation, m_, n_);
  box.radius = matrices_.radius(lane);
  for (const Intervals& slope : derivatives(expansion().first, first_, lane, false))
    box.slopes.push_back(slope.empty() ? RoundMatrix{Doubles(m_ * n_, 0.0), Doubles(m_ * n_, 0.0)}
                                       : rotation.apply_right(slope));
  box.rest.assign(variables_, Doubles(m_ * n_, 0.0));
  const auto second = derivatives(expansion().second, second_, lane, true);
  for (std::size_t p = 0; p < variables_; ++p)
    for (std::size_t q = p; q < variables_; ++q) {
      const Intervals& S = second[p * variables_ + q];
      if (S.empty()) continue;
      const RoundMatrix Z = rotation.apply_right(S);
      const double half = box.radius[p] * box.radius[q] / 2;
      add_magnitudes(Z, half, box.rest[p]);
      if (p != q) add_magnitudes(Z, half, box.rest[q]);
    }
  for (std::size_t k = 0; k < variables_; ++k) {
    Doubles W = box.rest[k];
    add_magnitudes(box.slopes[k], box.radius[k], W);
    add_column_sums(W, factor.error, n_, box.rest[k]);
  }
  return box;
}

}  // namespace regulus::detail
