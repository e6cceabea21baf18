// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/model/spline.hpp"

#include <cstddef>

namespace regulus::verifier {

/// By the second derivatives M, which are 0 at both ends:
/// h_{k−1}M_{k−1} + 2(h_{k−1} + h_k)M_k + h_kM_{k+1} = 6(d_k − d_{k−1}).
std::vector<double> approx_spline_slopes(const std::vector<double>& times,
                                         const std::vector<double>& values) {
  const std::size_t n = values.size();
  std::vector<double> h(n - 1), d(n - 1), M(n), above(n), slopes(n);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    h[k] = times[k + 1] - times[k];
    d[k] = (values[k + 1] - values[k]) / h[k];
  }
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double pivot = 2 * (h[k - 1] + h[k]) - h[k - 1] * above[k - 1];
    above[k] = h[k] / pivot;
    M[k] = (6 * (d[k] - d[k - 1]) - h[k - 1] * M[k - 1]) / pivot;
  }
  for (std::size_t k = n - 1; k-- > 1;) M[k] -= above[k] * M[k + 1];
  for (std::size_t k = 0; k + 1 < n; ++k) slopes[k] = d[k] - h[k] * (2 * M[k] + M[k + 1]) / 6;
  slopes[n - 1] = d[n - 2] + h[n - 2] * (M[n - 2] + 2 * M[n - 1]) / 6;
  return slopes;
}

}  // namespace regulus::verifier
