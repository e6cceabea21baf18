// SPDX-License-Identifier: Apache-2.0
#include "runtime/regularity/backend.hpp"

namespace regulus::detail {

const RegularityBackend& regularity_backend(Isa isa) noexcept {
#if defined(__x86_64__)
  if (isa == Isa::kAvx512) return kRegularityAvx512;
  if (isa == Isa::kAvx2) return kRegularityAvx2;
#endif
  static_cast<void>(isa);
  return kRegularityPortable;
}

const RegularityBackend& regularity_backend() noexcept { return regularity_backend(best_isa()); }

}  // namespace regulus::detail
