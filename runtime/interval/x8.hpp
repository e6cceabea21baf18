// SPDX-License-Identifier: Apache-2.0
// The elementary functions on eight intervals at once, for generated kernels.
//
// Shape     in: lo[8], then hi[8]; out likewise. sincos writes sin, then cos (32 doubles). atan2
//           reads the ordinate y, then the abscissa x (32 doubles).
// Requires  64-byte alignment; in and out do not overlap.
// Ensures   the result is the mask of undefined lanes: some point of the argument is outside the
//           domain, or a bound of the result exceeds 2^128 in magnitude, or the argument has a NaN
//           or its bounds in the wrong order. Their outputs are 0. In the other lanes the output is
//           bit for bit that of the function of the same name in runtime/interval/elementary.hpp.
// Rounding  any MXCSR: the function sets it to nearest and restores it. No state is kept.
#pragma once

extern "C" {
unsigned regulus_x8_sin(const double* in, double* out);
unsigned regulus_x8_cos(const double* in, double* out);
unsigned regulus_x8_sincos(const double* in, double* out);
unsigned regulus_x8_tan(const double* in, double* out);
unsigned regulus_x8_asin(const double* in, double* out);
unsigned regulus_x8_acos(const double* in, double* out);
unsigned regulus_x8_atan(const double* in, double* out);
unsigned regulus_x8_atan2(const double* in, double* out);
unsigned regulus_x8_exp(const double* in, double* out);
unsigned regulus_x8_log(const double* in, double* out);

struct regulus_x8_function {
  const char* name;
  unsigned (*address)(const double* in, double* out);
};
struct regulus_x8_function_table {
  const regulus_x8_function* functions;
  unsigned count;
};

/// Returns every function above with its name, for a loader that resolves symbols itself.
regulus_x8_function_table regulus_x8_functions();
}
