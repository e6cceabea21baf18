// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace regulus::detail {

/// Identifies this program: for the executable and each shared library in the process, the build id
/// of the linker; if there is none, the file, its size and the time of its last change.
///
/// Ensures   two programs have different identities if any part was built from other text. So no
///           program uses the cached results of another one.
[[nodiscard]] std::string build_id();

}  // namespace regulus::detail
