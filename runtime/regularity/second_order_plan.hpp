// SPDX-License-Identifier: Apache-2.0
// The terms that second_order.hpp sums, and the places of its numbers: plain arrays, so that code
// compiled for any instruction set can read them.
#pragma once

#include "runtime/regularity/lanes.hpp"
#include "runtime/regularity/views.hpp"

namespace regulus::detail {

/// A part of an array.
struct PlanRange {
  unsigned begin = 0, end = 0;
  [[nodiscard]] __attribute__((always_inline)) constexpr unsigned size() const noexcept {
    return end - begin;
  }
};

struct SecondOrderPlan {
  /// One listed derivative: `at` in its list, `place` in a matrix with columns_of_A columns.
  struct Entry {
    unsigned row, column, at, place;
  };
  struct Wide {
    unsigned variable;
    PlanRange columns;  ///< in `columns`: those of D_p that are not zero
    PlanRange first;    ///< in `entries`
  };
  struct Pair {
    unsigned p, q;     ///< of wide variables, p ≤ q
    PlanRange second;  ///< in `entries`, row by row, column by column
    unsigned starts;   ///< in `starts`: where each row begins in `entries`, and the last one ends
  };
  struct SameRow {
    unsigned variable;
    PlanRange second;  ///< in `entries`
  };
  struct RowVariable {
    unsigned variable, slot;
    PlanRange first;     ///< in `entries`
    unsigned mixed;      ///< in `mixed`: one range of `entries` for each wide variable
    PlanRange same_row;  ///< in `same_rows`: by itself and those before it
  };
  /// One uncertain quantity, or the coordinates of a point in a ball: a part of `row_variables`.
  struct Group {
    PlanRange members;
    unsigned slot;
  };

  unsigned rows, columns_of_A, slots, wides, pairs, groups;
  unsigned moving;            ///< K(t) and w_k(t) move with so many of the first wide variables
  bool keeps_shares;          ///< true if impacts are needed
  bool weighs_row_variables;  ///< true if those of variables with a row are needed, too
  const unsigned* touched;    ///< rows, by slot
  const unsigned* columns;
  const unsigned* starts;
  const Entry* entries;
  const unsigned* columns_of_entries;
  const Wide* wide;  ///< in the order of the variables
  const Pair* pair;
  const PlanRange* mixed;
  const SameRow* same_rows;
  const RowVariable* row_variables;
  const Group* group;
};

/// The numbers for one batch, in point layout. n columns of A, s slots, w wide variables. A sum
/// over p has the weights r_p, over p, q the weights r_pr_q.
struct SecondOrderWork {
  PointArray K, abs_K;               // n×s: at the rows touched
  PointArray D, DK, sum_DK;          // w·n×n; w·n×s; n×s
  PointArray e, sum_d, sum_D;        // n×n
  PointArray magnitude_of_B;         // n×n: ½ Σ_pq of |∂_p∂_qB|
  PointArray linear, rounding, P;    // n×n
  PointArray pair_sum, pair_radius;  // a few rows of n: of one pair
  PointArray pairs;                  // n×n for each pair: what it adds to P
  PointArray weight, weight_of_g;    // s×n: Σ_k Δ_k of |w̄_k|, of Σ_p r_p|g_kp|
  PointArray same_row;               // s×n: Σ_jk Δ_jΔ_k|∂_j∂_kA| within a row
  PointArray rest;                   // s×n: the rest of Σ_k Δ_k|w_k − w_k(t)|
  PointArray R, R_of_wide, R_of_row;  // s×s; (1 + w)·s×s: fixed, by each p; s for each row variable
  PointArray forms, moving;  // s for each row variable: w̄_kᵀK₀; s×s: R without these
  PointArray center, slope;  // n: w̄_k by entry; w·n: g_kp by entry
  PointArray weight_of_value, weight_of_row;  // 1 + w; s
  PointArray group_R, group_lower;            // (1 + w)·s, (1 + w)·n
};

/// The values for eight boxes.
struct SecondOrderInput {
  ConstPointMatrix K;              ///< n×m
  ConstIntervalMatrix product;     ///< B(t₀), n×n
  ConstIntervalVector first;       ///< at (t₀, ū), as listed
  ConstIntervalVector second;      ///< over the boxes, as listed
  ConstIntervalVector row_first;   ///< at (t₀, ū), as listed
  ConstIntervalVector row_second;  ///< over the boxes, as listed
  ConstPointVector radius;         ///< r_p, Δ_k: of each variable
};

/// γ of second_order_lanes.hpp, for sums of at most 64 terms.
inline constexpr double kSecondOrderGamma = (64 + 4) * 0x1p-50;
static_assert(2 * kMaxRows + 1 < 64);

}  // namespace regulus::detail
