// SPDX-License-Identifier: GPL-3.0-or-later
// How far errors move the configuration of a closure: not to first order, but all the way.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "codegen/question/closure/fold_search.hpp"
#include "codegen/question/quantity/quantity_options.hpp"

namespace regulus {

/// Bounds of |p_i(x, e) − p_i(x, 0)| over a motion: p_i an unknown on the branch, x the motion's
/// parameters, e the control errors and the errors of the geometry, all within their spreads.
struct FiniteError {
  std::string name, unit;
  double attained = 0, proved = std::numeric_limits<double>::infinity();  ///< rounded outward
  std::vector<Interval> place{};  ///< where `attained` is: parameters and errors
  bool is_closed = false;
  std::optional<Reason> stopped_by{};  ///< what ended the search before it was closed
  std::uint64_t boxes = 0;
};

struct FiniteErrors {
  std::vector<FiniteError> unknowns;
  std::vector<std::string> parameters;  ///< the names of FiniteError::place
  std::vector<std::string> units;       ///< of these; "1": none
  std::vector<Fold> folds{};            ///< that the errors reach
  std::string obstacle{};               ///< why there is no bound; empty: there is one
  std::uint64_t boxes = 0;              ///< of the search for the branch
  double seconds = 0;
};

/// Returns the unknowns that the quantity is about: all of them, or that of --freedom.
///
/// Throws    UsageError for a model without a closure, and for what finite errors do not have: another
///           quantity, a limit, a sign.
[[nodiscard]] std::vector<std::size_t> unknowns_of(const Request& request,
                                                   const QuantityOptions& quantity,
                                                   const std::string& limit);

/// Brackets each of them until (proved − attained)/proved ≤ gap. The branch is first shown to be one
/// over all errors.
///
/// Requires  request.model.closure.
/// Throws    UsageError if nothing has an error, or if points lie in balls; as prepare_closure().
[[nodiscard]] FiniteErrors bound_finite_errors(const Request& request,
                                               const std::vector<std::size_t>& unknowns, double gap,
                                               const SearchOptions& search,
                                               const FormingWatch& watch, Observer* progress);

}  // namespace regulus
