// SPDX-License-Identifier: Apache-2.0
// Operations whose true results are known, written as a kernel function: compiled with the packs
// ahead of time, and in process as its own program, it shows what the compiler made of directed
// rounding. The expected results, in the same order, are in self_test.cpp.
#include "regulus/kernel/pack.hpp"

#if !defined(REGULUS_SELF_TEST)
#define REGULUS_SELF_TEST regulus_self_test
#endif

extern "C" unsigned REGULUS_SELF_TEST(const double* boxes, const double* points, double* out,
                                      const void*);

extern "C" unsigned REGULUS_SELF_TEST(const double* boxes, const double* points, double* out,
                                      const void*) {
  using namespace regulus::pack;
  const I one = load(boxes, 0), three = load(boxes, 1), tenth = load(boxes, 2);
  const I wide = load(boxes, 3), tiny = load(boxes, 4), smallest = load(boxes, 5);
  const P p_one = point(points, 0), p_three = point(points, 1), p_tenth = point(points, 2);
  const P p_small = point(points, 3);
  unsigned undefined = 0, unusable = 0;
  int e = 0;

  store(out, e++, div(one, three, undefined));
  store(out, e++, div(-wide, -three, undefined));
  store(out, e++, div(tenth, -three, undefined));
  store(out, e++, sqrt(three, undefined));

  store(out, e++, tenth * three);
  store(out, e++, p_tenth * three);
  store(out, e++, p_tenth * p_three);
  store(out, e++, -tenth * tenth);
  store(out, e++, -p_tenth * tenth);
  store(out, e++, -p_tenth * p_tenth);
  store(out, e++, wide * wide);
  store(out, e++, -p_tenth * wide);

  store(out, e++, p_one + p_small);
  store(out, e++, one + p_small);
  store(out, e++, one + thin(p_small));
  store(out, e++, p_one - p_small);
  store(out, e++, p_small - one);
  store(out, e++, -one - thin(p_small));

  store(out, e++, mul_add(p_tenth, p_three, one));
  store(out, e++, mul_add(p_tenth, three, one));
  store(out, e++, mul_add(three, tenth, one));
  store(out, e++, mul_add(-p_tenth, three, one));
  store(out, e++, mul_add(-p_three, p_tenth, one));

  store(out, e++, sqr(tenth));
  store(out, e++, sqr(wide));
  store(out, e++, pow(tenth, 3));
  store(out, e++, pow(-tenth, 3));
  store(out, e++, pow(wide, 3));
  store(out, e++, pow(-tenth, 4));
  store(out, e++, abs(wide));
  store(out, e++, sin(one));

  // What a compiler might compute by itself.
  store(out, e++, P(0.1) * P(3.0));
  store(out, e++, P(1.0) + P(0x1p-60));
  store(out, e++, P(1.0) - P(0x1p-60));
  store(out, e++, constant(0.1, 0.1) * constant(3.0, 3.0));
  store(out, e++, div(constant(1.0, 1.0), constant(3.0, 3.0), undefined));
  store(out, e++, sqrt(constant(3.0, 3.0), undefined));
  store(out, e++, mul_add(P(0.1), P(3.0), constant(1.0, 1.0)));

  // What flushing subnormal numbers to zero would change.
  store(out, e++, tiny * tiny);
  store(out, e++, -tiny * tiny);
  store(out, e++, smallest + smallest);
  store(out, e++, p_three * smallest);

  // Outside the domain.
  (void)div(one, wide, unusable);
  store(out, e++, thin(P(static_cast<double>(unusable))));
  unusable = 0;
  (void)sqrt(wide, unusable);
  store(out, e++, thin(P(static_cast<double>(unusable))));
  return undefined;
}
