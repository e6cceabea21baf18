// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/exact/exact_double.hpp"

#include <cmath>
#include <limits>

namespace regulus::detail {

GiNaC::ex exact_number(double x) {
  constexpr int kDigits = std::numeric_limits<double>::digits;
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  return GiNaC::numeric(static_cast<long>(std::ldexp(fraction, kDigits))) *
         GiNaC::pow(GiNaC::ex(2), exponent - kDigits);
}

}  // namespace regulus::detail
