// SPDX-License-Identifier: GPL-3.0-or-later
// The model file that `regulus import` writes: only its own earlier file is replaced.
#pragma once

#include <string>

namespace regulus::detail {

/// Writes the model with a last line that has the digest of the lines above. An earlier file that
/// is still as it was written becomes FILE.old.
///
/// Throws    FileError if FILE, or FILE.old, which would be lost, is not as import wrote it: a
///           person may have edited it.
void write_imported(const std::string& path, const std::string& model);

}  // namespace regulus::detail
