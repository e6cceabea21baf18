// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/attack/oracle/value.hpp"

#include <stdexcept>

namespace regulus::detail::attack {
namespace {

/// Returns the result of an operation of Arb on one or two balls.
template <class Operation>
Value ball_of(Operation operation) {
  arb_t result;
  arb_init(result);
  operation(result);
  const Value value(result);
  arb_clear(result);
  return value;
}

bool is_in_unit_range(const Value& x) {
  return x.certain_at_least(Rational(-1)) && x.certain_at_most(Rational(1));
}

std::optional<Rational> exact_root(const Rational& x, unsigned long degree) {
  Rational root;
  if (x.sign() < 0) return std::nullopt;
  if (!fmpz_root(fmpq_numref(root.get()), fmpq_numref(x.get()), static_cast<slong>(degree)) ||
      !fmpz_root(fmpq_denref(root.get()), fmpq_denref(x.get()), static_cast<slong>(degree)))
    return std::nullopt;
  return root;
}

Value square_root(const Value& x) {
  if (!x.certain_at_least(Rational(0))) return {};
  if (x.exact())
    if (const auto root = exact_root(*x.exact(), 2)) return *root;
  return ball_of([&](arb_t r) { arb_sqrt(r, x.ball(), kBits); });
}

Value logarithm(const Value& x) {
  if (x.sign() != 1) return {};
  if (x.exact() && *x.exact() == Rational(1)) return Rational(0);
  return ball_of([&](arb_t r) { arb_log(r, x.ball(), kBits); });
}

Value exponential(const Value& x) {
  if (x.exact() && x.exact()->is_zero()) return Rational(1);
  return ball_of([&](arb_t r) { arb_exp(r, x.ball(), kBits); });
}

Value odd_function(const Value& x, void (*function)(arb_t, const arb_t, slong)) {
  if (x.exact() && x.exact()->is_zero()) return Rational(0);
  return ball_of([&](arb_t r) { function(r, x.ball(), kBits); });
}

Value arc_cosine(const Value& x) {
  if (!is_in_unit_range(x)) return {};
  if (x.exact() && *x.exact() == Rational(1)) return Rational(0);
  return ball_of([&](arb_t r) { arb_acos(r, x.ball(), kBits); });
}

Value arc_tangent(const Value& y, const Value& x) {
  const bool off_cut = x.sign() == 1 || y.sign() == 1 || y.sign() == -1;
  if (!off_cut) return {};
  if (y.exact() && y.exact()->is_zero()) return Rational(0);
  return ball_of([&](arb_t r) { arb_atan2(r, y.ball(), x.ball(), kBits); });
}

}  // namespace

std::optional<int> Value::sign() const {
  if (!defined_) return std::nullopt;
  if (exact_) return exact_->sign();
  if (arb_is_positive(ball_)) return 1;
  if (arb_is_negative(ball_)) return -1;
  return std::nullopt;
}

bool Value::is_zero_to(const Rational& unit) const {
  if (!defined_) return false;
  if (exact_) return exact_->is_zero();
  const Rational tiny = unit * Rational::two_to(-600);
  return arb_contains_zero(ball_) && certain_at_most(tiny) && certain_at_least(-tiny);
}

bool Value::certain_at_most(const Rational& bound) const {
  if (!defined_) return false;
  if (exact_) return *exact_ <= bound;
  const std::optional<int> sign = (*this - Value(bound)).sign();
  return sign && *sign <= 0;
}

bool Value::certain_at_least(const Rational& bound) const {
  if (!defined_) return false;
  if (exact_) return *exact_ >= bound;
  const std::optional<int> sign = (*this - Value(bound)).sign();
  return sign && *sign >= 0;
}

std::string Value::describe() const {
  if (!defined_) return "undefined";
  char* text = arb_get_str(ball_, 20, 0);
  std::string result = (exact_ ? "exactly " : "") + std::string(text);
  flint_free(text);
  return result;
}

Value operator+(const Value& a, const Value& b) {
  if (!a.defined_ || !b.defined_) return {};
  if (a.exact_ && b.exact_) return *a.exact_ + *b.exact_;
  return ball_of([&](arb_t r) { arb_add(r, a.ball_, b.ball_, kBits); });
}

Value operator-(const Value& a, const Value& b) { return a + b * Value(Rational(-1)); }

Value operator*(const Value& a, const Value& b) {
  if (!a.defined_ || !b.defined_) return {};
  if (a.exact_ && b.exact_) return *a.exact_ * *b.exact_;
  return ball_of([&](arb_t r) { arb_mul(r, a.ball_, b.ball_, kBits); });
}

Value operator/(const Value& a, const Value& b) {
  if (!a.defined_ || b.sign().value_or(0) == 0) return {};
  if (a.exact_ && b.exact_) return *a.exact_ / *b.exact_;
  return ball_of([&](arb_t r) { arb_div(r, a.ball_, b.ball_, kBits); });
}

Value power(const Value& base, const Value& exponent) {
  if (!base.defined() || !exponent.exact()) return {};
  const Rational& e = *exponent.exact();
  if (e.is_integer()) {
    const long n = fmpz_get_si(fmpq_numref(e.get()));
    if (n < 0 && base.sign().value_or(0) == 0) return {};
    if (base.exact()) return base.exact()->to_the(n);
    if (n < 0) return Value(Rational(1)) / power(base, Value(-e));
    return ball_of([&](arb_t r) { arb_pow_ui(r, base.ball(), static_cast<ulong>(n), kBits); });
  }
  const bool certain = e.sign() > 0 ? base.certain_at_least(Rational(0)) : base.sign() == 1;
  if (!certain) return {};
  if (base.exact()) {
    const auto root = exact_root(*base.exact(), fmpz_get_ui(fmpq_denref(e.get())));
    if (root) return root->to_the(fmpz_get_si(fmpq_numref(e.get())));
  }
  return ball_of([&](arb_t r) { arb_pow_fmpq(r, base.ball(), e.get(), kBits); });
}

Value magnitude(const Value& x) {
  if (!x.defined()) return {};
  if (x.exact()) return x.exact()->magnitude();
  return ball_of([&](arb_t r) { arb_abs(r, x.ball()); });
}

Value pi() {
  return ball_of([](arb_t r) { arb_const_pi(r, kBits); });
}

Value call(const std::string& function, const Value& x, const Value& y) {
  if (!x.defined()) return {};
  if (function == "sqrt") return square_root(x);
  if (function == "log") return logarithm(x);
  if (function == "exp") return exponential(x);
  if (function == "abs") return magnitude(x);
  if (function == "sin") return odd_function(x, arb_sin);
  if (function == "cos") {
    if (x.exact() && x.exact()->is_zero()) return Rational(1);
    return ball_of([&](arb_t r) { arb_cos(r, x.ball(), kBits); });
  }
  if (function == "tan") return odd_function(x, arb_tan);
  if (function == "atan") return odd_function(x, arb_atan);
  if (function == "asin") return is_in_unit_range(x) ? odd_function(x, arb_asin) : Value();
  if (function == "acos") return arc_cosine(x);
  if (function == "atan2") return arc_tangent(x, y);
  throw std::invalid_argument("no function " + function);
}

}  // namespace regulus::detail::attack
