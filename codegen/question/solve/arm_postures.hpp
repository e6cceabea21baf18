// SPDX-License-Identifier: GPL-3.0-or-later
// All postures of a serial arm in which its end is where the joints of a motion put it.
#pragma once

#include "codegen/question/solve/solve_run.hpp"

namespace regulus::detail {

/// Six joints that turn: four of them are searched (opposite_axes.hpp), in each of the three ways to
/// choose two opposite ones, until a list is whole; each solution of these equations is shown to be
/// a posture, or to be none. Where joints slide, all six are searched. An arm with joints that follow others is
/// searched alike (coupled_axes.hpp), or all over, if two of its joints are not left out.
///
/// The geometry is anywhere within its tolerances, and each posture in the list stands for one at each of
/// its values; the place is that of the nominal geometry. With control errors all is nominal.
///
/// Requires  request.model.arm; the motion has values.
/// Throws    UsageError for an arm that has not six joints that are free to move and follow none.
[[nodiscard]] Solutions solve_arm(const Request& request, const SolveRun& run);

}  // namespace regulus::detail
