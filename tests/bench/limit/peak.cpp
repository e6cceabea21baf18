// SPDX-License-Identifier: GPL-3.0-or-later
// CMakeLists.txt has the flags of this file.
#include "tests/bench/limit/peak.hpp"

#include <cstddef>
#include <utility>

#include "runtime/kernel/simd.hpp"

namespace regulus::detail::bench {

#if defined(REGULUS_ISA_AVX512)

namespace {

using simd::V8;

// Twice the chains that keep two ports with a latency of four cycles busy.
constexpr std::size_t kChains = 16;
constexpr int kSteps = 4096;
static_assert(kPeakOperations == kChains * double{kSteps});

/// Runs `step` on every chain again and again. The asm keeps each chain in a register and makes the
/// compiler believe that its value is needed.
template <class Step, std::size_t... Chains>
void run_chains(Step step, std::index_sequence<Chains...>) noexcept {
  V8 x[] = {(static_cast<void>(Chains), simd::splat(1.0))...};
  for (int i = 0; i < kSteps; ++i)
    (
        [&] {
          x[Chains] = step(x[Chains], std::integral_constant<std::size_t, Chains>());
          asm volatile("" : "+v"(x[Chains]));
        }(),
        ...);
}

}  // namespace

void peak_fused() noexcept {
  const V8 factor = simd::splat(0x0.fffffffp0), term = simd::splat(0x1p-40);
  run_chains([&](V8 x, auto) { return simd::fma_rd(x, factor, term); },
             std::make_index_sequence<kChains>());
}

void peak_bounds() noexcept {
  const V8 factor = simd::splat(0x0.fffffffp0), term = simd::splat(0x1p-40);
  const auto step = [&](V8 x, auto chain) {
    if constexpr (chain % 4 == 0) return simd::mul_rd(x, factor);
    if constexpr (chain % 4 == 1) return simd::mul_ru(x, factor);
    if constexpr (chain % 4 == 2) return simd::add_rd(x, term);
    if constexpr (chain % 4 == 3) return simd::add_ru(x, term);
  };
  run_chains(step, std::make_index_sequence<kChains>());
}

#else

void peak_fused() noexcept {}
void peak_bounds() noexcept {}

#endif

}  // namespace regulus::detail::bench
