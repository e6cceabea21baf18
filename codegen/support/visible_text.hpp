// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace regulus::detail {

/// Returns a text that a terminal shows as it is: control characters, those that change the
/// direction of writing, and bytes that are not UTF-8 are written as \xNN.
///
/// `lines`: line breaks stay.
[[nodiscard]] std::string visible(std::string_view text, bool lines = false);

}  // namespace regulus::detail
