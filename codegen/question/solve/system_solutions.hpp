// SPDX-License-Identifier: GPL-3.0-or-later
// All solutions of the equations of a [closure], by search, where the pose parameters have values.
#pragma once

#include "codegen/question/closure/closure_run.hpp"
#include "codegen/question/solve/root_search.hpp"
#include "codegen/question/solve/solutions.hpp"

namespace regulus::detail {

/// Throws    UsageError if a parameter of the motion has a range and not a value.
void require_values(const Request& request);

/// Returns the question of a search with the ranges of `problem` and a kernel; both must outlive it.
[[nodiscard]] RootQuestion question_of_system(const Problem& problem,
                                              const PreparedSystem& prepared);
/// The same of boxes all over which the derivatives are regular.
[[nodiscard]] RootQuestion question_of_followed(const Problem& problem,
                                                const PreparedSystem& prepared);
/// Returns the one of these with this number, which another process has named.
[[nodiscard]] RootQuestion question_of_system(const Problem& problem,
                                              const PreparedSystem& prepared, std::size_t number);

/// Searches the whole circle of an unknown whose range has a whole period, and otherwise the range.
///
/// Requires  prepared without derivatives by variables; require_values() passes.
[[nodiscard]] Solutions solve_system(const PreparedSystem& prepared, const RootSettings& settings,
                                     Observer* progress);

/// Puts solutions in the order of the middles of their values.
void sort_by_values(std::vector<CertainSolution>& solutions);

/// Returns a usual size of each unknown. An unknown that is 0 is calculated from others, with their
/// rounding: its size is a part of that of the largest one with its unit. At least 1 for what turns.
[[nodiscard]] std::vector<double> usual_sizes(const Solutions& solutions);

/// Returns the condition number of an n×n matrix in the 2-norm, approximately.
[[nodiscard]] double approx_condition(std::span<const double> matrix, std::size_t n);

}  // namespace regulus::detail
