// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <type_traits>

namespace regulus::detail::bench {

/// The arithmetic of a number type with operators, for straight-line code. sin and cos of a Number
/// are found by argument-dependent lookup. Two exact doubles become Numbers, since their sum need
/// not be a double. A Tag separates code that is compiled with other flags.
template <class N, class Tag = void>
struct OperatorArithmetic {
  using Number = N;

  void begin() noexcept {}
  [[nodiscard]] static N constant(double lo, double hi) { return N(lo, hi); }

  template <class X, class Y>
  [[nodiscard]] static N add(const X& x, const Y& y) {
    return exact_if_both_are<Y>(x) + y;
  }
  template <class X, class Y>
  [[nodiscard]] static N subtract(const X& x, const Y& y) {
    return exact_if_both_are<Y>(x) - y;
  }
  template <class X, class Y>
  [[nodiscard]] static N multiply(const X& x, const Y& y) {
    return exact_if_both_are<Y>(x) * y;
  }
  template <class X>
  [[nodiscard]] static X negate(const X& x) {
    return -x;
  }
  [[nodiscard]] static N sin(const N& x) {
    using std::sin;
    return sin(x);
  }
  [[nodiscard]] static N cos(const N& x) {
    using std::cos;
    return cos(x);
  }

 private:
  template <class Y, class X>
  static decltype(auto) exact_if_both_are(const X& x) {
    if constexpr (std::is_same_v<X, double> && std::is_same_v<Y, double>)
      return N(x);
    else
      return (x);
  }
};

}  // namespace regulus::detail::bench
