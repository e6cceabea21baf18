// SPDX-License-Identifier: Apache-2.0
// The digest that names a model file in reports and certificates, and an object in the cache.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace regulus::detail {

/// The SHA-256 digest of the bytes.
///
/// Shape     64 lower-case hexadecimal digits.
/// Requires  fewer than 2^61 bytes.
/// Source    FIPS 180-4, §6.2.
[[nodiscard]] std::string sha256(std::string_view bytes);

/// Computes the same digest of bytes that come in pieces.
class Sha256 {
 public:
  void add(std::string_view bytes);
  /// Returns the digest of the bytes added so far; more may be added afterwards.
  [[nodiscard]] std::string text() const;

 private:
  std::array<std::uint32_t, 8> hash_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                        0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::string tail_;  ///< the last, incomplete block
  std::uint64_t total_ = 0;
};

}  // namespace regulus::detail
