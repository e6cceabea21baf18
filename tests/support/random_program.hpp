// SPDX-License-Identifier: GPL-3.0-or-later
// Makes random expressions, with any builder that has the functions of ProgramBuilder.
#pragma once

#include <cln/rational.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "codegen/kernel/program/canonical.hpp"
#include "codegen/kernel/program/program.hpp"
#include "tests/support/random_source.hpp"

namespace regulus::detail::test {

struct ProgramShape {
  int inputs = 3;
  int points = 4;
  int operations = 12;
  int outputs = 2;
  bool functions = true;   ///< false: + − × ÷ and small powers only
  bool tree_like = false;  ///< most nodes are used once, as in rewritten formulas
  int largest_power = 4;
  int row_length = 0;  ///< of K; if not 0, sums of its rows are early nodes
};

inline std::vector<std::string> numbered_names(const char* prefix, int count) {
  std::vector<std::string> names;
  for (int i = 1; i <= count; ++i) names.push_back(prefix + std::to_string(i));
  return names;
}

/// Stores every operation as it is called: no folding, no sharing. ProgramBuilder must agree with
/// this.
class RawBuilder {
 public:
  RawBuilder(std::vector<std::string> inputs, std::vector<std::string> points) {
    program_.inputs = std::move(inputs);
    program_.points = std::move(points);
  }
  NodeId constant(const cln::cl_RA& value) {
    program_.constants.push_back(value);
    return push({Op::kConstant, 0, 0, static_cast<std::uint32_t>(program_.constants.size() - 1)});
  }
  NodeId pi() { return push({Op::kNumberPi}); }
  NodeId input(std::uint32_t index) { return push({Op::kInput, 0, 0, index}); }
  NodeId point(std::uint32_t index) { return push({Op::kPoint, 0, 0, index}); }
  NodeId negate(NodeId a) { return push({Op::kNegate, a}); }
  NodeId add(NodeId a, NodeId b) { return push({Op::kAdd, a, b}); }
  NodeId subtract(NodeId a, NodeId b) { return push({Op::kSubtract, a, b}); }
  NodeId multiply(NodeId a, NodeId b) { return push({Op::kMultiply, a, b}); }
  NodeId divide(NodeId a, NodeId b) { return push({Op::kDivide, a, b}); }
  NodeId power(NodeId a, int n) {
    if (n < 0) return divide(constant(1), power(a, -n));
    if (n == 0) return add(multiply(constant(0), a), constant(1));
    return n == 1 ? a : push({Op::kPower, a, 0, static_cast<std::uint32_t>(n)});
  }
  NodeId call(Op function, NodeId a) { return push({function, a}); }
  NodeId atan2(NodeId a, NodeId b) { return push({Op::kAtan2, a, b}); }
  void output(NodeId id) { program_.outputs.push_back(id); }
  Program finish() && { return canonical(std::move(program_)); }

 private:
  NodeId push(Node node) {
    program_.nodes.push_back(node);
    return static_cast<NodeId>(program_.nodes.size() - 1);
  }
  Program program_;
};

inline cln::cl_RA random_rational(RandomSource& random) {
  const long numerator = static_cast<long>(random.below(13)) - 6;
  const long denominators[] = {1, 1, 2, 3, 4, 10, 180};
  return cln::cl_RA(numerator) / denominators[random.below(7)];
}

/// The nodes made so far, and those that nothing uses yet.
struct NodePool {
  std::vector<NodeId> all;
  std::vector<NodeId> unused;

  void add(NodeId id) {
    all.push_back(id);
    unused.push_back(id);
  }
  NodeId pick(RandomSource& random, bool tree_like) {
    if (!tree_like || unused.empty() || random.one_in(3)) return all[random.below(all.size())];
    const std::size_t i = random.below(unused.size());
    const NodeId id = unused[i];
    unused.erase(unused.begin() + static_cast<std::ptrdiff_t>(i));
    return id;
  }
};

template <class Builder>
NodeId random_coefficient(RandomSource& random, Builder& builder, const ProgramShape& shape) {
  if (shape.points == 0 || random.one_in(3)) return builder.constant(random_rational(random));
  return builder.point(
      static_cast<unsigned>(random.below(static_cast<std::uint64_t>(shape.points))));
}

/// Returns one more node, made from those in `pool`.
template <class Builder>
NodeId random_node(RandomSource& random, Builder& builder, const ProgramShape& shape,
                   NodePool& pool) {
  const NodeId a = pool.pick(random, shape.tree_like);
  const NodeId b = pool.pick(random, shape.tree_like);
  const int n =
      static_cast<int>(random.below(static_cast<std::uint64_t>(shape.largest_power) + 2)) - 1;
  switch (random.below(shape.functions ? 14 : 10)) {
    case 0:
    case 1:
      return builder.add(a, b);
    case 2:
    case 3:
      return builder.subtract(a, b);
    case 4:
    case 5:
      return builder.multiply(a, b);
    case 6: {
      const NodeId factor = random_coefficient(random, builder, shape);
      return random.one_in(2) ? builder.multiply(a, factor) : builder.multiply(factor, a);
    }
    case 7:
      return builder.negate(a);
    case 8:
      return builder.power(a, n);
    case 9:
      return builder.divide(a, b);
    case 10:
      return builder.atan2(a, b);
    case 11:
      return builder.call(random.one_in(2) ? Op::kSin : Op::kCos, a);
    default: {
      constexpr Op kFunctions[] = {Op::kSqrt, Op::kTan, Op::kAsin, Op::kAcos,
                                   Op::kAtan, Op::kExp, Op::kLog,  Op::kAbs};
      return builder.call(kFunctions[random.below(8)], a);
    }
  }
}

/// Returns a sum of entries of a row of K. The coefficients have few bits, or so many that the sum
/// only just fits a double, or does not fit.
template <class Builder>
NodeId random_row_sum(RandomSource& random, Builder& builder, int first, int length) {
  std::optional<NodeId> sum;
  for (int i = 0; i < length; ++i) {
    const long largest = random.one_in(2) ? 200 : (1L << 23) + 1;
    const long factor = 1 + static_cast<long>(random.below(static_cast<std::uint64_t>(largest)));
    const cln::cl_RA coefficient =
        cln::cl_RA(random.one_in(2) ? factor : largest) / (random.one_in(4) ? 8 : 1);
    const auto term = builder.multiply(builder.constant(coefficient),
                                       builder.point(static_cast<unsigned>(first + i)));
    if (!sum)
      sum = term;
    else
      sum = random.one_in(2) ? builder.add(*sum, term) : builder.subtract(*sum, term);
  }
  return *sum;
}

/// Makes the same expressions from the same source and shape with every builder.
template <class Builder>
Program random_program(RandomSource& random, const ProgramShape& shape) {
  Builder builder(numbered_names("x", shape.inputs), numbered_names("k_1_", shape.points));
  NodePool pool;
  for (int i = 0; i < shape.inputs; ++i) pool.add(builder.input(static_cast<unsigned>(i)));
  for (int i = 0; i < shape.points; ++i) pool.add(builder.point(static_cast<unsigned>(i)));
  for (int first = 0; shape.row_length > 0 && first < shape.points; first += shape.row_length)
    for (int i = 0; i < 2; ++i) pool.add(random_row_sum(random, builder, first, shape.row_length));
  pool.add(builder.constant(random_rational(random)));
  pool.add(builder.constant(random_rational(random)));
  if (shape.functions && random.one_in(3)) pool.add(builder.pi());
  for (int i = 0; i < shape.operations; ++i) pool.add(random_node(random, builder, shape, pool));
  const std::size_t last = std::min<std::size_t>(pool.all.size(), shape.tree_like ? 2 : 4);
  for (int i = 0; i < shape.outputs; ++i)
    builder.output(pool.all[pool.all.size() - 1 - random.below(last)]);
  return std::move(builder).finish();
}

}  // namespace regulus::detail::test
