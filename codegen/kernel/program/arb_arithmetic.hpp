// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "codegen/kernel/program/ball.hpp"
#include "codegen/kernel/program/node.hpp"

namespace regulus::detail {

/// The interpreter's arithmetic on balls: rigorous, as narrow as `precision` bits allow.
///
/// Ensures   unless undefined(), the program is defined at every point of the operands and each
///           ball contains its value. A domain condition that is not certain counts as violated.
class ArbArithmetic {
 public:
  using Number = Ball;

  explicit ArbArithmetic(long precision) noexcept : precision_(precision) {}

  [[nodiscard]] bool undefined() const noexcept { return undefined_; }
  /// True if some operation certainly has no value at any point of its operands.
  [[nodiscard]] bool certainly_undefined() const noexcept { return violated_; }
  void clear() noexcept { undefined_ = violated_ = false; }

  [[nodiscard]] Ball constant(const cln::cl_RA& value) const { return Ball(value, precision_); }
  [[nodiscard]] Ball pi() const;
  [[nodiscard]] Ball negate(const Ball& a) const;
  [[nodiscard]] Ball add(const Ball& a, const Ball& b) const;
  [[nodiscard]] Ball subtract(const Ball& a, const Ball& b) const;
  [[nodiscard]] Ball multiply(const Ball& a, const Ball& b) const;
  [[nodiscard]] Ball divide(const Ball& a, const Ball& b);
  [[nodiscard]] Ball power(const Ball& a, unsigned exponent) const;
  [[nodiscard]] Ball atan2(const Ball& a, const Ball& b);

  /// The functions of one argument, kSqrt … kAbs.
  [[nodiscard]] Ball call(Op function, const Ball& a);

 private:
  void require(bool certain, bool violated) noexcept {
    undefined_ = undefined_ || !certain;
    violated_ = violated_ || violated;
  }
  void require_domain(Op function, const Ball& a);

  long precision_;
  bool undefined_ = false;
  bool violated_ = false;
};

}  // namespace regulus::detail
