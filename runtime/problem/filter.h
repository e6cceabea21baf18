// SPDX-License-Identifier: Apache-2.0
// A regularity test of your own, in a shared object that `regulus check --filter FILE.so` loads.
// Valid C99 and C++; it needs no other header. It takes part in the search after the built-in
// tests, on the boxes that they left undecided. Regulus cannot check its answers. The report says
// so: it has the name, the file, and the number of boxes that rest on the test.
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

enum { REGULUS_FILTER_ABI = 1, REGULUS_FILTER_LANES = 8 };

/// Eight boxes, one per lane, and what is known about them. In every requested lane, all
/// expressions of the model are defined everywhere on the box, and every array below encloses the
/// quantities that it describes. The contents of the other lanes are meaningless.
///
/// Shape     bound s (0 lower, 1 upper) of interval e: array[(2*e + s)*8 + lane]; double e of
///           `preconditioner`: array[e*8 + lane]. Matrices are row-major. 64-byte aligned.
typedef struct regulus_filter_boxes {
  unsigned lanes;                ///< bit l: lane l is requested
  unsigned variables;            ///< motion parameters first, then uncertain quantities
  unsigned motion_variables;     ///< how many of them are motion parameters
  unsigned rows, columns;        ///< m, n of A: m ≥ n
  const double* boxes;           ///< the range of each variable
  const double* matrix;          ///< A, m×n
  const double* preconditioner;  ///< K, n×m: any doubles, roughly an inverse of A at the midpoint
  const double* product;         ///< K·A, n×n, often narrower than K times `matrix`
  const double* row_scale;       ///< s > 0, one entry: |det J⁻¹| = s·|det A|
  double alpha;                  ///< α, not rounded down; 0: the question is full rank
} regulus_filter_boxes;

/// Requires  it throws no exception, changes none of its arguments, and may be called from any
///           thread. Rounding is to nearest; if it changes the rounding, its answer is not used.
/// Ensures   bit l of the result asserts that A has full column rank, and |det J⁻¹| > α if α > 0,
///           at every point of box l. Bits of other lanes are ignored.
typedef unsigned (*regulus_filter_function)(const regulus_filter_boxes* boxes, void* context);

typedef struct regulus_filter_interface {
  unsigned abi;      ///< REGULUS_FILTER_ABI
  const char* name;  ///< for reports: 1 to 64 printable ASCII characters
  regulus_filter_function certify;
  void* context;  ///< passed to `certify`
} regulus_filter_interface;

/// The shared object defines this.
extern const regulus_filter_interface regulus_filter;

#ifdef __cplusplus
}
#endif
