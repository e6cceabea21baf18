// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace regulus::detail {

/// Writes a file whole or not at all. Throws FileError.
void write_file(const std::string& path, const std::string& text);

}  // namespace regulus::detail
