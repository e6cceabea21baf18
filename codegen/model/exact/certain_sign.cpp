// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/certain_sign.hpp"

#include <arb.h>
#include <cln/integer.h>
#include <cln/integer_io.h>
#include <flint/fmpz.h>

#include <array>
#include <sstream>
#include <string>
#include <utility>

namespace regulus::detail {
namespace {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

constexpr long kFirstPrecision = 64, kLastPrecision = 4096;

/// An owned arb_t. An expression without a value is a ball that is not finite, and stays so.
class Enclosure {
 public:
  Enclosure() noexcept { arb_init(value_); }
  Enclosure(Enclosure&& other) noexcept : Enclosure() { arb_swap(value_, other.value_); }
  Enclosure(const Enclosure&) = delete;
  Enclosure& operator=(const Enclosure&) = delete;
  ~Enclosure() { arb_clear(value_); }
  [[nodiscard]] arb_ptr get() noexcept { return value_; }

 private:
  arb_t value_;
};

using Function = void (*)(arb_t, const arb_t, slong);
constexpr std::array<std::pair<const char*, Function>, 8> kEnclosedFunctions = {{{"sin", arb_sin},
                                                                                 {"cos", arb_cos},
                                                                                 {"tan", arb_tan},
                                                                                 {"asin", arb_asin},
                                                                                 {"acos", arb_acos},
                                                                                 {"atan", arb_atan},
                                                                                 {"exp", arb_exp},
                                                                                 {"log", arb_log}}};

class Evaluation {
 public:
  explicit Evaluation(long precision) : precision_(precision) {}

  Enclosure of(const ex& e) const {
    if (is_a<numeric>(e)) return rational(ex_to<numeric>(e));
    if (is_a<GiNaC::add>(e)) return folded(e, arb_add);
    if (is_a<GiNaC::mul>(e)) return folded(e, arb_mul);
    if (is_a<GiNaC::power>(e)) return power(e);
    if (is_a<GiNaC::function>(e)) return call(ex_to<GiNaC::function>(e));
    Enclosure result;
    if (e.is_equal(GiNaC::Pi))
      arb_const_pi(result.get(), precision_);
    else
      arb_indeterminate(result.get());
    return result;
  }

 private:
  static void set_integer(fmpz_t to, const numeric& n) {
    std::ostringstream digits;
    cln::print_integer(digits, 16U, cln::the<cln::cl_I>(n.to_cl_N()));
    fmpz_set_str(to, digits.str().c_str(), 16);
  }

  Enclosure rational(const numeric& n) const {
    Enclosure result;
    if (!n.is_rational()) {
      arb_indeterminate(result.get());
      return result;
    }
    fmpz_t numerator, denominator;
    fmpz_init(numerator);
    fmpz_init(denominator);
    set_integer(numerator, n.numer());
    set_integer(denominator, n.denom());
    arb_set_fmpz(result.get(), numerator);
    arb_div_fmpz(result.get(), result.get(), denominator, precision_);
    fmpz_clear(numerator);
    fmpz_clear(denominator);
    return result;
  }

  Enclosure folded(const ex& e, void (*operation)(arb_t, const arb_t, const arb_t, slong)) const {
    Enclosure result = of(e.op(0));
    for (std::size_t i = 1; i < e.nops(); ++i) {
      Enclosure next = of(e.op(i));
      operation(result.get(), result.get(), next.get(), precision_);
    }
    return result;
  }

  /// Whole exponents by multiplication, halves by a root, others only for a positive base.
  Enclosure power(const ex& e) const {
    Enclosure base = of(e.op(0));
    Enclosure exponent = of(e.op(1));
    if (e.op(1).is_equal(numeric(1, 2)))
      arb_sqrt(base.get(), base.get(), precision_);
    else
      arb_pow(base.get(), base.get(), exponent.get(), precision_);
    return base;
  }

  Enclosure call(const GiNaC::function& f) const {
    Enclosure result = of(f.op(0));
    const std::string name = f.get_name();
    if (name == "abs") {
      arb_abs(result.get(), result.get());
      return result;
    }
    if (name == "atan2") {
      Enclosure abscissa = of(f.op(1));
      arb_atan2(result.get(), result.get(), abscissa.get(), precision_);
      return result;
    }
    for (const auto& [known, function] : kEnclosedFunctions)
      if (name == known) {
        function(result.get(), result.get(), precision_);
        return result;
      }
    arb_indeterminate(result.get());
    return result;
  }

  long precision_;
};

CertainSign sign_of(const numeric& value) {
  if (value.is_zero()) return CertainSign::kZero;
  return value.is_negative() ? CertainSign::kNegative : CertainSign::kPositive;
}

}  // namespace

CertainSign certain_sign(const ex& constant) {
  const ex simplified = is_a<numeric>(constant) ? constant : constant.expand();
  if (simplified.info(GiNaC::info_flags::rational)) return sign_of(ex_to<numeric>(simplified));
  for (long precision = kFirstPrecision; precision <= kLastPrecision; precision *= 4) {
    Enclosure value = Evaluation(precision).of(constant);
    if (!arb_is_finite(value.get())) continue;
    if (arb_is_positive(value.get())) return CertainSign::kPositive;
    if (arb_is_negative(value.get())) return CertainSign::kNegative;
  }
  return CertainSign::kUnknown;
}

}  // namespace regulus::detail
