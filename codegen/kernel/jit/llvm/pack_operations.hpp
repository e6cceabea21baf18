// SPDX-License-Identifier: GPL-3.0-or-later
// The short operations of packs as functions on memory, one for each kind of operands: I interval,
// P point, D double, U mask of undefined lanes. Clang compiles them once, when the project is
// built. The compiler of pack programs copies the instructions of those without branches into the
// code. The others are called as steps of the vector machine.
#include "runtime/kernel/pack.hpp"

using regulus::pack::I;
using regulus::pack::P;

#define REGULUS_OPERATION(name, result, parameters, value) \
  void regulus_##name parameters {                         \
    using namespace regulus::pack;                         \
    *out = result(value);                                  \
  }
#define REGULUS_UNARY(name, expression) \
  REGULUS_OPERATION(name##_I, I, (I * out, const I* x), expression(*x))
#define REGULUS_PARTIAL(name) \
  REGULUS_OPERATION(name##_IU, I, (I * out, const I* x, unsigned* u), name(*x, *u))
#define REGULUS_BINARY(name, sign)                                               \
  REGULUS_OPERATION(name##_II, I, (I * out, const I* x, const I* y), *x sign* y) \
  REGULUS_OPERATION(name##_IP, I, (I * out, const I* x, const P* y), *x sign* y) \
  REGULUS_OPERATION(name##_PI, I, (I * out, const P* x, const I* y), *x sign* y) \
  REGULUS_OPERATION(name##_PP, I, (I * out, const P* x, const P* y), *x sign* y)
#define REGULUS_MUL_ADD(kinds, A, B)                                                   \
  REGULUS_OPERATION(mul_add_##kinds, I, (I * out, const A* x, const B* y, const I* z), \
                    mul_add(*x, *y, *z))

extern "C" {

REGULUS_OPERATION(load, I, (I * out, const double* rows), load(rows, 0))
REGULUS_OPERATION(point, P, (P * out, const double* rows), point(rows, 0))
void regulus_store(double* rows, const I* x) { regulus::pack::store(rows, 0, *x); }

REGULUS_OPERATION(P_D, P, (P * out, double c), c)
REGULUS_OPERATION(constant_DD, I, (I * out, double lo, double hi), constant(lo, hi))
REGULUS_OPERATION(thin_P, I, (I * out, const P* x), thin(*x))

REGULUS_OPERATION(point_of_I, P, (P * out, const I* x), point_of(*x))
REGULUS_OPERATION(exact_add_PP, P, (P * out, const P* x, const P* y), exact_add(*x, *y))
REGULUS_OPERATION(exact_sub_PP, P, (P * out, const P* x, const P* y), exact_sub(*x, *y))
REGULUS_OPERATION(exact_mul_PP, P, (P * out, const P* x, const P* y), exact_mul(*x, *y))
REGULUS_OPERATION(exact_mul_add_PPP, P, (P * out, const P* x, const P* y, const P* z),
                  exact_mul_add(*x, *y, *z))
REGULUS_OPERATION(negate_P, P, (P * out, const P* x), -*x)
REGULUS_UNARY(negate, -)
REGULUS_BINARY(add, +)
REGULUS_BINARY(subtract, -)
REGULUS_BINARY(multiply, *)
REGULUS_MUL_ADD(PPI, P, P)
REGULUS_MUL_ADD(PII, P, I)
REGULUS_MUL_ADD(IPI, I, P)
REGULUS_MUL_ADD(III, I, I)

REGULUS_UNARY(sqr, sqr)
REGULUS_UNARY(abs, abs)
REGULUS_OPERATION(div_IIU, I, (I * out, const I* x, const I* y, unsigned* u), div(*x, *y, *u))
REGULUS_PARTIAL(checked)
REGULUS_PARTIAL(sqrt)

}  // extern "C"
