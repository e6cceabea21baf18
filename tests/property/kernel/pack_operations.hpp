// SPDX-License-Identifier: GPL-3.0-or-later
// The operations of packs under test: a name, and an expression in intervals x y z, points p q and
// the mask of undefined lanes.
#pragma once

#define REGULUS_ARITHMETIC_OPERATIONS(OPERATION)       \
  OPERATION(negate, -x)                                \
  OPERATION(add, x + y)                                \
  OPERATION(subtract, x - y)                           \
  OPERATION(multiply, x* y)                            \
  OPERATION(add_point, x + p)                          \
  OPERATION(point_add, p + x)                          \
  OPERATION(subtract_point, x - p)                     \
  OPERATION(point_subtract, p - x)                     \
  OPERATION(multiply_point, x* p)                      \
  OPERATION(point_multiply, p* x)                      \
  OPERATION(negate_point, thin(-p))                    \
  OPERATION(points_add, p + q)                         \
  OPERATION(points_subtract, p - q)                    \
  OPERATION(points_multiply, p* q)                     \
  OPERATION(literal_multiply, P(-0.1) * x)             \
  OPERATION(constant_multiply, constant(0.1, 0.3) * x) \
  OPERATION(mul_add_points, mul_add(p, q, z))          \
  OPERATION(mul_add_point, mul_add(p, x, z))           \
  OPERATION(mul_add_by_point, mul_add(x, p, z))        \
  OPERATION(mul_add_intervals, mul_add(x, y, z))       \
  OPERATION(square, sqr(x))                            \
  OPERATION(power_2, pow(x, 2))                        \
  OPERATION(power_3, pow(x, 3))                        \
  OPERATION(power_4, pow(x, 4))                        \
  OPERATION(power_5, pow(x, 5))                        \
  OPERATION(power_6, pow(x, 6))                        \
  OPERATION(power_11, pow(x, 11))                      \
  OPERATION(absolute, abs(x))

#define REGULUS_PARTIAL_OPERATIONS(OPERATION) \
  OPERATION(divide, div(x, y, undefined))     \
  OPERATION(square_root, sqrt(x, undefined))  \
  OPERATION(check, checked(x, undefined))

#define REGULUS_ELEMENTARY_FUNCTIONS(OPERATION)   \
  OPERATION(sine, sin(x))                         \
  OPERATION(cosine, cos(x))                       \
  OPERATION(sine_of_both, first_of_sincos(x))     \
  OPERATION(cosine_of_both, second_of_sincos(x))  \
  OPERATION(tangent, tan(x, undefined))           \
  OPERATION(arcsine, asin(x, undefined))          \
  OPERATION(arccosine, acos(x, undefined))        \
  OPERATION(arctangent, atan(x))                  \
  OPERATION(arctangent_2, atan2(x, y, undefined)) \
  OPERATION(exponential, exp(x, undefined))       \
  OPERATION(logarithm, log(x, undefined))

#define REGULUS_PACK_OPERATIONS(OPERATION) \
  REGULUS_ARITHMETIC_OPERATIONS(OPERATION) \
  REGULUS_PARTIAL_OPERATIONS(OPERATION)    \
  REGULUS_ELEMENTARY_FUNCTIONS(OPERATION)

namespace regulus::detail::test {

#define REGULUS_ENUMERATOR(name, expression) name,
enum class PackOperation { REGULUS_PACK_OPERATIONS(REGULUS_ENUMERATOR) };
#undef REGULUS_ENUMERATOR

/// Evaluates one operation on `count` groups of eight lanes: 3 intervals and 2 points in each
/// group, one interval and one mask out.
using EvaluatePack = void (*)(PackOperation operation, unsigned count, const double* boxes,
                              const double* points, double* out, unsigned* undefined);

}  // namespace regulus::detail::test
