// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/way/path_bounds.hpp"

#include <gtest/gtest.h>

#include <random>

#include "codegen/kernel/program/rational_bounds.hpp"

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

numeric rational(std::mt19937_64& random, int scale) {
  return {static_cast<long>(random() % 2001) - 1000, static_cast<long>(scale)};
}

/// The exact value of a polynomial piece at a double.
cln::cl_RA value_at(const PieceOfPose& piece, double s) {
  const cln::cl_RA x = exact_rational(s);
  cln::cl_RA value = 0;
  for (std::size_t i = 4; i-- > 0;)
    value = value * x + cln::the<cln::cl_RA>(GiNaC::ex_to<numeric>(piece.power[i]).to_cl_N());
  return value;
}

TEST(PathBounds, EncloseEveryPointOfACubic) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 500; ++trial) {
    PieceOfPose piece;
    for (std::size_t i = 0; i < (trial % 2 == 0 ? 4U : 2U); ++i)
      piece.power[i] = rational(random, 1 + trial % 97);
    const CoordinateBounds bounds(piece);
    double ends[2];
    for (double& end : ends) end = static_cast<double>(random() % 4097) / 4096;
    const double begin = std::min(ends[0], ends[1]), end = std::max(ends[0], ends[1]);
    const Interval range = bounds.over(begin, end);
    for (int point = 0; point <= 8; ++point) {
      const double s = std::min(begin + (end - begin) * point / 8, end);
      const cln::cl_RA value = value_at(piece, s);
      EXPECT_LE(exact_rational(range.lo), value);
      EXPECT_GE(exact_rational(range.hi), value);
    }
  }
}

TEST(PathBounds, EncloseEveryPointOfAnArc) {
  PieceOfPose arc;
  arc.power[0] = numeric(1, 3);
  arc.cosine = 10;
  arc.sine = -5;
  arc.turn = 2 * GiNaC::Pi;
  const CoordinateBounds bounds(arc);
  for (int part = 0; part < 64; ++part) {
    const double begin = part / 64.0, end = (part + 1) / 64.0;
    const Interval range = bounds.over(begin, end);
    EXPECT_LT(range.hi - range.lo, 1.2);
    for (int point = 1; point < 8; ++point) {
      const double s = begin + (end - begin) * point / 8;
      const double value = 1.0 / 3 + 10 * std::cos(2 * M_PI * s) - 5 * std::sin(2 * M_PI * s);
      EXPECT_GE(value, range.lo - 1e-12);
      EXPECT_LE(value, range.hi + 1e-12);
    }
  }
}

TEST(PathBounds, EncloseGroupsOfPieces) {
  std::mt19937_64 random(11);
  Trajectory trajectory;
  for (int k = 0; k < 13; ++k) {
    TrajectoryPiece piece;
    piece.pose.resize(3);
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t c = 0; c < 4; ++c) piece.pose[i].power[c] = rational(random, 10);
    piece.pose[2].power[0] = 4;
    trajectory.pieces.push_back(piece);
  }
  const PathBounds path(trajectory, {0, numeric(1, 10), 0});
  ASSERT_EQ(path.moving().size(), 2U);
  EXPECT_EQ(path.errors()[0], Interval(0.0, 0.0));
  EXPECT_GE(path.errors()[1].hi, 0.1);
  for (const std::size_t count : {1U, 2U, 4U, 8U, 16U})
    for (std::size_t first = 0; first < 13; first += count)
      for (std::size_t m = 0; m < 2; ++m)
        for (std::size_t k = first; k < std::min<std::size_t>(13, first + count); ++k)
          EXPECT_TRUE(certain_subset(path.over(k, m, 0, 1), path.over_pieces(first, count, m)));
}

}  // namespace
}  // namespace regulus::detail
