// SPDX-License-Identifier: GPL-3.0-or-later
// Names in generated headers, which programs of users include.
#pragma once

#include <string>
#include <string_view>

namespace regulus::detail {

/// True if the text is an identifier in C and in C++ that neither language reserves and no common
/// header defines as a macro.
[[nodiscard]] bool is_free_name(std::string_view text);

/// Returns the text as such a name; not injective.
[[nodiscard]] std::string free_name(std::string_view text);

}  // namespace regulus::detail
