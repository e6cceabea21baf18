// SPDX-License-Identifier: GPL-3.0-or-later
// The digest that names a model file in reports and certificates, and an object in the cache.
#pragma once

#include <string>
#include <string_view>

namespace regulus::codegen {

/// The SHA-256 digest of the bytes.
///
/// Shape     64 lower-case hexadecimal digits.
/// Requires  fewer than 2^61 bytes.
/// Source    FIPS 180-4, §6.2.
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace regulus::codegen
