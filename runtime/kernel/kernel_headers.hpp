// SPDX-License-Identifier: Apache-2.0
// The texts of the headers that generated code includes, for compilers that read no files.
#pragma once

#include <span>
#include <string_view>

namespace regulus::detail {

struct KernelHeader {
  std::string_view path;  ///< as in an include: "runtime/kernel/pack.hpp"
  std::string_view text;
};

/// Ensures   all headers that "runtime/kernel/abi.hpp" and "runtime/kernel/pack.hpp" include,
///           directly or not, for any instruction set.
[[nodiscard]] std::span<const KernelHeader> kernel_headers() noexcept;

}  // namespace regulus::detail
