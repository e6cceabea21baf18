// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace regulus::verifier {

/// Returns the slopes of the natural cubic spline through these points, approximately.
///
/// Requires  two points or more, increasing times.
[[nodiscard]] std::vector<double> approx_spline_slopes(const std::vector<double>& times,
                                                       const std::vector<double>& values);

}  // namespace regulus::verifier
