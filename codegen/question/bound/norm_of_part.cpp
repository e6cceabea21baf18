// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/bound/norm_of_part.hpp"

#include "codegen/model/exact/certain_sign.hpp"
#include "codegen/model/mechanism/twist.hpp"

namespace regulus::detail {
namespace {

bool is_in(const Component& freedom, PosePart part, const std::vector<TwistComponent>& twist) {
  using Kind = TwistComponent::Kind;
  if (freedom.part != PosePart::kColumn || freedom.column >= twist.size()) return false;
  return twist[freedom.column].kind == (part == PosePart::kLinear ? Kind::kLinear : Kind::kAngular);
}

}  // namespace

void raise_by_freedoms(ComponentBound& norm, std::span<const ComponentBound> others,
                       const Model& model) {
  const PosePart part = norm.component.part;
  if (part == PosePart::kColumn || norm.is_unbounded) return;
  const std::vector<TwistComponent> twist = twist_of(model);
  for (const ComponentBound& other : others) {
    if (!other.attained || !is_in(other.component, part, twist)) continue;
    if (norm.attained &&
        certain_sign(other.attained->exact - norm.attained->exact) != CertainSign::kPositive)
      continue;
    norm.attained = other.attained;
    norm.place = other.place;
  }
}

}  // namespace regulus::detail
