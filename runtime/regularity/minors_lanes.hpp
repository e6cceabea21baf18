// SPDX-License-Identifier: Apache-2.0
// The loops over minors, with the vectors of the instruction set for which the including file is
// compiled. Included by backend_portable.cpp, backend_avx2.cpp, backend_avx512.cpp only.
//
// Only always-inlined or ISA-namespaced functions may be used here; see elementary/lanes.hpp.
#pragma once

#include "runtime/regularity/backend.hpp"
#include "runtime/regularity/pack_lanes.hpp"

namespace regulus::detail::minors {
inline namespace REGULUS_LANES_ISA {

using namespace lanes::REGULUS_LANES_ISA;

inline constexpr unsigned kMaxOfMinors = kMaxVertexOrder;
inline constexpr unsigned kMaxSets = 1U << kMaxOfMinors;

typedef Vector VectorOfMatrix __attribute__((may_alias));

struct Range {
  Vector lo, hi;
};

inline Vector load(const double* x) noexcept { return *reinterpret_cast<const VectorOfMatrix*>(x); }
inline void store(double* x, Vector value) noexcept {
  *reinterpret_cast<VectorOfMatrix*>(x) = value;
}

/// Plain processors have no instruction that counts bits, so the sizes are in a table.
struct SizeOfSets {
  unsigned char of[kMaxSets] = {};
  constexpr SizeOfSets() noexcept {
    for (unsigned set = 1; set < kMaxSets; ++set)
      of[set] = static_cast<unsigned char>(of[set >> 1] + (set & 1U));
  }
};
inline constexpr SizeOfSets kSize;

inline unsigned size_of(unsigned set) noexcept { return kSize.of[set]; }
/// Returns true if the term of column j has sign + in the expansion of `set` along its last row: an
/// even number of columns of the set lies to the right of j.
inline bool is_positive(unsigned set, unsigned j) noexcept { return size_of(set >> j) % 2 == 1; }

inline Range multiply(Range a, Range b) noexcept {
  const Vector p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  return {smaller(smaller(p, q), smaller(r, s)), larger(larger(p, q), larger(r, s))};
}

inline void expand(ConstIntervalMatrix matrix, IntervalVector determinant) noexcept {
  const unsigned n = matrix.rows();
  double* const result = determinant.data();
  Range minors[kMaxSets];
  for (unsigned lane = 0; lane < kLanes; lane += kVectorLanes) {
    const Vector one = splat<Vector>(1.0);
    minors[0] = {one, one};
    for (unsigned set = 1; set < 1U << n; ++set) {
      Range sum{Vector{}, Vector{}};
      for (unsigned left = set; left != 0; left &= left - 1) {
        const auto j = static_cast<unsigned>(__builtin_ctz(left));
        const double* entry = matrix.data() + ((size_of(set) - 1) * n + j) * 2 * kLanes + lane;
        const Range term = multiply({load(entry), load(entry + kLanes)}, minors[set & ~(1U << j)]);
        sum = is_positive(set, j) ? Range{sum.lo + term.lo, sum.hi + term.hi}
                                  : Range{sum.lo - term.hi, sum.hi - term.lo};
      }
      minors[set] = sum;
    }
    store(result + lane, minors[(1U << n) - 1].lo);
    store(result + kLanes + lane, minors[(1U << n) - 1].hi);
  }
}

inline void permanent(ConstPointMatrix magnitude, double factor, LaneNumbers& result) noexcept {
  const unsigned n = magnitude.rows();
  Vector permanents[kMaxSets];
  const Vector slack = splat<Vector>(0x1p-1000);
  for (unsigned lane = 0; lane < kLanes; lane += kVectorLanes) {
    permanents[0] = splat<Vector>(1.0);
    for (unsigned set = 1; set < 1U << n; ++set) {
      Vector sum{};
      for (unsigned left = set; left != 0; left &= left - 1) {
        const auto j = static_cast<unsigned>(__builtin_ctz(left));
        sum += load(magnitude.data() + ((size_of(set) - 1) * n + j) * kLanes + lane) *
               permanents[set & ~(1U << j)];
      }
      permanents[set] = sum * splat<Vector>(factor) + slack;
    }
    store(result.of + lane, permanents[(1U << n) - 1]);
  }
}

/// Some rows of the matrix for eight choices of their signs uᵢ, lane by lane, and both signs of vⱼ.
class SignedRows {
 public:
  SignedRows(unsigned count, unsigned n) noexcept : count_(count), n_(n) {
    for (unsigned set = 1; set < 1U << n; ++set) {
      if (size_of(set) > count) continue;
      for (unsigned left = set; left != 0; left &= left - 1) {
        const auto j = static_cast<unsigned>(__builtin_ctz(left));
        terms_[term_count_++] = {static_cast<unsigned char>(set),
                                 static_cast<unsigned char>(set & ~(1U << j)),
                                 static_cast<unsigned char>((size_of(set) - 1) * n + j),
                                 is_positive(set, j), (left & (left - 1)) == 0};
      }
    }
  }

  /// Lane l gets the choice first_choice + l; bit i of a choice set means uᵢ = −1 for row i here.
  void fill(const double* lo, const double* hi, unsigned first_choice) noexcept {
    for (unsigned e = 0; e < count_ * n_; ++e)
      for (unsigned l = 0; l < kLanes; ++l) {
        const bool negative = ((first_choice + l) >> (e / n_) & 1U) != 0;
        form_[0][e].lane(l) = negative ? hi[e] : lo[e];
        form_[1][e].lane(l) = negative ? lo[e] : hi[e];
      }
  }

  /// Computes minors of the first k rows and each set of k columns; bit j of v set means vⱼ = −1.
  void minors_for(unsigned v, Pack* minors) const noexcept {
    Pack row[kMaxOfMinors * kMaxOfMinors];
    for (unsigned e = 0; e < count_ * n_; ++e) row[e] = form_[v >> (e % n_) & 1U][e];
    minors[0] = Pack::of(1.0);
    Pack sum = Pack::of(0.0);
    for (const Term *term = terms_, *end = terms_ + term_count_; term != end; ++term) {
      if (term->positive)
        sum.add_product(row[term->entry], minors[term->rest]);
      else
        sum.subtract_product(row[term->entry], minors[term->rest]);
      if (!term->last) continue;
      minors[term->set] = sum;
      sum = Pack::of(0.0);
    }
  }

 private:
  struct Term {
    unsigned char set, rest, entry;
    bool positive, last;
  };
  unsigned count_, n_;
  unsigned term_count_ = 0;
  Term terms_[kMaxOfMinors * kMaxSets / 2];
  Pack form_[2][kMaxOfMinors * kMaxOfMinors];  ///< vⱼ = 1, vⱼ = −1
};

/// Laplace's expansion along the upper rows: the minors that are multiplied, and their signs.
class Laplace {
 public:
  struct Term {
    unsigned upper, lower;  ///< the columns of each minor
    double sign;
  };

  Laplace(unsigned n, unsigned upper_rows) noexcept {
    const unsigned every = (1U << n) - 1;
    for (unsigned set = 0; set <= every; ++set)
      if (size_of(set) == upper_rows) terms_[count_++] = {set, every & ~set, sign_of(set)};
  }
  [[nodiscard]] const Term* begin() const noexcept { return terms_; }
  [[nodiscard]] const Term* end() const noexcept { return terms_ + count_; }

 private:
  /// Returns −1 for an odd number of pairs of a column outside the set and one in it to its right.
  static double sign_of(unsigned set) noexcept {
    unsigned pairs = 0;
    for (unsigned left = set; left != 0; left &= left - 1) {
      const auto j = static_cast<unsigned>(__builtin_ctz(left));
      pairs += j - size_of(set & ((1U << j) - 1));
    }
    return pairs % 2 == 0 ? 1.0 : -1.0;
  }

  Term terms_[kMaxSets];
  unsigned count_ = 0;
};

/// Tests if every lane is beyond the error on the same side as all earlier lanes.
class SharedSign {
 public:
  explicit SharedSign(double error) noexcept : error_(error) {}
  /// A NaN is on neither side.
  [[nodiscard]] bool holds_for(const Pack& determinant) noexcept {
    for (const Vector& part : determinant.part) {
      const Vector error = splat<Vector>(error_);
      positive_ = positive_ && lane_bits(error < part) == kEvery;
      negative_ = negative_ && lane_bits(part < -error) == kEvery;
    }
    return positive_ || negative_;
  }

 private:
  static constexpr unsigned kEvery = (1U << kVectorLanes) - 1;
  double error_;
  bool positive_ = true;
  bool negative_ = true;
};

/// Tests the determinants for one v: every choice of the signs of the upper rows, and for each of
/// these the eight choices of the lower three rows in the lanes.
inline bool shares_sign(const SignedRows& upper, const SignedRows& lower, const Laplace& laplace,
                        unsigned v, SharedSign& sign) noexcept {
  Pack of_upper[kMaxSets], of_lower[kMaxSets];
  upper.minors_for(v, of_upper);
  lower.minors_for(v, of_lower);
  for (unsigned choice = 0; choice < kLanes; ++choice) {
    Pack determinant = Pack::of(0.0);
    for (const Laplace::Term& term : laplace)
      determinant.add_product(Pack::of(term.sign * of_upper[term.upper].lane(choice)),
                              of_lower[term.lower]);
    if (!sign.holds_for(determinant)) return false;
  }
  return true;
}

/// A^{uv} = A^{−u,−v}, so v₀ = 1 is enough.
inline bool vertices_share_sign(const BoundsOfOneLane& matrix, double error) noexcept {
  const unsigned n = matrix.n;
  constexpr unsigned kLowerRows = 3;
  const unsigned lower_rows = n < kLowerRows ? n : kLowerRows;
  const unsigned upper_rows = n - lower_rows;
  SignedRows upper(upper_rows, n), lower(lower_rows, n);
  const Laplace laplace(n, upper_rows);
  lower.fill(matrix.lo + upper_rows * n, matrix.hi + upper_rows * n, 0);
  SharedSign sign(error);
  for (unsigned choice = 0; choice < 1U << upper_rows; choice += kLanes) {
    upper.fill(matrix.lo, matrix.hi, choice);
    for (unsigned v = 0; v < 1U << n; v += 2)
      if (!shares_sign(upper, lower, laplace, v, sign)) return false;
  }
  return true;
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::minors
