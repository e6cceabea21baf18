// SPDX-License-Identifier: GPL-3.0-or-later
// The pose of a platform on legs of variable length, as a branch of the equations of its legs.
//
// The legs have the lengths ρ_k(q) that the inverse kinematics gives the commanded pose q with the
// nominal anchors, and errors δ_k. The platform is then not at q: it is moved by e and turned by E,
// from where it should be. With X the position of q and R its orientation
//
//     |X + e − a_k + E·R·b_k|² = (ρ_k(q) + δ_k)²,
//
// where a_k, b_k are the true anchors. Without errors e = 0 and E = 1 for every q.
#pragma once

#include "codegen/model/request.hpp"

namespace regulus::detail {

/// Returns the question about a closure whose unknowns are e and the angles roll, pitch and yaw of
/// E = Rz·Ry·Rx (of a platform in the plane its angle). The errors of the legs are those of the
/// motors, and the branch starts at 0. Along way-points the pieces give the pose, and none of the errors.
///
/// Throws    UsageError for a robot that is no such platform, for a motion with `where`, and for errors
///           of the pose.
[[nodiscard]] Request closure_of_platform(const Request& given);

}  // namespace regulus::detail
