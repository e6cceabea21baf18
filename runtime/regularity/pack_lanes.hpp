// SPDX-License-Identifier: Apache-2.0
// Eight doubles in as few vectors as possible, and arrays of them in point layout. For files that
// are compiled once per instruction set; elementary/lanes.hpp says what these may use.
#pragma once

#include "runtime/interval/elementary/lanes.hpp"
#include "runtime/interval/lanes.hpp"
#include "runtime/regularity/views.hpp"

namespace regulus::detail::lanes {
inline namespace REGULUS_LANES_ISA {

using namespace elementary::REGULUS_LANES_ISA;

/// An array of doubles, at any address that is valid for doubles.
typedef double VectorInArray
    __attribute__((vector_size(REGULUS_VECTOR_BYTES), may_alias, aligned(8)));

/// Returns a·b + c, rounded once if the processor can, else twice; once has the smaller bound.
REGULUS_LANE_INLINE Vector fused(Vector a, Vector b, Vector c) noexcept {
#if REGULUS_VECTOR_BYTES == 64
  return _mm512_fmadd_pd(a, b, c);
#elif REGULUS_VECTOR_BYTES == 32
  return _mm256_fmadd_pd(a, b, c);
#else
  return a * b + c;
#endif
}

struct Pack {
  static constexpr unsigned kParts = kLanes / kVectorLanes;
  Vector part[kParts];

  REGULUS_LANE_INLINE static Pack of(double c) noexcept {
    Pack x;
    for (Vector& p : x.part) p = splat<Vector>(c);
    return x;
  }
  REGULUS_LANE_INLINE static Pack load(const double* x) noexcept {
    Pack y;
    for (unsigned p = 0; p < kParts; ++p)
      y.part[p] = *reinterpret_cast<const VectorInArray*>(x + p * kVectorLanes);
    return y;
  }
  REGULUS_LANE_INLINE void store(double* x) const noexcept {
    for (unsigned p = 0; p < kParts; ++p)
      *reinterpret_cast<VectorInArray*>(x + p * kVectorLanes) = part[p];
  }

  REGULUS_LANE_INLINE double& lane(unsigned l) noexcept {
    return reinterpret_cast<double*>(part)[l];
  }
  [[nodiscard]] REGULUS_LANE_INLINE double lane(unsigned l) const noexcept {
    return reinterpret_cast<const double*>(part)[l];
  }

  /// Rounded twice, on every instruction set.
  REGULUS_LANE_INLINE void add_product(const Pack& a, const Pack& b) noexcept {
    for (unsigned p = 0; p < kParts; ++p) part[p] += a.part[p] * b.part[p];
  }
  REGULUS_LANE_INLINE void subtract_product(const Pack& a, const Pack& b) noexcept {
    for (unsigned p = 0; p < kParts; ++p) part[p] -= a.part[p] * b.part[p];
  }
  /// Rounded once or twice.
  REGULUS_LANE_INLINE void add_fused(const Pack& a, const Pack& b) noexcept {
    for (unsigned p = 0; p < kParts; ++p) part[p] = fused(a.part[p], b.part[p], part[p]);
  }
  REGULUS_LANE_INLINE void subtract_fused(const Pack& a, const Pack& b) noexcept {
    for (unsigned p = 0; p < kParts; ++p) part[p] = fused(-a.part[p], b.part[p], part[p]);
  }
};

REGULUS_LANE_INLINE Pack operator+(const Pack& a, const Pack& b) noexcept {
  Pack c;
  for (unsigned p = 0; p < Pack::kParts; ++p) c.part[p] = a.part[p] + b.part[p];
  return c;
}
REGULUS_LANE_INLINE Pack operator-(const Pack& a, const Pack& b) noexcept {
  Pack c;
  for (unsigned p = 0; p < Pack::kParts; ++p) c.part[p] = a.part[p] - b.part[p];
  return c;
}
REGULUS_LANE_INLINE Pack operator*(const Pack& a, const Pack& b) noexcept {
  Pack c;
  for (unsigned p = 0; p < Pack::kParts; ++p) c.part[p] = a.part[p] * b.part[p];
  return c;
}
REGULUS_LANE_INLINE Pack operator/(const Pack& a, const Pack& b) noexcept {
  Pack c;
  for (unsigned p = 0; p < Pack::kParts; ++p) c.part[p] = a.part[p] / b.part[p];
  return c;
}
REGULUS_LANE_INLINE Pack magnitude(const Pack& a) noexcept {
  Pack c;
  for (unsigned p = 0; p < Pack::kParts; ++p) c.part[p] = elementary::magnitude(a.part[p]);
  return c;
}
/// Returns b if one of them is NaN.
REGULUS_LANE_INLINE Pack larger(const Pack& a, const Pack& b) noexcept {
  Pack c;
  for (unsigned p = 0; p < Pack::kParts; ++p) c.part[p] = elementary::larger(b.part[p], a.part[p]);
  return c;
}
REGULUS_LANE_INLINE Pack square_root(const Pack& a) noexcept {
  Pack c;
  for (unsigned p = 0; p < Pack::kParts; ++p) c.part[p] = elementary::square_root(a.part[p]);
  return c;
}
/// Returns one bit per lane.
REGULUS_LANE_INLINE LaneMask less_lanes(const Pack& a, const Pack& b) noexcept {
  LaneMask lanes = 0;
  for (unsigned p = 0; p < Pack::kParts; ++p)
    lanes |= lane_bits(elementary::less(a.part[p], b.part[p])) << (p * kVectorLanes);
  return lanes;
}
REGULUS_LANE_INLINE Pack select_less(const Pack& a, const Pack& b, const Pack& yes,
                                     const Pack& no) noexcept {
  Pack c;
  for (unsigned p = 0; p < Pack::kParts; ++p)
    c.part[p] = elementary::select(elementary::less(a.part[p], b.part[p]), yes.part[p], no.part[p]);
  return c;
}
/// Applies raise_ru of lanes.hpp to each lane.
REGULUS_LANE_INLINE Pack raised(const Pack& x, double factor) noexcept {
  return x * Pack::of(factor) + Pack::of(0x1p-1000);
}

/// An array in point layout.
struct PackArray {
  double* x;

  REGULUS_LANE_INLINE Pack operator[](unsigned at) const noexcept {
    return Pack::load(x + at * kLanes);
  }
  REGULUS_LANE_INLINE void put(unsigned at, const Pack& value) const noexcept {
    value.store(x + at * kLanes);
  }
  REGULUS_LANE_INLINE void add(unsigned at, const Pack& value) const noexcept {
    put(at, (*this)[at] + value);
  }
  REGULUS_LANE_INLINE void add_fused(unsigned at, const Pack& a, const Pack& b) const noexcept {
    Pack sum = (*this)[at];
    sum.add_fused(a, b);
    put(at, sum);
  }
  REGULUS_LANE_INLINE PackArray operator+(unsigned at) const noexcept { return {x + at * kLanes}; }
};

/// Returns the numbers of a view; those of a constant view must not be changed.
template <typename Double, LaneLayout kLayout, LaneShape kShape>
REGULUS_LANE_INLINE PackArray packs_of(LaneView<Double, kLayout, kShape> view) noexcept {
  return {const_cast<double*>(view.data())};
}

/// Some rows of a matrix: `terms` of them, listed in `rows`; null: the first ones.
struct Rows {
  const unsigned* rows;
  unsigned terms;
  PackArray matrix;
  unsigned stride;

  [[nodiscard]] REGULUS_LANE_INLINE PackArray operator[](unsigned k) const noexcept {
    return matrix + (rows == nullptr ? k : rows[k]) * stride;
  }
};

/// Adds aᵀB, for the columns j … j + kAtOnce − 1, to sums that stay in registers.
template <unsigned kAtOnce>
REGULUS_LANE_INLINE void add_products(PackArray a, const Rows& b, unsigned j, Pack* sum) noexcept {
  for (unsigned k = 0; k < b.terms; ++k) {
    const Pack factor = a[k];
    const PackArray row = b[k] + j;
    for (unsigned c = 0; c < kAtOnce; ++c) sum[c].add_fused(factor, row[c]);
  }
}
template <unsigned kAtOnce>
REGULUS_LANE_INLINE void subtract_products(PackArray a, const Rows& b, unsigned j,
                                           Pack* sum) noexcept {
  for (unsigned k = 0; k < b.terms; ++k) {
    const Pack factor = Pack::of(0.0) - a[k];
    const PackArray row = b[k] + j;
    for (unsigned c = 0; c < kAtOnce; ++c) sum[c].add_fused(factor, row[c]);
  }
}

/// Calls visit.template operator()<kAtOnce>(j) for blocks of columns that fit in registers.
template <typename Visit>
REGULUS_LANE_INLINE void for_each_block(unsigned count, Visit&& visit) noexcept {
  unsigned j = 0;
  for (; j + 6 <= count; j += 6) visit.template operator()<6>(j);
  for (; j + 3 <= count; j += 3) visit.template operator()<3>(j);
  for (; j < count; ++j) visit.template operator()<1>(j);
}

/// Calls visit.template operator()<kRows, kAtOnce>(i, j) for blocks of a matrix: more rows at once
/// where there are more registers for them.
template <typename Visit>
REGULUS_LANE_INLINE void for_each_block(unsigned rows, unsigned columns, Visit&& visit) noexcept {
  constexpr unsigned kRows = REGULUS_VECTOR_BYTES == 64 ? 2 : 1;
  unsigned i = 0;
  const auto of_row = [&]<unsigned kAtOnce>(unsigned j) __attribute__((always_inline)) {
    visit.template operator()<1, kAtOnce>(i, j);
  };
  const auto of_rows = [&]<unsigned kAtOnce>(unsigned j) __attribute__((always_inline)) {
    visit.template operator()<kRows, kAtOnce>(i, j);
  };
  for (; i + kRows <= rows; i += kRows) for_each_block(columns, of_rows);
  for (; i < rows; ++i) for_each_block(columns, of_row);
}

/// Some rows of a matrix of which only the listed columns are not zero.
struct SparseRows {
  PackArray matrix;
  unsigned stride;
  const unsigned* columns;
  unsigned terms;
};

/// Sums for a block of a product's rows and columns, in registers.
template <unsigned kRows, unsigned kAtOnce>
struct Block {
  Pack x[kRows][kAtOnce];

  REGULUS_LANE_INLINE Block() noexcept {
    for (unsigned r = 0; r < kRows; ++r)
      for (unsigned c = 0; c < kAtOnce; ++c) x[r][c] = Pack::of(0.0);
  }

  /// Calls visit(r, c, sum) for each sum.
  template <typename Visit>
  REGULUS_LANE_INLINE void for_each(Visit&& visit) const noexcept {
    for (unsigned r = 0; r < kRows; ++r)
      for (unsigned c = 0; c < kAtOnce; ++c) visit(r, c, x[r][c]);
  }
  REGULUS_LANE_INLINE void read(PackArray matrix, unsigned stride) noexcept {
    for (unsigned r = 0; r < kRows; ++r)
      for (unsigned c = 0; c < kAtOnce; ++c) x[r][c] = matrix[r * stride + c];
  }
  REGULUS_LANE_INLINE void write(PackArray matrix, unsigned stride) const noexcept {
    for (unsigned r = 0; r < kRows; ++r)
      for (unsigned c = 0; c < kAtOnce; ++c) matrix.put(r * stride + c, x[r][c]);
  }
  /// Adds AB, for the columns of B from its first one on.
  REGULUS_LANE_INLINE void add_product(const SparseRows& A, PackArray B, unsigned stride) noexcept {
    for (unsigned k = 0; k < A.terms; ++k) {
      const unsigned column = A.columns[k];
      const PackArray row = B + column * stride;
      for (unsigned r = 0; r < kRows; ++r) {
        const Pack factor = A.matrix[r * A.stride + column];
        for (unsigned c = 0; c < kAtOnce; ++c) x[r][c].add_fused(factor, row[c]);
      }
    }
  }
};

/// sums[j] += (aᵀB)_j for `count` columns.
REGULUS_LANE_INLINE void add_row_product(PackArray a, const Rows& b, unsigned count,
                                         PackArray sums) noexcept {
  for_each_block(
      count, [&]<unsigned kAtOnce>(unsigned j) __attribute__((always_inline)) {
        Pack sum[kAtOnce];
        for (unsigned c = 0; c < kAtOnce; ++c) sum[c] = sums[j + c];
        add_products<kAtOnce>(a, b, j, sum);
        for (unsigned c = 0; c < kAtOnce; ++c) sums.put(j + c, sum[c]);
      });
}

}  // namespace REGULUS_LANES_ISA
}  // namespace regulus::detail::lanes
