// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds of the poses along the pieces of a trajectory, in doubles.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "codegen/model/way/trajectory.hpp"
#include "runtime/interval/interval.hpp"

namespace regulus::detail {

/// Encloses one pose parameter along one piece.
class CoordinateBounds {
 public:
  explicit CoordinateBounds(const PieceOfPose& piece);

  /// Ensures   the value at every s of [begin, end] ∈ result; the width is that of the true range,
  ///           but for rounding, if the piece is linear.
  ///
  /// Requires  0 ≤ begin ≤ end ≤ 1.
  /// Rounding  outward.
  [[nodiscard]] Interval over(double begin, double end) const noexcept;

 private:
  [[nodiscard]] Interval polynomial(Interval begin, Interval end) const noexcept;
  [[nodiscard]] Interval arc(Interval s) const noexcept;

  std::array<Interval, 4> power_{};
  Interval cosine_{0.0}, sine_{0.0}, turn_{0.0};
  bool is_linear_, has_arc_;
};

/// The pose parameters that change along a trajectory or have a control error, and their bounds.
class PathBounds {
 public:
  /// Throws InputError if a coefficient or an error has no finite value.
  PathBounds(const Trajectory& trajectory, const std::vector<GiNaC::ex>& errors);

  [[nodiscard]] std::size_t pieces() const noexcept { return pieces_; }
  /// Returns the indices of these pose parameters, in order.
  [[nodiscard]] std::span<const std::size_t> moving() const noexcept { return moving_; }
  /// Returns their control errors; 0: none.
  [[nodiscard]] std::span<const Interval> errors() const noexcept { return errors_; }
  /// Returns an error that each of them surely reaches.
  [[nodiscard]] std::span<const double> certain_errors() const noexcept { return certain_errors_; }
  /// Encloses the commanded values of the moving parameter number m.
  [[nodiscard]] Interval over(std::size_t piece, std::size_t m, double begin,
                              double end) const noexcept {
    return coordinates_[piece * moving_.size() + m].over(begin, end);
  }
  /// Encloses the same over the pieces from `first` on.
  [[nodiscard]] Interval over_pieces(std::size_t first, std::size_t count,
                                     std::size_t m) const noexcept;

 private:
  void find_moving(const Trajectory& trajectory, const std::vector<GiNaC::ex>& errors);
  void bound_groups();

  std::size_t pieces_;
  std::vector<std::size_t> moving_;
  std::vector<Interval> errors_;
  std::vector<double> certain_errors_;
  std::vector<CoordinateBounds> coordinates_;
  /// Level L: the hulls of groups of 2^L pieces, by group and moving parameter.
  std::vector<std::vector<Interval>> groups_;
};

}  // namespace regulus::detail
