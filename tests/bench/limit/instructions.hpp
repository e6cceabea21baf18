// SPDX-License-Identifier: GPL-3.0-or-later
// Counts the operations that a function asks for, and the instructions that it became.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "codegen/kernel/program/program.hpp"

namespace regulus::detail::bench {

/// Returns the number of operations on bounds: two for a sum, two for a product with an exact
/// double; for a product of two intervals four products, from which a minimum and a maximum select
/// two. Elementary functions are not counted, because they are calls.
[[nodiscard]] std::size_t bound_operations(const Program& program);

/// Returns the number of angles whose sine or cosine a program takes: one call for each.
[[nodiscard]] std::size_t sines_and_cosines(const Program& program);

/// Counts of instructions on 512-bit registers, by kind.
struct VectorInstructions {
  std::size_t arithmetic = 0;  ///< sums, products, fused ones, minima, maxima: operations on bounds
  std::size_t selection =
      0;  ///< blends, masked moves, comparisons, logic: the same two ports, no bound
  std::size_t moves = 0;  ///< loads, stores, copies, broadcasts, unmasked
  std::size_t bytes = 0;  ///< of all code, up to the last instruction of each symbol
};

/// Counts the instructions in a listing of `objdump --no-show-raw-insn` below the symbols that
/// contain `symbol`. In code without loops every instruction runs once.
[[nodiscard]] VectorInstructions count_instructions(std::string_view listing,
                                                    std::string_view symbol);

/// Returns the listing of a function without branches, below the symbol .data; nullopt if there is
/// no objdump. `code`: the function, then its constants.
[[nodiscard]] std::optional<std::string> disassemble(const std::string& code);

}  // namespace regulus::detail::bench
