// SPDX-License-Identifier: Apache-2.0
#include "runtime/verifier/middle_angle.hpp"

#include <cmath>

#include "runtime/verifier/proof.hpp"

namespace regulus::verifier {
namespace {

constexpr long kPartsOfRadian = 1024;
constexpr double kMostAngle = 1000.0;  ///< of a line

}  // namespace

NodeId middle_angle(const std::vector<SolutionLine>& lines, std::size_t value, Graph& graph) {
  if (lines.empty()) return graph.number("0");
  Interval angles = lines.front().values[value];
  for (const SolutionLine& line : lines) angles = hull(angles, line.values[value]);
  if (!(mag(angles) < kMostAngle)) throw Rejection("an angle of a line 'solution' is too large");
  const long parts = std::lround(double(kPartsOfRadian) * mid(angles));
  return graph.add(Op::kDivide, graph.number(Rational(parts)),
                   graph.number(Rational(kPartsOfRadian)));
}

}  // namespace regulus::verifier
