// SPDX-License-Identifier: Apache-2.0
// The contract between a generated kernel and everything that calls one. Valid C99 and C++, needs
// no other header, so that code compiled in process can include it.
#pragma once

enum { REGULUS_KERNEL_ABI = 2, REGULUS_LANES = 8 };

/// How MXCSR must be set while a function of the kernel runs. The caller sets it and restores it.
enum { REGULUS_ROUND_NEAREST = 0, REGULUS_ROUND_UPWARD = 1 };

/// Evaluates one function of a model on 8 boxes at once.
///
/// Shape     boxes[(2*v + s)*8 + lane]: bound s (0 lower, 1 upper) of variable v.
///           points[p*8 + lane]: exact doubles, the entries of K row-major. May be null if unused.
///           out[(2*e + s)*8 + lane]: bound s of output e. All three 64-byte aligned, not
///           overlapping.
/// Requires  |boxes| ≤ 2^64, |points| ≤ 2^128, lower ≤ upper, no NaN; the kernel's rounding set.
/// Ensures   for each lane whose bit in the result is 0: every expression is defined at every
///           point of the box, and each output encloses its expression over the box, with finite
///           bounds. For a lane whose bit is 1 nothing is known ("undefined"): its outputs are
///           meaningless.
typedef unsigned (*regulus_function)(const double* boxes, const double* points, double* out,
                                     const void* context);

/// A kernel: the functions of one model over one motion variety. n columns, m ≥ n rows.
/// Variables are the motion parameters, then the uncertain quantities. Functions may be null.
typedef struct regulus_kernel {
  unsigned abi;               ///< REGULUS_KERNEL_ABI of the generator
  unsigned rounding;          ///< REGULUS_ROUND_…
  unsigned variables;         ///< inputs of every function
  unsigned motion_variables;  ///< how many of them, from the first, are motion parameters
  unsigned rows, columns;     ///< m, n
  unsigned constraints;       ///< number of inequality constraints
  unsigned pose_parameters;
  regulus_function matrix;              ///< A: m·n outputs
  regulus_function matrix_derivatives;  ///< ∂_kA for each variable k: variables·m·n outputs
  regulus_function left_product;        ///< K·A, K n×m: n·n outputs
  regulus_function left_derivatives;  ///< ∂_k(K·A) for each variable k: variables·n·n outputs
  regulus_function right_product;     ///< A·K, K n×m: m·m outputs; null unless m = n
  regulus_function
      row_scale;  ///< product of the row scales: 1 output, positive; null when all are 1
  regulus_function constraint;   ///< H_j, each ≤ 0 inside the variety: `constraints` outputs
  regulus_function pose;         ///< the pose as a function of the variables
  regulus_function determinant;  ///< det A in closed form: 1 output; null unless formed
  regulus_function determinant_derivatives;  ///< ∂_k det A: variables outputs; null unless formed
  const void* context;                       ///< passed to every function
  const char* identity;                      ///< hash of the program the kernel was generated from
} regulus_kernel;
