// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "runtime/problem/observer.hpp"
#include "runtime/problem/problem.hpp"
#include "runtime/problem/result.hpp"

namespace regulus {

namespace detail {
class Search;
}  // namespace detail

/// Decides problems, one after the other. What it needs for a problem is kept for the next search
/// of the same problem, or of the same with other ranges, which then takes only the time of its boxes.
class Solver {
 public:
  Solver() noexcept;
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;
  ~Solver();

  /// Decides whether the matrix of a kernel has full column rank (α = 0), or |det J⁻¹| > α, over
  /// the whole of a problem's set of motion parameters and uncertain quantities.
  ///
  /// Requires  nothing of the problem: a faulty problem gives POSSIBLE PROBLEM, kBadProblem (see
  ///           find_fault). As long as this object lives, its kernels and filters do, with all that
  ///           they point to.
  /// Ensures   kNoSingularity: for every variable in its true range with all constraints ≤ 0, J⁻¹
  ///           is defined and of full column rank, and |det J⁻¹| > α if α > 0; it was not shown
  ///           that there is none (see Occupancy). kSingularity: the result's witness proves the
  ///           contrary. Otherwise nothing is claimed and reason and blocking_box say why. The
  ///           result does not depend on earlier searches. One thread at a time; the caller's
  ///           floating-point environment is kept.
  /// Source    Merlet, T-RO 2007, Algorithm 1 and Table II.
  [[nodiscard]] Result solve(const Problem& problem, const Settings& settings,
                             Observer* observer = nullptr);

  /// The same, but continues from the state that an earlier search of the same problem gave its
  /// observer at a pause. The caller must make sure that the state is true: it is not checked. A box
  /// without the whole range of an uncertain quantity that is kept whole gives kBadProblem.
  [[nodiscard]] Result resume(const Problem& problem, const Settings& settings,
                              std::span<const OpenBox> open, const SearchState& state,
                              Observer* observer = nullptr);

 private:
  struct Kept;
  void keep(std::unique_ptr<Kept> next) noexcept;
  void take_ranges(const Problem& problem);
  [[nodiscard]] detail::Search& search_for(const Problem& problem, const Settings& settings);

  std::unique_ptr<Kept> kept_;
};

/// The same with a solver that is used once. Re-entrant.
[[nodiscard]] Result solve(const Problem& problem, const Settings& settings,
                           Observer* observer = nullptr);
[[nodiscard]] Result resume(const Problem& problem, const Settings& settings,
                            std::span<const OpenBox> open, const SearchState& state,
                            Observer* observer = nullptr);

}  // namespace regulus
