// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/quantity/determinant_of_inverse.hpp"

#include <bit>
#include <cstddef>
#include <vector>

namespace regulus::detail {
namespace {

using GiNaC::ex;

/// Returns det A: minors[S] is that of the first |S| rows and the columns of S.
ex expansion(const GiNaC::matrix& A) {
  const unsigned n = A.rows();
  std::vector<ex> minors(std::size_t{1} << n, 0);
  minors[0] = 1;
  for (std::size_t set = 1; set < minors.size(); ++set) {
    const auto row = static_cast<unsigned>(std::popcount(set)) - 1;
    int sign = row % 2 == 0 ? 1 : -1;
    for (unsigned j = 0; j < n; ++j) {
      const std::size_t column = std::size_t{1} << j;
      if ((set & column) == 0) continue;
      minors[set] += sign * A(row, j) * minors[set & ~column];
      sign = -sign;
    }
  }
  return minors.back();
}

}  // namespace

ex determinant_of_inverse(const Model& model) {
  ex result = expansion(model.matrix);
  for (const ex& scale : model.row_scale) result *= scale;
  return result;
}

}  // namespace regulus::detail
