// SPDX-License-Identifier: GPL-3.0-or-later
// Counts how often this program asks for memory or takes a lock. Sanitizers have their own
// allocator, so nothing is counted with them.
#pragma once

#include <cstdint>

namespace regulus::detail::test {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kCallsAreCounted = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr bool kCallsAreCounted = false;
#else
inline constexpr bool kCallsAreCounted = true;
#endif
#else
inline constexpr bool kCallsAreCounted = true;
#endif

[[nodiscard]] std::uint64_t allocations() noexcept;
[[nodiscard]] std::uint64_t locks() noexcept;

}  // namespace regulus::detail::test
