// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/regularity/backend.hpp"
#include "runtime/regularity/lanes.hpp"
#include "runtime/regularity/views.hpp"

namespace regulus::detail {

/// The largest order tested: 2^(2n−1) determinants are computed.
inline constexpr std::size_t kMaxRohn = kMaxVertexOrder;

/// Returns the lanes whose interval matrix is regular because the 2^(2n−1) vertex matrices A^{uv}
/// (lower bound where uᵢvⱼ = 1, upper where −1) all have determinants of one certified sign.
///
/// Shape     matrix n×n.
/// Requires  finite bounds in `lanes`.
/// Ensures   every real matrix between the bounds of a returned lane is regular. None for
///           n > kMaxRohn.
/// Rounding  determinants to nearest by expansion; a sign counts only if the determinant exceeds a
///           bound of the error, see the source.
/// Source    Rex and Rohn, SIAM J. Matrix Anal. Appl. 20 (1998); Merlet, T-RO 2007, §III-B2.
[[nodiscard]] LaneMask certain_rohn(ConstIntervalMatrix matrix, LaneMask lanes) noexcept;

}  // namespace regulus::detail
