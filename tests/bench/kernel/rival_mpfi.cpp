// SPDX-License-Identifier: GPL-3.0-or-later
#include <mpfi.h>

#include "tests/bench/kernel/straight_rival.hpp"

namespace regulus::detail::bench {
namespace {

constexpr mp_prec_t kPrecision = 53;

/// An owned mpfi_t.
class Value {
 public:
  Value() { mpfi_init2(value_, kPrecision); }
  ~Value() { mpfi_clear(value_); }
  Value(const Value&) = delete;
  Value& operator=(const Value& other) {
    mpfi_set(value_, other.value_);
    return *this;
  }
  [[nodiscard]] mpfi_ptr get() { return value_; }
  [[nodiscard]] mpfi_srcptr get() const { return value_; }

 private:
  mpfi_t value_;
};

/// Every operation writes into the next element of a preallocated row of values, so nothing is
/// allocated while the clock runs.
class MpfiArithmetic {
 public:
  using Number = Value;
  using Scope = NoScope;
  using Handle = const Value&;

  static void from(Interval x, Value& y) { mpfi_interv_d(y.get(), x.lo, x.hi); }
  static Interval to(const Value& x) {
    mpfr_t bound;
    mpfr_init2(bound, kPrecision);
    mpfi_get_left(bound, x.get());
    const double lo = mpfr_get_d(bound, MPFR_RNDD);
    mpfi_get_right(bound, x.get());
    const double hi = mpfr_get_d(bound, MPFR_RNDU);
    mpfr_clear(bound);
    return {lo, hi};
  }

  void begin() noexcept { used_ = 0; }
  Value& constant(double lo, double hi) {
    Value& z = next();
    mpfi_interv_d(z.get(), lo, hi);
    return z;
  }
  Value& add(Handle x, Handle y) { return put(mpfi_add, x.get(), y.get()); }
  Value& add(Handle x, double y) { return put(mpfi_add_d, x.get(), y); }
  Value& add(double x, Handle y) { return put(mpfi_add_d, y.get(), x); }
  Value& add(double x, double y) { return add(constant(x, x), y); }
  Value& subtract(Handle x, Handle y) { return put(mpfi_sub, x.get(), y.get()); }
  Value& subtract(Handle x, double y) { return put(mpfi_sub_d, x.get(), y); }
  Value& subtract(double x, Handle y) { return put(mpfi_d_sub, x, y.get()); }
  Value& subtract(double x, double y) { return subtract(constant(x, x), y); }
  Value& multiply(Handle x, Handle y) { return put(mpfi_mul, x.get(), y.get()); }
  Value& multiply(Handle x, double y) { return put(mpfi_mul_d, x.get(), y); }
  Value& multiply(double x, Handle y) { return put(mpfi_mul_d, y.get(), x); }
  Value& multiply(double x, double y) { return multiply(constant(x, x), y); }
  Value& negate(Handle x) { return put(mpfi_neg, x.get()); }
  [[nodiscard]] static double negate(double x) { return -x; }
  Value& sin(Handle x) { return put(mpfi_sin, x.get()); }
  Value& cos(Handle x) { return put(mpfi_cos, x.get()); }

 private:
  Value& next() {
    if (used_ == tape_.size()) tape_.push_back(std::make_unique<Value>());
    return *tape_[used_++];
  }
  template <class Operation, class... Operands>
  Value& put(Operation operation, Operands... operands) {
    Value& z = next();
    operation(z.get(), operands...);
    return z;
  }

  std::vector<std::unique_ptr<Value>> tape_;
  std::size_t used_ = 0;
};

}  // namespace

std::unique_ptr<Rival> make_mpfi(const Sample& sample) {
  return std::make_unique<StraightRival<MpfiArithmetic>>(sample);
}

}  // namespace regulus::detail::bench
