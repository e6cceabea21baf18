// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/kernel/program/flint_rational.hpp"

#include <fmpz.h>

#include <memory>

namespace regulus::detail {

std::string FlintRational::text() const {
  const std::unique_ptr<char, void (*)(void*)> digits(fmpq_get_str(nullptr, 10, value_),
                                                      flint_free);
  return digits.get();
}

std::optional<FlintRational> FlintRational::read(const std::string& text) {
  const std::size_t slash = text.find('/');
  const std::string numerator = text.substr(0, slash);
  const std::string denominator = slash == std::string::npos ? "1" : text.substr(slash + 1);
  FlintRational result;
  if (fmpz_set_str(fmpq_numref(result.value_), numerator.c_str(), 10) != 0 ||
      fmpz_set_str(fmpq_denref(result.value_), denominator.c_str(), 10) != 0 ||
      fmpz_is_zero(fmpq_denref(result.value_))) {
    fmpz_one(fmpq_denref(result.value_));  // clear needs a valid number
    return std::nullopt;
  }
  fmpq_canonicalise(result.value_);
  if (result.text() != text) return std::nullopt;
  return result;
}

}  // namespace regulus::detail
