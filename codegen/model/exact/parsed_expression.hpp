// SPDX-License-Identifier: GPL-3.0-or-later
// An expression while it is read: the GiNaC expression that it simplifies to, the conditions for
// the written expression to be defined, and its size. The reader uses only these operations on
// untrusted text.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <string_view>
#include <vector>

namespace regulus::detail {

/// The reason why an operation is refused. A caller that knows file and line turns it into an
/// InputError.
struct ParseRefusal {
  std::string found;
  std::string expected;
};

struct ParsedExpression {
  GiNaC::ex value;
  /// Expressions that are all defined exactly where the written expression is, without the
  /// conditions that `value` shows itself. An operation that always has a value adds nothing.
  std::vector<GiNaC::ex> must_be_defined{};
  bool constant = true;              ///< no symbol was written in it
  int depth = 1;                     ///< of the written tree, named sub-expressions included
  double size = 1;                   ///< nodes of that tree
  double bits = 0;                   ///< bound of the bits in its exact coefficients
  bool is_angle_in_degrees = false;  ///< the meaning of a name whose numbers are degrees
};

// The limits prevent a small file from using unbounded memory, time or stack: by doubling chains of
// named sub-expressions, towers of powers, or deep nesting.
constexpr int kMostDepth = 256;
constexpr double kLargestSize = 1e5;
constexpr double kMostBits = 1e6;
constexpr int kLargestPower = 100;
constexpr int kMaxMergedPower = 1 << 20;      ///< of powers of powers
constexpr int kMaxRootDenominator = 1 << 13;  ///< of exponents that become square roots

[[nodiscard]] ParsedExpression number(const GiNaC::numeric& value);
[[nodiscard]] ParsedExpression constant(const GiNaC::ex& value);
[[nodiscard]] ParsedExpression variable(const GiNaC::realsymbol& symbol);
/// The angle of `symbol` degrees.
[[nodiscard]] ParsedExpression angle_in_degrees(const GiNaC::realsymbol& symbol);

/// Operands of one chain a + b − c … or a · b / c …, in the order they are written.
struct Operand {
  ParsedExpression term;
  bool inverted = false;  ///< subtracted, or divided by
};

// All throw ParseRefusal if the result would not be real, or would exceed a limit above.

[[nodiscard]] ParsedExpression sum(std::vector<Operand> operands);

/// Records the condition that divisors are not zero.
[[nodiscard]] ParsedExpression product(std::vector<Operand> operands);

/// base^exponent for a constant rational exponent p/q in lowest terms, |p/q| ≤ kLargestPower.
///
/// Ensures   q = 1 is repeated multiplication (x^0 = 1 wherever x is defined). A power of two q up
///           to kMaxRootDenominator needs x ≥ 0 and becomes square roots: x^(3/4) is
///           sqrt(sqrt(x))^3. Any other q (x^(1/3)) needs x > 0 and becomes exp(p/q · log x). A
///           negative exponent also needs x ≠ 0.
[[nodiscard]] ParsedExpression power(const ParsedExpression& base,
                                     const ParsedExpression& exponent);

}  // namespace regulus::detail
