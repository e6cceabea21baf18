// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/mechanism.hpp"

#include <algorithm>
#include <set>

namespace regulus::detail {

bool Pose::is_identity() const {
  const auto zero = [](const WrittenNumber& x) { return x.is_zero(); };
  if (!std::ranges::all_of(xyz, zero)) return false;
  if (orientation == OrientationForm::kNone) return true;
  if (orientation == OrientationForm::kRotation) return false;
  const std::size_t first = orientation == OrientationForm::kQuaternion ? 1 : 0;
  return std::all_of(angles.begin() + static_cast<std::ptrdiff_t>(first), angles.end(), zero);
}

bool Mechanism::has_link(const std::string& link) const {
  return std::ranges::find(links, link) != links.end();
}

bool Mechanism::has_loops() const {
  std::set<std::string> children;
  return !loops.empty() || std::ranges::any_of(joints, [&children](const ImportedJoint& joint) {
    return !children.insert(joint.child).second;
  });
}

}  // namespace regulus::detail
