// SPDX-License-Identifier: GPL-3.0-or-later
// A written expression while it is read: the GiNaC expression it simplifies to, what must be
// defined for the written one to be defined, and how large it has grown. Untrusted text is read
// with these operations only.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <string_view>
#include <vector>

namespace regulus::inline model {

/// Why an operation is refused. Whoever knows file and line turns it into an InputError.
struct Refusal {
  std::string found;
  std::string expected;
};

struct ParsedExpression {
  GiNaC::ex value;
  /// Expressions that are all defined exactly where the written expression is, as far as `value`
  /// does not show it. An operation that has a value everywhere its operands have one adds nothing.
  std::vector<GiNaC::ex> must_be_defined{};
  bool constant = true;  ///< no symbol was written in it
  int depth = 1;         ///< of the written tree, named sub-expressions included
  double size = 1;       ///< nodes of that tree
  double bits = 0;       ///< bound of the bits in its exact coefficients
};

// The limits keep a small file from asking for unbounded memory, time or stack: doubling chains of
// named sub-expressions, towers of powers, deep nesting.
constexpr int kMostDepth = 256;
constexpr double kLargestSize = 1e5;
constexpr double kMostBits = 1e6;
constexpr int kLargestPower = 100;
constexpr int kMaxMergedPower = 1 << 20;      ///< of powers of powers
constexpr int kMaxRootDenominator = 1 << 13;  ///< of exponents that become square roots

[[nodiscard]] ParsedExpression number(const GiNaC::numeric& value);
[[nodiscard]] ParsedExpression constant(const GiNaC::ex& value);
[[nodiscard]] ParsedExpression variable(const GiNaC::realsymbol& symbol);

/// Operands of one chain a + b − c … or a · b / c …, in the order they are written.
struct Operand {
  ParsedExpression term;
  bool inverted = false;  ///< subtracted, or divided by
};

// All throw Refusal when the result would not be real, or exceed a limit above.

[[nodiscard]] ParsedExpression sum(std::vector<Operand> operands);

/// Divisors are recorded as having to be non-zero.
[[nodiscard]] ParsedExpression product(std::vector<Operand> operands);

/// base^exponent for a constant rational exponent p/q in lowest terms, |p/q| ≤ kLargestPower.
///
/// Ensures   q = 1 is repeated multiplication (x^0 = 1 wherever x is defined). A power of two q up
///           to kMaxRootDenominator needs x ≥ 0 and becomes square roots: x^(3/4) is
///           sqrt(sqrt(x))^3. Any other q (x^(1/3)) needs x > 0 and becomes exp(p/q · log x). A
///           negative exponent needs x ≠ 0 besides.
[[nodiscard]] ParsedExpression power(const ParsedExpression& base,
                                     const ParsedExpression& exponent);

}  // namespace regulus::inline model
