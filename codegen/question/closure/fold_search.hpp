// SPDX-License-Identifier: GPL-3.0-or-later
// Finds and certifies a singular configuration that a branch reaches.
#pragma once

#include <optional>
#include <vector>

#include "codegen/question/closure/closure_run.hpp"

namespace regulus::detail {

/// A piece of a curve of configurations, over a range of one of its coordinates: the part of a line
/// of places, 0, or unknown 1 … n. The tube is of the others, in their order.
struct CurveArc {
  std::size_t coordinate = 0;
  Interval range;
  BranchTube tube;
};

/// Why a singular configuration is on the branch: FORMAT.md, "Closures".
struct FoldPath {
  std::vector<double> towards;    ///< the end of the line, by motion parameter
  std::vector<double> uncertain;  ///< by uncertain quantity and error; empty: they stay
  std::vector<CurveArc> arcs;     ///< each shares a configuration with the one before it
  BranchTube end;                 ///< of (t, p, v), without variables
  std::vector<double> normal;     ///< n
};

/// A configuration at which the derivatives of the equations by the unknowns, Φ_p, are singular.
struct Fold {
  std::vector<Interval> place;     ///< encloses the motion parameters and uncertain quantities
  std::vector<Interval> unknowns;  ///< encloses the configuration there
  std::vector<Interval>
      direction;  ///< encloses v ≠ 0 with Φ_p v = 0: what moves with the motors locked
  bool is_on_branch = false;  ///< configurations lead to it from the start, all in the variety
  FoldPath path{};            ///< these; without arcs if it is not on the branch
};

/// Goes from the start along a line to `towards`, until the branch is lost. There the system
///
///     Φ(x(t), p) = 0,   Φ_p(x(t), p)·v = 0,   n·v = 1
///
/// in (t, p, v) has a certain solution, by the test of branch_tube.hpp. The fold is on the branch if
/// tubes lead to it: along the line, and from there, where Φ_p becomes singular, along the unknown
/// that moves most in place of t.
///
/// Shape     towards: by motion parameter, within the ranges. uncertain: the values of the other
///           variables at the end of the line, within theirs; it begins at their middles. Empty: they
///           stay there. A point beyond its ball is brought into it.
/// Ensures   nullopt if nothing is shown.
/// Throws    the exceptions of prepare_closure().
[[nodiscard]] std::optional<Fold> find_fold(const PreparedClosure& prepared,
                                            const std::vector<double>& towards,
                                            const std::vector<double>& uncertain,
                                            const SearchOptions& search, const FormingWatch& watch);

/// Returns values of the uncertain quantities, at ends of their ranges, for which the fold beyond
/// `towards` is nearest to the start, to first order; nullopt if there is no fold near there.
[[nodiscard]] std::optional<std::vector<double>> nearest_corner(const PreparedClosure& prepared,
                                                                const std::vector<double>& towards,
                                                                const SearchOptions& search,
                                                                const FormingWatch& watch);

}  // namespace regulus::detail
