// SPDX-License-Identifier: Apache-2.0
// Operations whose true results are known, written like a kernel. The program is compiled with the
// packs ahead of time, and also in process. It shows how the compiler treats directed rounding. The
// expected results, in the same order, are in self_test.cpp. A file that includes this one may
// define regulus_self_test as another name.
#include "runtime/kernel/pack.hpp"

using namespace regulus::pack;

extern "C" unsigned regulus_self_test(const double* boxes, const double* points, double* out,
                                      const void*);

extern "C" unsigned regulus_self_test(const double* boxes, const double* points, double* out,
                                      const void*) {
  unsigned undefined = 0;
  unsigned unusable = 0;
  const I one = load(boxes, 0);
  const I three = load(boxes, 1);
  const I tenth = load(boxes, 2);
  const I wide = load(boxes, 3);
  const I tiny = load(boxes, 4);
  const I smallest = load(boxes, 5);
  const P p_one = point(points, 0);
  const P p_three = point(points, 1);
  const P p_tenth = point(points, 2);
  const P p_small = point(points, 3);

  store(out, 0, div(one, three, undefined));
  store(out, 1, div(-wide, -three, undefined));
  store(out, 2, div(tenth, -three, undefined));
  store(out, 3, sqrt(three, undefined));

  store(out, 4, tenth * three);
  store(out, 5, p_tenth * three);
  store(out, 6, p_tenth * p_three);
  store(out, 7, -tenth * tenth);
  store(out, 8, -p_tenth * tenth);
  store(out, 9, -p_tenth * p_tenth);
  store(out, 10, wide * wide);
  store(out, 11, -p_tenth * wide);

  store(out, 12, p_one + p_small);
  store(out, 13, one + p_small);
  store(out, 14, one + thin(p_small));
  store(out, 15, p_one - p_small);
  store(out, 16, p_small - one);
  store(out, 17, -one - thin(p_small));

  store(out, 18, mul_add(p_tenth, p_three, one));
  store(out, 19, mul_add(p_tenth, three, one));
  store(out, 20, mul_add(three, tenth, one));
  store(out, 21, mul_add(-p_tenth, three, one));
  store(out, 22, mul_add(-p_three, p_tenth, one));

  store(out, 23, sqr(tenth));
  store(out, 24, sqr(wide));
  store(out, 25, pow(tenth, 3));
  store(out, 26, pow(-tenth, 3));
  store(out, 27, pow(wide, 3));
  store(out, 28, pow(-tenth, 4));
  store(out, 29, abs(wide));
  store(out, 30, sin(one));

  // Results that a compiler might compute by itself.
  store(out, 31, P(0.1) * P(3.0));
  store(out, 32, P(1.0) + P(0x1p-60));
  store(out, 33, P(1.0) - P(0x1p-60));
  store(out, 34, constant(0.1, 0.1) * constant(3.0, 3.0));
  store(out, 35, div(constant(1.0, 1.0), constant(3.0, 3.0), undefined));
  store(out, 36, sqrt(constant(3.0, 3.0), undefined));
  store(out, 37, mul_add(P(0.1), P(3.0), constant(1.0, 1.0)));

  // Results that change if subnormal numbers are flushed to zero.
  store(out, 38, tiny * tiny);
  store(out, 39, -tiny * tiny);
  store(out, 40, smallest + smallest);
  store(out, 41, p_three * smallest);

  // Arguments outside the domain.
  (void)div(one, wide, unusable);
  store(out, 42, thin(P(static_cast<double>(unusable))));
  unusable = 0;
  (void)sqrt(wide, unusable);
  store(out, 43, thin(P(static_cast<double>(unusable))));
  return undefined;
}
