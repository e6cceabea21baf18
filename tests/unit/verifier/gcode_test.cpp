// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the verifier's own readers of trajectories.
#include "runtime/verifier/model/gcode.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "runtime/verifier/evaluation.hpp"
#include "runtime/verifier/model/spline.hpp"

namespace regulus::verifier {
namespace {

/// Returns a coordinate of a move in mm, approximately.
double place(const ProgramMove& move, std::size_t axis, double s) {
  Graph graph;
  const NodeId root = place_on_move(graph, move, axis);
  const std::vector<Ball> at(1, Ball(Interval{s, s}, 64));
  const auto value = evaluate(graph, {root}, at, 64);
  EXPECT_TRUE(value);
  return value ? mid((*value)[0].enclosure()) : NAN;
}

TEST(Program, HasLinesInMillimetres) {
  const auto moves =
      read_program("G20 G90\nG0 X1 Y2 Z-.5\n\nG1 X2 ; on\n(away) G91 Y-1 G21\nX0\nM2\nX9");
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(moves[0].line, 4U);
  EXPECT_DOUBLE_EQ(place(moves[0], 0, 0.5), 1.5 * 25.4);
  EXPECT_DOUBLE_EQ(place(moves[0], 2, 0.5), -0.5 * 25.4);
  EXPECT_DOUBLE_EQ(place(moves[1], 1, 1), 2 * 25.4 - 1);
}

/// RS274/NGC: the words of a line act in one order, whatever theirs is.
TEST(Program, MovesOnALineThatDwells) {
  for (const char* line : {"G4 P1 G1 X-5", "X-5 G4 P1", "G1 X-5 G4 P1"})
    EXPECT_EQ(read_program(std::string("G1 X0 Y0 Z5\n") + line).size(), 1U) << line;
}

TEST(Program, EndsWithTheSecondPercent) {
  EXPECT_EQ(read_program("%\nG0 X0 Y0 Z0\nX1\n%\nX2\n").size(), 1U);
}

TEST(Program, HasArcsInBothDirections) {
  const char* begin = "G0 X10 Y0 Z1\n";
  for (const bool clockwise : {false, true}) {
    const auto moves =
        read_program(std::string(begin) + (clockwise ? "G2" : "G3") + " X0 Y10 I-10 Z3");
    ASSERT_EQ(moves.size(), 1U);
    const double turn = clockwise ? -1.5 * M_PI : 0.5 * M_PI;
    EXPECT_NEAR(place(moves[0], 0, 0.3), 10 * std::cos(0.3 * turn), 1e-12);
    EXPECT_NEAR(place(moves[0], 1, 0.3), 10 * std::sin(0.3 * turn), 1e-12);
    EXPECT_NEAR(place(moves[0], 2, 0.3), 1.6, 1e-12);
    const auto whole = read_program(std::string(begin) + (clockwise ? "G2" : "G3") + " I-10");
    ASSERT_EQ(whole.size(), 1U);
    EXPECT_NEAR(place(whole[0], 1, 0.25), clockwise ? -10 : 10, 1e-12);
  }
}

TEST(Program, MovesArcsInOtherPlanes) {
  const auto zx = read_program("G0 X0 Y5 Z10 G18\nG3 Z0 X10 K-10");
  ASSERT_EQ(zx.size(), 1U);
  EXPECT_NEAR(place(zx[0], 2, 0.5), 10 * std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(place(zx[0], 0, 0.5), 10 * std::sqrt(0.5), 1e-12);
  const auto yz = read_program("G0 X0 Y10 Z0 G19 G90.1\nG2 Y0 Z-10 J0 K0");
  EXPECT_NEAR(place(yz[0], 2, 0.5), -10 * std::sqrt(0.5), 1e-12);
}

TEST(Program, KeepsBothEndsOfAnArc) {
  const auto moves = read_program("G0 X10 Y0 Z0\nG3 X-10.005 Y0 I-10");
  EXPECT_NEAR(place(moves[0], 0, 0), 10, 1e-12);
  EXPECT_NEAR(place(moves[0], 0, 1), -10.005, 1e-12);
}

/// Lines that nobody should obey in part.
constexpr const char* kUnknown[] = {"G5 X1",
                                    "G43 X1",
                                    "A5",
                                    "X1 X2",
                                    "X",
                                    "X1.2.3",
                                    "G2 X1 Y1 R5",
                                    "G2 X1",
                                    "G91.5",
                                    "G1.23",
                                    "(open",
                                    "#1=5",
                                    "X[1]",
                                    "G-1",
                                    "X--1",
                                    "M98 P1000",
                                    "G3 I-2 P2",
                                    "G1.04 X1",
                                    "M3.7",
                                    "G80 X1",
                                    "G0 G1 X1",
                                    "G2 I1 K1",
                                    "G90.1 G2 X1 I1",
                                    "I1",
                                    "/X1",
                                    "X1\rY1",
                                    "%",
                                    "O1",
                                    "G4",
                                    "P1",
                                    "G53 X1",
                                    "G92 X1",
                                    "G64",
                                    "G55",
                                    "G43 H1",
                                    "X1*71",
                                    "M6",
                                    "E1",
                                    "L1",
                                    "(py,1)",
                                    "(a(b)",
                                    "G93",
                                    "N-1",
                                    "F-1",
                                    "T1.5",
                                    "G3 Y.000001 I-3",
                                    "G2 X9 Y9 I1"};

TEST(Program, IsNotReadIfAWordIsNotKnown) {
  for (const char* line : kUnknown)
    EXPECT_THROW(static_cast<void>(read_program("G0 X0 Y0 Z0\nG1 X5\n" + std::string(line) + "\n")),
                 Unfinished)
        << line;
  for (const char* text : {"", "X1 Y1", "G91 X1", "G2 X1 Y1 Z1 I1", "G0 X1 Y1 Z1"})
    EXPECT_THROW(static_cast<void>(read_program(text)), Unfinished) << text;
}

TEST(NaturalSpline, HasKnownSlopes) {
  // Its second derivatives are 0, −3, 0.
  const std::vector<double> slopes = approx_spline_slopes({0, 1, 2}, {1, 2, 1});
  EXPECT_NEAR(slopes[0], 1.5, 1e-15);
  EXPECT_NEAR(slopes[1], 0, 1e-15);
  EXPECT_NEAR(slopes[2], -1.5, 1e-15);
  for (const double slope : approx_spline_slopes({0, 1, 3, 3.5}, {2, 5, 11, 12.5}))
    EXPECT_NEAR(slope, 3, 1e-14);
  EXPECT_EQ(approx_spline_slopes({1, 3}, {1, 2}), (std::vector<double>{0.5, 0.5}));
}

}  // namespace
}  // namespace regulus::verifier
