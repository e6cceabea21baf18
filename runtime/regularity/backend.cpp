// SPDX-License-Identifier: Apache-2.0
#include "regulus/regularity/backend.hpp"

#include <initializer_list>

namespace regulus {

const RegularityBackend& regularity_backend(X8Isa isa) noexcept {
#if defined(__x86_64__)
  if (isa == X8Isa::kAvx512) return kRegularityAvx512;
  if (isa == X8Isa::kAvx2) return kRegularityAvx2;
#endif
  static_cast<void>(isa);
  return kRegularityBaseline;
}

const RegularityBackend& regularity_backend() noexcept {
  for (const X8Isa isa : {X8Isa::kAvx512, X8Isa::kAvx2})
    if (x8_available(isa)) return regularity_backend(isa);
  return kRegularityBaseline;
}

}  // namespace regulus
