// SPDX-License-Identifier: GPL-3.0-or-later
// What a function of a kernel is called in its object.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "regulus/codegen/jit/reader/syntax.hpp"

namespace regulus::codegen::reader {

/// The symbols of the functions of a kernel, by their names in its text.
using Symbols = std::map<std::string_view, std::string>;

/// "kernel." and 64 hexadecimal digits; of an exported function its name.
///
/// Ensures   two functions have the same symbol only if they compute the same, whatever kernels
/// they
///           are of and whatever the names in them are: those of the other functions they call
///           count by what these do.
/// Throws    OutsideSubset for two functions of one name.
[[nodiscard]] Symbols symbols_of(const KernelText& kernel);

}  // namespace regulus::codegen::reader
