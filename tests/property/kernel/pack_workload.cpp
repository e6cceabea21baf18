// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/kernel/pack_workload.hpp"

#include <cstdio>

#include "runtime/kernel/rounding_scope.hpp"

namespace regulus::detail::test {
namespace {
constexpr std::size_t kIntervals = 3, kPoints = 2;
}

Workload::Workload(std::size_t groups, CornerInputs& inputs)
    : groups_(groups), boxes_(kIntervals * groups), points_(kPoints * groups) {
  for (std::size_t lane = 0; lane < 8; ++lane) {
    for (std::size_t i = 0; i < boxes_.size(); ++i) boxes_.set(i, lane, inputs.interval());
    for (std::size_t i = 0; i < points_.size(); ++i) points_.set(i, lane, inputs.number());
  }
}

Arguments Workload::arguments(std::size_t i) const {
  const std::size_t group = i / 8, lane = i % 8;
  return {boxes_.get(kIntervals * group, lane), boxes_.get(kIntervals * group + 1, lane),
          boxes_.get(kIntervals * group + 2, lane), points_.get(kPoints * group, lane),
          points_.get(kPoints * group + 1, lane)};
}

Results Workload::evaluate(const Variant& variant, PackOperation operation) const {
  Results results(groups_);
  const RoundingScope scope(required_rounding(variant.isa));
  variant.evaluate(operation, static_cast<unsigned>(groups_), boxes_.data(), points_.data(),
                   results.intervals.data(), results.undefined.data());
  return results;
}

double point_of(Interval x, CornerInputs& inputs) {
  switch (inputs.below(5)) {
    case 0:
      return x.lo;
    case 1:
      return x.hi;
    case 2:
      return contains_zero(x) ? 0 : mid(x);
    default: {
      const double t = inputs.uniform(0, 1);
      return std::clamp(x.lo * (1 - t) + x.hi * t, x.lo, x.hi);
    }
  }
}

std::string describe(Tightest bounds) {
  char text[96];
  std::snprintf(text, sizeof text, "[%a, %a]", bounds.lo, bounds.hi);
  return text;
}

std::string describe(const Arguments& at) {
  char points[96];
  std::snprintf(points, sizeof points, " p = %a, q = %a", at.p, at.q);
  return "x = " + describe(Tightest{at.x.lo, at.x.hi}) +
         ", y = " + describe(Tightest{at.y.lo, at.y.hi}) +
         ", z = " + describe(Tightest{at.z.lo, at.z.hi}) + "," + points;
}

const char* name_of(PackOperation operation) {
  switch (operation) {
#define REGULUS_NAME(name, expression) \
  case PackOperation::name:            \
    return #name;
    REGULUS_PACK_OPERATIONS(REGULUS_NAME)
#undef REGULUS_NAME
  }
  return "";
}

#define REGULUS_ELEMENT(name, expression) PackOperation::name,
std::vector<PackOperation> arithmetic_operations() {
  return {REGULUS_ARITHMETIC_OPERATIONS(REGULUS_ELEMENT)
              REGULUS_PARTIAL_OPERATIONS(REGULUS_ELEMENT)};
}
std::vector<PackOperation> elementary_functions() {
  return {REGULUS_ELEMENTARY_FUNCTIONS(REGULUS_ELEMENT)};
}
#undef REGULUS_ELEMENT

}  // namespace regulus::detail::test
