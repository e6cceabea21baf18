// SPDX-License-Identifier: GPL-3.0-or-later
// Translates exact mathematics to operations of packs. Every decision about the machine code is
// made here.
#pragma once

#include <cstdint>
#include <vector>

#include "codegen/kernel/pack/partition.hpp"
#include "codegen/kernel/program/module.hpp"
#include "codegen/kernel/program/program.hpp"
#include "runtime/machine/pack_program.hpp"

namespace regulus::detail {

inline constexpr std::size_t kOperationsPerPart = 64;

/// A function of a kernel as a list of operations, with notes for readers of the list.
struct SelectedFunction {
  static constexpr NodeId kNoNode = static_cast<NodeId>(-1);

  /// A step of the plan that begins at an instruction, for a comment there.
  struct Mark {
    std::uint32_t instruction;
    std::size_t step;
  };

  FunctionPlan plan;
  machine::PackFunction code;
  std::vector<NodeId> nodes;  ///< the node of each instruction, or kNoNode
  std::vector<Mark> marks;    ///< first steps of outputs and of parts, in the order of the list
};

/// Chooses the operations of a program.
///
///   products inside sums   one mul_add, rounded once, if only the sum reads the product; a − b·c
///                          if a factor is exact doubles, whose negation is exact
///   signs                  moved into the difference or the exact factor that they precede
///   sines and cosines      of one argument in one part: one operation
///   powers                 by squaring, each step checked, if the result may overflow
///   sums over a row of K   as exact doubles (exact_nodes.hpp)
///   factors                the interval that is used more often goes to the left, where packs test
///                          signs
///
/// Requires  a well formed program; operations_per_part ≥ 1; points row by row, `row_length` in
///           each row of K, or 0 if they are on no grid.
/// Ensures   machine::find_fault finds none in the list. Equal programs give equal lists. `meter`,
///           if any, counts nodes and operations.
[[nodiscard]] SelectedFunction select(const Program& program, std::size_t operations_per_part,
                                      std::size_t row_length, WorkMeter* meter = nullptr);

/// Selects the operations of all functions of a module.
///
/// Requires  a module that check_module accepts; std::invalid_argument otherwise. Throws
///           FormingStopped if `watch` stops it.
[[nodiscard]] machine::PackKernel select(const Module& module,
                                         std::size_t operations_per_part = kOperationsPerPart,
                                         const FormingWatch* watch = nullptr);

}  // namespace regulus::detail
