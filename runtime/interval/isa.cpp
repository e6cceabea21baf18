// SPDX-License-Identifier: Apache-2.0
#include "runtime/interval/isa.hpp"

namespace regulus {

bool supported(Isa isa) noexcept {
#if defined(__x86_64__)
  if (isa == Isa::kAvx512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
  if (isa == Isa::kAvx2) return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#endif
  return isa == Isa::kPortable;
}

Isa best_isa() noexcept {
  for (const Isa isa : kAllIsas)
    if (supported(isa)) return isa;
  return Isa::kPortable;
}

}  // namespace regulus
