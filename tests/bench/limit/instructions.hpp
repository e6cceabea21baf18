// SPDX-License-Identifier: GPL-3.0-or-later
// What a function computes and what it became.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "codegen/program/program.hpp"

namespace regulus::bench {

/// Operations on bounds that a program asks for: two for a sum, two for a product with an exact
/// double; for a product of two intervals four products, of which two are selected by a minimum and
/// a maximum. Elementary functions are not counted: they are calls.
[[nodiscard]] std::size_t bound_operations(const Program& program);

/// How many different angles a program takes the sine or the cosine of: one call each.
[[nodiscard]] std::size_t sines_and_cosines(const Program& program);

/// Instructions on 512-bit registers, by what they do.
struct VectorInstructions {
  std::size_t arithmetic = 0;  ///< sums, products, fused ones, minima, maxima: operations on bounds
  std::size_t selection =
      0;  ///< blends, masked moves, comparisons, logic: the same two ports, no bound
  std::size_t moves = 0;  ///< loads, stores, copies, broadcasts, unmasked
  std::size_t bytes = 0;  ///< of all code, up to the last instruction of each symbol
};

/// Counts what a listing of `objdump -d --no-show-raw-insn` has between the heads of symbols that
/// contain `symbol`. Code without loops runs as often as it is written.
[[nodiscard]] VectorInstructions count_instructions(std::string_view listing,
                                                    std::string_view symbol);

/// The listing of an object in memory; nullopt where there is no objdump.
[[nodiscard]] std::optional<std::string> disassemble(const std::string& object);

}  // namespace regulus::bench
