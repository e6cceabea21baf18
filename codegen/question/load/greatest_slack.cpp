// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/load/greatest_slack.hpp"

#include <cmath>

namespace regulus::detail {
namespace {

constexpr double kTiny = 1e-11;

/// The tableau of: minimise b·λ with Σλ_i·normal_i = 0, Σλ_i = 1, λ ≥ 0. An artificial variable for
/// each equation follows the λ, then the right side; the last row has the reduced costs.
class DualTableau {
 public:
  DualTableau(std::span<const double> normals, std::size_t dimension,
              std::span<const double> bounds)
      : equations_(dimension + 1),
        unknowns_(bounds.size()),
        width_(unknowns_ + equations_ + 1),
        entries_((equations_ + 1) * width_),
        basis_(equations_) {
    for (std::size_t i = 0; i < unknowns_; ++i) {
      for (std::size_t d = 0; d < dimension; ++d) at(d, i) = normals[i * dimension + d];
      at(dimension, i) = 1;
    }
    at(dimension, width_ - 1) = 1;
    for (std::size_t d = 0; d < equations_; ++d) {
      at(d, unknowns_ + d) = 1;
      basis_[d] = unknowns_ + d;
    }
  }

  [[nodiscard]] std::optional<GreatestSlack> solve(std::span<const double> bounds) {
    for (std::size_t i = unknowns_; i < width_ - 1; ++i) at(equations_, i) = 1;
    remove_basic_costs();
    if (!minimise(width_ - 1) || at(equations_, width_ - 1) < -1e-9) return std::nullopt;
    drive_out_artificials();
    for (std::size_t i = 0; i < width_; ++i) at(equations_, i) = i < unknowns_ ? bounds[i] : 0;
    remove_basic_costs();
    if (!minimise(unknowns_)) return std::nullopt;
    return result();
  }

 private:
  double& at(std::size_t row, std::size_t column) { return entries_[row * width_ + column]; }

  void add_multiple(std::size_t to, std::size_t from, double factor) {
    for (std::size_t j = 0; j < width_; ++j) at(to, j) += factor * at(from, j);
  }

  void remove_basic_costs() {
    for (std::size_t d = 0; d < equations_; ++d)
      add_multiple(equations_, d, -at(equations_, basis_[d]));
  }

  void pivot(std::size_t row, std::size_t column) {
    const double factor = 1 / at(row, column);
    for (std::size_t j = 0; j < width_; ++j) at(row, j) *= factor;
    for (std::size_t i = 0; i <= equations_; ++i)
      if (i != row) add_multiple(i, row, -at(i, column));
    basis_[row] = column;
  }

  /// Returns the row that limits an entering column; nullopt: none does.
  [[nodiscard]] std::optional<std::size_t> leaving_row(std::size_t column) {
    std::optional<std::size_t> best;
    double least = 0;
    for (std::size_t i = 0; i < equations_; ++i) {
      if (at(i, column) <= kTiny) continue;
      const double ratio = at(i, width_ - 1) / at(i, column);
      const bool is_less = !best || ratio < least - kTiny;
      if (is_less || (ratio < least + kTiny && basis_[i] < basis_[*best])) {
        least = is_less ? ratio : std::fmin(least, ratio);
        best = i;
      }
    }
    return best;
  }

  /// The first `columns` columns may enter the basis.
  [[nodiscard]] bool minimise(std::size_t columns) {
    for (std::size_t step = 0; step < 64 * width_; ++step) {
      std::size_t column = 0;
      while (column < columns && at(equations_, column) >= -kTiny) ++column;
      if (column == columns) return true;
      const auto row = leaving_row(column);
      if (!row) return false;
      pivot(*row, column);
    }
    return false;
  }

  /// An equation whose coefficients are all 0 keeps its artificial variable, which stays 0.
  void drive_out_artificials() {
    for (std::size_t d = 0; d < equations_; ++d) {
      if (basis_[d] < unknowns_) continue;
      std::size_t largest = 0;
      for (std::size_t i = 1; i < unknowns_; ++i)
        if (std::fabs(at(d, i)) > std::fabs(at(d, largest))) largest = i;
      if (std::fabs(at(d, largest)) > 1e-9) pivot(d, largest);
    }
  }

  /// An artificial variable that stays has no multiplier.
  [[nodiscard]] GreatestSlack result() {
    GreatestSlack found{{}, 0, std::vector<double>(unknowns_)};
    for (std::size_t d = 0; d < equations_; ++d)
      if (basis_[d] < unknowns_) found.multipliers[basis_[d]] = std::fmax(0, at(d, width_ - 1));
    for (std::size_t d = 0; d + 1 < equations_; ++d)
      found.z.push_back(-at(equations_, unknowns_ + d));
    found.s = -at(equations_, width_ - 2);
    return found;
  }

  const std::size_t equations_, unknowns_, width_;
  std::vector<double> entries_;
  std::vector<std::size_t> basis_;
};

}  // namespace

std::optional<GreatestSlack> approx_greatest_slack(std::span<const double> normals,
                                                   std::size_t dimension,
                                                   std::span<const double> bounds) {
  if (bounds.empty()) return std::nullopt;
  for (const double b : bounds)
    if (!std::isfinite(b)) return std::nullopt;
  return DualTableau(normals, dimension, bounds).solve(bounds);
}

}  // namespace regulus::detail
