// SPDX-License-Identifier: GPL-3.0-or-later
// Asks about a closure, and tells what was found.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "codegen/answer/facts.hpp"
#include "codegen/question/closure/fold_search.hpp"
#include "codegen/question/closure/threshold_finding.hpp"
#include "runtime/problem/observer.hpp"
#include "runtime/problem/result.hpp"

namespace regulus::detail {

/// The search over a branch, the singular configurations that it led to, and what was found of a threshold.
struct ClosureFinding {
  ClosureResult searched;
  std::vector<Fold> folds{};
  std::optional<ThresholdFinding> threshold{};  ///< of a motion that has one, if it was compared

  /// Returns the first one that is shown to be on the branch; null if there is none.
  [[nodiscard]] const Fold* reached() const {
    const auto found = std::ranges::find(folds, true, &Fold::is_on_branch);
    return found == folds.end() ? nullptr : &*found;
  }
  [[nodiscard]] bool is_refuted() const { return reached() != nullptr; }
};

/// The ends of a branch are looked for so much further than the first box without it.
inline constexpr double kPartBeyondBoxes = 0x1p-6;

/// Looks for a singular configuration that keeps the branch from a small box without a tube, or is
/// anywhere in the motion. `place`, `is_lost`: as BranchSettings::ask has them.
[[nodiscard]] std::optional<Fold> fold_beyond(const PreparedClosure& prepared,
                                              std::vector<double> place, bool is_lost,
                                              const SearchOptions& search,
                                              const FormingWatch& watch);

/// Asks whether the branch is regular all over the motion, and whether it exceeds a threshold.
[[nodiscard]] ClosureFinding check_closure(PreparedClosure& prepared, const SearchOptions& search,
                                           const FormingWatch& watch, const PiecesRun& run = {});

/// Decides every box of the motion, down to so small a part of each range, and looks for the ends of
/// the branch in a motion of one parameter.
[[nodiscard]] ClosureFinding pave_closure(PreparedClosure& prepared, const SearchOptions& search,
                                          double resolution, const FormingWatch& watch,
                                          const PiecesRun& run = {});

/// Tells the splits of a paving, without their boxes, and its leaves: free, singular if a threshold is
/// exceeded nowhere on the branch there, outside, or undecided.
void tell_boxes(const PreparedClosure& prepared, const ClosureFinding& found, Observer& observer);

/// Returns the finding in the terms of a check.
[[nodiscard]] Result check_result(const PreparedClosure& prepared, const ClosureFinding& found);

/// Returns why the branch is not proved.
[[nodiscard]] std::string reason_of(const ClosureFinding& found);

/// A coordinate of the place where a branch begins.
struct StartCoordinate {
  std::string name, unit;
  Interval value;
};
/// Tells where the branch begins. `configuration`: of its unknowns there; empty: not certain.
void tell_start(const PreparedClosure& prepared, const std::vector<StartCoordinate>& place,
                const std::vector<Interval>& configuration, Facts& facts);
/// Tells singular configurations.
void tell_folds(const PreparedClosure& prepared, const std::vector<Fold>& folds, Facts& facts);
/// Tells the equations, where the branch begins, and the singular configurations that were found.
void tell_branch(const PreparedClosure& prepared, const BranchLinks& links,
                 const std::vector<Fold>& folds, Facts& facts);

void tell_closure(const PreparedClosure& prepared, const SearchOptions& search,
                  const ClosureFinding& found, Facts& facts);

}  // namespace regulus::detail
