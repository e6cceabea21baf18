// SPDX-License-Identifier: GPL-3.0-or-later
// The axes of a serial arm's joints, seen from one of its links.
#pragma once

#include <vector>

#include "codegen/model/mechanism/joint_polynomial.hpp"
#include "codegen/model/mechanism/serial.hpp"

namespace regulus::detail {

/// The twist that a joint at unit speed gives to a body, per component a polynomial.
struct JointScrew {
  PolynomialVector velocity;  ///< of the point of the body that is at the reference point
  PolynomialVector spin;      ///< angular velocity
};

/// Returns the groups of joints that turn about parallel axes at all poses.
[[nodiscard]] JointGroups parallel_groups(const Serial& robot, std::shared_ptr<TermBudget> budget);

/// Returns the groups of one joint each.
[[nodiscard]] JointGroups single_groups(const Serial& robot, std::shared_ptr<TermBudget> budget);

/// Returns the points of a link to choose from: origins of the joints on both sides, and the points
/// where their axes meet other axes.
[[nodiscard]] std::vector<Point> reference_points(const Serial& robot, std::size_t link);

/// Returns the screw of each joint in the frame of the link, 0 for the base, at its origin.
[[nodiscard]] std::vector<JointScrew> joint_screws(const Serial& robot, const JointGroups& groups,
                                                   std::size_t link);

/// Returns the same screws at another point of the link.
[[nodiscard]] std::vector<JointScrew> moved_to(std::vector<JointScrew> screws, const Point& point);

}  // namespace regulus::detail
