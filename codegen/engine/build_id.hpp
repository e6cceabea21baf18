// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace regulus::inline engine {

/// Which program this is: for the executable and each shared library in the process the build id
/// that its linker noted, or where there is none the file, its size and the time of its last
/// change.
///
/// Ensures   two programs of which any part was built from other text have different identities;
///           what an earlier one kept is then never taken for what this one would make.
[[nodiscard]] std::string build_id();

}  // namespace regulus::inline engine
