// SPDX-License-Identifier: Apache-2.0
#include "runtime/problem/filter.hpp"

#include <algorithm>
#include <cfenv>
#include <cstring>

namespace regulus {
namespace {

constexpr std::size_t kLongestName = 64;

bool is_printable(char c) { return c >= ' ' && c <= '~'; }

/// Not inlined: a function that uses the floating-point environment must not be moved.
[[gnu::noinline]] unsigned answer(const regulus_filter_interface& filter,
                                  const regulus_filter_boxes& boxes) noexcept try {
  const unsigned lanes = filter.certify(&boxes, filter.context);
  return std::fegetround() == FE_TONEAREST ? lanes & boxes.lanes : 0;
} catch (...) {
  return 0;
}

}  // namespace

std::optional<std::string> find_fault(const regulus_filter_interface& filter) {
  if (filter.abi != REGULUS_FILTER_ABI)
    return "the filter has ABI " + std::to_string(filter.abi) + ", but this Regulus has ABI " +
           std::to_string(static_cast<int>(REGULUS_FILTER_ABI));
  if (filter.certify == nullptr) return "the filter has no function certify";
  const std::size_t length = filter.name == nullptr ? 0 : ::strnlen(filter.name, kLongestName + 1);
  if (length == 0 || length > kLongestName ||
      !std::all_of(filter.name, filter.name + length, is_printable))
    return "the name of the filter does not have 1 to 64 printable ASCII characters";
  return std::nullopt;
}

// The whole environment is saved, also that of x87: a foreign function may leave anything in it.
unsigned call_filter(const regulus_filter_interface& filter,
                     const regulus_filter_boxes& boxes) noexcept {
  std::fenv_t kept;
  if (std::fegetenv(&kept) != 0 || std::fesetenv(FE_DFL_ENV) != 0) return 0;
  const unsigned lanes = answer(filter, boxes);
  return std::fesetenv(&kept) == 0 ? lanes : 0;
}

}  // namespace regulus
