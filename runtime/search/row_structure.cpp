// SPDX-License-Identifier: Apache-2.0
// ∂_kA itself is K·∂_kA for a K that selects rows; rows are asked for n at a time.
#include "regulus/search/row_structure.hpp"

#include <algorithm>

#include "regulus/kernel/call.hpp"
#include "regulus/search/aligned_buffer.hpp"

namespace regulus {
namespace {

constexpr int kNone = -1;
constexpr int kMany = -2;

/// The only row that each uncertain variable touches, kNone or kMany.
class Survey {
 public:
  explicit Survey(const Problem& problem)
      : kernel_(*problem.kernel),
        f_(*problem.kernel),
        boxes_(2 * f_.variables * kLanes),
        points_(std::size_t{f_.rows} * f_.columns * kLanes),
        out_(2 * std::size_t{f_.variables} * f_.columns * f_.columns * kLanes),
        row_(f_.variables, kNone) {
    for (std::size_t k = 0; k < f_.variables; ++k) {
      std::fill_n(boxes_.get() + lower_at(k, 0), kLanes, problem.outer[k].lo);
      std::fill_n(boxes_.get() + upper_at(k, 0), kLanes, problem.outer[k].hi);
    }
  }

  /// false: the derivatives are not defined everywhere.
  bool run() {
    for (std::size_t first = 0; first < f_.rows; first += f_.columns)
      if (!look_at_rows(first)) return false;
    return true;
  }
  [[nodiscard]] int row_of(std::size_t variable) const { return row_[variable]; }

 private:
  bool look_at_rows(std::size_t first) {
    const std::size_t m = f_.rows, n = f_.columns;
    std::fill_n(points_.get(), n * m * kLanes, 0.0);
    for (std::size_t i = 0; i < n && first + i < m; ++i)
      std::fill_n(points_.get() + point_at(i * m + first + i, 0), kLanes, 1.0);
    if (kernel_.call(f_.left_derivatives, boxes_.get(), points_.get(), out_.get()) != 0)
      return false;
    for (std::size_t k = f_.motion_variables; k < f_.variables; ++k)
      for (std::size_t e = 0; e < n * n; ++e)
        if (!is_zero(k * n * n + e)) touch(k, static_cast<int>(first + e / n));
    return true;
  }

  [[nodiscard]] bool is_zero(std::size_t entry) const {
    return out_[lower_at(entry, 0)] == 0.0 && out_[upper_at(entry, 0)] == 0.0;
  }

  void touch(std::size_t variable, int row) {
    int& known = row_[variable];
    known = known == kNone || known == row ? row : kMany;
  }

  Kernel kernel_;
  const regulus_kernel& f_;
  AlignedBuffer boxes_, points_, out_;
  std::vector<int> row_;
};

}  // namespace

RowStructure find_row_structure(const Problem& problem, const Settings& settings) {
  const regulus_kernel& kernel = *problem.kernel;
  RowStructure structure;
  if (settings.method != Method::kAuto || kernel.left_derivatives == nullptr ||
      kernel.left_product == nullptr || kernel.variables == kernel.motion_variables)
    return structure;
  Survey survey(problem);
  if (!survey.run()) return structure;
  structure.slot.assign(kernel.variables, RowStructure::kWide);
  for (std::size_t k = kernel.motion_variables; k < kernel.variables; ++k) {
    if (survey.row_of(k) < 0) continue;
    const auto row = static_cast<std::size_t>(survey.row_of(k));
    auto& rows = structure.rows;
    const auto known = std::find(rows.begin(), rows.end(), row);
    structure.slot[k] = static_cast<int>(known - rows.begin());
    if (known == rows.end()) rows.push_back(row);
  }
  return structure;
}

}  // namespace regulus
