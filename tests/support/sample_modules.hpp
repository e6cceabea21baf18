// SPDX-License-Identifier: GPL-3.0-or-later
// Small modules that together use everything that the emitter can print.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "codegen/kernel/program/module.hpp"

namespace regulus::detail::test {

inline std::vector<std::string> entries_of_k(int rows, int columns) {
  std::vector<std::string> names;
  for (int i = 1; i <= rows; ++i)
    for (int j = 1; j <= columns; ++j)
      names.push_back("k_" + std::to_string(i) + "_" + std::to_string(j));
  return names;
}

/// Makes a planar arm: A = [[cos ψ, −sin ψ], [x, y]], and K·A as a sum over entries of K.
inline Module planar_module() {
  Module m;
  m.model = "planar";
  m.motion = "small";
  m.variables = {"x", "y", "psi"};
  m.motion_variables = 3;
  m.rows = m.columns = 2;
  m.pose_parameters = 3;
  {
    ProgramBuilder b(m.variables, {});
    b.output(b.call(Op::kCos, b.input(2)));
    b.output(b.negate(b.call(Op::kSin, b.input(2))));
    b.output(b.input(0));
    b.output(b.input(1));
    m.functions.push_back({"matrix", "A, as the model writes it", std::move(b).finish(), 2, 2, {}});
  }
  {
    ProgramBuilder b(m.variables, entries_of_k(2, 2));
    std::vector<std::string> comments;
    for (std::uint32_t i = 0; i < 2; ++i) {
      const NodeId first = b.point(2 * i), second = b.point(2 * i + 1);
      b.output(
          b.add(b.multiply(first, b.call(Op::kCos, b.input(2))), b.multiply(second, b.input(0))));
      b.output(b.subtract(b.multiply(second, b.input(1)),
                          b.multiply(first, b.call(Op::kSin, b.input(2)))));
      comments.insert(comments.end(), {"Occurrences of x: 1.", "Occurrences of y: 1."});
    }
    m.functions.push_back(
        {"left_product", "K·A, §III-B1 form 2", std::move(b).finish(), 2, 2, comments});
  }
  {
    ProgramBuilder b(m.variables, {});
    for (std::uint32_t i = 0; i < 3; ++i) b.output(b.input(i));
    m.functions.push_back({"pose", "the pose", std::move(b).finish(), 3, 1, {}});
  }
  return m;
}

/// Uses every operation, constants of every kind, values that can overflow, and zero derivatives.
inline Module everything_module() {
  Module m;
  m.model = "everything";
  m.motion = "all";
  m.variables = {"x", "T", "int"};
  m.motion_variables = 2;
  m.rows = m.columns = 1;
  m.constraints = 12;
  {
    ProgramBuilder b(m.variables, {"k_1_1"});
    const NodeId k = b.point(0), x = b.input(0), t = b.input(1);
    b.output(b.add(b.multiply(b.multiply(k, k), x), b.power(t, 5)));
    m.functions.push_back({"left_product", "K·A", std::move(b).finish(), 1, 1, {}});
  }
  {
    ProgramBuilder b(m.variables, {"k_1_1"});
    b.output(b.multiply(b.point(0), b.point(0)));
    b.output(b.constant(0));
    b.output(b.constant(0));
    m.functions.push_back({"left_derivatives", "∂(K·A)", std::move(b).finish(), 3, 1, {}});
  }
  {
    ProgramBuilder b(m.variables, {"k_1_1"});
    const NodeId k = b.point(0), x = b.input(0), t = b.input(1), n = b.input(2);
    const NodeId degree = b.divide(b.pi(), b.constant(180));
    b.output(b.divide(b.call(Op::kSqrt, x), b.add(b.constant("1/3"), b.call(Op::kAbs, t))));
    b.output(b.call(Op::kTan, b.multiply(t, degree)));
    b.output(b.add(b.call(Op::kAsin, t), b.call(Op::kAcos, t)));
    b.output(b.atan2(b.add(x, b.constant(1)), n));
    b.output(b.multiply(b.call(Op::kExp, t), b.call(Op::kLog, x)));
    b.output(b.power(b.add(x, n), 20));
    b.output(b.multiply(b.power(b.constant(2), 1100), x));
    b.output(b.call(Op::kAtan, b.negate(k)));
    b.output(b.subtract(x, b.multiply(t, b.subtract(n, b.constant("3/2")))));
    b.output(b.negate(b.subtract(b.negate(b.multiply(x, t)), n)));
    b.output(b.constant("-1/10"));
    b.output(b.multiply(b.constant(0), b.call(Op::kSqrt, b.constant(-1))));
    m.functions.push_back({"constraint", "H", std::move(b).finish(), 12, 1, {}});
  }
  return m;
}

/// Makes one long polynomial and reuses it; it is longer than a part.
inline Module long_module(int terms) {
  Module m;
  m.model = "long";
  m.motion = "all";
  m.variables = {"x", "y"};
  m.motion_variables = 2;
  m.rows = m.columns = 1;
  m.pose_parameters = 2;
  ProgramBuilder b(m.variables, {});
  NodeId sum = b.input(0);
  std::vector<NodeId> squares;
  for (int i = 1; i <= terms; ++i) {
    const NodeId term = b.power(b.add(b.input(0), b.constant(cln::cl_RA(i) / 7)), 2);
    squares.push_back(term);
    sum = b.add(b.multiply(sum, b.input(1)), term);
  }
  b.output(sum);
  NodeId product = b.constant("1/2");
  for (const NodeId square : squares) product = b.call(Op::kSin, b.multiply(square, product));
  b.output(product);
  m.functions.push_back({"pose", "the pose", std::move(b).finish(), 2, 1, {}});
  return m;
}

/// Uses names and comments that try to break out of comments in the generated code.
inline Module hostile_module() {
  const std::string attack =
      "x\"); system(\"true\"); /* */ \\\n#include \"/etc/passwd\"\n//\r\xE2\x80\xAE";
  Module m;
  m.model = attack;
  m.motion = "*/ int main() {} /*";
  m.variables = {attack, "int", "x__y", "while", "a b", "a_b", "v_a_b", "", "__FILE__", "t_1"};
  m.motion_variables = 10;
  m.rows = m.columns = 1;
  ProgramBuilder b(m.variables, {attack});
  NodeId sum = b.point(0);
  for (std::uint32_t i = 0; i < m.variables.size(); ++i)
    sum = b.add(b.call(Op::kSin, b.input(i)), sum);
  b.output(sum);
  m.functions.push_back({"left_product", attack, std::move(b).finish(), 1, 1, {attack}});
  m.functions.push_back(m.functions.back());
  m.functions.back().name = "matrix";
  return m;
}

}  // namespace regulus::detail::test
