// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace regulus::detail {

/// Opens the text in the editor that VISUAL or EDITOR names, or in vi, and returns the changed
/// text.
///
/// Throws    FileError if the text cannot be passed to the editor, or the editor ends with an
///           error.
[[nodiscard]] std::string edited(const std::string& text);

}  // namespace regulus::detail
