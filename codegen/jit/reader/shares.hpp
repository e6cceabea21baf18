// SPDX-License-Identifier: GPL-3.0-or-later
// A kernel cut in two, to be compiled side by side.
#pragma once

#include <cstddef>
#include <set>
#include <string_view>
#include <vector>

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

}  // namespace regulus::codegen::reader
