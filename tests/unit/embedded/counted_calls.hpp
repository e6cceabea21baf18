// SPDX-License-Identifier: GPL-3.0-or-later
// How often this program asked for memory or took a lock. Sanitizers have their own allocator:
// there, nothing is counted.
#pragma once

#include <cstdint>

namespace regulus::test {

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

}  // namespace regulus::test
