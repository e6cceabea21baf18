// SPDX-License-Identifier: GPL-3.0-or-later
// Random families of matrices with exactly known determinants, for the tests of second order.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/regularity/midpoint_inverse.hpp"
#include "runtime/regularity/second_order.hpp"
#include "tests/support/lane_arrays.hpp"

namespace regulus::detail::test {

inline constexpr std::size_t kWide = 2;

/// A(t, u) = A₀ + t₀A₁ + t₁A₂ + t₀²A₃ + t₀t₁A₄ + t₁³A₅
///           + Σ_k u_k e_l(k) (w_k + t₀w'_k + t₁²w''_k + u_k w‴_k + u_{k−1} w⁗_k)ᵀ,
/// The last term exists only if u_{k−1} touches the same row. Midpoints and nominal values are 0.
struct Family {
  std::size_t m, n, variables;
  std::vector<std::vector<double>> A;               // six, m×n
  std::vector<std::size_t> row;                     // of u_k
  std::vector<std::vector<std::vector<double>>> w;  // of u_k: five, n
  std::vector<double> radius;                       // of t and each u
  bool in_balls = false;                            // u_{2i}, u_{2i+1}: a point in a disc

  Family(Random& random, std::size_t order, std::size_t extra_rows)
      : m(order + extra_rows), n(order) {
    const double size = std::ldexp(1.0, 1 - static_cast<int>(random.below(5)));
    for (int a = 0; a < 6; ++a) {
      A.emplace_back();
      for (std::size_t e = 0; e < m * n; ++e)
        A.back().push_back(a == 0 ? test::uniform(random, -0.5, 0.5) + (e / n == e % n ? 2.0 : 0.0)
                                  : test::uniform(random, -1, 1));
    }
    for (std::size_t p = 0; p < kWide; ++p) radius.push_back(size * test::uniform(random, 0, 0.5));
    for (std::size_t k = 0; k < 2 * m; ++k) {
      row.push_back(k % 2 == 1 ? row.back() : random.below(m));
      w.emplace_back();
      for (int part = 0; part < 5; ++part) {
        w.back().emplace_back();
        for (std::size_t j = 0; j < n; ++j)
          w.back().back().push_back(part > 0 && random.one_in(2) ? 0.0
                                                                 : test::uniform(random, -1, 1));
      }
      radius.push_back(size * test::uniform(random, 0, 0.3));
    }
    variables = radius.size();
  }

  [[nodiscard]] bool has_neighbour(std::size_t k) const { return k > 0 && row[k - 1] == row[k]; }

  [[nodiscard]] std::vector<Exact> at(const std::vector<Exact>& x) const {
    const Exact &s = x[0], &t = x[1];
    std::vector<Exact> result;
    for (std::size_t e = 0; e < m * n; ++e)
      result.push_back(Exact(A[0][e]) + s * Exact(A[1][e]) + t * Exact(A[2][e]) +
                       s * s * Exact(A[3][e]) + s * t * Exact(A[4][e]) +
                       t * t * t * Exact(A[5][e]));
    for (std::size_t k = 0; k < row.size(); ++k)
      for (std::size_t j = 0; j < n; ++j) {
        const Exact& u = x[kWide + k];
        Exact slope = Exact(w[k][0][j]) + s * Exact(w[k][1][j]) + t * t * Exact(w[k][2][j]) +
                      u * Exact(w[k][3][j]);
        if (has_neighbour(k)) slope = slope + x[kWide + k - 1] * Exact(w[k][4][j]);
        Exact& entry = result[row[k] * n + j];
        entry = entry + u * slope;
      }
    return result;
  }

  [[nodiscard]] RowStructure structure() const {
    RowStructure result;
    result.slot.assign(kWide, RowStructure::kWide);
    for (const std::size_t l : row) {
      const auto known = std::find(result.rows.begin(), result.rows.end(), l);
      result.slot.push_back(static_cast<int>(known - result.rows.begin()));
      if (known == result.rows.end()) result.rows.push_back(l);
    }
    if (in_balls) {
      result.ball.assign(kWide, RowStructure::kNoBall);
      for (std::size_t k = 0; k < row.size(); ++k) result.ball.push_back(static_cast<int>(k / 2));
    }
    return result;
  }

  void put_in_balls() {
    in_balls = true;
    for (std::size_t k = 1; k < row.size(); k += 2) radius[kWide + k] = radius[kWide + k - 1];
  }

  /// Returns values of t and u, within their discs.
  [[nodiscard]] std::vector<Exact> member(Random& random) const {
    std::vector<Exact> x;
    for (const double r : radius) x.emplace_back(test::member(random, -r, r));
    for (std::size_t k = 0; in_balls && k + 1 < row.size(); k += 2) {
      const double r = radius[kWide + k];
      if (random.one_in(3)) {
        x[kWide + k + random.below(2)] = Exact(0.0);
      } else {  // 0.6² + 0.8² = 1, or less
        x[kWide + k] = Exact(0.59 * (random.one_in(2) ? r : -r));
        x[kWide + k + 1] = Exact(0.79 * (random.one_in(2) ? r : -r));
      }
    }
    return x;
  }

  [[nodiscard]] Interval range(std::size_t k) const { return {-radius[k], radius[k]}; }
};

/// All inputs of bound_ru, in lane 0 and copied to the others.
class Inputs {
 public:
  Inputs(Random& random, const Family& family, double noise_of_K = 0.1)
      : f(family), noise_of_K_(noise_of_K) {
    lists = {f.m, f.n, f.variables, {}, {}, {}, {}};
    invert(random);
    for (const double r : f.radius) radius.insert(radius.end(), kLanes, r);
    for (std::size_t i = 0; i < f.n; ++i)
      for (std::size_t j = 0; j < f.n; ++j) expand(i, j);
    for (std::size_t k = 0; k < f.row.size(); ++k)
      for (std::size_t j = 0; j < f.n; ++j) expand_row(k, j);
  }

  [[nodiscard]] SecondOrderInput input() const {
    using test::intervals;
    return {.K = ConstPointMatrix(K.data(), f.n, f.m),
            .product = intervals(product, f.n),
            .first = intervals(first),
            .second = intervals(second),
            .row_first = intervals(row_first),
            .row_second = intervals(row_second),
            .radius = test::points(radius)};
  }

  std::vector<double> K, product, first, second, row_first, row_second, radius;
  DerivativeLists lists;

 private:
  static void put(std::vector<double>& x, Interval value) {
    x.insert(x.end(), kLanes, value.lo);
    x.insert(x.end(), kLanes, value.hi);
  }

  void invert(Random& random) {
    K.resize(f.m * f.n * kLanes);
    std::vector<double> A(f.m * f.n * kLanes);
    LaneNumbers det;
    for (std::size_t e = 0; e < f.m * f.n; ++e)
      for (std::size_t l = 0; l < kLanes; ++l) A[point_at(e, l)] = f.A[0][e];
    static_cast<void>(
        approx_inverse(ConstPointMatrix(A.data(), f.m, f.n), PointMatrix(K.data(), f.n, f.m), det));
    // A poor inverse is as valid as a good one, and leaves more to bound.
    for (std::size_t p = 0; p < f.m * f.n; ++p) {
      const double noise = 1.0 + test::uniform(random, -noise_of_K_, noise_of_K_);
      for (std::size_t l = 0; l < kLanes; ++l) K[point_at(p, l)] *= noise;
    }
  }

  /// Returns (K·A_a)[i][j].
  [[nodiscard]] Interval times_K(std::size_t a, std::size_t i, std::size_t j) const {
    Interval sum(0.0);
    for (std::size_t p = 0; p < f.m; ++p)
      sum += Interval(K[point_at(i * f.m + p, 0)]) * Interval(f.A[a][p * f.n + j]);
    return sum;
  }

  void expand(std::size_t i, std::size_t j) {
    put(product, times_K(0, i, j));
    for (std::size_t p = 0; p < kWide; ++p) {
      lists.first.push_back({i, j, p, 0});
      put(first, times_K(1 + p, i, j));
    }
    lists.second.push_back({i, j, 0, 0});
    put(second, Interval(2.0) * times_K(3, i, j));
    lists.second.push_back({i, j, 0, 1});
    put(second, times_K(4, i, j));
    lists.second.push_back({i, j, 1, 1});
    put(second, Interval(6.0) * f.range(1) * times_K(5, i, j));
  }

  void expand_row(std::size_t k, std::size_t j) {
    const std::size_t variable = kWide + k, row = f.row[k];
    lists.row_first.push_back({row, j, variable, 0});
    put(row_first, Interval(f.w[k][0][j]));
    lists.row_second.push_back({row, j, 0, variable});
    put(row_second, Interval(f.w[k][1][j]));
    lists.row_second.push_back({row, j, 1, variable});
    put(row_second, Interval(2.0) * f.range(1) * Interval(f.w[k][2][j]));
    lists.row_second.push_back({row, j, variable, variable});
    put(row_second, Interval(2.0) * Interval(f.w[k][3][j]));
    if (!f.has_neighbour(k)) return;
    lists.row_second.push_back({row, j, variable - 1, variable});
    put(row_second, Interval(f.w[k][4][j]));
  }

  const Family& f;
  double noise_of_K_;
};

struct Bounds {
  std::vector<double> T, v;
  LaneNumbers lower, moving;
  bool regular;

  Bounds(const Family& f, const Inputs& in, const SecondOrderOptions& options = {},
         const RegularityBackend& backend = regularity_backend()) {
    SecondOrderBounds bounds(in.lists, f.structure(), options, backend);
    T.resize(bounds.order() * bounds.order() * kLanes);
    v.resize(bounds.order() * kLanes);
    const SecondOrderInput input = in.input();
    const PointMatrix view = test::points(T, bounds.order());
    bounds.bound_ru(input, view);
    regular = certain_h_matrix(view, test::points(v)) == kAllLanes;
    lower = determinant_rd(view);
    moving = bounds.moving_determinant_ru(input);
  }
};

inline std::vector<Exact> product_with_K(const Family& f, const Inputs& in,
                                         const std::vector<Exact>& A) {
  std::vector<Exact> KA(f.n * f.n);
  for (std::size_t i = 0; i < f.n; ++i)
    for (std::size_t j = 0; j < f.n; ++j)
      for (std::size_t p = 0; p < f.m; ++p)
        KA[i * f.n + j] = KA[i * f.n + j] + Exact(in.K[point_at(i * f.m + p, 0)]) * A[p * f.n + j];
  return KA;
}

}  // namespace regulus::detail::test
