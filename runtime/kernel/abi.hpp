// SPDX-License-Identifier: Apache-2.0
// The contract between a generated kernel and its callers. It is valid C99 and C++, and needs no
// other header, so that code compiled in process can include it.
#pragma once

enum { REGULUS_KERNEL_ABI = 3, REGULUS_LANES = 8 };

/// The MXCSR setting that a kernel's functions need. The caller sets it and restores it.
enum { REGULUS_ROUND_NEAREST = 0, REGULUS_ROUND_UPWARD = 1 };

/// The number of bits of the grid of a row of K, see regulus_function, and the least exponent of
/// the greatest entry of a row that is not zero.
enum { REGULUS_POINT_BITS = 29, REGULUS_LEAST_POINT_EXPONENT = -800 };

/// Evaluates one function of a model on 8 boxes at once.
///
/// Shape     boxes[(2*v + s)*8 + lane]: bound s (0 lower, 1 upper) of variable v.
///           points[p*8 + lane]: exact doubles, the entries of K row-major. May be null if unused.
///           out[(2*e + s)*8 + lane]: bound s of output e. All three 64-byte aligned, not
///           overlapping.
/// Requires  |boxes| ≤ 2^64, |points| ≤ 2^128, lower ≤ upper, no NaN; the kernel's rounding set.
///           Each row of K on a grid: its entries are multiples of one power of two, smaller than
///           2^REGULUS_POINT_BITS times that, and the greatest of them is 0 or at least
///           2^REGULUS_LEAST_POINT_EXPONENT in magnitude. Then sums of them with short coefficients
///           are doubles, and a kernel may compute these without a second bound. Any K is sound, so
///           the caller can choose one on a grid.
/// Ensures   for each lane whose bit in the result is 0: every expression is defined at every
///           point of the box, and each output encloses its expression over the box, with finite
///           bounds. For a lane whose bit is 1 nothing is known ("undefined"): its outputs are
///           meaningless and differ between engines. regulus::CheckedKernel sets them to [−∞, ∞], so that
///           callers of that class see the same outputs with every engine.
typedef unsigned (*regulus_function)(const double* boxes, const double* points, double* out,
                                     const void* context);

/// The derivative in an output: of entry (row, column) by variable `first` and, unless it is
/// REGULUS_FIRST_ORDER, also by `second` ≥ first.
typedef struct regulus_derivative {
  unsigned row, column;
  unsigned first, second;
} regulus_derivative;

enum { REGULUS_FIRST_ORDER = 0x7fffffff };

/// A function whose outputs are derivatives, one for each listed place. Derivatives of that order
/// that are not listed are zero wherever A is defined. `function` is null if the list is empty.
typedef struct regulus_derivatives {
  regulus_function function;
  const regulus_derivative* list;
  unsigned count;
} regulus_derivatives;

/// Taylor's expansion of K·A to second order. Uncertain quantities that touch one row of A only are
/// treated separately: A is expanded at their nominal values ū.
typedef struct regulus_expansion {
  const int* row_of_variable;  ///< the only row that an uncertain quantity touches, or −1
  /// For each variable the number of the ball it is a coordinate of, or −1. Null: there are none.
  const int* ball_of_variable;
  /// Bounds of ū, lower and upper for each variable, unused where row_of_variable is −1. Null: the
  /// functions at ū take those quantities from `boxes` like any other.
  const double* nominal;
  regulus_function product;        ///< K·A at ū, n·n outputs
  regulus_derivatives first;       ///< of K·A at ū, n×n, by variables without a row of their own
  regulus_derivatives second;      ///< the same, second order
  regulus_derivatives row_first;   ///< of A, by variables that touch one row
  regulus_derivatives row_second;  ///< of A, by at least one variable that touches one row
} regulus_expansion;

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
  const regulus_expansion* expansion;        ///< may be null
  const void* context;                       ///< passed to every function
  const char* identity;                      ///< hash of the program the kernel was generated from
} regulus_kernel;
