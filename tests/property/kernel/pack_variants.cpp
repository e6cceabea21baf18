// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/property/kernel/pack_variants.hpp"

#include <iterator>

extern "C" {
#define VARIANT(symbol, name, isa, primary)                                                 \
  void symbol(regulus::detail::test::PackOperation, unsigned, const double*, const double*, \
              double*, unsigned*);
#include "pack_variants.inc"
#undef VARIANT
#define UNFLAGGED(symbol, compiler) \
  unsigned symbol(const double*, const double*, double*, const void*);
#include "unflagged.inc"
#undef UNFLAGGED
}

namespace regulus::detail::test {

std::vector<Variant> variants() {
  std::vector<Variant> found;
#define VARIANT(symbol, name, isa, primary) \
  if (supported(*parse_isa(#isa))) found.push_back({name, *parse_isa(#isa), primary, symbol});
#include "pack_variants.inc"
#undef VARIANT
  return found;
}

std::span<const Unflagged> unflagged_self_tests() {
  static constexpr Unflagged kAll[] = {
#define UNFLAGGED(symbol, compiler) {compiler, symbol},
#include "unflagged.inc"
#undef UNFLAGGED
      {"", nullptr}};
  return std::span(kAll).first(std::size(kAll) - 1);
}

}  // namespace regulus::detail::test
