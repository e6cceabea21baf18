// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace regulus::inline shell {

/// The text after somebody has changed it in the editor that VISUAL or EDITOR names, or in vi.
///
/// Throws    FileError when the text cannot be handed over, or the editor ends with an error.
[[nodiscard]] std::string edited(const std::string& text);

}  // namespace regulus::inline shell
