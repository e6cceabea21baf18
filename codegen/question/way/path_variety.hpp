// SPDX-License-Identifier: GPL-3.0-or-later
// A whole trajectory as the variety of one search that halves boxes.
//
// Its variables are u, the parameters that the motion has beside s, the uncertain quantities and the
// control errors. On piece k of N, counted from 0, u = k + s. The range of u is [0, P], P the least power of
// two ≥ N, so halves are groups of pieces, pieces, and parts of pieces. Nothing lies beyond N. On a
// piece the variables are those of its certificate, with s in the place of u.
#pragma once

#include <span>
#include <vector>

#include "codegen/question/way/path_bounds.hpp"
#include "runtime/problem/problem.hpp"

namespace regulus::detail {

class PathVariety {
 public:
  using Box = std::vector<Interval>;

  /// `kernel`: the problem of the hull, whose variables are path.moving() in order, then `added`
  /// ones, then the uncertain quantities. `path` must outlive this object, and what the problem
  /// refers to.
  PathVariety(const PathBounds& path, const Problem& kernel, std::size_t added);

  /// The problem of the search: the same kernel with other variables.
  [[nodiscard]] const Problem& problem() const noexcept { return problem_; }
  /// The same kernel with its own variables.
  [[nodiscard]] const Problem& kernel() const noexcept { return kernel_; }

  /// True if no piece is in the box.
  [[nodiscard]] bool is_beyond(const Box& box) const noexcept;
  /// True if a box with such a u has several pieces. It must be halved in u.
  [[nodiscard]] static bool is_group(const Interval& u) noexcept { return u.hi - u.lo > 1; }
  /// Returns a box of the kernel that holds every pose of the box with its errors.
  ///
  /// Requires  the box is one of halves, or thin in u.
  /// Rounding  outward.
  [[nodiscard]] Box on_kernel(const Box& box) const;
  /// Returns the impact of each variable by that of those of the kernel; if that is empty, by what
  /// makes the box of the kernel wide. To nearest.
  [[nodiscard]] std::vector<double> impact(const Box& box, std::span<const double> kernel) const;
  /// Returns slopes along each variable, about, by those along the variables of the kernel.
  ///
  /// Requires  the box has one piece.
  [[nodiscard]] std::vector<double> slopes(const Box& box, std::span<const double> kernel) const;
  /// Returns a place of the box that is one of the motion: its middle, or where the slopes lead.
  ///
  /// Requires  the box has one piece. `slopes` may be empty.
  [[nodiscard]] Box place(const Box& box, std::span<const double> slopes) const;

  /// Returns the piece of a box that has one.
  [[nodiscard]] std::size_t piece_of(const Box& box) const noexcept;
  /// Returns the variables of its certificate at a place.
  [[nodiscard]] Box on_piece(const Box& place) const;

 private:
  [[nodiscard]] Interval commanded(const Interval& u, std::size_t m) const noexcept;
  [[nodiscard]] double error_width(const Box& box, std::size_t m) const noexcept;
  [[nodiscard]] double weight_of_width(const Box& box, std::size_t variable) const noexcept;

  const PathBounds& path_;
  const Problem kernel_;
  const std::size_t moving_, added_, own_;  ///< own_: variables that the kernel has as they are
  std::vector<std::size_t> error_;          ///< by moving parameter, the variable; 0: it has none
  Problem problem_;
};

}  // namespace regulus::detail
