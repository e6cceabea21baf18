// SPDX-License-Identifier: GPL-3.0-or-later
#include "runtime/regularity/h_matrix.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>
#include <vector>

#include "tests/support/lane_arrays.hpp"

namespace regulus::detail {
namespace {

using test::intervals;
using test::points;

std::vector<double> in_every_lane(const std::vector<double>& entries) {
  std::vector<double> x(entries.size() * kLanes);
  for (std::size_t e = 0; e < entries.size(); ++e)
    for (std::size_t l = 0; l < kLanes; ++l) x[point_at(e, l)] = entries[e];
  return x;
}

LaneMask certify(const std::vector<double>& entries, std::size_t n) {
  const std::vector<double> P = in_every_lane(entries);
  std::vector<double> v(n * kLanes);
  return certain_h_matrix(points(P, n), points(v));
}

/// Tests whether a call of certain_contraction with arguments of these types compiles.
template <typename First, typename Second>
constexpr bool kIsContractionOf = std::is_invocable_v<decltype(certain_contraction), First, Second>;

TEST(HMatrix, ArgumentsInTheWrongPlaceDoNotCompile) {
  static_assert(kIsContractionOf<ConstPointMatrix, ConstPointVector>);
  static_assert(kIsContractionOf<PointMatrix, PointVector>);
  static_assert(!kIsContractionOf<ConstPointVector, ConstPointMatrix>);
  static_assert(!kIsContractionOf<ConstIntervalMatrix, ConstPointVector>);
  static_assert(!kIsContractionOf<const double*, const double*>);
  using Distance = decltype(distance_to_identity_ru);
  static_assert(std::is_invocable_v<Distance, ConstIntervalMatrix, PointMatrix>);
  static_assert(!std::is_invocable_v<Distance, ConstIntervalMatrix, ConstPointMatrix>);
  static_assert(!std::is_invocable_v<Distance, PointMatrix, IntervalMatrix>);
}

TEST(HMatrix, CertifiesUpToSpectralRadiusOne) {
  EXPECT_EQ(certify({0.999999}, 1), kAllLanes);
  EXPECT_EQ(certify({1.0}, 1), 0U);
  // ρ = √(ab): cyclic and badly scaled.
  EXPECT_EQ(certify({0, 1e6, 0.99e-6, 0}, 2), kAllLanes);
  EXPECT_EQ(certify({0, 1e6, 1.01e-6, 0}, 2), 0U);
  // The matrix is reducible: only the diagonal matters.
  EXPECT_EQ(certify({0.5, 1e9, 0, 0.5}, 2), kAllLanes);
}

TEST(HMatrix, NeverCertifiesWhatIsNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {infinity, nan, 1e308})
    for (std::size_t e = 0; e < 4; ++e) {
      std::vector<double> P{0.1, 0.2, 0.2, 0.1};
      P[e] = bad;
      EXPECT_EQ(certify(P, 2), 0U) << bad << " at " << e;
    }
}

TEST(HMatrix, DecidesEachLaneByItself) {
  std::vector<double> P(kLanes), v(kLanes);
  for (std::size_t l = 0; l < kLanes; ++l) P[l] = l % 3 == 0 ? 0.5 : 1.5;
  EXPECT_EQ(certain_h_matrix(points(P, 1), points(v)), 0b01001001U);
}

TEST(HMatrix, ContractionRefusesVectorsThatAreNotPositiveAndFinite) {
  const std::vector<double> P = in_every_lane({0.5, 0, 0, 0.5});
  EXPECT_EQ(certain_contraction(points(P, 2), points(in_every_lane({1, 1}))), kAllLanes);
  EXPECT_EQ(certain_contraction(points(P, 2), points(in_every_lane({1, 0}))), 0U);
  EXPECT_EQ(certain_contraction(points(P, 2), points(in_every_lane({-1, -1}))), 0U);
  EXPECT_EQ(certain_contraction(
                points(P, 2), points(in_every_lane({1, std::numeric_limits<double>::infinity()}))),
            0U);
}

TEST(HMatrix, ContractionFailsAtEqualityAndWithinRounding) {
  const std::vector<double> P = in_every_lane({1.0});
  EXPECT_EQ(certain_contraction(points(P, 1), points(in_every_lane({1}))), 0U);
  const std::vector<double> close = in_every_lane({1.0 - 0x1p-53});
  EXPECT_EQ(certain_contraction(points(close, 1), points(in_every_lane({1}))), 0U);
}

TEST(HMatrix, DistanceToIdentityTakesTheFartherBound) {
  const std::vector<double> product = in_every_lane({0.75, 1.5, -3, 2, -1, 0.5, 0.5, 1});
  std::vector<double> P(4 * kLanes);
  distance_to_identity_ru(intervals(product, 2), points(P, 2));
  EXPECT_GE(P[0], 0.5);
  EXPECT_LE(P[0], 0.5 + 0x1p-50);
  EXPECT_EQ(P[point_at(1, 0)], 3.0);
  EXPECT_EQ(P[point_at(2, 0)], 1.0);
  EXPECT_GE(P[point_at(3, 0)], 0.5);
}

TEST(HMatrix, MeanValueLowersOnlyTheLanesAsked) {
  const std::vector<double> center = in_every_lane({0.125});
  const std::vector<double> derivatives = in_every_lane({-2, 1});
  const std::vector<double> radius = in_every_lane({0.25});
  std::vector<double> P = in_every_lane({4});
  lower_to_mean_value_ru(points(center, 1), intervals(derivatives, 1), points(radius), 0b10U,
                         points(P, 1));
  EXPECT_EQ(P[0], 4.0);
  EXPECT_GE(P[1], 0.625);
  EXPECT_LE(P[1], 0.625 + 0x1p-45);
}

TEST(HMatrix, MeanValueNeverRaisesABound) {
  const std::vector<double> center = in_every_lane({1});
  const std::vector<double> derivatives = in_every_lane({-2, 1});
  const std::vector<double> radius = in_every_lane({8});
  std::vector<double> P = in_every_lane({4});
  lower_to_mean_value_ru(points(center, 1), intervals(derivatives, 1), points(radius), kAllLanes,
                         points(P, 1));
  EXPECT_EQ(P[0], 4.0);
}

TEST(HMatrix, PerronVectorsOfAKnownMatrix) {
  // P = u wᵀ has right vector u, left vector w, radius wᵀu.
  const std::vector<double> P = in_every_lane({0.1, 0.3, 0.2, 0.6});  // u = (1, 2), w = (0.1, 0.3)
  std::vector<double> v(2 * kLanes), y(2 * kLanes);
  const LaneNumbers radius = approx_perron(points(P, 2), {.right = points(v), .left = points(y)});
  EXPECT_NEAR(v[point_at(0, 5)] / v[point_at(1, 5)], 0.5, 1e-3);
  EXPECT_NEAR(y[point_at(0, 5)] / y[point_at(1, 5)], 1.0 / 3, 1e-3);
  EXPECT_NEAR(radius[5], 0.7, 1e-3);
}

}  // namespace
}  // namespace regulus::detail
