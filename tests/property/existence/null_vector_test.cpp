// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices whose places of rank loss are known in closed form: planted ones are enclosed, near misses and
// places where a determinant only touches 0 are never taken for one.
#include "runtime/existence/null_vector.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random_source.hpp"

namespace regulus::detail::test {
namespace {

/// A(t) = B + Σ_k (C_k·s_k + D_k·s_k²), s = t − t*, with small whole numbers; B·v* = 0 exactly if `gap` is 0.
struct Planted {
  Planted(RandomSource& random, std::size_t variables, std::size_t columns)
      : d(variables), n(columns), m(d + n - 1) {
    const auto whole = [&] { return double(random.below(9)) - 4.0; };
    for (std::size_t k = 0; k < d; ++k) place.push_back(whole() / 8 + 1.0 / 1024);
    vector.push_back(1);
    for (std::size_t j = 1; j < n; ++j) vector.push_back(whole());
    for (std::size_t i = 0; i < m; ++i) {
      double first = 0;
      B.push_back(0);
      for (std::size_t j = 1; j < n; ++j) {
        B.push_back(whole());
        first -= B.back() * vector[j];
      }
      B[i * n] = first;
    }
    for (std::size_t e = 0; e < d * m * n; ++e) C.push_back(whole()), D.push_back(whole());
  }

  [[nodiscard]] MatrixOverBox over(std::span<const Interval> t) const {
    MatrixOverBox result;
    for (std::size_t e = 0; e < m * n; ++e) {
      Interval entry(B[e]);
      if (e % n == 0) entry = entry + Interval(gap);
      for (std::size_t k = 0; k < d; ++k) {
        const Interval s = t[k] - Interval(place[k]);
        entry = entry + Interval(C[k * m * n + e]) * s + Interval(D[k * m * n + e]) * s * s;
      }
      result.entries.push_back(entry);
    }
    for (std::size_t k = 0; k < d; ++k)
      for (std::size_t e = 0; e < m * n; ++e)
        result.slopes.push_back(Interval(C[k * m * n + e]) +
                                Interval(2 * D[k * m * n + e]) * (t[k] - Interval(place[k])));
    return result;
  }

  [[nodiscard]] MatrixFunction function() const {
    return [this](std::span<const Interval> t) { return std::optional(over(t)); };
  }

  std::size_t d, n, m;
  std::vector<double> place, vector, B, C, D;
  double gap = 0;
};

std::vector<double> moved(RandomSource& random, std::vector<double> x, double most) {
  for (double& value : x) value += most * (double(random.below(2001)) / 1000 - 1);
  return x;
}

/// Compares v with the planted vector, of which the box's component 1 is 1.
bool holds(const NullVectorBox& box, const Planted& planted) {
  for (std::size_t k = 0; k < planted.d; ++k)
    if (!(box.t[k].lo <= planted.place[k] && planted.place[k] <= box.t[k].hi)) return false;
  const auto unit = std::size_t(std::ranges::find(box.vector, Interval(1.0)) - box.vector.begin());
  for (std::size_t j = 0; j < planted.n; ++j) {
    const double v = planted.vector[j] / planted.vector.at(unit);
    if (!(box.vector[j].lo - 1e-15 <= v && v <= box.vector[j].hi + 1e-15)) return false;
  }
  return true;
}

const std::vector<Interval> kEverywhere(4, Interval(-100, 100));

TEST(PlantedNullVectors, AreEnclosedNarrowly) {
  RandomSource random(11);
  int found = 0;
  for (int round = 0; round < 4000; ++round) {
    const Planted planted(random, 1 + random.below(4), 1 + random.below(6));
    const auto box =
        enclose_null_vector(planted.function(), moved(random, planted.place, 1e-6),
                            moved(random, planted.vector, 1e-6), std::span(kEverywhere));
    if (!box) continue;  // planted at a place where the system is not regular
    ++found;
    EXPECT_TRUE(holds(*box, planted));
    for (const Interval& x : box->t) EXPECT_LE(x.hi - x.lo, 1e-10);
    for (const Interval& x : box->vector) EXPECT_LE(x.hi - x.lo, 1e-10);
  }
  EXPECT_GT(found, 3000);
}

TEST(PlantedNullVectors, OutsideTheRangesAreNotTaken) {
  RandomSource random(12);
  for (int round = 0; round < 2000; ++round) {
    const Planted planted(random, 1 + random.below(3), 1 + random.below(5));
    const std::size_t k = random.below(planted.d);
    std::vector<Interval> ranges = kEverywhere;
    ranges[k] = round % 2 == 0 ? Interval(planted.place[k], 100) : Interval(-100, planted.place[k]);
    EXPECT_FALSE(
        enclose_null_vector(planted.function(), planted.place, planted.vector, std::span(ranges)))
        << "the range ends where the rank is lost";
  }
}

/// det = s² + g² > 0, the least singular value is |g| at s = 0; more rows change nothing of that.
std::optional<MatrixOverBox> near_miss(std::span<const Interval> t, double g) {
  MatrixOverBox result;
  result.entries = {t[0], Interval(g), Interval(-g), t[0]};
  result.slopes = {Interval(1), Interval(0), Interval(0), Interval(1)};
  if (t.size() == 1) return result;
  result.entries.insert(result.entries.end(), {t[1], t[1] * t[0]});
  result.slopes.insert(result.slopes.end(), {Interval(0), t[1]});
  result.slopes.insert(result.slopes.end(),
                       {Interval(0), Interval(0), Interval(0), Interval(0), Interval(1), t[0]});
  return result;
}

TEST(NearMisses, AreNeverTaken) {
  RandomSource random(13);
  for (const double g : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-18, 1e-30})
    for (std::size_t d = 1; d <= 2; ++d)
      for (int round = 0; round < 200; ++round) {
        const auto function = [g](std::span<const Interval> t) { return near_miss(t, g); };
        EXPECT_FALSE(enclose_null_vector(
            function, moved(random, std::vector<double>(d), round % 2 == 0 ? 1e-9 : 1e-3),
            moved(random, {0.5, 0.5}, 1), std::span(kEverywhere)))
            << g;
      }
}

/// det = s² − g: two places for g > 0, one that is only touched for g = 0, none for g < 0.
TEST(ADeterminantThatTouchesZero, IsNotTaken) {
  RandomSource random(14);
  for (const double g : {0.0, -1e-9, -1e-20, -0x1p-1060})
    for (int round = 0; round < 200; ++round) {
      const auto function = [g](std::span<const Interval> t) {
        return std::optional(MatrixOverBox{{t[0], Interval(1), Interval(g), t[0]},
                                           {Interval(1), Interval(0), Interval(0), Interval(1)}});
      };
      EXPECT_FALSE(
          enclose_null_vector(function, moved(random, {0}, 1e-6), {1, 0}, std::span(kEverywhere)))
          << g;
    }
}

TEST(AFunctionWithoutAValue, IsNotTaken) {
  const auto function = [](std::span<const Interval> t) -> std::optional<MatrixOverBox> {
    if (t[0].lo <= 0) return std::nullopt;
    return MatrixOverBox{{t[0]}, {Interval(1)}};
  };
  EXPECT_FALSE(enclose_null_vector(function, {1.0}, {1.0}, std::span(kEverywhere)));
}

}  // namespace
}  // namespace regulus::detail::test
