// SPDX-License-Identifier: GPL-3.0-or-later
// Filters that must be detected, refused, or contained; the build selects one.
#include <regulus/filter.h>

#include <cfenv>
#include <stdexcept>

namespace {

[[maybe_unused]] unsigned vouch_for_everything(const regulus_filter_boxes*, void*) { return ~0u; }

[[maybe_unused]] unsigned vouch_for_nothing(const regulus_filter_boxes*, void*) { return 0; }

[[maybe_unused]] unsigned round_upward(const regulus_filter_boxes*, void*) {
  std::fesetround(FE_UPWARD);
  return ~0u;
}

[[maybe_unused]] unsigned throw_up(const regulus_filter_boxes*, void*) {
  throw std::runtime_error("no");
}

}  // namespace

#if defined(FILTER_CERTIFY)
const regulus_filter_interface regulus_filter = {REGULUS_FILTER_ABI + FILTER_NEWER, FILTER_NAME,
                                                 FILTER_CERTIFY, nullptr};
#endif
