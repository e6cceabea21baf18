// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/question/engine/point_values.hpp"

#include <cmath>

#include "codegen/kernel/program/arb_arithmetic.hpp"
#include "codegen/kernel/program/interpreter.hpp"

namespace regulus::detail {

std::optional<std::vector<double>> approx_values(const Program& program,
                                                 std::span<const Interval> variables) {
  constexpr long kBits = 256;
  ArbArithmetic arithmetic(kBits);
  std::vector<Ball> inputs;
  for (const Interval& x : variables) inputs.emplace_back(Interval(mid(x)), kBits);
  const std::vector<Ball> outputs =
      evaluate<ArbArithmetic>(program, std::span<const Ball>(inputs), {}, arithmetic);
  if (arithmetic.undefined()) return std::nullopt;
  std::vector<double> values;
  for (const Ball& ball : outputs) {
    values.push_back(mid(ball.enclosure()));
    if (!std::isfinite(values.back())) return std::nullopt;
  }
  return values;
}

}  // namespace regulus::detail
