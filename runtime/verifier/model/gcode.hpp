// SPDX-License-Identifier: Apache-2.0
// Reads the moves of a program in G-code, and shares nothing with the front end.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "runtime/verifier/expression.hpp"

namespace regulus::verifier {

/// A straight line, or an arc in the plane of two axes with a straight third coordinate.
struct ProgramMove {
  std::size_t line = 0;
  std::array<Rational, 3> from, to;  ///< in mm
  bool is_arc = false, is_clockwise = false;
  std::array<std::size_t, 3> axes{0, 1, 2};  ///< of an arc: those of its plane, and the third
  std::array<Rational, 2> centre;
};

/// Returns the moves of RS274/NGC from the line on where x, y and z are known. Throws Unfinished, with
/// the line, for every word that is not known to have no effect on the path.
[[nodiscard]] std::vector<ProgramMove> read_program(std::string_view text);

/// Returns the angle of a vector with ordinate y ≠ 0, from −pi to pi, by an arc tangent: exact algebra
/// knows its sine and cosine.
[[nodiscard]] NodeId angle_of(Graph& graph, const Rational& y, const Rational& x);

/// Returns a coordinate in mm as an expression of the variable 0, which goes from 0 to 1. If the ends
/// of an arc are not equally far from its centre, the difference is added linearly.
[[nodiscard]] NodeId place_on_move(Graph& graph, const ProgramMove& move, std::size_t axis);

}  // namespace regulus::verifier
