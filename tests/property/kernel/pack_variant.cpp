// SPDX-License-Identifier: GPL-3.0-or-later
// The packs by one compiler at one level of optimisation for one instruction set. The build
// compiles this file many times; REGULUS_VARIANT is the name of the function.
#include "runtime/kernel/pack.hpp"
#include "tests/property/kernel/pack_operations.hpp"

namespace {

using namespace regulus::pack;
using regulus::detail::test::PackOperation;

[[maybe_unused]] inline I first_of_sincos(I x) {
  I sine = x, cosine = x;
  sincos(x, sine, cosine);
  return sine;
}
[[maybe_unused]] inline I second_of_sincos(I x) {
  I sine = x, cosine = x;
  sincos(x, sine, cosine);
  return cosine;
}

}  // namespace

extern "C" void REGULUS_VARIANT(PackOperation operation, unsigned count, const double* boxes,
                                const double* points, double* out, unsigned* undefined_lanes);

extern "C" void REGULUS_VARIANT(PackOperation operation, unsigned count, const double* boxes,
                                const double* points, double* out, unsigned* undefined_lanes) {
  for (unsigned i = 0; i < count; ++i, boxes += 48, points += 16, out += 16) {
    [[maybe_unused]] const I x = load(boxes, 0), y = load(boxes, 1), z = load(boxes, 2);
    [[maybe_unused]] const P p = point(points, 0), q = point(points, 1);
    unsigned undefined = 0;
    switch (operation) {
#define REGULUS_CASE(name, expression) \
  case PackOperation::name:            \
    store(out, 0, expression);         \
    break;
      REGULUS_PACK_OPERATIONS(REGULUS_CASE)
#undef REGULUS_CASE
    }
    undefined_lanes[i] = undefined;
  }
}
