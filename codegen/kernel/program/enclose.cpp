// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/enclose.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "codegen/kernel/program/arb_arithmetic.hpp"
#include "codegen/kernel/program/rational_bounds.hpp"

namespace regulus::detail {
namespace {

constexpr long kFirstPrecision = 128;
// More than 1074 + 53 bits, so that values near the smallest subnormal are separated, too.
constexpr long kLastPrecision = 2048;

/// Bounds that are equal or neighbours cannot be improved by more bits, except by making them
/// equal.
bool is_tight(const Interval& x) {
  return std::nextafter(x.lo, std::numeric_limits<double>::infinity()) >= x.hi;
}

std::vector<bool> constant_nodes(const Program& program) {
  std::vector<bool> constant(program.nodes.size(), true);
  for (std::size_t i = 0; i < constant.size(); ++i) {
    const Node& node = program.nodes[i];
    const int operands = operand_count(node.op);
    if (node.op == Op::kInput || node.op == Op::kPoint) constant[i] = false;
    if (operands >= 1 && !constant[node.a]) constant[i] = false;
    if (operands == 2 && !constant[node.b]) constant[i] = false;
  }
  return constant;
}

/// The constant nodes of one program at one precision.
class ConstantBalls {
 public:
  ConstantBalls(const Program& program, const std::vector<bool>& constant, long precision)
      : program_(program),
        arithmetic_(precision),
        known_(convert_constants(program, arithmetic_)),
        balls_(program.nodes.size()),
        defined_(program.nodes.size(), false) {
    for (std::size_t i = 0; i < balls_.size(); ++i)
      if (constant[i]) compute(i);
  }

  [[nodiscard]] std::optional<Interval> enclosure(std::size_t i) const {
    if (!defined_[i]) return std::nullopt;
    return balls_[i].enclosure();
  }

 private:
  void compute(std::size_t i) {
    const Node& node = program_.nodes[i];
    defined_[i] = true;
    for (int k = 0; k < operand_count(node.op); ++k)
      defined_[i] = defined_[i] && defined_[k == 0 ? node.a : node.b];
    if (!defined_[i]) return;
    arithmetic_.clear();
    balls_[i] = known_[i]
                    ? *known_[i]
                    : apply<ArbArithmetic, Ball>(node, std::span<const Ball>(balls_), arithmetic_);
    defined_[i] = !arithmetic_.undefined() && arb_is_finite(balls_[i].get());
  }

  const Program& program_;
  ArbArithmetic arithmetic_;
  KnownValues<Ball> known_;
  std::vector<Ball> balls_;
  std::vector<bool> defined_;
};

/// Every enclosure from a ball holds, so the narrower bound of two holds.
void improve(std::optional<Interval>& known, const std::optional<Interval>& found) {
  if (!found) return;
  if (!known) {
    known = found;
    return;
  }
  known = Interval{std::fmax(known->lo, found->lo), std::fmin(known->hi, found->hi)};
}

bool enclose_rationals(const Program& program, const std::vector<bool>& constant,
                       KnownValues<Interval>& known) {
  bool all = true;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Node& node = program.nodes[i];
    if (node.op == Op::kConstant)
      known[i] = enclose(program.constants[node.index]);
    else if (constant[i])
      all = false;
  }
  return all;
}

void require_constant(const Program& program, std::size_t output) {
  if (output >= program.outputs.size()) throw std::out_of_range("the program has no such output");
  for (const Node& node : program.nodes)
    if (node.op == Op::kInput || node.op == Op::kPoint)
      throw std::invalid_argument("the expression is not constant");
}

}  // namespace

KnownValues<Interval> enclose_constant_nodes(const Program& program) {
  const std::vector<bool> constant = constant_nodes(program);
  KnownValues<Interval> known(program.nodes.size());
  bool done = enclose_rationals(program, constant, known);
  for (long precision = kFirstPrecision; !done && precision <= kLastPrecision; precision *= 2) {
    const ConstantBalls balls(program, constant, precision);
    done = true;
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (!constant[i] || (known[i] && is_tight(*known[i]))) continue;
      improve(known[i], balls.enclosure(i));
      done = done && known[i] && is_tight(*known[i]);
    }
  }
  return known;
}

std::optional<Interval> enclose(const Program& constant, std::size_t output) {
  require_constant(constant, output);
  return enclose_constant_nodes(constant)[constant.outputs[output]];
}

std::optional<Interval> enclose_outward(const Program& lo, const Program& hi) {
  const auto lower = enclose(lo);
  const auto upper = enclose(hi);
  if (!lower || !upper) return std::nullopt;
  return Interval{lower->lo, upper->hi};
}

std::optional<Interval> round_inward(const Program& lo, const Program& hi) {
  const auto lower = enclose(lo);
  const auto upper = enclose(hi);
  if (!lower || !upper || !(lower->hi <= upper->lo)) return std::nullopt;
  return Interval{lower->hi, upper->lo};
}

}  // namespace regulus::detail
