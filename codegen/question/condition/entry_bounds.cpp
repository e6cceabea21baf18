// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/condition/entry_bounds.hpp"

#include <cmath>
#include <utility>

namespace regulus::detail {

EntryBounds::EntryBounds(const RotatedBox& box) {
  const std::size_t n = box.columns, size = box.rows * n;
  const auto is_diagonal = [n](std::size_t e) { return e / n == e % n; };
  std::vector<double> all(size);
  for (std::size_t e = 0; e < size; ++e)
    all[e] = box.center.error[e] + (is_diagonal(e) ? 0 : std::fabs(box.center.middle[e]));
  for (std::size_t k = 0; k < box.radius.size(); ++k) {
    const RoundMatrix& slope = box.slopes[k];
    std::vector<double> part(size);
    for (std::size_t e = 0; e < size; ++e) {
      part[e] = slope.error[e] + (is_diagonal(e) ? 0 : std::fabs(slope.middle[e]));
      part[e] = part[e] * box.radius[k] + (box.rest.empty() ? 0 : box.rest[k][e]);
      all[e] += part[e];
    }
    parts.push_back(std::move(part));
  }
  off.assign(size, 0);
  for (std::size_t e = 0; e < size; ++e)
    if (is_diagonal(e))
      error.push_back(enlarged(all[e]));
    else
      off[e] = enlarged(all[e]);
}

}  // namespace regulus::detail
