// SPDX-License-Identifier: Apache-2.0
// The orientation of a platform by the names of its pose.
#pragma once

#include "runtime/verifier/model/section_reading.hpp"
#include "runtime/verifier/rigid_motion.hpp"

namespace regulus::verifier {

inline constexpr const char* kAngleInPlane = "angle";  ///< about z, of a platform in the plane

/// `size` times a rotation; size is 1 but for a quaternion of any length.
struct OrientationNodes {
  MatrixNodes scaled;
  NodeId size;
};

/// Returns the names of the word of `orientation`; empty for one that has no angles.
[[nodiscard]] std::vector<std::string> orientation_names(const std::string& word);

/// `in_degrees`: the names are numbers of degrees. Throws Unfinished if the scope lacks a name.
[[nodiscard]] OrientationNodes read_orientation(const std::string& word, const Scope& scope,
                                                bool in_degrees, GraphAlgebra& algebra);

/// Returns |X + R·b − a|² of a leg from a to b, where X is x, y, z of the scope, and R the orientation.
/// Throws Unfinished if the scope lacks a name.
[[nodiscard]] NodeId squared_length_at(const SectionLeg& leg, const std::string& word,
                                       bool in_degrees, const Scope& scope, Graph& graph);

}  // namespace regulus::verifier
