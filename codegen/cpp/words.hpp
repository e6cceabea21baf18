// SPDX-License-Identifier: GPL-3.0-or-later
// Names in generated headers: theirs are read by programs that are not ours.
#pragma once

#include <string>
#include <string_view>

namespace regulus::inline cpp {

/// Whether the text is an identifier in C and in C++ that neither language reserves, nor common
/// headers define as a macro.
[[nodiscard]] bool is_free_name(std::string_view text);

/// The text as such a name; not injective.
[[nodiscard]] std::string free_name(std::string_view text);

}  // namespace regulus::inline cpp
