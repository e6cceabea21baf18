// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/kernel/ahead_of_time.hpp"

extern "C" {
#if defined(__x86_64__)
extern const regulus_kernel bench_avx512_kernel;
extern const regulus_kernel bench_avx2_kernel;
#endif
extern const regulus_kernel bench_portable_kernel;
}

namespace regulus::detail::bench {

const regulus_kernel* ahead_of_time(Isa isa) noexcept {
  switch (isa) {
#if defined(__x86_64__)
    case Isa::kAvx512:
      return &bench_avx512_kernel;
    case Isa::kAvx2:
      return &bench_avx2_kernel;
#endif
    case Isa::kPortable:
      return &bench_portable_kernel;
    default:
      return nullptr;
  }
}

}  // namespace regulus::detail::bench
