// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/stretched_vectors.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "codegen/question/condition/singular_vectors.hpp"

namespace regulus::detail {
namespace {

using Doubles = std::vector<double>;

/// Encloses |Ax|².
Interval square_of_image(std::span<const Interval> A, std::size_t rows, const Doubles& x) {
  Interval sum(0.0);
  for (std::size_t i = 0; i < rows; ++i) {
    Interval image(0.0);
    for (std::size_t j = 0; j < x.size(); ++j) image += A[i * x.size() + j] * Interval(x[j]);
    sum += sqr(image);
  }
  return sum;
}

Interval square_of_length(const Doubles& x) {
  Interval sum(0.0);
  for (const double c : x) sum += sqr(Interval(c));
  return sum;
}

/// Approximate right singular vectors: of the largest and of the least value.
struct ExtremeVectors {
  Doubles most, least;
};

std::optional<ExtremeVectors> extreme_vectors(std::span<const Interval> A, std::size_t rows,
                                              std::size_t columns) {
  Doubles middles;
  for (const Interval& a : A) middles.push_back(mid(a));
  const auto found = approx_singular_vectors(middles, rows, columns);
  if (!found) return std::nullopt;
  ExtremeVectors vectors;
  for (std::size_t j = 0; j < columns; ++j) {
    vectors.most.push_back(found->right[j * columns]);
    vectors.least.push_back(found->right[j * columns + columns - 1]);
  }
  return vectors;
}

}  // namespace

StretchedVectors attained_condition(std::span<const Interval> A, std::size_t rows,
                                    std::size_t columns) {
  StretchedVectors shown;
  auto found = extreme_vectors(A, rows, columns);
  if (!found) return shown;
  shown.most = std::move(found->most);
  shown.least = std::move(found->least);
  const Interval length = square_of_length(shown.least);
  const Interval high = square_of_image(A, rows, shown.most) * length;
  const Interval low = square_of_image(A, rows, shown.least) * square_of_length(shown.most);
  if (low.hi == 0 && length.lo > 0)
    shown.condition = kInfinity;
  else if (high.lo > 0 && is_bounded(low))
    shown.condition = std::max(1.0, sqrt_rd(div_rd(high.lo, low.hi)));
  return shown;
}

AttainedValues attained_values(std::span<const Interval> A, std::size_t rows, std::size_t columns) {
  AttainedValues shown;
  const auto found = extreme_vectors(A, rows, columns);
  if (!found) return shown;
  const Interval high = square_of_image(A, rows, found->most), most = square_of_length(found->most);
  const Interval low = square_of_image(A, rows, found->least),
                 least = square_of_length(found->least);
  if (high.lo > 0 && most.lo > 0 && is_bounded(most))
    shown.largest = sqrt_rd(div_rd(high.lo, most.hi));
  if (least.lo > 0 && is_bounded(low)) shown.least = sqrt_ru(div_ru(low.hi, least.lo));
  return shown;
}

}  // namespace regulus::detail
