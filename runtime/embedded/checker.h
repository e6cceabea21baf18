/* SPDX-License-Identifier: Apache-2.0 */
/* Checks a piece of a trajectory, or of a workspace, from a control loop. Valid C99 and C++.
 *
 *     regulus_checker* checker = regulus_checker_new(&my_kernel, lower, upper, 0.0, 256,
 *                                                   fault, sizeof fault);
 *     ...
 *     for (;;) {   // every millisecond, say
 *       if (regulus_check(checker, from, to, &report) != REGULUS_CHECK_NO_SINGULARITY) brake();
 *     }
 *
 * `my_kernel` is a regulus_kernel (runtime/kernel/abi.hpp) that was compiled ahead of time.
 * regulus_checker_new allocates everything. regulus_check does not allocate, throw or lock, and
 * evaluates at most `max_boxes` boxes. */
#ifndef REGULUS_EMBEDDED_CHECKER_H
#define REGULUS_EMBEDDED_CHECKER_H

#include <stddef.h>

#include "runtime/kernel/abi.hpp"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum regulus_check_verdict {
  REGULUS_CHECK_NO_SINGULARITY = 0,  /* proved for every pose of the piece */
  REGULUS_CHECK_SINGULARITY = 1,     /* the contrary is proved */
  REGULUS_CHECK_POSSIBLE_PROBLEM = 2 /* neither is proved; nothing is claimed */
} regulus_check_verdict;

typedef enum regulus_check_reason {
  REGULUS_CHECK_ALL_CERTIFIED,     /* NO SINGULARITY */
  REGULUS_CHECK_OPPOSITE_SIGNS,    /* two points, determinants of opposite signs, joined */
  REGULUS_CHECK_SMALL_DETERMINANT, /* a point with |det| <= alpha */
  REGULUS_CHECK_WIDTH,             /* a box that is not split any more could not be decided */
  REGULUS_CHECK_UNCERTAINTY,       /* at one pose the uncertain quantities alone defeat the test */
  REGULUS_CHECK_UNDEFINED,         /* an expression is undefined at, or near, a pose */
  REGULUS_CHECK_BOX_BUDGET,        /* more boxes would be needed */
  REGULUS_CHECK_BAD_RANGES,        /* a NaN, bounds in the wrong order, outside the whole range */
  REGULUS_CHECK_NO_POSE            /* the constraints exclude every pose of the piece */
} regulus_check_reason;

typedef struct regulus_check_report {
  regulus_check_verdict verdict;
  regulus_check_reason reason;
  unsigned boxes; /* evaluated */
  /* The places: `places` boxes, bound s (0 lower, 1 upper) of variable v of box p at
   * place[2*(p*variables + v) + s]. SINGULARITY: the points of the proof, 1 or 2. POSSIBLE PROBLEM:
   * the box that could not be decided, if there is one. Valid until the next call with the same
   * checker. */
  unsigned places;
  const double* place;
} regulus_check_report;

typedef struct regulus_checker regulus_checker;

/* Prepares for checks of a kernel.
 *
 * Shape     lower, upper: a bound for each variable of the kernel, motion parameters first. The
 *           pieces to be checked lie in the ranges of the motion parameters. Uncertain quantities
 *           have all of their range in every check.
 * Requires  `kernel`, and all that it points to, stay unchanged for the life of the checker.
 *           alpha >= 0. 1 <= max_boxes <= 2^20: the most boxes of one check; memory grows with it
 *           up to some thousand boxes.
 * Errors    returns null; if `fault` is not null, writes the reason there, cut to `fault_size`
 *           bytes. */
regulus_checker* regulus_checker_new(const regulus_kernel* kernel, const double* lower,
                                     const double* upper, double alpha, unsigned max_boxes,
                                     char* fault, size_t fault_size);
void regulus_checker_free(regulus_checker* checker);

/* Checks one piece.
 *
 * Shape     lower, upper: a bound for each motion parameter.
 * Ensures   REGULUS_CHECK_NO_SINGULARITY: for every motion parameter within the bounds (as exact
 *           numbers) at which no constraint is positive, and every value of the uncertain
 *           quantities, J^-1 is defined and of full column rank, and |det J^-1| > alpha if
 *           alpha > 0. `report` may be null. One thread at a time may use a checker. The caller's
 *           floating-point environment is kept, whatever it is. */
regulus_check_verdict regulus_check(regulus_checker* checker, const double* lower,
                                    const double* upper, regulus_check_report* report);

#ifdef __cplusplus
}
#endif

#endif
