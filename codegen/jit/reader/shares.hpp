// SPDX-License-Identifier: GPL-3.0-or-later
// A kernel cut into pieces that are compiled side by side.
#pragma once

#include <cstddef>
#include <set>
#include <string_view>
#include <vector>

#include "regulus/codegen/jit/reader/fingerprint.hpp"
#include "regulus/codegen/jit/reader/syntax.hpp"

namespace regulus::codegen::reader {

/// The functions that one object defines, by name. `tables` says which one defines the tables, too.
struct Share {
  std::set<std::string_view> functions;
  bool tables = false;
};

/// Ensures   each function in one share, with the functions that it calls; shares of about equal
///           length, the last with the tables; a single one when the kernel is short.
[[nodiscard]] std::vector<Share> share_out(const KernelText& kernel);

/// As share_out, for objects that other kernels are to use, too.
///
/// Ensures   a function that calls none is in one of the first shares, or in none if its symbol is
///           among `known`; all others in the last one, with the tables.
[[nodiscard]] std::vector<Share> share_out_unknown(const KernelText& kernel, const Symbols& symbols,
                                                   const std::set<std::string_view>& known);

}  // namespace regulus::codegen::reader
