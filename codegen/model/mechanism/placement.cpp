// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/mechanism/placement.hpp"

#include "codegen/model/exact/parsed_expression.hpp"

namespace regulus::detail {
namespace {

GiNaC::ex checked(const GiNaC::ex& entry) {
  GiNaC::ex result = reduced(entry);
  if (GiNaC::is_a<GiNaC::add>(result) && result.nops() > kMostEntryTerms)
    throw ParseRefusal{"rotations that follow each other with " + std::to_string(result.nops()) +
                           " terms in one entry",
                       "one rotation in their place: quaternion = [w, x, y, z]"};
  return result;
}

}  // namespace

Placement compose(const Placement& first, const Placement& second) {
  Placement result;
  for (unsigned i = 0; i < 3; ++i)
    for (unsigned j = 0; j < 3; ++j) {
      GiNaC::ex entry = 0;
      for (unsigned k = 0; k < 3; ++k) entry += first.R(i, k) * second.R(k, j);
      result.R(i, j) = checked(entry);
    }
  const Point p = sum(times(first.R, second.p), first.p);
  for (std::size_t i = 0; i < 3; ++i) result.p[i] = checked(p[i]);
  return result;
}

}  // namespace regulus::detail
