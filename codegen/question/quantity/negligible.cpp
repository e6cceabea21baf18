// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/quantity/negligible.hpp"

#include <algorithm>

#include "codegen/kernel/formulation/variety.hpp"
#include "codegen/question/quantity/quantity_traits.hpp"

namespace regulus::detail {
namespace {

double size_of(const GiNaC::ex& value) { return mag(enclose_constant(value, "a constant")); }

double largest_of(const std::vector<GiNaC::ex>& values) {
  double largest = 0;
  for (const GiNaC::ex& value : values) largest = std::max(largest, size_of(value));
  return largest;
}

double least_of(const std::vector<GiNaC::ex>& values) {
  double least = largest_of(values);
  for (const GiNaC::ex& value : values) least = std::min(least, size_of(value));
  return least;
}

double largest_of(const VectorSet& set) {
  std::vector<GiNaC::ex> values;
  for (const GeometryParameter& entry : set.entries) {
    values.push_back(entry.value);
    values.push_back(entry.tolerance);
  }
  for (const ToleranceBall& ball : set.balls) values.push_back(ball.radius);
  return largest_of(values);
}

}  // namespace

double negligible(const Model& model, const Component& component) {
  const double set = component.set == nullptr ? 0 : largest_of(*component.set);
  switch (model.closure ? closure_traits_of(component.kind).data : traits_of(component.kind).data) {
    case NeededData::kLoad:
    case NeededData::kTwist:
      return kNegligiblePart * set;
    case NeededData::kMotorErrors:
      return kNegligiblePart * largest_of(model.actuators.error);
    case NeededData::kMotorSpeeds:
      return kNegligiblePart * largest_of(model.actuators.speed);
    case NeededData::kLoadAndStiffness:
      return kNegligiblePart * set / least_of(model.actuators.stiffness);
    case NeededData::kNone:
      break;
  }
  return 0;
}

}  // namespace regulus::detail
