// SPDX-License-Identifier: Apache-2.0
#include "runtime/kernel/isa.hpp"

#include "regulus/instruction_set_flags.hpp"
#include "runtime/kernel/abi.hpp"

namespace regulus {

std::string_view name(Isa isa) noexcept {
  switch (isa) {
    case Isa::kAvx512:
      return "avx512";
    case Isa::kAvx2:
      return "avx2";
    case Isa::kPortable:
      return "portable";
  }
  __builtin_unreachable();
}

std::optional<Isa> parse_isa(std::string_view word) noexcept {
  for (const Isa isa : kAllIsas)
    if (name(isa) == word) return isa;
  return std::nullopt;
}

std::span<const char* const> compile_flags(Isa isa) noexcept {
  switch (isa) {
    case Isa::kAvx512:
      return kAvx512Flags;
    case Isa::kAvx2:
      return kAvx2Flags;
    case Isa::kPortable:
      return kPortableFlags;
  }
  __builtin_unreachable();
}

unsigned required_rounding(Isa isa) noexcept {
  return isa == Isa::kAvx2 ? REGULUS_ROUND_UPWARD : REGULUS_ROUND_NEAREST;
}

}  // namespace regulus
